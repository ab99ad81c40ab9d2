// The oracles against closed forms, exact arithmetic, CGAL and the two solvers of peers.csv.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/verification/oracle/exact.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/mesh_io.h"

using namespace vkh;
using namespace vkh::test;
using glm::dvec3;

namespace {

constexpr double kTolerance = 1e-6;

double joint_margin(const Mesh& a, const Mesh& b) {
  return 64.0 * 0x1p-53 * diagonal(joined(a, b));
}

/// The interval must hold the value, and be as narrow as requested.
void check_encloses(const Mesh& a, const Mesh& b, double expected,
                    double relative_tolerance = kTolerance) {
  const double tolerance = relative_tolerance * diagonal(a);
  const Interval got = reference_hausdorff(a, b, tolerance);
  CAPTURE(a.name);
  CAPTURE(b.name);
  CAPTURE(expected);
  CHECK(got.lower <= expected);
  CHECK(expected <= got.upper);
  CHECK(got.upper - got.lower <= 1.01 * tolerance + 2.0 * joint_margin(a, b));
}

Mesh degenerate_point(const dvec3& p) { return single_triangle(p, p, p); }

}  // namespace

TEST_CASE("exact squared distances of known triangles") {
  const dvec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  CHECK(squared_distance_exact(dvec3(1, 1, 3), a, b, c) == 9);
  CHECK(squared_distance_exact(dvec3(-3, -4, 0), a, b, c) == 25);
  CHECK(squared_distance_exact(dvec3(2, -5, 0), a, b, c) == 25);
  CHECK(squared_distance_exact(dvec3(4, 4, 1), a, b, c) == 9);
  CHECK(squared_distance_exact(dvec3(1, 0, 0), a, dvec3(3, 3, 3), dvec3(-1, 0, 2)) ==
        squared_distance_exact(dvec3(1, 0, 0), dvec3(-1, 0, 2), a, dvec3(3, 3, 3)));
  CHECK(squared_distance_exact(dvec3(0, 0, 1), dvec3(0), dvec3(1, 1, 1)) == Rational(2, 3));
}

TEST_CASE("exact squared distances of degenerate triangles and extreme exponents") {
  const dvec3 p(3, 4, 12);
  const dvec3 o(0);
  CHECK(squared_distance_exact(p, o, o, o) == 169);
  CHECK(squared_distance_exact(p, o) == 169);
  CHECK(squared_distance_exact(p, o, o, dvec3(0, 0, 5)) == 25 + 49);
  CHECK(squared_distance_exact(p, dvec3(0, 0, 20), o, dvec3(0, 0, 5)) == 25);
  CHECK(squared_distance_exact(o, o, o, o) == 0);
  const float tiny = 0x1p-149f;
  const Rational tiny_squared = squared_distance_exact(glm::vec3(0, 0, tiny), glm::vec3(-1, -1, 0),
                                                       glm::vec3(2, -1, 0), glm::vec3(-1, 2, 0));
  CHECK(tiny_squared * (Rational(1) << 298u) == 1);
  CHECK(sqrt_near(tiny_squared) == 0x1p-149);
  const double huge = 0x1p1000;
  CHECK(squared_distance_exact(dvec3(0, 0, huge), o) == (Rational(1) << 2000u));
}

TEST_CASE("bounds of a square root are decided exactly") {
  const Rational two = 2;
  const double root = std::sqrt(2.0);  // above sqrt(2)
  CHECK(is_upper_bound(root, two));
  CHECK_FALSE(is_lower_bound(root, two));
  CHECK(is_lower_bound(std::nextafter(root, 0.0), two));
  CHECK_FALSE(is_upper_bound(std::nextafter(root, 0.0), two));
  CHECK((is_upper_bound(3.0, 9) && is_lower_bound(3.0, 9)));
  CHECK_FALSE(is_upper_bound(std::nan(""), two));
  CHECK_FALSE(is_lower_bound(std::nan(""), two));
  CHECK((is_upper_bound(HUGE_VAL, two) && is_lower_bound(-HUGE_VAL, two)));
  CHECK((is_upper_bound_of_square(2.0, two) && is_lower_bound_of_square(2.0, two)));
  CHECK_FALSE(is_lower_bound_of_square(std::nextafter(2.0, 3.0), two));
}

