#include "host/base/float128.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace vkh {
namespace {

constexpr UInt128 kTop = {uint64_t{1} << 63, 0};
constexpr int kDropped = 128 - 113;  // the bits of a word of 128 that rounding takes

// Shifts right. If a bit that is set falls off, the last bit is set instead: what is left then
// still lies strictly between the same two multiples of 4, so that a rounding further up is not
// misled.
UInt128 shifted_right(const UInt128& x, int64_t bits) {
  if (bits >= 128) return {0, 1};
  UInt128 shifted = x >> static_cast<int>(bits);
  if ((shifted << static_cast<int>(bits)) != x) shifted.low |= 1;
  return shifted;
}

// The upper half of the product; its last bit is set where the lower half is not 0.
UInt128 upper_product(const UInt128& x, const UInt128& y) {
  const UInt128 low = multiply(x.low, y.low), high = multiply(x.high, y.high);
  const UInt128 left = multiply(x.low, y.high), right = multiply(x.high, y.low);
  const UInt128 middle = UInt128{0, low.high} + UInt128{0, left.low} + UInt128{0, right.low};
  UInt128 upper = high + UInt128{0, left.high} + UInt128{0, right.high} + UInt128{0, middle.high};
  if ((middle.low | low.low) != 0) upper.low |= 1;
  return upper;
}

using Words = std::array<uint64_t, 4>;  // of 32 bits, the least first

Words words_of(const UInt128& x) {
  const uint64_t mask = 0xffffffff;
  return {x.low & mask, x.low >> 32, x.high & mask, x.high >> 32};
}

// One word of a quotient, of `rest` (five words, less than y * 2^32) by y, whose top bit is set,
// and what is left in `rest` (Knuth, The Art of Computer Programming 2, 4.3.1 D).
uint64_t quotient_word(std::array<uint64_t, 5>& rest, const Words& y) {
  constexpr uint64_t kBase = uint64_t{1} << 32;
  const uint64_t top = rest[4] << 32 | rest[3];
  uint64_t word = top / y[3], left = top % y[3];
  while (left < kBase && (word >= kBase || word * y[2] > (left << 32 | rest[2]))) {
    --word;
    left += y[3];
  }
  uint64_t borrow = 0, carry = 0;
  for (size_t i = 0; i < 5; ++i) {
    const uint64_t product = (i < 4 ? word * y[i] : 0) + carry;
    const uint64_t difference = rest[i] - (product & (kBase - 1)) - borrow;
    carry = product >> 32;
    borrow = difference >> 63;
    rest[i] = difference & (kBase - 1);
  }
  if (borrow == 0) return word;
  carry = 0;
  for (size_t i = 0; i < 5; ++i) {
    const uint64_t sum = rest[i] + (i < 4 ? y[i] : 0) + carry;
    carry = sum >> 32;
    rest[i] = sum & (kBase - 1);
  }
  return word - 1;
}

// x * 2^128 / y, rounded down, of x < y; its last bit is set where there is a remainder.
UInt128 quotient(const UInt128& x, const UInt128& y) {
  const Words divisor = words_of(y), dividend = words_of(x);
  std::array<uint64_t, 5> rest = {0, dividend[0], dividend[1], dividend[2], dividend[3]};
  Words words{};
  for (size_t i = 4; i-- > 0;) {
    words[i] = quotient_word(rest, divisor);
    if (i > 0) rest = {0, rest[0], rest[1], rest[2], rest[3]};
  }
  UInt128 result = {words[3] << 32 | words[2], words[1] << 32 | words[0]};
  if (rest != std::array<uint64_t, 5>{}) result.low |= 1;
  return result;
}

// Compares the sizes of numbers that are not NaN.
struct Size {
  int32_t exponent;
  UInt128 size;
  friend auto operator<=>(const Size&, const Size&) = default;
};

}  // namespace

// The value is size * 2^(exponent - 127), and size is not 0; its last bit may stand for what lies
// beyond it, of either size: 15 bits are dropped, or 14 after a shift.
Float128 Float128::rounded(bool is_negative, int32_t exponent, UInt128 size) {
  const int zeros = countl_zero(size);
  size = size << zeros;
  exponent -= zeros;
  constexpr uint64_t kUnit = uint64_t{1} << kDropped, kHalf = kUnit / 2;
  const uint64_t rest = size.low & (kUnit - 1);
  size.low -= rest;
  if (rest < kHalf || (rest == kHalf && (size.low & kUnit) == 0))
    return {is_negative, exponent, size};
  size = size + UInt128{0, kUnit};
  if (size == UInt128{}) return {is_negative, exponent + 1, kTop};
  return {is_negative, exponent, size};
}

