// The host's check of the witness against exact arithmetic: it encloses d(p, B), accepts true
// bounds and refuses a lower bound that is too large by 1e-12 of the distance.
#include "vkhausdorff/verify.h"

#include <doctest/doctest.h>

#include <cmath>

#include "host/solve/coverage.h"
#include "tests/shapes/hard_pairs.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/model/arithmetic.h"
#include "tests/verification/oracle/exact.h"
#include "vkhausdorff/solver.h"

using namespace vkh;
using namespace vkh::test;

namespace {

/// The exact witness in units of 2^-20: every coordinate a dyadic rational.
struct ExactPoint {
  Rational x, y, z;
};

ExactPoint exact_witness(const Mesh& a, const Report& r) {
  const glm::uvec3 f = a.faces[r.witness_a.face];
  const auto coordinate = [&](int i) {
    Rational sum = 0;
    for (int k = 0; k < 3; ++k)
      sum += Rational(r.witness_a.barycentric[k]) * Rational(a.vertices[f[k]][i]);
    return sum;
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

struct RationalVector {
  Rational x, y, z;
};
RationalVector minus(const ExactPoint& p, const glm::dvec3& q) {
  return {p.x - Rational(q.x), p.y - Rational(q.y), p.z - Rational(q.z)};
}
Rational dot(const RationalVector& a, const RationalVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
RationalVector cross(const RationalVector& a, const RationalVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
RationalVector minus(const RationalVector& a, const RationalVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Rational to_segment(const RationalVector& r, const RationalVector& e) {
  const Rational along = dot(r, e), length = dot(e, e);
  if (along <= 0) return dot(r, r);
  const RationalVector beyond = minus(r, e);
  if (along >= length) return dot(beyond, beyond);
  return dot(r, r) - along * along / length;
}

Rational squared_distance(const ExactPoint& p, const Mesh& b, const glm::uvec3& f) {
  const RationalVector pa = minus(p, b.vertices[f.x]), pb = minus(p, b.vertices[f.y]),
                       pc = minus(p, b.vertices[f.z]);
  const RationalVector ab = minus(pa, pb), bc = minus(pb, pc), ca = minus(pc, pa);
  const RationalVector n = cross(ab, bc);
  if (dot(n, n) > 0 && dot(cross(ab, pa), n) >= 0 && dot(cross(bc, pb), n) >= 0 &&
      dot(cross(ca, pc), n) >= 0) {
    const Rational height = dot(pa, n);
    return height * height / dot(n, n);
  }
  return std::min({to_segment(pa, ab), to_segment(pb, bc), to_segment(pc, ca)});
}

Report any_report(Random& random, const Mesh& a) {
  Report r;
  r.witness_a.face = random.below(static_cast<uint32_t>(a.faces.size()));
  const uint32_t j = random.below((1u << 20) + 1), k = random.below((1u << 20) + 1 - j);
  r.witness_a.barycentric = {std::ldexp((1u << 20) - j - k, -20), std::ldexp(j, -20),
                             std::ldexp(k, -20)};
  if (random.below(4) == 0) r.witness_a.barycentric = {1, 0, 0};
  return r;
}

void check_enclosure(const HardPair& hard, Random& random) {
  Report r = any_report(random, hard.pair.a);
  const ExactPoint p = exact_witness(hard.pair.a, r);
  Rational squared = squared_distance(p, hard.pair.b, hard.pair.b.faces[0]);
  for (const glm::uvec3& f : hard.pair.b.faces)
    squared = std::min(squared, squared_distance(p, hard.pair.b, f));
  const WitnessCheck check = verify_witness(hard.pair.a, hard.pair.b, r);
  CHECK(is_lower_bound(check.distance_lower, squared));
  CHECK(is_upper_bound(check.distance_upper, squared));
  const double d = sqrt_near(squared);
  const auto [lo, hi] = bounding_box(joined(hard.pair.a, hard.pair.b));
  const double size = std::max({std::abs(lo.x), std::abs(hi.x), std::abs(lo.y), std::abs(hi.y),
                                std::abs(lo.z), std::abs(hi.z)});
  if (d > 1e-13 * size && d > 1e-290) {
    r.lower = d * (1 + 1e-12);
    CHECK_FALSE(verify_witness(hard.pair.a, hard.pair.b, r).holds);
    r.lower = d * (1 - 1e-12);
    CHECK(verify_witness(hard.pair.a, hard.pair.b, r).holds);
  }
}

}  // namespace

TEST_CASE("the witness's distance is enclosed, in every family") {
  const std::vector<std::string> names = family_names();
  const uint64_t rounds = std::max<uint64_t>(case_count() / 10'000, 2);
  Random random(20240901);
  for (uint64_t i = 0; i < rounds * names.size(); ++i) {
    const size_t family = i % names.size();
    const uint64_t seed = random.bits();
    CAPTURE(names[family]);
    CAPTURE(seed);
    check_enclosure(hard_pair(family, seed), random);
  }
}

TEST_CASE("a witness that is no point of A is refused") {
  const HardPair hard = hard_pair(0, 3);
  Report r;
  r.witness_a.barycentric = {0.5, 0.5, 0.5};
  CHECK_FALSE(verify_witness(hard.pair.a, hard.pair.b, r).holds);
  r.witness_a.barycentric = {1.5, -0.5, 0};
  CHECK_FALSE(verify_witness(hard.pair.a, hard.pair.b, r).holds);
  r.witness_a.barycentric = {1, 0, 0};
  r.witness_a.face = hard.pair.a.faces.size();
  CHECK_FALSE(verify_witness(hard.pair.a, hard.pair.b, r).holds);
}

TEST_CASE("what a run certifies passes, and not when it is raised") {
  for (const uint64_t seed : {1u, 2u, 3u, 4u}) {
    const HardPair hard = hard_pair(0, seed);
    Report r = solver().distance(hard.pair.a, hard.pair.b);
    const WitnessCheck check = verify_witness(hard.pair.a, hard.pair.b, r);
    CHECK(check.holds);
    CHECK(r.lower <= check.distance_upper);
    r.lower = std::nextafter(check.distance_upper, INFINITY);
    CHECK_FALSE(verify_witness(hard.pair.a, hard.pair.b, r).holds);
  }
}

TEST_CASE("parts of a face sum to the whole, or it is said which do not") {
  constexpr uint64_t kWhole = uint64_t{1} << 40;
  const auto check = [](const std::vector<uint64_t>& areas, bool bounded) {
    return check_coverage(areas, kWhole, bounded);
  };
  CHECK(check({kWhole, 3, 0, kWhole - 3}, true).holds);
  CHECK(check({kWhole, 3, 0, kWhole - 3}, true).whole == 2);
  CHECK(check({kWhole, kWhole / 2, 0, kWhole / 2}, true).closed == 0.75);
  CHECK_FALSE(check({kWhole - 1, 0}, true).holds);
  CHECK_FALSE(check({kWhole, 1}, true).holds);
  CHECK_FALSE(check({uint64_t{1} << 63, kWhole - (uint64_t{1} << 63)}, true).holds);
  CHECK(check({0, kWhole, 0, 0}, false).waiting == 1);
  CHECK(check({0, kWhole, 0, 0}, false).holds);
  CHECK_FALSE(check({0, kWhole, 0, 0}, true).holds);
}

TEST_CASE("all of A is accounted for, however the run ends") {
  const auto check = [&](const HardPair& hard, SolveOptions options) {
    options.engine.coverage = true;
    const Report r = solver().distance(hard.pair.a, hard.pair.b, options);
    REQUIRE(r.coverage_check);
    CAPTURE(r.coverage_check->whole);
    CAPTURE(r.coverage_check->waiting);
    CHECK(r.coverage_check->wrong == 0);
    CHECK(r.coverage_check->holds);
    if (options.wave_limit > 1000) CHECK(r.coverage_check->waiting == 0);
  };
  const size_t families = family_names().size();
  for (size_t family = 0; family < families; ++family) {
    CAPTURE(family);
    const HardPair hard = hard_pair(family, 100 + family);
    check(hard, {});
    SolveOptions cut;
    cut.wave_limit = 1 + static_cast<uint32_t>(family) % 4;
    cut.memory_bytes = 1;
    check(hard, cut);
    SolveOptions little;
    little.memory_bytes = 4096;  // natively some wait, and not all are given up
    check(hard, little);
  }
}
