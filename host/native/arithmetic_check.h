// Checks that this thread computes as host/native's bounds assume: IEEE 754, each operation rounded
// to nearest, and nothing flushed to zero.
#pragma once

#include <string>

namespace vkh::native {

/// Says what is wrong with this thread's arithmetic, for people; empty: nothing was found.
std::string arithmetic_fault();

}  // namespace vkh::native
