// Both files of a pair, read at the same time, and what is known of the answer before and after.
#pragma once

#include <memory>
#include <string>

#include "host/answer/pair_job.h"
#include "host/answer/progress_line.h"
#include "host/answer/stop.h"
#include "host/mesh/mesh_pair.h"
#include "host/read/read_limits.h"

namespace vkh {

/// How far reading is, and whether it is to go on. Threads that read keep it.
struct Reading {
  ProgressLine& line;
  const Stop& stop;
};

/// Throws what read_mesh throws, of A before B. Shows how far it is, and ends with Interrupted when
/// it is to stop. After a bad A nobody waits for B, whose threads go on and keep `reading`: the
/// program must end by end_process.
MeshPair read_pair(const std::string& file_a, const std::string& file_b, ReadLimits limits,
                   const std::shared_ptr<const Reading>& reading);

/// What is known before anything is read: [0, infinity).
Answer unread_answer(const PairJob& job);

/// Once the meshes are there: counts, units, lengths in them, and a first bound, which is returned:
/// no point of either is farther from the other than the joint diagonal. Throws UsageError for
/// units that do not go together and lengths that they do not resolve.
double take_meshes(const PairJob& job, const Mesh& a, const Mesh& b, Answer& answer);

/// How narrow the interval of such an answer has to be.
SolveOptions asked_options(const PairJob& job, const Answer& known);

/// After a run: what people should know about the memory that it took of `asked` bytes.
void add_memory_notes(uint64_t asked, Answer& answer);

}  // namespace vkh
