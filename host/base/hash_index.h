// Finds equal elements of an array by hashing: the table holds element numbers, the keys stay with
// the caller.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace vkh {

inline uint64_t mix_bits(uint64_t hash, uint64_t word) {
  hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 29);
}

/// Positions are one if their bits are, after -0 became +0.
inline uint64_t position_bits(double x) { return std::bit_cast<uint64_t>(x + 0.0); }

inline uint64_t hash_position(const glm::dvec3& p) {
  return mix_bits(mix_bits(mix_bits(0, position_bits(p.x)), position_bits(p.y)),
                  position_bits(p.z));
}

inline bool same_position(const glm::dvec3& p, const glm::dvec3& q) {
  return position_bits(p.x) == position_bits(q.x) && position_bits(p.y) == position_bits(q.y) &&
         position_bits(p.z) == position_bits(q.z);
}

/// `Hash` takes an element number, `Same` two of them.
template <class Hash, class Same>
class HashIndex {
 public:
  HashIndex(size_t expected_count, Hash hash, Same same)
      : slots_(std::bit_ceil(2 * expected_count + 16), kFree), hash_(hash), same_(same) {}

  /// The first element inserted that equals `element`; `element` itself if it is new.
  uint32_t insert(uint32_t element) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    uint32_t& slot = find(element);
    if (slot != kFree) return slot;
    ++count_;
    return slot = element;
  }

 private:
  static constexpr uint32_t kFree = UINT32_MAX;

  uint32_t& find(uint32_t element) {
    const size_t mask = slots_.size() - 1;
    size_t at = hash_(element) & mask;
    while (slots_[at] != kFree && !same_(slots_[at], element)) at = (at + 1) & mask;
    return slots_[at];
  }

  void grow() {
    std::vector<uint32_t> old(2 * slots_.size(), kFree);
    old.swap(slots_);
    for (const uint32_t element : old) {
      if (element != kFree) find(element) = element;
    }
  }

  std::vector<uint32_t> slots_;
  size_t count_ = 0;
  Hash hash_;
  Same same_;
};

}  // namespace vkh
