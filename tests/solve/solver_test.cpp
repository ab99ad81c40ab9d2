// Whole runs against closed forms and against themselves: changes that must not change the answer,
// and changes that must change it by a known amount.
#include "vkhausdorff/solver.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "host/base/rounding.h"
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using namespace vkh::test;

/// One for the program, as a caller would keep it: buffers and pipelines go from run to run.
Report distance(const Mesh& a, const Mesh& b, const SolveOptions& options = {}) {
  static Solver& solver = kept<Solver>(test_device());
  const Report r = solver.distance(a, b, options);
  CHECK(r.lower >= 0);
  CHECK(r.lower <= r.upper);
  return r;
}

std::string text(const Report& r) {
  return std::string(status_name(r.status)) + " [" + std::to_string(r.lower) + ", " +
         std::to_string(r.upper) + "] gap " + std::to_string(r.gap() * 1e6) + "e-6, " +
         std::to_string(r.waves) + " waves";
}

SolveOptions with_tolerance(double tolerance, bool is_absolute = false) {
  SolveOptions options;
  options.tolerance = tolerance;
  options.tolerance_is_absolute = is_absolute;
  return options;
}

// Bounds are float32 on the device, and each distance costs a few ulp of itself: a tolerance of
// fewer than 10 ulp of h cannot be counted on. Such a run ends with at most 32, and reports it.
constexpr double kUlp = 0x1p-23;
constexpr double kResolvedUlp = 10, kWidestUlp = 32;

/// The run closes at the default tolerance, if float32 can, and its interval holds `exact`, which
/// is itself rounded.
Report check_closed(const Mesh& a, const Mesh& b, double exact) {
  const Report r = distance(a, b);
  CAPTURE(text(r));
  CAPTURE(exact);
  CHECK(r.tolerance == multiply_down(1e-6, r.diagonal_a));
  CHECK(r.lower <= exact * (1 + 1e-14));
  CHECK(r.upper >= exact * (1 - 1e-14));
  if (r.tolerance >= kResolvedUlp * kUlp * exact) {
    CHECK(r.status == Status::kClosed);
    CHECK(r.upper - r.lower <= r.tolerance);
  } else {
    CHECK((r.status == Status::kClosed || r.status == Status::kPrecision));
    CHECK(r.upper - r.lower <= kWidestUlp * kUlp * exact);
  }
  CHECK((r.status == Status::kClosed) == is_within(r.lower, r.upper, r.tolerance));
  return r;
}

void check_meets(const Report& r, const Report& other) {
  CAPTURE(text(r));
  CAPTURE(text(other));
  CHECK(interval(r).meets(interval(other)));
}

/// Pairs of every kind that close at 1e-6.
std::vector<NamedPair> pairs() {
  return {{"spheres", icosphere(1.0, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05})},
          {"V", v_lid(), v_sheet()},
          {"twin", height_field(24, 1), height_field(24, 3)},
          {"soups", soup(1, 60), soup(2, 80)},
          {"torus", torus(1.0, 0.3, 24, 12), noisy(torus(1.0, 0.3, 24, 12), 0.02, 5)}};
}

/// The witness proves `lower`: a point of its face of A, that far from B, and the point of
/// its face of B that is closest.
void check_witness(const Report& r, const Mesh& a, const Mesh& b) {
  REQUIRE(r.witness_a.face < a.faces.size());
  REQUIRE(r.witness_b.face < b.faces.size());
  const auto [pa, pb, pc] = corners(a, static_cast<uint32_t>(r.witness_a.face));
  const double size = diagonal(joined(a, b));
  CHECK(point_triangle_distance(r.witness_a.point, pa, pb, pc) <= 1e-14 * size);
  const double there = point_mesh_distance(r.witness_a.point, b);
  CHECK(there >= r.lower - 1e-14 * size);
  CHECK(there <= r.upper + 1e-14 * size);
  CHECK(glm::distance(r.witness_a.point, r.witness_b.point) <= there + 1e-6 * size);
}

}  // namespace

// --- Closed forms ---

TEST_CASE("a square patch moved straight up is as far as it was moved") {
  const Mesh patch = square_patch(8, 0.0);
  for (const double delta : {1e-6, 1e-5, 1e-4, 1e-3, 0.03125, 0.1, 1.0, 10.0}) {
    CAPTURE(delta);
    check_closed(square_patch(8, delta), patch, delta);
    check_closed(square_patch(5, delta), patch, delta);  // no corner above another
  }
}

