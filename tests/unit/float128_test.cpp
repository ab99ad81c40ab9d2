// Float128 and UInt128 against MPFR at 113 bits, to nearest, and against GMP's integers.
#include "host/base/float128.h"

#include <doctest/doctest.h>
#include <gmpxx.h>
#include <mpfr.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "host/base/hypot3.h"

namespace {

using vkh::Float128;
using vkh::UInt128;

#if defined(_WIN32) || defined(VKH_SANITIZED)
constexpr int kRounds = 20'000;
#else
constexpr int kRounds = 400'000;
#endif
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class Big {
 public:
  Big() { mpfr_init2(number_, 113); }
  ~Big() { mpfr_clear(number_); }
  Big(const Big&) = delete;
  Big& operator=(const Big&) = delete;
  mpfr_t number_;
};

// Words whose bits are at random, runs of ones and zeros, or few: carries and ties are frequent.
uint64_t hard_word(std::mt19937_64& random) {
  const uint64_t word = random();
  switch (random() % 4) {
    case 0:
      return word;
    case 1:
      return ~uint64_t{0} << (word % 64);
    case 2:
      return ~uint64_t{0} >> (word % 64);
    default:
      return uint64_t{1} << (word % 64) | uint64_t{1} << (word / 64 % 64);
  }
}

double hard_double(std::mt19937_64& random, int exponents) {
  const uint64_t fraction = hard_word(random) >> 12;
  const auto spread = static_cast<uint64_t>(2 * exponents + 1);
  const uint64_t field = 1023 - static_cast<uint64_t>(exponents) + random() % spread;
  return std::bit_cast<double>((random() & 1) << 63 | field << 52 | fraction);
}

struct Operand {
  Float128 ours;
  Big theirs;
  // Three doubles, each of the last bits of the one before or below: often all of 113 bits.
  explicit Operand(std::mt19937_64& random) {
    double part = hard_double(random, 60);
    ours = part;
    mpfr_set_d(theirs.number_, part, MPFR_RNDN);
    for (const uint64_t parts = random() % 3; const int i : {0, 1}) {
      if (static_cast<uint64_t>(i) >= parts) break;
      part *= std::ldexp(hard_double(random, 0), -50 - static_cast<int>(random() % 8));
      ours += part;
      mpfr_add_d(theirs.number_, theirs.number_, part, MPFR_RNDN);
    }
  }
};

// Every bit: what is left after the double next to it fits into two more.
bool same(const Float128& ours, const Big& theirs) {
  Float128 left = ours;
  Big sum;
  mpfr_set_zero(sum.number_, 1);
  for (int part = 0; part < 3; ++part) {
    const auto near = static_cast<double>(left);
    mpfr_add_d(sum.number_, sum.number_, near, MPFR_RNDN);
    left -= near;
  }
  return left == 0 && mpfr_equal_p(sum.number_, theirs.number_) != 0 &&
         static_cast<double>(ours) == mpfr_get_d(theirs.number_, MPFR_RNDN);
}

bool agrees(const Operand& x, const Operand& y) {
  Big result;
  mpfr_add(result.number_, x.theirs.number_, y.theirs.number_, MPFR_RNDN);
  bool agree = same(x.ours + y.ours, result);
  mpfr_sub(result.number_, x.theirs.number_, y.theirs.number_, MPFR_RNDN);
  agree = agree && same(x.ours - y.ours, result);
  mpfr_mul(result.number_, x.theirs.number_, y.theirs.number_, MPFR_RNDN);
  agree = agree && same(x.ours * y.ours, result);
  mpfr_div(result.number_, x.theirs.number_, y.theirs.number_, MPFR_RNDN);
  agree = agree && same(x.ours / y.ours, result);
  return agree && (x.ours < y.ours) == (mpfr_less_p(x.theirs.number_, y.theirs.number_) != 0) &&
         (x.ours == y.ours) == (mpfr_equal_p(x.theirs.number_, y.theirs.number_) != 0);
}

bool same_double(double x, double y) {
  return std::isnan(x) ? std::isnan(y) : std::bit_cast<uint64_t>(x) == std::bit_cast<uint64_t>(y);
}

mpz_class integer(uint64_t x) {
  mpz_class result;
  mpz_import(result.get_mpz_t(), 1, 1, sizeof x, 0, 0, &x);
  return result;
}
mpz_class integer(const UInt128& x) { return (integer(x.high) << 64) + integer(x.low); }

}  // namespace

