// shaders/math/two_float.h against exact arithmetic: exact where + and - round to nearest, and
// within the stated multiples of kUlp2 in every arithmetic that Vulkan allows.
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/tally.h"
#include "tests/verification/model/exact_lib.h"
#include "tests/verification/model/lib_device.h"

using namespace vkh;
using namespace vkh::test;

namespace {

/// The error that a flush to zero may add: three components of a few results under 2^-126. It is
/// 2^-44 of the square of kTiny, which the callers' bounds add.
constexpr double kFlush = 0x1p-122;

double wide(float x) { return static_cast<double>(x); }
double size(float x) { return std::abs(wide(x)); }
double size(const Stored& p) { return glm::length(p.value()); }

std::string scalars(const Device& device, float a, float b) {
  return std::string(device.name()) + ": " + hex(wide(a)) + ", " + hex(wide(b));
}

/// A number close to -a in half of the cases: there a sum cancels.
float addend(Random& random, float a) {
  if (random.below(2) == 0) return hard_float(random, -40, 4);
  const float near = -a * (1.0f + static_cast<float>(random.range(-1, 1) * 0x1p-20));
  return random.below(2) == 0 ? near : near * 0.5f;
}

Stored subtrahend(Random& random, const Stored& a) {
  Stored b = hard_vector(random, -30, 0);
  if (random.below(2) == 0) return b;
  for (int i = 0; i < 3; ++i) {
    b.hi[i] = a.hi[i] + a.hi[i] * static_cast<float>(random.range(-1, 1) * 0x1p-20);
    b.lo[i] = low_part(random, b.hi[i]);
  }
  return b;
}

struct Pair {
  float hi, lo;
};

Pair pair(const math::Two& x) { return {math::answer(x.hi), math::answer(x.lo)}; }

bool has_bits(float x, int bits) {
  if (x == 0.0f) return true;
  const int64_t mantissa = exact::Dyadic(wide(x)).mantissa;
  return std::abs(mantissa) < int64_t{1} << bits;
}

void check_pair(const char* what, const Device& device, const Integer& error, double bound,
                Tally& tally, const auto& describe) {
  const double off = std::abs(to_double(error));
  if (device.nearest()) {
    tally.require(error == 0, (std::string(what) + " is exact to nearest").c_str(), describe);
  } else {
    tally.measure((std::string(what) + ", error / kUlp2 of the operands").c_str(),
                  off / (bound * 0x1p-44), describe);
  }
  tally.require(off <= bound * math::wide(math::kUlp2) / 2.0,
                (std::string(what) + " is off by at most kUlp2 / 2").c_str(), describe);
}

}  // namespace

TEST_CASE("two_float.h: two_sum and two_product") {
  const uint64_t count = case_count();
  Random random(20240612);
  Tally tally("two_sum, two_product");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const Device device(i);
    const float a = hard_float(random, -40, 4);
    const float b = addend(random, a);
    const Pair sum = device.run([&] { return pair(math::two_sum(a, b)); });
    const auto describe = [&] { return scalars(device, a, b); };
    check_pair("two_sum", device, fixed_sum(a, b) - fixed_sum(sum.hi, sum.lo), size(a) + size(b),
               tally, describe);

    // Products whose last bits are normal, so that nothing is flushed.
    const float x = hard_float(random, -39, 4), y = hard_float(random, -39, 4);
    const Pair product = device.run([&] { return pair(math::two_product(x, y)); });
    const auto describe_product = [&] { return scalars(device, x, y); };
    const double exact_product = wide(x) * wide(y);
    check_pair("two_product", device, fixed(exact_product) - fixed_sum(product.hi, product.lo),
               std::abs(exact_product), tally, describe_product);

    const float half = device.run([&] { return math::answer(math::upper_half(x)); });
    const auto describe_half = [&] { return scalars(device, x, half); };
    tally.require(has_bits(half, 12) && has_bits(x - half, 12), "halves have 12 bits",
                  describe_half);
  }
  tally.conclude(count);
}