TEST_CASE("a square patch moved sideways sticks out by as much") {
  const Mesh patch = square_patch(6, 0.0);
  for (const double delta : {0.001, 0.25, 3.0}) {
    check_closed(translated(patch, {delta, 0, 0}), patch, delta);
    check_closed(translated(patch, {delta, delta, 0}), patch, std::sqrt(2.0) * delta);
  }
}

TEST_CASE("concentric icospheres of the same directions are as far as their radii differ") {
  // The corners of A lie above those of B, and the farthest points of a sphere from a convex body
  // inside it are corners; the nearest point of B to r u is u where u is a corner of B.
  for (const double radius : {1.0 + 1e-4, 1.25, 3.0}) {
    check_closed(icosphere(radius, 3), icosphere(1.0, 3), radius - 1);
  }
}

TEST_CASE(
    "an outer sphere's farthest point is a corner, seen from the inner one the middle of a face") {
  const Mesh outer = icosphere(2.0, 0);
  const Mesh inner = icosphere(1.0, 0);
  check_closed(outer, inner, 1.0);
  // From inside, a point's distance from the convex outer surface is that from the nearest face's
  // plane; it is largest where the inner sphere's surface is closest to the centre: the middle of
  // its faces, at half the outer inradius.
  const double inradius = std::sqrt((5 + 2 * std::sqrt(5.0)) / 15);  // of circumradius 1
  const Report r = check_closed(inner, outer, inradius);
  check_witness(r, inner, outer);
}

TEST_CASE("one far triangle and a large plane") {
  const Mesh plane = big_plane(1.0);
  for (const double height : {0.5, 4.0, 100.0}) {
    const Mesh dot = single_triangle({0, 0, height}, {0, 0, height}, {0, 0, height});
    CHECK(distance(dot, plane).lower <= height);
    CHECK(distance(dot, plane).upper >= height);
    const Mesh peak = single_triangle({0.1, 0, 0}, {0, 0.1, 0}, {0, 0, height});
    check_closed(peak, plane, height);
  }
}

TEST_CASE("V against its hull: the maximum is inside a face whose corners are all on B") {
  const Report r = check_closed(v_lid(), v_sheet(), v_lid_distance());
  CHECK(r.lower > 0.832047);
  CHECK(r.upper < 0.832053);
  check_witness(r, v_lid(), v_sheet());
  check_closed(v_sheet(), v_lid(), 1.5);
  for (const double valley : {-0.75, -0.3, 0.5}) {
    check_closed(v_lid(), v_sheet(1.0, valley), v_lid_distance(1.0, valley));
    check_closed(v_lid(), v_sheet(0.01, valley), v_lid_distance(0.01, valley));
  }
}

TEST_CASE("1e-9 closes where h is a large part of the diagonal") {
  const auto check = [](const Mesh& a, const Mesh& b, double exact) {
    const Report r = distance(a, b, with_tolerance(1e-9));
    CAPTURE(text(r));
    CHECK(r.status == Status::kClosed);
    CHECK(r.lower <= exact);
    CHECK(exact <= r.upper);
  };
  for (const double gap : {0.3, 1.0, 7.0}) check(square_patch(4, gap), square_patch(3, 0.0), gap);
}

// The distance goes from 0 at the vertices to a third of the diagonal: the base must follow the
// lower bound. The last bit of a barycentric ends it, 2^-20 of a face of A that is as large as A.
TEST_CASE("3e-7 closes where the lower bound rises from 0") {
  for (const double valley : {-0.75, -0.3, 0.0, 0.5}) {
    const Report r = distance(v_lid(), v_sheet(1.0, valley), with_tolerance(3e-7));
    CAPTURE(text(r));
    CHECK(r.status == Status::kClosed);
    CHECK(r.lower <= v_lid_distance(1.0, valley));
    CHECK(v_lid_distance(1.0, valley) <= r.upper);
  }
}

TEST_CASE("a triangle against a triangle") {
  const Mesh t = single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  check_closed(t, t, 0);
  check_closed(single_triangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1}), t, 1);
  check_closed(single_triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0}), t, 1);
  check_closed(t, single_triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0}), 0);
  check_closed(single_triangle({5, 0, 0}, {6, 0, 0}, {5, 1, 0}), t, 5);
}

