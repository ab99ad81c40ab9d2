// Finds equal elements of an array by hashing: the table holds element numbers, the keys stay with
// the caller. Files come from anywhere, so the hash has a secret: without one, 8.5 MB of chosen
// positions took 40 s.
#pragma once

#include <array>
#include <bit>
#include <chrono>
#include <cstdint>
#include <exception>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

namespace vkh {

using HashSecret = std::array<uint64_t, 2>;

/// The secret, drawn once a process. The results of a HashIndex do not depend on it.
inline const HashSecret& hash_secret() {
  static const HashSecret secret = [] {
    HashSecret words{};
    try {
      std::random_device source;
      for (uint64_t& word : words) word = uint64_t{source()} << 32 | source();
    } catch (const std::exception&) {  // no random source here: this secret is better than none
      const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
      words = {static_cast<uint64_t>(now), reinterpret_cast<uintptr_t>(&words)};
    }
    return words;
  }();
  return secret;
}

/// SipHash (Aumasson and Bernstein, 2012) of whole words, each as 8 little-endian bytes: without
/// the secret, words that collide cannot be chosen. It has 1-3 rounds, as is usual in hash tables.
template <int kRounds = 1, int kLastRounds = 3, size_t kCount>
uint64_t keyed_hash(const HashSecret& secret, const std::array<uint64_t, kCount>& words) {
  uint64_t a = secret[0] ^ 0x736f6d6570736575u, b = secret[1] ^ 0x646f72616e646f6du;
  uint64_t c = secret[0] ^ 0x6c7967656e657261u, d = secret[1] ^ 0x7465646279746573u;
  const auto mix = [&](int rounds) {
    for (; rounds > 0; --rounds) {
      a += b;
      c += d;
      b = std::rotl(b, 13) ^ a;
      d = std::rotl(d, 16) ^ c;
      a = std::rotl(a, 32) + d;
      c += b;
      d = std::rotl(d, 21) ^ a;
      b = std::rotl(b, 17) ^ c;
      c = std::rotl(c, 32);
    }
  };
  const auto absorb = [&](uint64_t word) {
    d ^= word;
    mix(kRounds);
    a ^= word;
  };
  for (const uint64_t word : words) absorb(word);
  absorb(uint64_t{8 * kCount} << 56);
  c ^= 0xff;
  mix(kLastRounds);
  return a ^ b ^ c ^ d;
}

/// Makes -0 +0, so that equal positions have equal bits.
inline uint64_t position_bits(double x) { return std::bit_cast<uint64_t>(x + 0.0); }

inline uint64_t hash_position(const HashSecret& secret, const glm::dvec3& p) {
  return keyed_hash(secret, std::array{position_bits(p.x), position_bits(p.y), position_bits(p.z)});
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
