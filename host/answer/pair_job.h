// A pair from files to an answer: read, opened and solved on other threads, so that the end of its
// time, Ctrl-C and SIGTERM are handled whatever a driver does meanwhile.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/answer/answer.h"
#include "host/answer/session.h"
#include "host/answer/stop.h"
#include "host/answer/survey_wish.h"
#include "host/mesh/mesh_pair.h"
#include "host/read/read_limits.h"

namespace vkh {

/// The request, before any file or device is touched.
struct PairJob {
  std::string command;             ///< Answer::command
  std::vector<std::string> words;  ///< Answer::words
  std::string file_a, file_b;      ///< both empty: the built-in pair
  std::string unit;                ///< the unit of files that do not name one; empty: unknown
  Length tolerance;
  bool tolerance_is_typed = true;      ///< false: a pair's own limit brings a gate's with it
  std::optional<Length> max;           ///< the limit of `gate`
  std::string face_max_a, face_max_b;  ///< files with limits per face; empty: none
  std::optional<PartOf> part;          ///< the part of A, alone
  std::optional<Length> known_lower;   ///< the bound that other parts have shown
  bool symmetric = false, verify = false;
  bool hashes = false;           ///< Input::sha256 is wanted
  bool proof = false;            ///< Answer::proof_a is wanted
  std::string device;            ///< DeviceRequest::selector
  bool several_devices = false;  ///< allows several, see open_session()
  bool caches = true;            ///< keeps compiled pipelines in the user's folder
  SurveyWish survey;
  bool asks_for_cells() const { return proof || survey.is_any(); }
  SolveOptions options;  ///< all but tolerance, limit, time and progress
  ReadLimits limits;     ///< all but the callbacks
};

/// An answer, with the objects that are destroyed only after it is printed.
struct Done {
  Answer answer;
  MeshPair pair;
  Session session;
};

/// Throws what reading, Device and Solver throw, and UsageError for a length that the files' units
/// do not resolve. When `stop` is asked for, the answer is what is known: its interval is true, if
/// only [0, infinity). Threads may then be left behind: the program must end by end_process.
Done run_job(const PairJob& job, const Stop& stop);

}  // namespace vkh
