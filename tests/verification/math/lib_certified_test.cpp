// shaders/math/certified.h against exact arithmetic: upward-rounded values are never below,
// downward-rounded ones never above, in any arithmetic that Vulkan allows.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/tally.h"
#include "tests/verification/model/exact_lib.h"
#include "tests/verification/model/lib_device.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr double kUlpExact = 0x1p-23;
constexpr double kTinyExact = 0x1p-60;

float non_negative(Random& random, int lo, int hi) { return std::abs(hard_float(random, lo, hi)); }

std::string scalar(const Device& device, double x, double got) {
  return std::string(device.name()) + ": " + hex(x) + " got " + hex(got);
}

/// x stands for anything that it can be n ulp away from.
void check_outward(const Device& device, Random& random, Tally& tally) {
  const float x = random.below(16) == 0 ? 0.0f : non_negative(random, -130, 10);
  const auto n = static_cast<float>(random.below(65));
  const double up = device.run([&] { return math::wide(math::round_up(x, n)); });
  const double down = device.run([&] { return math::wide(math::round_down(x, n)); });
  const Rational relative(static_cast<double>(n) * kUlpExact);
  // Under 2^-126, x may be a flushed normal number: nothing is left of it.
  const Rational given =
      static_cast<double>(x) < 0x1p-126 ? Rational(0) : Rational(static_cast<double>(x));
  const auto describe = [&] {
    return scalar(device, static_cast<double>(x), up) + " " + hex(down) +
           ", n = " + std::to_string(static_cast<int>(n));
  };
  tally.require(Rational(up) >= given / (1 - relative), "round_up", describe);
  tally.require(Rational(down) <= given / (1 + relative), "round_down", describe);
  tally.require(up >= 0x1p-126 && down >= 0.0, "what is flushed is under round_up", describe);
  const double value = static_cast<double>(x);
  if (value < 0x1p-30) return;
  const double n_wide = static_cast<double>(n);
  tally.measure("round_up, ulp too many", (up / value - 1.0) / kUlpExact - n_wide, describe);
  tally.measure("round_down, ulp too many", (1.0 - down / value) / kUlpExact - n_wide, describe);
}

void check_root(const Device& device, Random& random, Tally& tally) {
  const float x = random.below(16) == 0 ? 0.0f : non_negative(random, -140, 4);
  const double up = device.run([&] { return math::wide(math::sqrt_up(x)); });
  const double down = device.run([&] { return math::wide(math::sqrt_down(x)); });
  const Rational square(static_cast<double>(x));
  const auto describe = [&] {
    return scalar(device, static_cast<double>(x), up) + " " + hex(down);
  };
  tally.require(is_upper_bound(up, square), "sqrt_up", describe);
  tally.require(is_lower_bound(down, square), "sqrt_down", describe);
}

Stored any_vector(Random& random) {
  const int lo = -4 - static_cast<int>(random.below(70));
  Stored v = hard_vector(random, lo, lo + 4);
  if (random.below(4) == 0) v.hi[1] = v.hi[2] = v.lo[1] = v.lo[2] = 0.0f;
  if (random.below(16) == 0) v = {};
  return v;
}

void check_norms(const Device& device, Random& random, Tally& tally) {
  const Stored v = any_vector(random);
  struct {
    double up, down, length, sharp;
  } const got = device.run([&]() -> decltype(got) {
    const math::vec3 hi = math::given(v.hi);
    return {math::wide(math::norm_up(hi)), math::wide(math::norm_down(hi)),
            math::wide(math::length_up(math::dot3(hi, hi))),
            math::wide(math::sharp_norm_up(math::given(v)))};
  });
  const Rational square = square_of(fixed_vector(v.hi));
  const auto describe = [&] {
    return std::string(device.name()) + ": " + hex(v) + " got " + hex(got.up) + " " +
           hex(got.down) + " " + hex(got.sharp);
  };
  tally.require(is_upper_bound(got.up, square), "norm_up", describe);
  tally.require(is_upper_bound(got.length, square), "length_up", describe);
  tally.require(is_lower_bound(got.down, square), "norm_down", describe);
  const Rational whole = square_of(fixed_vector(v));
  tally.require(is_upper_bound(got.sharp, whole), "sharp_norm_up", describe);
  const double near = sqrt_near(whole);
  if (near <= 2e-15) return;
  tally.measure("sharp_norm_up, ulp", (got.sharp / near - 1.0) / kUlpExact, describe);
  tally.measure("sharp_norm_up, -ulp", (1.0 - got.sharp / near) / kUlpExact, describe);
  tally.measure("norm_up, -ulp", (1.0 - got.up / sqrt_near(square)) / kUlpExact, describe);
  tally.require(got.sharp <= near * (1.0 + 4.0 * kUlpExact), "sharp_norm_up is within 4 ulp",
                describe);
}

