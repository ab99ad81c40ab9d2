// make_mesh: the faces that it drops and refuses, and its counts against exact arithmetic.
#include "vkhausdorff/mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "host/mesh/make_mesh.h"
#include "vkhausdorff/error.h"

namespace {

using vkh::FileFaces;
using vkh::InputError;
using vkh::Mesh;
using Vertices = std::vector<glm::dvec3>;
using Faces = std::vector<glm::uvec3>;

uint64_t degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return vkh::make_mesh("m", {a, b, c}, {{0, 1, 2}}).counts.degenerate;
}

/// The face's number for each triangle, one by one, if faces have these numbers of triangles.
std::vector<uint32_t> numbered(const std::vector<uint32_t>& triangles_of_faces) {
  std::vector<uint32_t> numbers;
  for (uint32_t face = 0; face < triangles_of_faces.size(); ++face)
    numbers.insert(numbers.end(), triangles_of_faces[face], face);
  return numbers;
}

/// A reader's form: only the faces that are not one triangle.
FileFaces file_faces(const std::vector<uint32_t>& triangles_of_faces) {
  FileFaces faces;
  size_t first = 0;
  for (const uint32_t count : triangles_of_faces) {
    if (count != 1) faces.add(first, count);
    first += count;
  }
  return faces;
}

/// Runs of similar faces, since files have long ones.
std::vector<uint32_t> random_faces(std::mt19937& random) {
  std::vector<uint32_t> counts;
  for (size_t runs = random() % 8; runs > 0; --runs)
    counts.insert(counts.end(), random() % 5, static_cast<uint32_t>(random() % 4));
  return counts;
}

}  // namespace

TEST_CASE("a file of triangles takes no map, and one of quads takes one run") {
  CHECK(FileFaces().are_triangles());
  CHECK(FileFaces().of(7) == 7);
  CHECK(FileFaces().count(7) == 7);
  CHECK(file_faces({1, 1, 1}).are_triangles());
  const FileFaces quads = file_faces(std::vector<uint32_t>(1000, 2));
  CHECK(quads.runs() == std::vector<FileFaces::Run>{{2000, 1000}});
  CHECK(quads.of(0) == 0);
  CHECK(quads.of(1001) == 500);
  CHECK(quads.count(2003) == 1003);
}

TEST_CASE("a triangle has its face's number, whatever stands before it") {
  std::mt19937 random(23);
  for (int trial = 0; trial < 2000; ++trial) {
    const std::vector<uint32_t> counts = random_faces(random);
    const std::vector<uint32_t> numbers = numbered(counts);
    const FileFaces faces = file_faces(counts);
    CHECK(faces.count(numbers.size()) == counts.size());
    CHECK(faces.of_all(numbers.size()) == numbers);
    CHECK(faces.is_valid(numbers.size()));
    for (size_t i = 0; i < numbers.size(); ++i) CHECK(faces.of(i) == numbers[i]);
  }
}

TEST_CASE("blocks of a file, one after another, give the map of the file") {
  std::mt19937 random(24);
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<uint32_t> all;
    FileFaces joined;
    size_t first = 0;
    for (int block = 0; block < 4; ++block) {
      const std::vector<uint32_t> counts = random_faces(random);
      joined.append(file_faces(counts), first);
      first += std::accumulate(counts.begin(), counts.end(), size_t{0});
      all.insert(all.end(), counts.begin(), counts.end());
    }
    CHECK(joined.runs() == file_faces(all).runs());
  }
}

TEST_CASE("a map that no file has is told") {
  using Runs = std::vector<FileFaces::Run>;
  const Runs good = {{2, 2}, {6, 4}, {6, 7}};
  CHECK(FileFaces(good).is_valid(6));
  CHECK_FALSE(FileFaces(good).is_valid(5));
  for (const Runs& wrong : {Runs{{2, 0}}, Runs{{2, 1}, {1, 2}}, Runs{{2, 1}, {4, 1}}, Runs{{3, 2}}})
    CHECK_FALSE(FileFaces(wrong).is_valid(100));
}