// A double that sums, products and quotients treat as this number where one of the two is 0,
// infinite or NaN.
double Float128::stand_in() const {
  if (is_nan()) return std::numeric_limits<double>::quiet_NaN();
  const double size = is_zero() ? 0 : is_finite() ? 1 : std::numeric_limits<double>::infinity();
  return is_negative_ ? -size : size;
}

Float128::Float128(double x) : is_negative_(std::signbit(x)) {
  const auto bits = std::bit_cast<uint64_t>(x);
  const uint64_t fraction = bits << 12;
  const auto field = static_cast<int32_t>(bits >> 52 & 0x7ff);
  if (field == 0x7ff) {
    *this = {is_negative_, kExponentBeyond, {kTop.high, fraction}};
  } else if (field != 0) {
    *this = {is_negative_, field - 1023, {kTop.high | fraction >> 1, 0}};
  } else if (fraction != 0) {
    const int zeros = std::countl_zero(fraction);
    *this = {is_negative_, -1023 - zeros, {fraction << zeros, 0}};
  }
}

Float128::operator double() const {
  if (is_zero() || !is_finite()) return stand_in();
  if (exponent_ > 1023) return stand_in() * std::numeric_limits<double>::infinity();
  const int kept = exponent_ >= -1022 ? 53 : 53 - std::min(-1022 - exponent_, 54);
  if (kept < 0) return stand_in() * 0.0;
  const int dropped = 128 - kept;
  uint64_t fraction = kept == 0 ? 0 : size_.high >> (dropped - 64);
  const UInt128 rest = kept == 0 ? size_ : size_ - UInt128{fraction << (dropped - 64), 0};
  const UInt128 half = UInt128{0, 1} << (dropped - 1);
  if (rest > half || (rest == half && (fraction & 1) != 0)) ++fraction;
  // The fraction has its leading bit, which adds 1 to the exponent's field; a carry adds one more.
  const auto field = static_cast<uint64_t>(exponent_ >= -1022 ? exponent_ + 1022 : 0);
  const uint64_t sign = is_negative_ ? uint64_t{1} << 63 : 0;
  return std::bit_cast<double>(sign | ((field << 52) + fraction));
}

Float128 Float128::operator-() const {
  Float128 negative = *this;
  negative.is_negative_ = !is_negative_;
  return negative;
}

Float128 operator+(const Float128& a, const Float128& b) {
  if (!a.is_finite() || !b.is_finite() || (a.is_zero() && b.is_zero()))
    return {a.stand_in() + b.stand_in()};
  if (a.is_zero() || b.is_zero()) return a.is_zero() ? b : a;
  const bool is_b_larger = Size{a.exponent_, a.size_} < Size{b.exponent_, b.size_};
  const Float128 &large = is_b_larger ? b : a, &small = is_b_larger ? a : b;
  const UInt128 other =
      shifted_right(small.size_, int64_t{large.exponent_} - int64_t{small.exponent_});
  if (a.is_negative_ != b.is_negative_) {
    // Where a bit fell off, the difference is at most one bit shorter than the larger size.
    const UInt128 size = large.size_ - other;
    if (size == UInt128{}) return {};
    return Float128::rounded(large.is_negative_, large.exponent_, size);
  }
  const UInt128 size = large.size_ + other;
  if (!(size < other)) return Float128::rounded(large.is_negative_, large.exponent_, size);
  UInt128 half = shifted_right(size, 1);
  half.high |= kTop.high;
  return Float128::rounded(large.is_negative_, large.exponent_ + 1, half);
}

Float128 operator*(const Float128& a, const Float128& b) {
  if (!a.is_finite() || !b.is_finite() || a.is_zero() || b.is_zero())
    return {a.stand_in() * b.stand_in()};
  return Float128::rounded(a.is_negative_ != b.is_negative_, a.exponent_ + b.exponent_ + 1,
                           upper_product(a.size_, b.size_));
}

Float128 operator/(const Float128& a, const Float128& b) {
  if (!a.is_finite() || !b.is_finite() || a.is_zero() || b.is_zero())
    return {a.stand_in() / b.stand_in()};
  const bool is_larger = !(a.size_ < b.size_);
  return Float128::rounded(a.is_negative_ != b.is_negative_,
                           a.exponent_ - b.exponent_ - (is_larger ? 0 : 1),
                           quotient(is_larger ? a.size_ >> 1 : a.size_, b.size_));
}

std::partial_ordering operator<=>(const Float128& a, const Float128& b) {
  if (a.is_nan() || b.is_nan()) return std::partial_ordering::unordered;
  if (a.is_zero() && b.is_zero()) return std::partial_ordering::equivalent;
  if (a.is_negative_ != b.is_negative_)
    return a.is_negative_ ? std::partial_ordering::less : std::partial_ordering::greater;
  const Size of_a = {a.exponent_, a.size_}, of_b = {b.exponent_, b.size_};
  return a.is_negative_ ? of_b <=> of_a : of_a <=> of_b;
}

}  // namespace vkh
