// Pairs that are split at midpoints: the same surfaces, exactly, or a refusal. Runs the real
// vkh_split, $VKH_PROGRAM.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "tests/shapes/shapes.h"
#include "tests/support/program.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/exact.h"
#include "tools/pairs/subdivision.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

using namespace vkh;
using namespace vkh::test;
using vkh::pairs::average;
using vkh::pairs::Subdivision;

namespace {

using Triangle = std::array<glm::dvec3, 3>;

bool is_before(const glm::dvec3& p, const glm::dvec3& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

struct Before {
  bool operator()(const Triangle& s, const Triangle& t) const {
    return std::lexicographical_compare(s.begin(), s.end(), t.begin(), t.end(), is_before);
  }
};
/// The same triangle of the same orientation is the same array.
Triangle turned(Triangle t) {
  Triangle least = t;
  for (int turn = 0; turn < 2; ++turn) {
    std::rotate(t.begin(), t.begin() + 1, t.end());
    least = std::min(least, t, Before());
  }
  return least;
}

using Triangles = std::multiset<Triangle, Before>;

/// Splits by the definition: into four, and each of the four again.
void split_recursively(const Triangle& t, uint32_t levels, Triangles& out) {
  if (levels == 0) {
    out.insert(turned(t));
    return;
  }
  const auto& [a, b, c] = t;
  const glm::dvec3 ab = (a + b) / 2.0, bc = (b + c) / 2.0, ca = (c + a) / 2.0;
  for (const Triangle& child : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
    split_recursively(child, levels - 1, out);
}

Triangle triangle_of(const Mesh& mesh, size_t face) {
  const glm::uvec3& f = mesh.faces[face];
  return {mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]};
}

Mesh on_grid(Mesh mesh, int bits) {
  for (glm::dvec3& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis)
      v[axis] = std::ldexp(std::nearbyint(std::ldexp(v[axis], bits)), -bits);
  }
  return mesh;
}

Mesh split(const Mesh& mesh, uint32_t levels) {
  const std::string path = folder() / "split.ply";
  Subdivision(mesh, levels).write(path);
  return read_mesh(path);
}

void check_children(const Mesh& mesh, const Mesh& fine, uint32_t levels) {
  const size_t children = size_t{1} << (2 * levels);
  REQUIRE(fine.faces.size() == children * mesh.faces.size());
  size_t wrong = 0;
  for (size_t face = 0; face < mesh.faces.size(); ++face) {
    Triangles expected, found;
    split_recursively(triangle_of(mesh, face), levels, expected);
    for (size_t i = 0; i < children; ++i)
      found.insert(turned(triangle_of(fine, face * children + i)));
    wrong += expected == found ? 0 : 1;
  }
  CHECK(wrong == 0);
}

std::string file_of(const std::string& name, const Mesh& mesh) {
  std::string text = "OFF\n" + std::to_string(mesh.vertices.size()) + " " +
                     std::to_string(mesh.faces.size()) + " 0\n";
  char line[128];
  for (const glm::dvec3& v : mesh.vertices) {
    std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", v.x, v.y, v.z);
    text += line;
  }
  for (const glm::uvec3& f : mesh.faces) {
    std::snprintf(line, sizeof line, "3 %u %u %u\n", f.x, f.y, f.z);
    text += line;
  }
  return write_file(name, text);
}

Words split_words(const std::string& a, const std::string& b, const std::string& levels) {
  return {a,          b,
          "--levels", levels,
          "--out-a",  folder() / "out_a.ply",
          "--out-b",  folder() / "out_b.ply"};
}

double hard_double(Random& random) {
  const double near[] = {1, 1 + 0x1p-52, -1, 0, 0x1p-1074, 1e300, 3};
  if (random.below(2) == 0) return near[random.below(7)];
  const int bits = static_cast<int>(random.below(54)),
            exponent = static_cast<int>(random.below(64));
  return std::ldexp(std::nearbyint(std::ldexp(random.range(-1, 1), bits)), exponent - 32 - bits);
}

}  // namespace

