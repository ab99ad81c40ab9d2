// Finds elements at equal positions, for several threads at once.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "host/base/hash_index.h"
#include "host/base/thread_pool.h"
#include "host/base/uint128.h"

namespace vkh {

/// A hash table with a secret, like HashIndex, but of a fixed size. `Position` gives an element's.
template <class Position>
class PositionIndex {
 public:
  /// Takes `count` elements at most: two slots of three are taken then.
  PositionIndex(const ThreadPool& pool, size_t count, Position position)
      : slots_(filled(pool, count + count / 2 + 16, kFree)), position_(position) {}

  /// Sets found[e - begin], for the elements from begin to end, to an element at the same position:
  /// the same one for all elements of a position, but the first thread decides which. Returns how
  /// many became their own.
  size_t insert(uint32_t begin, uint32_t end, uint32_t* found) {
    constexpr uint32_t kAhead = 16;  // slots fetched at once: each is a cache miss
    std::array<uint64_t, kAhead> hashes;
    size_t own = 0;
    for (uint32_t first = begin; first < end; first += std::min(kAhead, end - first)) {
      const uint32_t count = std::min(kAhead, end - first);
      for (uint32_t i = 0; i < count; ++i) {
        hashes[i] = hash_position(secret_, position_(first + i));
        prefetch_to_write(&slots_[start_of(hashes[i])]);
      }
      for (uint32_t i = 0; i < count; ++i) {
        found[first + i - begin] = insert(first + i, hashes[i]);
        own += found[first + i - begin] == first + i ? 1 : 0;
      }
    }
    return own;
  }

 private:
  static constexpr uint64_t kFree = UINT64_MAX;

  size_t start_of(uint64_t hash) const {
    return static_cast<size_t>(multiply(hash, slots_.size()).high);
  }

  // Inserts one element. A slot holds the hash's lower half, so that hardly any other position is
  // compared. Relaxed order suffices: positions existed before the threads.
  uint32_t insert(uint32_t element, uint64_t hash) {
    const uint64_t mine = hash << 32 | element;
    for (size_t at = start_of(hash);; at = at + 1 == slots_.size() ? 0 : at + 1) {
      const std::atomic_ref<uint64_t> slot(slots_[at]);
      uint64_t held = slot.load(std::memory_order_relaxed);
      if (held == kFree && slot.compare_exchange_strong(held, mine, std::memory_order_relaxed))
        return element;
      const auto other = static_cast<uint32_t>(held);
      if ((held ^ mine) >> 32 == 0 && same_position(position_(other), position_(element)))
        return other;
    }
  }

  Array<uint64_t> slots_;
  Position position_;
  HashSecret secret_ = hash_secret();
};

}  // namespace vkh
