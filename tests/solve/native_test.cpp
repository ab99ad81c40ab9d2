// Whole pairs in doubles (host/native): generated hard pairs against the independent solver, exact
// distances and the witness by brute force in 113 bits; the same bits for any number of threads.
#include "host/native/native.h"

#include "host/native/arithmetic_check.h"
#include "host/native/levels.h"
// Its include guard keeps the float version of shaders/math out.
#include <doctest/doctest.h>

#include <cfenv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "host/base/float_environment.h"
#include "tests/shapes/hard_pairs.h"
#include "tests/support/sanitized.h"
#include "tests/verification/oracle/exact.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/report.h"
#include "vkhausdorff/verify.h"

using namespace vkh;
using namespace vkh::test;
using native::NativeOptions;
using native::NativeReport;
using native::NativeStatus;
using native::run_pair;

namespace {

uint64_t count_of(uint64_t usual) {
  const char* given = std::getenv("VKH_CASES");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : usual;
}

/// The witness as a report has it: barycentrics are exact.
bool has_witness_at(const Mesh& a, const Mesh& b, const NativeReport& r) {
  Report report;
  report.lower = r.lower;
  report.upper = r.upper;
  const UVec3& f = a.faces[r.witness.face_a];
  const auto& w = r.witness.barycentric;
  report.witness_a.barycentric = {w[0], w[1], w[2]};
  report.witness_a.point = w[0] * a.vertices[f.x] + w[1] * a.vertices[f.y] + w[2] * a.vertices[f.z];
  report.witness_a.set_face(a, r.witness.face_a);
  report.witness_b.set_face(b, r.witness.face_b);
  report.has_witness = true;
  return verify_witness(a, b, report).holds;
}

/// A power of two that brings the joint box to about 1: the reference squares twice.
int exponent_of(const MeshPair& pair) {
  const auto [lo_a, hi_a] = vkh::test::bounding_box(pair.a);
  const auto [lo_b, hi_b] = vkh::test::bounding_box(pair.b);
  const glm::dvec3 extent = glm::max(hi_a, hi_b) - glm::min(lo_a, lo_b);
  const double largest = std::max({extent.x, extent.y, extent.z});
  return largest > 0 ? -std::ilogb(largest) : 0;
}

/// One power of two may overflow.
Mesh rescaled(Mesh mesh, int exponent) {
  for (DVec3& v : mesh.vertices) {
    for (int i = 0; i < 3; ++i) v[i] = std::ldexp(v[i], exponent);
  }
  return mesh;
}

Interval reference_of(const HardPair& hard, int exponent) {
  return reference_hausdorff(rescaled(hard.pair.a, exponent), rescaled(hard.pair.b, exponent),
                             1e-10, 100'000);
}

NativeOptions options_for(const HardPair& hard, uint64_t seed) {
  NativeOptions options;
  options.tolerance = hard.tolerance;
  // Most runs are as users run them; some are out of memory or cut short.
  const uint64_t way = seed % 16;
  if (way == 0) options.level_limit = 1 + static_cast<uint32_t>(seed / 16 % 4);
  if (way == 1) options.memory_bytes = (1 + seed / 16 % 64) * native::kBytesOfCandidate;
  return options;
}

/// What is wrong with an interval; empty if nothing is.
std::string fault_of(const HardPair& hard, const NativeReport& r) {
  if (!(r.lower >= 0 && r.lower <= r.upper && std::isfinite(r.upper))) return "no interval";
  if (!has_witness_at(hard.pair.a, hard.pair.b, r)) return "a witness closer than lower";
  const int exponent = exponent_of(hard.pair);
  const Interval unit{std::ldexp(r.lower, exponent), std::ldexp(r.upper, exponent)};
  if (!unit.meets(reference_of(hard, exponent))) return "misses the reference";
  if (hard.exact && !(r.lower <= *hard.exact && *hard.exact <= r.upper)) return "misses exact h";
  return {};
}

bool same(const NativeReport& x, const NativeReport& y) {
  return x.lower == y.lower && x.upper == y.upper && x.candidates == y.candidates &&
         x.queries == y.queries && x.witness.face_a == y.witness.face_a &&
         x.witness.face_b == y.witness.face_b && x.witness.barycentric == y.witness.barycentric &&
         x.closed == y.closed;
}

}  // namespace

TEST_CASE("generated pairs: the interval meets the reference and exact distances") {
  const std::vector<std::string> families = family_names();
  uint64_t wrong = 0, closed = 0, limited = 0, noticed = 0;
  const uint64_t count = count_of(kIsSanitized ? 80 : 400);
  for (uint64_t i = 0; i < count; ++i) {
    const size_t family = i % families.size();
    const uint64_t seed = Random(0x67u * 0x9e3779b97f4a7c15u + i).bits();
    const HardPair hard = hard_pair(family, seed);
    const NativeOptions options = options_for(hard, seed);
    const NativeReport r = run_pair(hard.pair.a, hard.pair.b, options);
    const std::string fault = fault_of(hard, r);
    CAPTURE(families[family]);
    CAPTURE(seed);
    CAPTURE(r.lower);
    CAPTURE(r.upper);
    CHECK_MESSAGE(fault.empty(), fault);
    wrong += fault.empty() ? 0 : 1;
    closed += r.status == NativeStatus::kClosed ? 1 : 0;
    limited += seed % 16 < 2 ? 1 : 0;
    if (r.status == NativeStatus::kClosed) CHECK(r.upper - r.lower <= r.tolerance);
    NativeOptions two = options;
    two.threads = 2;
    if (i % 4 == 0) CHECK(same(r, run_pair(hard.pair.a, hard.pair.b, two)));
    // The same with a lower end that is raised by 1e-9 of itself must be seen to be false.
    NativeReport spoilt = r;
    spoilt.lower *= 1 + 1e-9;
    noticed += spoilt.lower > spoilt.upper || !has_witness_at(hard.pair.a, hard.pair.b, spoilt);
  }
  MESSAGE(count << " pairs, " << closed << " closed, " << limited << " limited, " << wrong
                << " wrong, " << noticed << " raised ends noticed");
  CHECK(noticed > count / 2);
  CHECK(closed + limited > count - count / 10);
}

TEST_CASE("closed forms") {
  const auto interval = [](const Mesh& a, const Mesh& b, double tolerance) {
    NativeOptions options;
    options.tolerance = tolerance;
    const NativeReport r = run_pair(a, b, options);
    CHECK(r.status == NativeStatus::kClosed);
    return Interval{r.lower, r.upper};
  };
  CHECK(interval(v_lid(), v_sheet(), 1e-9).contains(1.5 / std::sqrt(3.25)));
  const Interval raised_patch = interval(square_patch(1, 0.375), square_patch(1, 0.0), 1e-12);
  CHECK(raised_patch.contains(0.375));
  const Interval same_mesh = interval(torus(1, 0.25, 12, 8), torus(1, 0.25, 12, 8), 1e-6);
  CHECK(same_mesh.lower == 0);
  CHECK(same_mesh.upper == 0);
}

TEST_CASE("a pair far from the origin is measured as well as near it") {
  const glm::dvec3 far(0x1p40, -0x1p41, 0x1p39);
  const Mesh a = translated(v_lid(), far), b = translated(v_sheet(), far);
  const NativeReport r = run_pair(a, b);
  CHECK(r.status == NativeStatus::kClosed);
  CHECK(Interval{r.lower, r.upper}.contains(1.5 / std::sqrt(3.25)));
}

TEST_CASE("a placed vertex is within the displacement, exactly") {
  Random random(67);
  uint64_t moved = 0;
  const uint64_t count = 20'000;
  for (uint64_t i = 0; i < count; ++i) {
    // Far boxes have a centre, whose subtraction is rounded where a vertex is finer; small ones
    // beside large ones underflow.
    const double far = i % 2 == 0 ? std::ldexp(random.unit() + 0.5, 8) : 0;
    const auto fine = [&] { return far + std::ldexp(random.unit(), -int(random.below(20))); };
    const auto vertex = [&] { return glm::dvec3(fine(), fine(), fine()); };
    Mesh mesh;
    mesh.vertices = {vertex(), vertex(), vertex()};
    mesh.faces = {{0, 1, 2}};
    Box box = vkh::bounding_box(mesh);
    if (i % 4 == 1) mesh.vertices[1].x = std::ldexp(random.unit(), -1040 - int(random.below(30)));
    if (i % 4 == 1) box.hi.x = 0x1p100;
    const Frame frame = native::frame_of(box);
    const native::PlacedVertices placed = native::placed_vertices(frame, mesh);
    Rational farthest = 0;
    for (size_t v = 0; v < 3; ++v) {
      Rational sum = 0;
      const glm::dvec3 at(placed.at[v].x, placed.at[v].y, placed.at[v].z);
      for (int axis = 0; axis < 3; ++axis) {
        Rational exactly = Rational(mesh.vertices[v][axis]) - Rational(frame.centre[axis]);
        const auto power = static_cast<unsigned>(std::abs(frame.exponent));
        exactly = frame.exponent < 0 ? Rational(exactly >> power) : Rational(exactly << power);
        const Rational off = Rational(at[axis]) - exactly;
        sum += off * off;
      }
      farthest = std::max(farthest, sum);
    }
    moved += farthest > 0 ? 1 : 0;
    REQUIRE(Rational(placed.displacement) * Rational(placed.displacement) >= farthest);
  }
  CHECK(moved > count / 8);
}

TEST_CASE("scaled by a power of two, the ends scale exactly, down to subnormals") {
  const HardPair hard = hard_pair(0, 67);
  const NativeReport r = run_pair(hard.pair.a, hard.pair.b);
  for (const int exponent : {-900, -300, 300, 900}) {
    const NativeReport s = run_pair(scaled(hard.pair.a, exponent), scaled(hard.pair.b, exponent));
    CHECK(s.lower == std::ldexp(r.lower, exponent));
    CHECK(s.upper == std::ldexp(r.upper, exponent));
  }
}

TEST_CASE("arithmetic that bounds may not rest on is seen") {
  CHECK(native::arithmetic_fault().empty());
  for (const int direction : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(direction);
    const std::string fault = native::arithmetic_fault();
    std::fesetround(FE_TONEAREST);
    CHECK(fault == "sums are not rounded to the nearest double");
  }
#ifdef VKH_SSE
  const unsigned before = _mm_getcsr();
  for (const unsigned flag : {0x8000u, 0x40u}) {  // results; operands
    _mm_setcsr(before | flag);
    const std::string fault = native::arithmetic_fault();
    _mm_setcsr(before);
    CHECK(fault == "numbers under 2^-1022 are flushed to zero");
  }
#endif
}

TEST_CASE("the caller's rounding and flushing change no bit") {
  const HardPair hard = hard_pair(3, 6767);
  NativeOptions options;
  options.threads = 2;
  const NativeReport r = run_pair(hard.pair.a, hard.pair.b, options);
  for (const int direction : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(direction);
    const NativeReport turned = run_pair(hard.pair.a, hard.pair.b, options);
    std::fesetround(FE_TONEAREST);
    CHECK(same(r, turned));
  }
#ifdef VKH_SSE
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040u);  // flush results, take subnormal operands for 0
  const NativeReport flushed = run_pair(hard.pair.a, hard.pair.b, options);
  _mm_setcsr(before);
  CHECK(same(r, flushed));
#endif
}