TEST_CASE("an average is exact, or said not to be") {
  Random random(7);
  size_t exact = 0, inexact = 0;
  for (int i = 0; i < 200'000; ++i) {
    const uint32_t levels = 1 + random.below(4), n = 1u << levels;
    const uint32_t j = random.below(n + 1);  // on an edge, as the first to be looked at
    const std::array<double, 3> values = {hard_double(random), hard_double(random), 0};
    const pairs::Average found = average(values, {n - j, j, 0}, levels);
    Rational truth = Rational(values[0]) * (n - j) + Rational(values[1]) * j;
    truth /= n;
    const double near = truth.get_d();
    const bool is_double = Rational(near) == truth;
    if (found.is_exact != is_double || (is_double && found.value != near)) {
      CAPTURE(values[0]);
      CAPTURE(values[1]);
      CAPTURE(j);
      CAPTURE(levels);
      CHECK(found.is_exact == is_double);
      CHECK(found.value == near);
    }
    (is_double ? exact : inexact) += 1;
    if (!is_double && near != 0 && std::abs(near) > 1e-290) CHECK(found.bits > 53);
  }
  CHECK(exact > 10'000);
  CHECK(inexact > 10'000);
}

TEST_CASE("each face becomes what splitting it by hand makes, in order and in orientation") {
  const Mesh meshes[] = {on_grid(icosphere(1, 1), 30), on_grid(soup(3, 20), 40),
                         single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                         make_mesh("degenerate", {{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 0, 0}})};
  for (const Mesh& mesh : meshes) {
    for (uint32_t levels = 0; levels <= 4; ++levels) {
      CAPTURE(mesh.name);
      CAPTURE(levels);
      check_children(mesh, split(mesh, levels), levels);
    }
  }
}

TEST_CASE("corners along shared edges are shared") {
  const Mesh sphere = on_grid(icosphere(1, 1), 30);  // 80 faces, 120 edges, 42 vertices
  for (uint32_t levels = 1; levels <= 4; ++levels) {
    const uint64_t n = 1u << levels;
    const Mesh fine = split(sphere, levels);
    CHECK(fine.vertices.size() == 42 + 120 * (n - 1) + 80 * (n - 1) * (n - 2) / 2);
    CHECK(fine.vertices.size() + fine.faces.size() - fine.faces.size() * 3 / 2 == 2);  // Euler
    CHECK(fine.counts.unreferenced == 0);
    std::vector<glm::dvec3> places = fine.vertices;
    std::sort(places.begin(), places.end(), is_before);
    CHECK(std::adjacent_find(places.begin(), places.end()) == places.end());
  }
}

TEST_CASE("columns are float where they hold every coordinate") {
  const Mesh one = single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1 + 0x1p-23, 0});
  CHECK(!Subdivision(one, 0).shape().is_double);
  CHECK(Subdivision(one, 1).shape().is_double == false);  // half of it is one, too
  const Mesh odd = single_triangle({0, 0, 0}, {1, 0, 0}, {1, 1 + 0x1p-23, 0x1p-24});
  CHECK(!Subdivision(odd, 0).shape().is_double);
  const Mesh between = single_triangle({0, 0, 1}, {1, 0, 0}, {0, 1, 1 + 0x1p-23});
  CHECK(Subdivision(between, 1).shape().is_double);
  check_children(between, split(between, 3), 3);
}

TEST_CASE("an inexact midpoint is refused by name and bits, and nothing is written") {
  const Mesh a = single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1 + 0x1p-52, 0});
  const Mesh b = single_triangle({0, 1, 0}, {1, 0, 0}, {0, 1 + 0x1p-52, 0});
  CHECK_NOTHROW(Subdivision(a, 1));
  CHECK_THROWS_WITH_AS(Subdivision(b, 1),
                       doctest::Contains("edge of vertices 0 and 2: the point at 1/2, 1/2, 0/2 of "
                                         "its corners takes 54 bits on the y axis"),
                       InputError);
  const std::string good = file_of("good.off", a), bad = file_of("bad.off", b);
  for (const auto& [first, second] : {std::pair{good, bad}, {bad, good}}) {
    const Outcome outcome = run(split_words(first, second, "1"));
    CHECK(outcome.exit_code == 4);
    CHECK(outcome.err.find("bad.off: edge of vertices 0 and 2") != std::string::npos);
    CHECK(!std::filesystem::exists(folder() / "out_a.ply"));
    CHECK(!std::filesystem::exists(folder() / "out_b.ply"));
  }
}

TEST_CASE("what 32-bit indices do not reach is refused before the work") {
  const Mesh mesh = icosphere(1, 5);  // 20,480 faces
  CHECK_THROWS_AS(Subdivision(mesh, 9), UsageError);
  CHECK_THROWS_AS(Subdivision(mesh, 31), UsageError);
}

TEST_CASE("the distance of a split pair is the small pair's") {
  const Mesh a = on_grid(icosphere(1, 2), 40), b = on_grid(icosphere(1.01, 1), 40);
  const Report small = solver().distance(a, b), large = solver().distance(split(a, 2), split(b, 2));
  REQUIRE(small.status == Status::kClosed);
  REQUIRE(large.status == Status::kClosed);
  CHECK(small.lower <= large.upper);
  CHECK(large.lower <= small.upper);
}

TEST_CASE("a pair that is rounded to a grid first is the small pair, and is kept") {
  const Mesh a = icosphere(1, 1), b = icosphere(0.9, 1);
  Words words = split_words(file_of("a.off", a), file_of("b.off", b), "2");
  CHECK(run(words).exit_code == 4);
  words.insert(words.end(), {"--grid", "20", "--small-a", folder() / "small_a.ply", "--small-b",
                             folder() / "small_b.ply"});
  const Outcome outcome = run(words);
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.out.find("multiples of 2^-20") != std::string::npos);
  const Mesh small_a = read_mesh(folder() / "small_a.ply"),
             small_b = read_mesh(folder() / "small_b.ply");
  CHECK(small_a.vertices == on_grid(a, 20).vertices);
  CHECK(small_b.vertices == on_grid(b, 20).vertices);
  CHECK(small_a.faces == a.faces);
  check_children(small_a, read_mesh(folder() / "out_a.ply"), 2);
  check_children(small_b, read_mesh(folder() / "out_b.ply"), 2);
}
