// Changes a shader like a driver that regroups sums, even decorated ones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace vkh::layer {

struct Regrouped {
  std::vector<uint32_t> words;
  uint32_t sums = 0;  ///< how many of them
};

/// The module with (a + d) - (b + c) for every ((a - b) - c) + d of floats: equal in exact
/// arithmetic. A module that is broken stays as it is.
Regrouped regrouped(std::span<const uint32_t> words);

}  // namespace vkh::layer
