// Work on many items that its caller may end early.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>

#include "host/base/parallel.h"

namespace vkh {

/// Called between pieces of work, on the thread that began it; false ends the work. Empty: it goes
/// on.
using GoesOn = std::function<bool()>;

/// Calls work(i) for all of `count` items, several at once, in pieces of some 20 ms, and calls
/// `goes_on` before each piece. Returns whether all were done; otherwise only the first ones were.
/// No result depends on the size of pieces.
template <class Work>
bool each_while(size_t count, const GoesOn& goes_on, const Work& work) {
  constexpr size_t kFirst = 64, kRanges = 32, kMostOfRange = 1024;
  constexpr std::chrono::milliseconds kShort(10), kLong(40);
  size_t piece = kFirst;
  for (size_t first = 0; first < count;) {
    if (goes_on && !goes_on()) return false;
    const auto start = std::chrono::steady_clock::now();
    const size_t size = goes_on ? std::min(piece, count - first) : count - first;
    const size_t of_range = std::clamp<size_t>(size / kRanges, 1, kMostOfRange);
    for_each_range_of(of_range, size, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) work(first + i);
    });
    first += size;
    const auto took = std::chrono::steady_clock::now() - start;
    if (took < kShort) piece *= 2;
    if (took > kLong) piece = std::max(piece / 2, kFirst);
  }
  return true;
}

}  // namespace vkh
