// Both files of a pair, read at the same time.
#pragma once

#include <string>

#include "host/demo/default_pair.h"
#include "host/source/read_limits.h"

namespace vkh {

/// Throws what read_mesh throws, of A before B. Says on a terminal how far it is, and ends with
/// Interrupted after Ctrl-C.
MeshPair read_pair(const std::string& file_a, const std::string& file_b, ReadLimits limits);

}  // namespace vkh
