// A's diagonal and its shares against exact arithmetic: the limit is enclosed for all exact corners
// of A within its delta.
#include <doctest/doctest.h>
#include <gmpxx.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/length.h"

namespace {

using namespace vkh;
using Q = mpq_class;

class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}
  uint64_t below(uint64_t count) { return engine_() % count; }
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double log_uniform(double low, double high) {
    return std::pow(10, std::log10(low) + unit() * (std::log10(high) - std::log10(low)));
  }

 private:
  std::mt19937_64 engine_;
};

/// A box somewhere, and how far its planes move at most.
struct Moved {
  Box box;
  double delta;
};

Moved random_box(Random& random) {
  const double size = random.log_uniform(1e-6, 1e6), far = random.log_uniform(1e-3, 1e3) * size;
  // Cubes move the most; an A that is long or flat moves less.
  const bool is_cube = random.below(2) == 0;
  Moved moved{};
  for (int i = 0; i < 3; ++i) {
    moved.box.lo[i] = far * (random.unit() - 0.5);
    moved.box.hi[i] = moved.box.lo[i] + (is_cube ? size : size * random.unit());
  }
  moved.delta = random.below(4) == 0 ? 0 : random.log_uniform(1e-15, 0.02) * diagonal(moved.box);
  return moved;
}

/// The square of the diagonal whose planes all move outward (1) or inward (-1) by delta.
Q squared_diagonal(const Moved& moved, int outward) {
  Q sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Q extent = Q(moved.box.hi[i]) - Q(moved.box.lo[i]) + 2 * outward * Q(moved.delta);
    sum += extent * extent;
  }
  return sum;
}

Q squared(const Q& x) { return x * x; }

struct Share {
  std::string text;
  Q exact;
};

/// From 1 % to 20,000 %, as people type it: in %, or as a number of diagonals.
Share random_share(Random& random) {
  const auto digits = static_cast<unsigned long>(1 + random.below(1000000000));
  const int exponent = static_cast<int>(random.below(3)) - 9;  // 1e-9 to 10
  Q number = digits;
  for (int k = exponent; k < 0; ++k) number /= 10;
  const bool is_percent = random.below(2) == 0;
  const std::string text = std::to_string(digits) + "e" + std::to_string(exponent);
  return {text + (is_percent ? "%" : "diag"), is_percent ? Q(number / 100) : number};
}

}  // namespace

TEST_CASE("a share of A's diagonal is enclosed, wherever the exact corners are") {
  Random random(1);
  int closest = 0;  // cases in which half of the width would have been too little
  for (int i = 0; i < 20000; ++i) {
    const Moved moved = random_box(random);
    const Diagonal of_a(diagonal(moved.box), moved.delta);
    const Share share = random_share(random);
    CAPTURE(moved.delta);
    CAPTURE(of_a.held());
    CAPTURE(share.text);
    const Limit limit = limit_in_files(parse_length("--max", share.text, PlainNumber::kRefused),
                                       "--max", "mm", of_a);
    for (const int outward : {-1, 0, 1}) {
      const Q exact = squared(share.exact) * squared_diagonal(moved, outward);
      CHECK(squared(Q(limit.within)) <= exact);
      CHECK(squared(Q(limit.beyond)) >= exact);
    }
    const Q half = share.exact * (Q(of_a.held()) + Q(of_a.most())) / 2;
    closest += squared(half) < squared(share.exact) * squared_diagonal(moved, 1) ? 1 : 0;
  }
  CHECK(closest > 9000);  // the cases are hard enough to notice half of the constant
}

TEST_CASE("a diagonal without a delta is what it was, to the bit") {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double held = random.log_uniform(1e-300, 1e300);
    const Diagonal of_a(held, 0);
    CHECK(of_a.held() == held);
    CHECK(of_a.least() == held);
    CHECK(of_a.most() == held);
  }
}

TEST_CASE("a diagonal that may be less than half of what it seems decides nothing") {
  const auto limit = [](double held, double delta) {
    return limit_in_files(parse_length("--max", "50%", PlainNumber::kRefused), "--max", "mm",
                          Diagonal(held, delta));
  };
  CHECK(limit(1, 0.1).within > 0);
  CHECK_THROWS_WITH_AS(limit(1, 0.2),
                       "--max '50%': A's diagonal is only known to lie between 0.307 and 1.7; give "
                       "the length itself, as 0.1abs or 0.1mm",
                       UsageError);
  CHECK_THROWS_AS(limit(1, 1), UsageError);
  CHECK_THROWS_AS(limit(0, 1e-9), UsageError);
  CHECK(Diagonal(1, 1).least() == 0);
  // What does not decide is not refused: no tolerance is met, and the interval is true.
  CHECK(in_files(parse_length("--tol", "50%", PlainNumber::kRefused), "--tol", "mm", Diagonal(1, 1))
            .within == 0);
}

// A tolerance in the files' unit, or a limit, knows nothing of the diagonal.
TEST_CASE("other lengths have nothing of A's delta") {
  for (const char* text : {"0.1abs", "0.1mm", "0.004in"}) {
    const Length length = parse_length("--max", text, PlainNumber::kRefused);
    const Limit with = limit_in_files(length, "--max", "mm", Diagonal(1, 0.2));
    const Limit without = limit_in_files(length, "--max", "mm", Diagonal(1, 0));
    CHECK(with.within == without.within);
    CHECK(with.beyond == without.beyond);
  }
}

TEST_CASE("limits of sides: the smaller and the larger are enclosed where both overlap") {
  const SidedLimits limits{{1, 4}, {2, 3}};
  CHECK(limits.smaller().within == 1);
  CHECK(limits.smaller().beyond == 3);
  CHECK(limits.larger().within == 2);
  CHECK(limits.larger().beyond == 4);
}
