// Finds the few elements that may equal another one, for several threads at once.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "host/base/thread_pool.h"
#include "host/base/uint128.h"

namespace vkh {

/// A Bloom filter of one hash. Every element marks the place of its hash, and equal ones mark the
/// same. Then an element whose place no other one marked is unlike all others. Among different
/// elements one in ten or so is taken for a repeat, so repeats still have to be compared.
class RepeatFilter {
 public:
  static constexpr size_t kLine = 512;  ///< places in a line of memory

  /// Has 16 places, a bit each, for each of `count` elements.
  RepeatFilter(const ThreadPool& pool, size_t count)
      : is_alone_(pool.threads() == 1),
        places_((count / (kLine * kTogether / 16) + 1) * kLine * kTogether),
        marked_(filled(pool, places_ / 64, uint64_t{0})),
        repeated_(filled(pool, places_ / kTogether / 64, uint64_t{0})) {}

  uint64_t places() const { return places_; }  ///< a multiple of kLine
  void fetch(uint64_t place) const { prefetch_to_write(&marked_[place / 64]); }
  void mark(uint64_t place) {
    if (set(marked_, place)) set(repeated_, place / kTogether);
  }
  /// Whether two elements may have marked the place, once all have been marked.
  bool is_repeated(uint64_t place) const {
    const uint64_t bit = place / kTogether;
    return (repeated_[bit / 64] >> bit % 64 & 1) != 0;
  }

 private:
  // Neighbours share a bit of `repeated_`, which then fits into a smaller cache.
  static constexpr uint64_t kTogether = 8;

  // Returns whether it was set. Adding to a word that others add to takes ten times as long.
  bool set(const Array<uint64_t>& words, uint64_t bit) const {
    const std::atomic_ref<uint64_t> word(words[bit / 64]);
    const uint64_t mask = uint64_t{1} << bit % 64;
    if (!is_alone_) return (word.fetch_or(mask, std::memory_order_relaxed) & mask) != 0;
    const uint64_t old = word.load(std::memory_order_relaxed);
    word.store(old | mask, std::memory_order_relaxed);
    return (old & mask) != 0;
  }

  bool is_alone_;
  uint64_t places_;
  Array<uint64_t> marked_, repeated_;
};

/// The elements from 0 to count - 1 for which is_chosen(element), in order.
template <class IsChosen>
Array<uint32_t> chosen_of(const ThreadPool& pool, size_t count, const IsChosen& is_chosen) {
  std::vector<std::vector<uint32_t>> parts(ThreadPool::parts_of(count));
  pool.for_parts(count, [&](size_t part, size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      if (is_chosen(static_cast<uint32_t>(e))) parts[part].push_back(static_cast<uint32_t>(e));
    }
  });
  std::vector<size_t> starts(parts.size());
  for (size_t part = 0; part < parts.size(); ++part) starts[part] = parts[part].size();
  Array<uint32_t> chosen(starts_of(starts));
  pool.for_each(parts.size(), [&](size_t part) {
    std::copy(parts[part].begin(), parts[part].end(), chosen.begin() + starts[part]);
  });
  return chosen;
}

}  // namespace vkh