TEST_CASE("closest points in double hold their promise on hard triangles") {
  Random random(11);
  for (const Mesh& mesh : {soup(1, 1500), needles(2, 1500), slivers(3, 1500), caps(4, 1500),
                           degenerate_faces(5, 300)}) {
    double worst = 0.0;
    for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
      const auto [a, b, c] = corners(mesh, f);
      const double longest =
          std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
      for (int i = 0; i < 4; ++i) {
        const double u = random.unit();
        const double v = random.unit() * (1.0 - u);
        const dvec3 inside = a + u * (b - a) + v * (c - a);
        const double height = longest * std::pow(10.0, random.range(-15.0, 0.0));
        dvec3 normal = glm::cross(b - a, c - a);
        normal = glm::length(normal) > 0.0 ? glm::normalize(normal) : random.direction();
        const dvec3 p = i == 0   ? random.in_cube(2.0)
                        : i == 1 ? inside
                        : i == 2 ? inside + height * normal
                                 : inside + height * random.direction();
        const double exact = sqrt_near(squared_distance_exact(p, a, b, c));
        const double size = glm::distance(p, a) + longest + 1e-300;
        worst = std::max(worst, std::abs(point_triangle_distance(p, a, b, c) - exact) / size);
      }
    }
    CAPTURE(mesh.name);
    CHECK(worst <= 6.0 * 0x1p-53);
  }
}

TEST_CASE("the brute-force distance to a mesh is the exact one") {
  const Mesh mesh = joined(soup(8, 60), degenerate_faces(9, 30));
  Random random(12);
  for (int i = 0; i < 50; ++i) {
    const dvec3 p = random.in_cube(1.5);
    const double d = point_mesh_distance(p, mesh);
    const Rational exact = squared_distance_exact(p, mesh);
    CHECK(is_upper_bound(d * (1.0 + 0x1p-48), exact));
    CHECK(is_lower_bound(d * (1.0 - 0x1p-48), exact));
    const MeshPoint at = closest_point_on_mesh(p, mesh);
    CHECK(glm::distance(at.point, p) == doctest::Approx(d).epsilon(1e-14));
    const auto [a, b, c] = corners(mesh, at.face);
    CHECK(point_triangle_distance(at.point, a, b, c) <= 1e-15);
  }
}

TEST_CASE("closed forms: patches and planes") {
  for (const double delta : {1e-9, 0.125, 3.0}) {
    check_encloses(square_patch(7, 0.0), square_patch(7, delta), delta);
    check_encloses(square_patch(5, 0.0), square_patch(8, delta), delta);
  }
  const Mesh triangle = single_triangle({0, 0, 1}, {1, 0, 2}, {0, 1, 5});
  check_encloses(triangle, big_plane(100.0), 5.0);
  check_encloses(degenerate_faces(3, 30), big_plane(8.0, -2.0),
                 bounding_box(degenerate_faces(3, 30)).second.z + 2.0);
  const Interval between_points =
      reference_hausdorff(degenerate_point({0, 3, 4}), degenerate_point({0, 0, 0}), 0.0);
  CHECK(between_points.contains(5.0));
  CHECK(between_points.upper - between_points.lower < 1e-12);
}

TEST_CASE("closed forms: V against its hull") {
  const Mesh lid = v_lid();
  const Mesh sheet = v_sheet();
  for (const dvec3& v : lid.vertices) CHECK(point_mesh_distance(v, sheet) == 0.0);
  CHECK(v_lid_distance() == doctest::Approx(0.832050294337844).epsilon(1e-14));
  check_encloses(lid, sheet, v_lid_distance());
  check_encloses(sheet, lid, 1.5);
  for (const double valley : {-0.61803, 0.1, 0.7}) {
    check_encloses(lid, v_sheet(0.9, valley), v_lid_distance(0.9, valley));
  }
}

