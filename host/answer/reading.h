// Reads both files of a pair at the same time, and fills the answer before and after.
#pragma once

#include <memory>
#include <string>

#include "host/answer/pair_job.h"
#include "host/answer/progress_line.h"
#include "host/answer/stop.h"
#include "host/mesh/mesh_pair.h"
#include "host/read/read_limits.h"

namespace vkh {

/// The progress line and the stop of a read. Threads that read keep it.
struct Reading {
  ProgressLine& line;
  const Stop& stop;
};

/// Throws what read_mesh throws, A's error before B's. Shows the progress, and ends with
/// Interrupted when it is to stop. After a bad A the call does not wait for B, whose threads go on
/// and keep `reading`: the program must end by end_process.
MeshPair read_pair(const std::string& file_a, const std::string& file_b, ReadLimits limits,
                   const std::shared_ptr<const Reading>& reading);

/// The answer before anything is read: [0, infinity).
Answer unread_answer(const PairJob& job);

/// Fills in the answer's counts, its unit, its lengths in that unit, and a first upper bound, which
/// is also returned: no point of either mesh is farther from the other mesh than the joint diagonal
/// and both deltas. Throws UsageError for units that do not go together and for lengths that cannot
/// be converted to the files' unit, and InputError where a share is asked of a mesh without area.
double take_meshes(const PairJob& job, const Mesh& a, const Mesh& b, Answer& answer);

/// The options for an interval as narrow as such an answer needs.
SolveOptions asked_options(const PairJob& job, const Answer& known);

/// Adds, after a run, notes on the memory that it took of `asked` bytes.
void add_memory_notes(uint64_t asked, Answer& answer);

}  // namespace vkh