void check_quotient(const Device& device, Random& random, Tally& tally) {
  const float a = non_negative(random, -90, 3);
  const float b = non_negative(random, -50, 3);
  const double got = device.run([&] { return math::wide(math::quotient_down(a, b)); });
  const Rational exact = Rational(static_cast<double>(a)) / Rational(static_cast<double>(b));
  const auto describe = [&] {
    return scalar(device, static_cast<double>(a), got) + " over " + hex(static_cast<double>(b));
  };
  tally.require(Rational(got) <= exact, "quotient_down", describe);
  const double near = exact.get_d();
  tally.require(got >= near * (1.0 - 4.0 * kUlpExact) - 4.0 * kTinyExact,
                "quotient_down is within 4 ulp", describe);
  if (near > 0x1p-30) {
    tally.measure("quotient_down, -ulp", (got / near - 1.0) / kUlpExact, describe);
  }
  const double plain = device.run([&] { return math::wide(math::ratio(a, b)); });
  const bool small = static_cast<double>(b) <= 0x1p-96;
  tally.require(std::isfinite(plain) && (!small || plain == 0.0), "ratio is finite", describe);
}

void check_neighbours(const Device& device, Random& random, Tally& tally) {
  const float x = random.below(16) == 0 ? 0.0f : non_negative(random, -149, 20);
  const double up = device.run([&] { return math::wide(math::next_up(x)); });
  const double down = device.run([&] { return math::wide(math::next_down(x)); });
  const double value = static_cast<double>(x);
  const auto describe = [&] { return scalar(device, value, up) + " " + hex(down); };
  tally.require(up > value && down >= 0.0, "next_up", describe);
  if (value > kTinyExact) {
    tally.require(up == static_cast<double>(std::nextafter(x, 1e30f)) &&
                      down == static_cast<double>(std::nextafter(x, 0.0f)),
                  "the neighbours of a normal float", describe);
  } else {
    tally.require(up >= value + kTinyExact && down == 0.0, "kTiny above, 0 below", describe);
  }
}

}  // namespace

TEST_CASE("certified.h: outward rounding, roots, lengths, quotients") {
  const uint64_t count = case_count();
  Random random(20240615);
  Tally tally("certified.h");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const Device device(i);
    check_outward(device, random, tally);
    check_root(device, random, tally);
    check_norms(device, random, tally);
    check_quotient(device, random, tally);
    check_neighbours(device, random, tally);
  }
  tally.conclude(10 * count);
}

#ifndef VKH_TEST_VULKAN_MODEL
TEST_CASE("the tests' arithmetics reach the headers' operations") {
  // Volatile: a compiler that knows the operands rounds them itself, to nearest.
  volatile float one = 1.0f, little = 0x1p-40f, least = 0x1p-126f;
  for (uint64_t i = 0; i < kArithmetics.size(); ++i) {
    const Device device(i);
    CAPTURE(device.name());
    const float above = device.run([&] { return math::rounded({one, little}); });
    CHECK((above > 1.0f) == (device.arithmetic.rounding == _MM_ROUND_UP));
    const float below = device.run([&] { return math::rounded({-one, little}); });
    CHECK((below > -1.0f) == (!device.nearest() && device.arithmetic.rounding != _MM_ROUND_DOWN));
    const float half = device.run([&] { return math::two_product(least, 0.5f).hi; });
    CHECK((half == 0.0f) == device.arithmetic.flush);
  }
}
#endif
