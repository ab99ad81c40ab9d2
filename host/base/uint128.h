// Unsigned integers of 128 bits, and the one place that asks a compiler for its own arithmetic.
#pragma once

#include <bit>
#include <compare>
#include <cstdint>
#if defined(_MSC_VER) && defined(_M_X64)
#include <intrin.h>
#endif

namespace vkh {

/// high * 2^64 + low, modulo 2^128. Two's complement makes differences of it signed.
struct UInt128 {
  uint64_t high = 0, low = 0;

  friend constexpr bool operator==(const UInt128&, const UInt128&) = default;
  friend constexpr auto operator<=>(const UInt128&, const UInt128&) = default;

  friend constexpr UInt128 operator+(const UInt128& x, const UInt128& y) {
    const uint64_t sum = x.low + y.low;
    return {x.high + y.high + (sum < x.low ? 1 : 0), sum};
  }
  friend constexpr UInt128 operator-(const UInt128& x, const UInt128& y) {
    return {x.high - y.high - (x.low < y.low ? 1 : 0), x.low - y.low};
  }
  /// Shifts by 0 to 127 bits, as >> does.
  friend constexpr UInt128 operator<<(const UInt128& x, int bits) {
    if (bits == 0) return x;
    if (bits >= 64) return {x.low << (bits - 64), 0};
    return {x.high << bits | x.low >> (64 - bits), x.low << bits};
  }
  friend constexpr UInt128 operator>>(const UInt128& x, int bits) {
    if (bits == 0) return x;
    if (bits >= 64) return {0, x.high >> (bits - 64)};
    return {x.high >> bits, x.low >> bits | x.high << (64 - bits)};
  }
};

/// The number of zeros above the highest bit that is set; 128 for 0.
constexpr int countl_zero(const UInt128& x) {
  return x.high != 0 ? std::countl_zero(x.high) : 64 + std::countl_zero(x.low);
}

/// The number of zeros below the lowest bit that is set; 128 for 0.
constexpr int countr_zero(const UInt128& x) {
  return x.low != 0 ? std::countr_zero(x.low) : 64 + std::countr_zero(x.high);
}

/// Multiplies without rounding, by four products of 32 bits: for compilers that have nothing wider.
constexpr UInt128 multiply_by_halves(uint64_t x, uint64_t y) {
  const uint64_t mask = 0xffffffff;
  const uint64_t low = (x & mask) * (y & mask), cross = (x >> 32) * (y & mask);
  const uint64_t middle = (x & mask) * (y >> 32) + (cross & mask) + (low >> 32);  // under 2^64
  return {(x >> 32) * (y >> 32) + (cross >> 32) + (middle >> 32), middle << 32 | (low & mask)};
}

/// Multiplies without rounding.
inline UInt128 multiply(uint64_t x, uint64_t y) {
#if defined(__SIZEOF_INT128__)
  __extension__ typedef unsigned __int128 Wide;
  const Wide product = static_cast<Wide>(x) * y;
  return {static_cast<uint64_t>(product >> 64), static_cast<uint64_t>(product)};
#elif defined(_MSC_VER) && defined(_M_X64)
  UInt128 product;
  product.low = _umul128(x, y, &product.high);
  return product;
#else
  return multiply_by_halves(x, y);
#endif
}

/// Tells the processor that the memory at this address will be read soon.
inline void prefetch_to_read([[maybe_unused]] const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address, 0);
#endif
}

/// Tells the processor that the memory at this address will be written soon.
inline void prefetch_to_write([[maybe_unused]] const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address, 1);
#endif
}

}  // namespace vkh
