// Both files of a pair, read at the same time.
#pragma once

#include <memory>
#include <string>

#include "host/demo/default_pair.h"
#include "host/job/progress_line.h"
#include "host/job/stop.h"
#include "host/source/read_limits.h"

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

}  // namespace vkh