TEST_CASE("sums, products, quotients and comparisons are MPFR's of 113 bits, bit for bit") {
  std::mt19937_64 random(41);
  for (int round = 0; round < kRounds; ++round) {
    const Operand x(random), y(random);
    if (!agrees(x, y)) FAIL("round " << round);
  }
}

TEST_CASE("neighbours cancel as in MPFR") {
  std::mt19937_64 random(42);
  for (int round = 0; round < kRounds / 4; ++round) {
    Operand x(random), y(random);
    mpfr_set(y.theirs.number_, x.theirs.number_, MPFR_RNDN);
    y.ours = x.ours;
    const double nudge =
        static_cast<double>(x.ours) * std::ldexp(1, -static_cast<int>(random() % 120));
    y.ours += nudge;
    mpfr_add_d(y.theirs.number_, y.theirs.number_, nudge, MPFR_RNDN);
    if (!agrees(x, y)) FAIL("round " << round);
  }
}

TEST_CASE("products of four doubles keep all their bits, whatever their exponents") {
  std::mt19937_64 random(43);
  for (int round = 0; round < kRounds / 4; ++round) {
    Float128 ours = 1;
    Big theirs;
    mpfr_set_ui(theirs.number_, 1, MPFR_RNDN);
    for (int factor = 0; factor < 4; ++factor) {
      const double x = hard_double(random, 1022);
      ours = ours * x;
      mpfr_mul_d(theirs.number_, theirs.number_, x, MPFR_RNDN);
    }
    for (; mpfr_get_exp(theirs.number_) > 300; ours = ours * 0x1p-500)
      mpfr_mul_d(theirs.number_, theirs.number_, 0x1p-500, MPFR_RNDN);
    for (; mpfr_get_exp(theirs.number_) < -300; ours = ours * 0x1p500)
      mpfr_mul_d(theirs.number_, theirs.number_, 0x1p500, MPFR_RNDN);
    if (!same(ours, theirs)) FAIL("round " << round);
  }
}

TEST_CASE("a double becomes one and comes back; halves of the least and the largest are rounded") {
  std::mt19937_64 random(44);
  for (int round = 0; round < kRounds; ++round) {
    const auto x = std::bit_cast<double>(random());
    if (!same_double(static_cast<double>(Float128(x)), x)) FAIL("round " << round);
  }
  for (int round = 0; round < kRounds / 4; ++round) {  // subnormal results
    const double x = hard_double(random, 3), y = std::ldexp(hard_double(random, 2), -1040);
    Big theirs;
    mpfr_set_d(theirs.number_, x, MPFR_RNDN);
    mpfr_mul_d(theirs.number_, theirs.number_, y, MPFR_RNDN);
    mpfr_mul_d(theirs.number_, theirs.number_, 0x1p-20, MPFR_RNDN);
    const auto ours = static_cast<double>(Float128(x) * y * 0x1p-20);
    if (!same_double(ours, mpfr_get_d(theirs.number_, MPFR_RNDN))) FAIL("round " << round);
  }
  const Float128 least = 0x1p-1074, largest = std::numeric_limits<double>::max();
  CHECK(same_double(static_cast<double>(least * 0.5), 0.0));
  CHECK(same_double(static_cast<double>(least * -0.5), -0.0));
  CHECK(static_cast<double>(least * 0.75) == 0x1p-1074);
  CHECK(static_cast<double>(least * 1.5) == 0x1p-1073);
  CHECK(same_double(static_cast<double>(least * least), 0.0));
  CHECK(static_cast<double>(largest + Float128(0x1p969)) == std::numeric_limits<double>::max());
  CHECK(static_cast<double>(largest + Float128(0x1p970)) == kInfinity);
  CHECK(static_cast<double>(largest * largest * -1) == -kInfinity);
}

