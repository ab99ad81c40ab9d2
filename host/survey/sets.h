// Elements that are joined to sets.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace vkh {

/// Names each element's set by its first element.
class Sets {
 public:
  explicit Sets(size_t count) : first_(count) { std::iota(first_.begin(), first_.end(), 0u); }
  uint32_t of(uint32_t i) {
    while (first_[i] != i) i = first_[i] = first_[first_[i]];
    return i;
  }
  void join(uint32_t i, uint32_t j) {
    const uint32_t a = of(i), b = of(j);
    first_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> first_;
};

}  // namespace vkh
