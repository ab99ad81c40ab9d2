// The promise of `closed`, in exact arithmetic and at every scale: the reported width is at most
// the reported tolerance, and that at most the requested fraction of the diagonal.
#include <cmath>
#include <limits>

#include "host/base/hypot3.h"
#include "host/base/rounding.h"
#include "tests/shapes/adversarial.h"
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "tests/support/tally.h"
#include "tests/verification/model/arithmetic.h"
#include "tests/verification/oracle/exact.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

Rational width_of(double lower, double upper) { return Rational(upper) - Rational(lower); }

/// A mesh of any scale, subnormal ones too, and often near the other.
double hard_double(Random& random, double near) {
  if (random.below(3) == 0) return near * (1 + random.range(0, 0x1p-40));
  if (random.below(8) == 0) return 0;
  return log_uniform(random, -1074, random.below(2) == 0 ? -1000 : 1000);
}

/// The promises of one report, whatever its status is.
void check_promises(const Report& r, double fraction, Tally& tally) {
  const auto describe = [&] {
    return hex(r.lower) + ", " + hex(r.upper) + " tolerance " + hex(r.tolerance) + " diagonal " +
           hex(r.diagonal_a);
  };
  const bool finite = std::isfinite(r.upper);
  const bool narrow = finite && width_of(r.lower, r.upper) <= Rational(r.tolerance);
  tally.require((r.status == Status::kClosed) == narrow, "closed where the width says", describe);
  const Rational asked = Rational(fraction) * Rational(r.diagonal_a);
  tally.require(Rational(r.tolerance) <= asked, "the tolerance is what was asked", describe);
  tally.require(!finite || r.diagonal_a == 0 ||
                    Rational(r.gap()) * Rational(r.diagonal_a) >= width_of(r.lower, r.upper),
                "the gap is rounded up", describe);
  tally.require(r.status != Status::kClosed || r.diagonal_a == 0 || r.gap() <= fraction,
                "a closed gap is at most the fraction", describe);
  tally.count("closed", r.status == Status::kClosed);
}

void check_symmetric(const Mesh& a, const Mesh& b, Tally& tally) {
  const SymmetricReport both = solver().symmetric(a, b);
  const CertifiedInterval whole = both.interval();
  const double tolerance = both.a_to_b.tolerance;
  check_promises(both.a_to_b, 1e-6, tally);
  tally.require(both.b_to_a.tolerance == tolerance, "one tolerance", [] { return ""; });
  tally.require((whole.status == Status::kClosed) ==
                    (width_of(whole.lower, whole.upper) <= Rational(tolerance)),
                "closed where the symmetric width says",
                [&] { return hex(whole.lower) + ", " + hex(whole.upper) + " " + hex(tolerance); });
}

}  // namespace

TEST_CASE("sums, products and quotients of doubles against exact rationals") {
  Random random(15);
  Tally tally("rounding");
  const uint64_t count = case_count() / 4;
  for (uint64_t i = 0; i < count; ++i) {
    const double x = log_uniform(random, -1074, 1000), y = hard_double(random, x);
    const auto describe = [&] { return hex(x) + " " + hex(y); };
    const double infinity = std::numeric_limits<double>::infinity();
    const Rational sum = Rational(x) + Rational(y), difference = Rational(y) - Rational(x);
    tally.require(Rational(add_up(x, y)) >= sum, "add_up", describe);
    tally.require(Rational(std::nextafter(add_up(x, y), -infinity)) < sum, "least", describe);
    tally.require(Rational(add_down(x, -y)) <= Rational(-difference), "add_down", describe);
    tally.require(Rational(std::nextafter(add_down(x, -y), infinity)) > Rational(-difference),
                  "largest", describe);
    const double width = width_up(x, y), tolerance = y - x;  // to nearest
    tally.require(is_within(x, y, tolerance) == (difference <= Rational(tolerance)), "is_within",
                  describe);
    tally.count("rounded down", Rational(tolerance) < difference && width > tolerance);
    const double fraction = log_uniform(random, -40, 0);
    const Rational product = Rational(fraction) * Rational(x);
    const double down = multiply_down(fraction, x);
    tally.require(Rational(down) <= product, "multiply_down", describe);
    tally.require(Rational(std::nextafter(down, infinity)) > product, "largest product", describe);
    const double up = divide_up(y, x);
    tally.require(std::isinf(up) || Rational(up) * Rational(x) >= Rational(y), "divide_up",
                  describe);
  }
  tally.conclude(count);
  CHECK(tally.counted("rounded down") > count / 20);
}