TEST_CASE("make_mesh drops what no face uses, in order, and only that must be finite") {
  const double nan = std::nan("");
  const Mesh mesh = vkh::make_mesh(
      "m", {{nan, 0, 0}, {1, 0, 0}, {0, INFINITY, 0}, {0, 1, 0}, {0, 0, 1}}, {{4, 3, 1}});
  CHECK(mesh.vertices == Vertices{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CHECK(mesh.faces == Faces{{2, 1, 0}});
  CHECK(mesh.counts.unreferenced == 2);
  CHECK_THROWS_WITH(vkh::make_mesh("m", {{0, 0, 0}, {nan, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}),
                    "m: vertex 1: (nan, 0, 0) is not finite; expected finite coordinates");
  CHECK_THROWS_WITH(vkh::make_mesh("m", Vertices(8), {{0, 1, 2}, {0, 99, 7}}),
                    "m: face 1: index 99 of 8 vertices; expected indices below 8");
  CHECK_THROWS_AS(vkh::make_mesh("m", Vertices(8), {}), InputError);
}

TEST_CASE("make_mesh counts duplicates by position, in any order") {
  const Vertices cube = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  const Mesh mesh =
      vkh::make_mesh("m", cube, {{0, 1, 2}, {2, 1, 0}, {3, 4, 2}, {0, 1, 5}, {0, 0, 1}, {1, 1, 0}});
  CHECK(mesh.counts.duplicate == 2);
  CHECK(mesh.counts.degenerate == 2);
  CHECK(mesh.faces.size() == 6);
}

namespace {

// Counts by sorting and comparing all faces.
uint64_t duplicates_by_set(const Mesh& mesh) {
  using Position = std::array<double, 3>;
  std::set<std::array<Position, 3>> known;
  for (const glm::uvec3& f : mesh.faces) {
    std::array<Position, 3> face;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3& p = mesh.vertices[f[i]];
      face[static_cast<size_t>(i)] = {p.x, p.y, p.z};  // -0 and 0 are equal here, too
    }
    std::sort(face.begin(), face.end());
    known.insert(face);
  }
  return mesh.faces.size() - known.size();
}

// Faces between vertices of which some share a position, and copies of faces in another order.
Mesh with_repeats(size_t vertices, size_t faces, uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](size_t bound) { return static_cast<uint32_t>(random() % bound); };
  Mesh mesh;
  for (size_t v = 0; v < vertices; ++v) {
    const glm::dvec3 fresh(below(1 << 20), below(1 << 20), -0.0);
    mesh.vertices.push_back(v > 0 && below(8) == 0 ? mesh.vertices[below(v)] + 0.0 : fresh);
  }
  for (size_t f = 0; f < faces; ++f) {
    const glm::uvec3 fresh(below(vertices), below(vertices), below(vertices));
    const glm::uvec3 old = f > 0 ? mesh.faces[below(f)] : fresh;
    mesh.faces.push_back(below(6) > 0   ? fresh
                         : below(2) > 0 ? glm::uvec3(old.y, old.x, old.z)
                                        : old);
  }
  return mesh;
}

}  // namespace

TEST_CASE("duplicates are as many as comparing all faces finds, on one thread and on several") {
  const vkh::ThreadPool alone(1, {}, {}), several(4, {}, {});
  struct Sizes {
    size_t vertices, faces;
  };
  for (const Sizes& of : {Sizes{1, 3}, Sizes{3, 40}, Sizes{50, 400}, Sizes{1000, 900},
                          Sizes{9000, 700}, Sizes{40'000, 70'000}}) {
    CAPTURE(of.faces);
    const Mesh mesh = with_repeats(of.vertices, of.faces, 11);
    const uint64_t expected = duplicates_by_set(mesh);
    CHECK(expected > 0);
    for (const vkh::ThreadPool* pool : {&alone, &several})
      CHECK(vkh::count_duplicates(mesh, vkh::Positions::kAny, *pool) == expected);
  }
}

TEST_CASE("faces whose positions differ are no duplicates, however many share a vertex") {
  const vkh::ThreadPool alone(1, {}, {}), several(4, {}, {});
  Mesh fan;
  constexpr uint32_t kFaces = 30'000;
  for (uint32_t v = 0; v < kFaces + 2; ++v) fan.vertices.emplace_back(v, v % 7, -1.0 * v);
  for (uint32_t f = 0; f < kFaces; ++f) fan.faces.emplace_back(0, f + 1, f + 2);
  for (const vkh::ThreadPool* pool : {&alone, &several}) {
    CHECK(vkh::count_duplicates(fan, vkh::Positions::kAny, *pool) == 0);
    CHECK(vkh::count_duplicates(fan, vkh::Positions::kDiffer, *pool) == 0);
  }
  fan.faces.emplace_back(77, 0, 76);
  CHECK(vkh::count_duplicates(fan, vkh::Positions::kDiffer, several) == 1);
}

TEST_CASE("collinearity is exact at every scale") {
  for (int scale = -1070; scale <= 1015; scale += 5) {
    CAPTURE(scale);
    const auto at = [&](double x, double y, double z) {
      return glm::dvec3(std::ldexp(x, scale), std::ldexp(y, scale), std::ldexp(z, scale));
    };
    CHECK(degenerate(at(1, 2, 3), at(2, 4, 6), at(3, 6, 9)) == 1);
    CHECK(degenerate(at(1, 2, 3), at(2, 4, 6), at(3, 6, 10)) == 0);
    glm::dvec3 off_line = at(3, 6, 9);
    off_line.y = std::nextafter(off_line.y, 0.0);
    CHECK(degenerate(at(1, 2, 3), at(2, 4, 6), off_line) == 0);
  }
  const double huge = 1.7976931348623157e308, tiny = 5e-324;
  CHECK(degenerate({-huge, -huge, -huge}, {0, 0, 0}, {huge, huge, huge}) == 1);
  CHECK(degenerate({-huge, -huge, -huge}, {0, tiny, 0}, {huge, huge, huge}) == 0);
  CHECK(degenerate({0, 0, 0}, {tiny, 0, 0}, {huge, 0, 0}) == 1);
  CHECK(degenerate({0, 0, 0}, {tiny, 0, 0}, {huge, 0, tiny}) == 0);
}

// Meshes of one face: one takes Wine or the sanitizers twenty times as long.
#if defined(_WIN32) || defined(VKH_SANITIZED)
constexpr int kRounds = 10'000;
#else
constexpr int kRounds = 200'000;
#endif

TEST_CASE("collinearity agrees with integer arithmetic") {
  // Products of two steps of 30 bits, from a base of 50 bits: differences and cross products are
  // exact in int64, and floating point alone cannot tell.
  std::mt19937_64 random(7);
  const auto draw = [&](int64_t bound) {
    return std::uniform_int_distribution<int64_t>(-bound, bound)(random);
  };
  uint64_t lines = 0;
  for (int round = 0; round < kRounds; ++round) {
    int64_t base[3], u[3], v[3];
    const int64_t s = draw(1000), t = draw(1000);
    const int64_t nudge = round % 2 == 0 ? 0 : draw(1);
    for (int i = 0; i < 3; ++i) {
      base[i] = draw(int64_t{1} << 50);
      const int64_t step = draw(int64_t{1} << 20);
      u[i] = s * step;
      v[i] = t * step + (i == round % 3 ? nudge : 0);
    }
    glm::dvec3 a{}, b{}, c{};
    bool zero = true;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      a[i] = static_cast<double>(base[i]);
      b[i] = static_cast<double>(base[i] + u[i]);
      c[i] = static_cast<double>(base[i] + v[i]);
      zero = zero && u[i] * v[j] == u[j] * v[i];
    }
    lines += zero ? 1 : 0;
    const uint64_t found = degenerate(a, b, c);
    if (found != (zero ? 1u : 0u)) FAIL("round " << round);
  }
  CHECK(lines > kRounds / 2);
  CHECK(lines < kRounds * 9 / 10);
}