TEST_CASE("zeros of two signs, infinities and NaN behave as those of double") {
  const std::array<double, 9> all = {0.0,       -0.0,      1.0,        -1.0, 3.5,
                                     0x1p-1074, kInfinity, -kInfinity, kNan};
  for (const double x : all) {
    for (const double y : all) {
      CAPTURE(x);
      CAPTURE(y);
      const Float128 a = x, b = y;
      CHECK(same_double(static_cast<double>(a + b), x + y));
      CHECK(same_double(static_cast<double>(a - b), x - y));
      CHECK(same_double(static_cast<double>(a * b), x * y));
      CHECK(same_double(static_cast<double>(a / b), x / y));
      CHECK((a < b) == (x < y));
      CHECK((a <= b) == (x <= y));
      CHECK((a > b) == (x > y));
      CHECK((a == b) == (x == y));
      CHECK((a != b) == (x != y));
    }
  }
}

TEST_CASE("integers of 128 bits are GMP's, modulo 2^128") {
  std::mt19937_64 random(45);
  const mpz_class modulus = mpz_class(1) << 128;
  for (int round = 0; round < kRounds / 4; ++round) {
    const UInt128 x = {hard_word(random), hard_word(random)},
                  y = {hard_word(random), hard_word(random)};
    const mp_bitcnt_t places = random() % 128;
    const auto bits = static_cast<int>(places);
    const mpz_class shifted = (integer(x) << places) % modulus,
                    sum = (integer(x) + integer(y)) % modulus;
    const mpz_class difference = (integer(x) - integer(y) + modulus) % modulus;
    const mpz_class product = integer(x.low) * integer(y.low);
    const bool agree = integer(x << bits) == shifted &&
                       integer(x >> bits) == integer(x) >> places && integer(x + y) == sum &&
                       integer(x - y) == difference && (x < y) == (integer(x) < integer(y)) &&
                       integer(vkh::multiply(x.low, y.low)) == product &&
                       integer(vkh::multiply_by_halves(x.low, y.low)) == product;
    if (!agree) FAIL("round " << round);
  }
  CHECK(countl_zero(UInt128{0, 1}) == 127);
  CHECK(countl_zero(UInt128{1, 0}) == 63);
  CHECK(countr_zero(UInt128{1, 0}) == 64);
  CHECK(countr_zero(UInt128{0, 2}) == 1);
}

TEST_CASE("hypot3 is within 5 * 2^-53 of a length, and has the bits of libstdc++") {
  std::mt19937_64 random(48);
  Big exact, square, off;
  for (int round = 0; round < kRounds / 4; ++round) {
    const std::array<double, 3> v = {hard_double(random, 40), hard_double(random, 40),
                                     round % 3 == 0 ? 0 : hard_double(random, 40)};
    mpfr_set_zero(exact.number_, 1);
    for (const double x : v) {
      mpfr_set_d(square.number_, x, MPFR_RNDN);
      mpfr_sqr(square.number_, square.number_, MPFR_RNDN);
      mpfr_add(exact.number_, exact.number_, square.number_, MPFR_RNDN);
    }
    mpfr_sqrt(exact.number_, exact.number_, MPFR_RNDN);
    const double length = vkh::hypot3(v[0], v[1], v[2]);
    mpfr_d_sub(off.number_, length, exact.number_, MPFR_RNDN);
    const double allowed = 5 * 0x1p-53 * mpfr_get_d(exact.number_, MPFR_RNDN);
    if (std::abs(mpfr_get_d(off.number_, MPFR_RNDN)) > allowed) FAIL("round " << round);
#ifdef __GLIBCXX__
    if (length != std::hypot(v[0], v[1], v[2])) FAIL("round " << round);
#endif
  }
  CHECK(vkh::hypot3(0, 0, 0) == 0);
  CHECK(vkh::hypot3(3e-320, 0, 4e-320) > 4.9e-320);
  CHECK(vkh::hypot3(3e300, 4e300, 0) == 5e300);
}
