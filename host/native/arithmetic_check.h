// Whether this thread computes as host/native's bounds rest on: IEEE 754, each operation rounded by
// itself to nearest, and nothing flushed to zero.
#pragma once

#include <string>

namespace vkh::native {

/// Says what is wrong with this thread's arithmetic, for people; empty: nothing was found.
std::string arithmetic_fault();

}  // namespace vkh::native