TEST_CASE(
    "a mesh against itself, or against more: [0, 0], wherever it is and however it is stored") {
  for (const Mesh& mesh : {icosphere(1.0, 3), torus(1.0, 0.3, 24, 12), square_patch(9, 0.25),
                           soup(5, 80), in_float32(icosphere(1.0, 3)),
                           in_float32(translated(square_patch(9, 0.25), {1e4, -1e4, 1e4})),
                           translated(soup(5, 80), {1e6, -2e6, 1e7 / 3}),
                           translated(icosphere(1.0, 3), {1e15 / 3, 0.1, 0.1})}) {
    CAPTURE(mesh.faces.size());
    const Mesh more = permuted(joined(mesh, translated(soup(6, 9), mesh.vertices[0])), 3);
    for (const Report& r : {distance(mesh, mesh, with_tolerance(1e-9)), distance(mesh, more),
                            solver().distance(mesh, solver().prepare(more))}) {
      CAPTURE(text(r));
      CHECK(r.lower == 0.0);
      CHECK(r.upper == 0.0);
      CHECK(r.gap() == 0.0);
      CHECK(r.status == Status::kClosed);
    }
    CHECK(solver().symmetric(mesh, mesh).interval().upper == 0.0);
  }
}

TEST_CASE("meshes that differ by less than what is stored are not one") {
  const Mesh a = soup(5, 80);  // 53 bits per coordinate, of which 49 are stored
  Mesh b = a;
  double& moved = b.vertices[17].y;
  moved = std::nextafter(moved, 0.0);
  for (const Report& r : {distance(a, b), solver().symmetric(a, b).a_to_b}) {
    CHECK(r.lower == 0.0);
    CHECK(r.upper > 0.0);
  }
}

TEST_CASE("a large mesh against itself is decided by its corners") {
  const Mesh a = icosphere(1.0, 5);     // 20,480 faces
  const Mesh b = height_field(118, 1);  // 27,848 faces
  for (const Mesh& mesh : {a, b}) {
    const Report r = distance(mesh, mesh);
    CAPTURE(text(r));
    CHECK(r.status == Status::kClosed);
    CHECK(r.waves <= 1);
    CHECK(r.upper <= r.tolerance);
    CHECK(r.lower <= r.tolerance);
  }
}

// --- Metamorphic ---

TEST_CASE("both meshes moved a million units away: the same distance") {
  for (const auto& [name, a, b] : pairs()) {
    const auto& called = name;
    CAPTURE(called);
    const Report here = distance(a, b);
    const glm::dvec3 far(1e6, -1e6, 5e5);
    // Moving rounds the coordinates themselves, by at most 2^-33 each.
    const Report there = distance(translated(a, far), translated(b, far));
    CAPTURE(text(here));
    CAPTURE(text(there));
    CHECK(there.status == Status::kClosed);
    CHECK(there.lower <= here.upper + 1e-9);
    CHECK(here.lower <= there.upper + 1e-9);
  }
}

TEST_CASE("scaling by a power of two scales the interval bit by bit") {
  for (const auto& [name, a, b] : pairs()) {
    const auto& called = name;
    CAPTURE(called);
    const Report one = distance(a, b);
    for (const int k : {-1000, -40, -3, 5, 60, 900}) {
      CAPTURE(k);
      const Report r = distance(scaled(a, k), scaled(b, k));
      CHECK(r.lower == std::ldexp(one.lower, k));
      CHECK(r.upper == std::ldexp(one.upper, k));
      CHECK(r.status == one.status);
      CHECK(r.candidates == one.candidates);
    }
  }
}

TEST_CASE("rotated together: the same distance") {
  for (const auto& [name, a, b] : pairs()) {
    const auto& called = name;
    CAPTURE(called);
    const Report turned = distance(rotated(a, {1, 2, 3}, 0.7), rotated(b, {1, 2, 3}, 0.7));
    CHECK(turned.status == Status::kClosed);
    const Report straight = distance(a, b);
    CHECK(turned.lower <= straight.upper + 1e-14);
    CHECK(straight.lower <= turned.upper + 1e-14);
  }
}

TEST_CASE("the order of faces, vertices and corners does not matter") {
  for (const auto& [name, a, b] : pairs()) {
    const auto& called = name;
    CAPTURE(called);
    const Report given = distance(a, b);
    check_meets(distance(permuted(a, 1), permuted(b, 2)), given);
    check_meets(distance(a, permuted(b, 3)), given);
  }
}

