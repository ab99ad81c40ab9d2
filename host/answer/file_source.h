// The meshes and devices of a command: files are read and hashed, and devices are opened, on other
// threads, so that the end of its time, Ctrl-C and SIGTERM are handled even while a driver hangs.
#pragma once

#include <memory>

#include "host/answer/asking_state.h"
#include "host/answer/progress_line.h"
#include "host/answer/stop.h"

namespace vkh {

/// The files that the question names, or the built-in pair where it names none. read() throws what
/// reading does, and UsageError for a length that the files' units do not resolve; open() throws
/// what Device and Solver throw. Shows how far all work is, by `line`.
std::unique_ptr<AskingSource> files_of(const Question& question, const Stop& stop,
                                       std::shared_ptr<ProgressLine> line);

}  // namespace vkh