TEST_CASE("closed forms: farthest from points, where the Lipschitz bounds are attained") {
  // Each point of B lies 0.1 beyond a corner, seen from the circumcentre, which is farthest from
  // all.
  const double radius = 0.7;
  const auto on_circle = [](double r, double angle) {
    return dvec3(r * std::cos(angle), 0.25, r * std::sin(angle));
  };
  const std::array<double, 3> angles = {0.3, 2.0, 4.1};
  Mesh ends = degenerate_point(on_circle(radius + 0.1, angles[0]));
  for (size_t i : {1u, 2u}) {
    ends = joined(ends, degenerate_point(on_circle(radius + 0.1, angles[i])));
  }
  check_encloses(single_triangle(on_circle(radius, angles[0]), on_circle(radius, angles[1]),
                                 on_circle(radius, angles[2])),
                 ends, radius + 0.1, 1e-10);
  // A segment between two points: it is farthest where their distances even out.
  const Mesh two = joined(degenerate_point({-0.1, 0, 0}), degenerate_point({1.3, 0, 0}));
  check_encloses(single_triangle({0, 0, 0}, {1, 0, 0}, {0.3, 0, 0}), two, 0.7, 1e-10);
  // Without a sample of its longest edge's middle, an obtuse triangle has nothing but its bounds.
  const Mesh flat = single_triangle({0, 0, 0}, {1, 0, 0}, {0.99, -0.001, 0});
  const Mesh even = joined(degenerate_point({-0.1, 0, 0}), degenerate_point({1.1, 0, 0}));
  const Interval bounds_only = reference_hausdorff(flat, even, 0.0, 0);
  CHECK(bounds_only.lower < 0.5);
  CHECK(bounds_only.upper >= 0.6);
}

TEST_CASE("closed forms: nested convex bodies") {
  check_encloses(cube(1.0), cube(2.0), 1.0);
  check_encloses(cube(2.0), cube(1.0), std::sqrt(3.0));
  // Regular icosahedra: face planes lie at 0.7946... of the radius, and the inner one's points are
  // at least, its faces' at most, that much of (R - r) from the outer one.
  const double inscribed = std::sqrt((5.0 + 2.0 * std::sqrt(5.0)) / 15.0);
  check_encloses(icosphere(1.0, 0), icosphere(1.5, 0), 0.5 * inscribed);
  // A vertex of the outer sphere is R - r from the inner one: it lies in its twin's normal cone.
  check_encloses(icosphere(1.5, 3), icosphere(1.0, 3), 0.5);
  check_encloses(uv_sphere(2.0, 12, 17), uv_sphere(1.0, 12, 17), 1.0);
}