TEST_CASE("the other direction is another distance") {
  const Mesh small = square_patch(4, 0.0, 1.0);
  const Mesh large = square_patch(4, 0.0, 2.0);
  check_closed(small, large, 0);
  check_closed(large, small, std::sqrt(2.0));
}

TEST_CASE("vertices that no face uses, degenerate and duplicate faces do not matter") {
  for (const auto& [name, a, b] : pairs()) {
    const auto& called = name;
    CAPTURE(called);
    const Report plain = distance(a, b);
    std::vector<glm::dvec3> strays = a.vertices;
    strays.emplace_back(1e9, 0, 0);
    const Mesh stray = make_mesh("stray", strays, a.faces);
    CHECK(stray.counts.unreferenced == 1);
    check_meets(distance(stray, b), plain);
    check_meets(distance(with_duplicates(a, 1), with_duplicates(b, 2)), plain);
    // Faces of A that are corners or edges of other faces add no point.
    std::vector<glm::uvec3> faces = a.faces;
    for (const uint32_t f : {0u, 1u}) {
      faces.emplace_back(a.faces[f].x, a.faces[f].x, a.faces[f].x);
      faces.emplace_back(a.faces[f].x, a.faces[f].y, a.faces[f].x);
    }
    check_meets(distance(make_mesh("degenerate", a.vertices, faces), b), plain);
  }
}

TEST_CASE("meshes of degenerate faces only") {
  const Mesh segments = degenerate_faces(1, 30);
  const Mesh others = degenerate_faces(2, 30);
  for (const auto& [a, b] : {std::pair(segments, others), std::pair(segments, soup(3, 30)),
                             std::pair(soup(3, 30), segments)}) {
    const Report r = distance(a, b);
    CAPTURE(text(r));
    CHECK(interval(r).meets(reference_hausdorff(a, b, 1e-6)));
  }
  check_closed(segments, segments, 0);
}

TEST_CASE("a run again is the same run, bit by bit") {
  for (const auto& [name, a, b] : pairs()) {
    const auto& called = name;
    CAPTURE(called);
    const Report first = distance(a, b);
    for (int repeat = 0; repeat < 3; ++repeat) {
      check_same(distance(a, b), first);
    }
  }
}

TEST_CASE("the witness proves the lower bound") {
  for (const auto& [name, a, b] : pairs()) {
    const auto& called = name;
    CAPTURE(called);
    check_witness(distance(a, b), a, b);
  }
}

TEST_CASE("tolerances: relative to A, absolute, coarse and fine") {
  const auto [name, a, b] = pairs()[0];
  const Interval exact = reference_hausdorff(a, b, 1e-11);
  for (const double tolerance : {1e-6, 1e-5, 1e-3, 0.1, 1.0}) {
    CAPTURE(tolerance);
    const Report relative = distance(a, b, with_tolerance(tolerance));
    CHECK(relative.status == Status::kClosed);
    CHECK(relative.tolerance == multiply_down(tolerance, relative.diagonal_a));
    CHECK(relative.upper - relative.lower <= relative.tolerance);
    CHECK(interval(relative).meets(exact));
    const Report absolute = distance(a, b, with_tolerance(tolerance, true));
    CHECK(absolute.tolerance == tolerance);
    CHECK(absolute.upper - absolute.lower <= tolerance);
    CHECK(interval(absolute).meets(exact));
  }
  const Report fine = distance(a, b, with_tolerance(1e-12));
  CHECK(fine.status != Status::kClosed);  // float32 cannot; the interval stays true
  CHECK(interval(fine).meets(exact));
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(distance(a, b, with_tolerance(wrong)), UsageError);
}

TEST_CASE("meshes copied to the device give the bits of those that are written there") {
  const DeviceRequest request{.selector = test_device().description().name,
                              .validation = std::getenv("VKH_VALIDATION") != nullptr,
                              .robust = true,
                              .maps_memory = false};
  Device copying(request);
  Solver solver(copying);
  // The second fits the first one's memory, the third does not.
  for (const std::uint32_t level : {2U, 1U, 3U}) {
    const Mesh a = icosphere(1, level), b = translated(icosphere(1.1, level), {0.1, 0.2, 0});
    const Report r = solver.distance(a, b), expected = distance(a, b);
    CHECK(r.lower == expected.lower);
    CHECK(r.upper == expected.upper);
    CHECK(r.candidates == expected.candidates);
  }
  CHECK(copying.validation_messages() == 0);
}