TEST_CASE("collinearity is exact where the differences themselves are rounded") {
  // Points k * direction with k of 33 bits at exponents far apart: each coordinate is exact, their
  // differences are not. Near 2^-530 their products underflow besides.
  std::mt19937_64 random(8);
  std::uniform_int_distribution<int64_t> wide(int64_t{1} << 32, int64_t{1} << 33);
  std::uniform_int_distribution<int64_t> narrow(1, 1 << 19);
  std::uniform_int_distribution<int> apart(-40, 40);
  for (int round = 0; round < kRounds / 4; ++round) {
    const int scale = round % 2 == 0 ? 0 : -560 - round % 40;
    const glm::dvec3 direction(narrow(random), -narrow(random), narrow(random));
    std::array<glm::dvec3, 3> points;
    for (glm::dvec3& p : points) {
      p = direction * std::ldexp(static_cast<double>(wide(random)), scale + apart(random));
    }
    if (points[0] == points[1] || points[1] == points[2] || points[2] == points[0]) continue;
    if (degenerate(points[0], points[1], points[2]) != 1) FAIL("on the line, round " << round);
    double& moved = points[static_cast<size_t>(round % 3)][round / 3 % 3];
    moved = std::nextafter(moved, INFINITY);
    if (degenerate(points[0], points[1], points[2]) != 0) FAIL("off the line, round " << round);
  }
}