TEST_CASE("two_float.h: a product that is flushed is off by less than kTiny's square") {
  const uint64_t count = case_count();
  Random random(20240613);
  Tally tally("two_product near 2^-126");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const Device device(i);
    const float a = hard_float(random, -100, -10), b = hard_float(random, -100, -10);
    const Pair product = device.run([&] { return pair(math::two_product(a, b)); });
    // Compares in doubles: the exact product may lie below 2^-150.
    const double off = std::abs(wide(a) * wide(b) - wide(product.hi) - wide(product.lo));
    const double bound = math::wide(math::kUlp2) * wide(a) * wide(b) / 2.0;
    tally.require(off <= std::abs(bound) + 0x1p-120, "two_product, flushed",
                  [&] { return scalars(device, a, b); });
  }
  tally.conclude(count);
}

namespace {

void check_error(const char* what, double off, double size, double factor, Tally& tally,
                 const auto& describe) {
  const double ulp2 = math::wide(math::kUlp2);
  const std::string claim = std::string(what) + " is off by at most " +
                            std::to_string(static_cast<int>(factor)) + " kUlp2 of the operands";
  tally.require(off <= factor * ulp2 * size + kFlush, claim.c_str(), describe);
  if (size > 0x1p-60) {
    tally.measure((std::string(what) + ", error / 2^-44 of the operands").c_str(),
                  off / (size * 0x1p-44), describe);
  }
}

Stored lib_difference(const Device& device, const Stored& a, const Stored& b) {
  return device.run(
      [&] { return math::answer(math::two_difference(math::given(a), math::given(b))); });
}

void check_difference(const Device& device, Random& random, Tally& tally) {
  const Stored a = hard_vector(random, -30, 0);
  const Stored b = subtrahend(random, a);
  const Stored got = lib_difference(device, a, b);
  const double off = length_near(fixed_vector(a) - fixed_vector(b) - fixed_vector(got));
  check_error("two_difference", off, size(a) + size(b), 1.0, tally,
              [&] { return std::string(device.name()) + ": " + hex(a) + " - " + hex(b); });
}

float weight(Random& random) {
  switch (random.below(4)) {
    case 0:
      return random.below(2) == 0 ? 0.0f : 1.0f;
    case 1:
      return std::ldexp(static_cast<float>(random.below(1u << 20)), -20);
    default:
      return hard_float(random, -20, 0);
  }
}

void check_combination(const Device& device, Random& random, Tally& tally) {
  const Stored u = hard_vector(random, -30, 0), v = hard_vector(random, -30, 0);
  const float x = weight(random), y = weight(random);
  // Half of them cancel to what is left of x u.
  const Stored base = random.below(2) == 0 ? subtrahend(random, stored(-wide(x) * u.value()))
                                           : hard_vector(random, -30, 0);
  const Stored got = device.run([&] {
    return math::answer(
        math::two_combination(math::given(base), x, math::given(u), y, math::given(v)));
  });
  const exact::Vector exact = fixed(1.0) * fixed_vector(base) + fixed(wide(x)) * fixed_vector(u) +
                              fixed(wide(y)) * fixed_vector(v);
  const double off = length_near(exact - fixed(1.0) * fixed_vector(got), 2 * kFixedBits);
  const double sizes = size(base) + size(x) * size(u) + size(y) * size(v);
  check_error("two_combination", off, sizes, 4.0, tally, [&] {
    return std::string(device.name()) + ": " + hex(base) + " + " + hex(wide(x)) + " " + hex(u) +
           " + " + hex(wide(y)) + " " + hex(v);
  });
}

void check_dot(const Device& device, Random& random, Tally& tally) {
  const Stored a = hard_vector(random, -20, 0);
  const Stored b = random.below(4) == 0 ? a : hard_vector(random, -20, 0);
  const Pair got = device.run([&] { return pair(math::two_dot(math::given(a), math::given(b))); });
  const Integer exact = exact::dot(fixed_vector(a), fixed_vector(b));
  const double off =
      std::abs(to_double(exact - fixed(1.0) * fixed_sum(got.hi, got.lo), 2 * kFixedBits));
  check_error("two_dot", off, size(a) * size(b), 8.0, tally,
              [&] { return std::string(device.name()) + ": " + hex(a) + " . " + hex(b); });
}

}  // namespace

TEST_CASE("two_float.h: two_difference, two_combination, two_dot") {
  const uint64_t count = case_count();
  Random random(20240614);
  Tally tally("two_difference, two_combination, two_dot");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const Device device(i);
    check_difference(device, random, tally);
    check_combination(device, random, tally);
    check_dot(device, random, tally);
  }
  tally.conclude(3 * count);
}
