// Both files of a pair, read at the same time.
#pragma once

#include <string>

#include "host/demo/default_pair.h"
#include "host/job/progress_line.h"
#include "host/job/stop.h"
#include "host/source/read_limits.h"

namespace vkh {

/// Throws what read_mesh throws, of A before B. Shows how far it is, and ends with Interrupted when
/// it is to stop. After a bad A nobody waits for B, whose threads still look at `line` and `stop`:
/// the program must end by end_process.
MeshPair read_pair(const std::string& file_a, const std::string& file_b, ReadLimits limits,
                   ProgressLine& line, const Stop& stop);

}  // namespace vkh