TEST_CASE("a tolerance that is the width rounded to nearest, below it, is not met") {
  SolveOptions options;
  options.tolerance_is_absolute = true;
  int missed = 0;
  for (uint64_t i = 0; i < 300; ++i) {
    // B is a point near each corner of A: far bounds, which a coarse run leaves far apart.
    const Mesh a = soup(500 + i, 1);
    Mesh b = noisy(a, 0.02, i);
    b.faces = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    options.wave_limit = 1;
    options.tolerance = 1e-3;
    Report r;
    double nearest = 0;
    for (int again = 0; again < 4 && nearest != options.tolerance; ++again) {
      if (again > 0) options.tolerance = nearest;
      r = solver().distance(a, b, options);
      nearest = r.upper - r.lower;
    }
    if (nearest != options.tolerance || Rational(nearest) >= width_of(r.lower, r.upper)) continue;
    ++missed;
    CAPTURE(hex(r.lower));
    CAPTURE(hex(r.upper));
    CHECK(r.status != Status::kClosed);
  }
  CHECK(missed >= 3);
}

// The points that are shown are as far apart as the interval says, whatever their size.
void check_witness(const Report& r) {
  const glm::dvec3 d = glm::dvec3(r.witness_a.point) - glm::dvec3(r.witness_b.point);
  const double distance = hypot3(d.x, d.y, d.z);
  CHECK(distance >= r.lower * (1 - 1e-6));
  CHECK(distance <= r.upper * (1 + 1e-6));
}

TEST_CASE("directed and symmetric runs from 2^-1060 to 2^1010") {
  Tally tally("scales");
  for (const int scale :
       {-1060, -1050, -1040, -1030, -1022, -1018, -1000, -300, 0, 300, 1000, 1010}) {
    for (uint64_t i = 0; i < 5; ++i) {
      const Mesh a = scaled(soup(300 + i, 3), scale), b = scaled(soup(400 + i, 2), scale);
      const Report r = solver().distance(a, b);
      check_promises(r, 1e-6, tally);
      check_symmetric(a, b, tally);
      if (scale >= -1000) check_witness(r);
    }
  }
  const Mesh point = single_triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  for (const double d : {5e-324, 1e-310, 0x1p-1018, 1.0, 1e300}) {
    const Mesh other = single_triangle({d, 0, 0}, {d, 0, 0}, {d, 0, 0});
    check_symmetric(point, other, tally);
    check_symmetric(point, single_triangle({0, 0, 0}, {d, 0, 0}, {0, d, 0}), tally);
    check_symmetric(single_triangle({0, 0, 0}, {d, 0, 0}, {0, d, 0}), other, tally);
  }
  tally.conclude(500);
  CHECK(tally.counted("closed") > 60);
}

TEST_CASE("the largest coordinates, whose diagonal is no double") {
  const double m = kLargest;
  const Mesh low = single_triangle({-m, -m, -m}, {-m, -m, -m}, {-m, -m, -m});
  const Mesh high = single_triangle({m, m, m}, {m, m, m}, {m, m, m});
  const Mesh face = single_triangle({m, 0, 0}, {-m, 0, 0}, {0, m, 0});
  const Mesh raised = single_triangle({m, 0, m / 4}, {-m, 0, m / 4}, {0, m, m / 4});
  Tally tally("the largest");
  for (const Mesh* a : {&low, &face, &raised}) {
    for (const Mesh* b : {&high, &face, &raised}) {
      const SymmetricReport both = solver().symmetric(*a, *b);
      check_promises(solver().distance(*a, *b), 1e-6, tally);
      check_promises(both.a_to_b, 1e-6, tally);
      CHECK(both.interval().lower <= both.interval().upper);
      CHECK(std::isfinite(both.a_to_b.tolerance));
      CHECK(std::isfinite(both.a_to_b.diagonal_a));
    }
  }
  tally.conclude(30);
  // Farther than any double: the lower bound is one, the upper bound is none.
  const Report far = solver().distance(low, high);
  CHECK(is_lower_bound(far.lower, Rational(12) * Rational(m) * Rational(m)));
  CHECK(far.lower > 0.99 * m);
  CHECK(far.upper == std::numeric_limits<double>::infinity());
  CHECK(far.status == Status::kPrecision);
  const Report lifted = solver().distance(raised, face);
  CHECK(is_lower_bound(lifted.lower, Rational(m) * Rational(m) / 16));
  CHECK(is_upper_bound(lifted.upper, Rational(m) * Rational(m) / 16));
  CHECK(lifted.status == Status::kClosed);
}
