// A question on its way to an answer: files are read and hashed, a device is opened and the pair is
// solved on other threads, so that the end of its time, Ctrl-C and SIGTERM are handled whatever a
// driver does meanwhile.
#pragma once

#include <memory>

#include "host/answer/session.h"
#include "host/answer/stop.h"
#include "vkhausdorff/answer.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/question.h"

namespace vkh {

/// An answer, with the objects that are destroyed only after it is printed: none but the answer,
/// where the question was ended before its meshes were solved.
struct Answered {
  Answer answer;
  std::shared_ptr<const ReadMesh> a, b;
  Session session;
};

/// Throws what reading, Device and Solver throw, and UsageError for a length that the files' units
/// do not resolve. When `stop` is asked for, the answer is what is known: its interval is true, if
/// only [0, infinity). Threads may then be left behind: the program must end by end_process.
Answered ask(const Question& question, const Stop& stop);

}  // namespace vkh