TEST_CASE("a mesh is at distance zero from itself, whatever its order or extra faces") {
  const double tolerance = 1e-6;
  for (const Mesh& mesh : {height_field(20, 1), torus(1.0, 0.3, 24, 12), soup(4, 300),
                           slivers(6, 200), degenerate_faces(7, 60)}) {
    CAPTURE(mesh.name);
    ReferenceStats stats;
    const Interval self = reference_hausdorff(mesh, mesh, tolerance, 100'000, &stats);
    CHECK(self.lower == 0.0);
    CHECK(self.upper <= tolerance + joint_margin(mesh, mesh));
    const Mesh other = with_duplicates(permuted(mesh, 5), 6);
    CHECK(reference_hausdorff(mesh, other, tolerance).upper <= tolerance + 1e-12);
    CHECK(reference_hausdorff(other, mesh, tolerance).upper <= tolerance + 1e-12);
    CHECK(reference_hausdorff(mesh, joined(mesh, cube(9.0)), tolerance).upper <= tolerance + 1e-12);
  }
}

TEST_CASE("metamorphic: scale, rigid motion, order, more faces") {
  const Mesh a = noisy(torus(1.0, 0.3, 24, 12), 0.02, 3);
  const Mesh b = joined(torus(1.0, 0.3, 40, 17), soup(9, 40));
  const double tolerance = 1e-5;
  const Interval plain = reference_hausdorff(a, b, tolerance);
  CHECK(plain.lower > 0.005);
  for (const int k : {-40, 3, 30}) {
    const Interval big = reference_hausdorff(scaled(a, k), scaled(b, k), std::ldexp(tolerance, k));
    CHECK(big.lower == std::ldexp(plain.lower, k));
    CHECK(big.upper == std::ldexp(plain.upper, k));
  }
  const dvec3 axis(1, 2, 3), by(5, -7, 2);
  const Interval moved = reference_hausdorff(translated(rotated(a, axis, 1.0), by),
                                             translated(rotated(b, axis, 1.0), by), tolerance);
  const double slack = 1e-13;
  CHECK(moved.meets({plain.lower - slack, plain.upper + slack}));
  CHECK(reference_hausdorff(permuted(a, 1), permuted(b, 2), tolerance).meets(plain));
  CHECK(reference_hausdorff(with_duplicates(a, 1), with_duplicates(b, 2), tolerance).meets(plain));
  const Interval nearer = reference_hausdorff(a, joined(b, soup(10, 50)), tolerance);
  CHECK(nearer.lower <= plain.upper);
}

TEST_CASE("a small budget gives a wider interval that is still true") {
  const Mesh a = height_field(24, 1);
  const Mesh b = noisy(height_field(24, 2), 1e-3, 4);
  const Interval full = reference_hausdorff(a, b, 1e-7);
  CHECK(full.upper - full.lower <= 1.01e-7);
  double width = HUGE_VAL;
  for (const uint64_t budget : {0u, 2'000u, 4'000u, 20'000u}) {
    const Interval cut = reference_hausdorff(a, b, 1e-7, budget);
    CHECK(cut.lower <= full.upper);
    CHECK(full.lower <= cut.upper);
    CHECK(cut.upper - cut.lower <= width);
    width = cut.upper - cut.lower;
  }
  const Interval cut = reference_hausdorff(a, b, 1e-7, 0);
  CHECK(cut.upper - cut.lower > 1e-5);
}

TEST_CASE("dense samples of A stay within the interval") {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    const Mesh a = seed % 2 ? soup(seed, 40) : caps(seed, 40);
    const Mesh b = seed < 4 ? soup(100 + seed, 80) : needles(100 + seed, 80);
    const Interval got = reference_hausdorff(a, b, 1e-4);
    double largest = 0.0;
    double spacing = 0.0;
    constexpr int kCells = 24;
    for (uint32_t f = 0; f < a.faces.size(); ++f) {
      const auto c = corners(a, f);
      for (int i = 0; i <= kCells; ++i) {
        for (int j = 0; i + j <= kCells; ++j) {
          const dvec3 p = (c[0] * double(i) + c[1] * double(j) + c[2] * double(kCells - i - j)) /
                          double(kCells);
          largest = std::max(largest, point_mesh_distance(p, b));
        }
      }
      const double edge = std::max(
          {glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
      spacing = std::max(spacing, edge / kCells);
    }
    CAPTURE(seed);
    CHECK(largest <= got.upper + 1e-14);
    CHECK(got.lower <= largest + spacing);
  }
}

namespace {

struct Peer {
  std::string file_a, file_b;
  Interval state_of_the_art, reference;
};

std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

std::map<std::string, Peer> read_peers(const std::filesystem::path& folder) {
  std::map<std::string, Peer> peers;
  std::ifstream manifest(folder / "manifest.csv");
  std::ifstream intervals(folder / "peers.csv");
  std::string line;
  while (std::getline(manifest, line)) {
    const auto f = split_line(line);
    if (f.size() > 3) peers[f[0]] = {f[2], f[3], {}, {}};
  }
  std::getline(intervals, line);
  while (std::getline(intervals, line)) {
    const auto f = split_line(line);
    Peer& peer = peers.at(f.at(0));
    peer.state_of_the_art = {std::stod(f.at(3)), std::stod(f.at(4))};
    peer.reference = {std::stod(f.at(6)), std::stod(f.at(7))};
  }
  return peers;
}

}  // namespace

TEST_CASE("two other solvers agree on real pairs") {
  const char* shared = std::getenv("VKH_SHARED");
  const std::filesystem::path folder = std::filesystem::path(shared ? shared : "") / "pairs";
  if (!std::filesystem::exists(folder / "peers.csv")) {
    MESSAGE("skipped: no pairs in $VKH_SHARED/pairs");
    return;
  }
  const auto peers = read_peers(folder);
  for (const char* name :
       {"tetwild_thingi10k_37322_sf_published", "decimation_thingi10k_96582_vcg50",
        "tetwild_thingi10k_49220_tetwild", "tetwild_thingi10k_73340_tetwild",
        "decimation_thingi10k_100036_vcg50", "tetwild_thingi10k_107100_sf_published"}) {
    const Peer& peer = peers.at(name);
    const Mesh a = read_mesh(folder / peer.file_a);
    const Mesh b = read_mesh(folder / peer.file_b);
    const auto start = std::chrono::steady_clock::now();
    ReferenceStats stats;
    const Interval got = reference_hausdorff(a, b, kTolerance * diagonal(a), 4'000'000, &stats);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    MESSAGE(std::string(name) << ": " << took.count() << " ms, " << stats.candidates
                              << " candidates, " << stats.queries << " queries, " << stats.waves
                              << " waves");
    CHECK(got.meets(peer.reference));
    CHECK(got.meets(peer.state_of_the_art));
    CHECK(got.upper - got.lower <= 1.01 * kTolerance * diagonal(a));
  }
}
