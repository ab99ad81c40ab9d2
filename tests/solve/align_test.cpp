// Fits: a mesh that was moved comes back, whatever its shape; what has several places says so; and
// an interval after a fit is of the matrix that was found, exactly. The sanitizers see those cases
// whose code differs; how good fits are is the release tree's.
#include "vkhausdorff/align.h"

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>

#include "host/mesh/default_pair.h"
#include "tests/shapes/shapes.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/exact.h"
#include "vkhausdorff/asking.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/place.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr size_t kPoses = kIsSanitized ? 1 : 2;

/// A bumpy, lopsided ball: it has no symmetry.
Mesh lump(uint32_t subdivisions) {
  Mesh mesh = icosphere(1.0, subdivisions);
  for (DVec3& v : mesh.vertices) {
    const double r = 1 + 0.3 * std::sin(3 * v.x + 1) * std::cos(2 * v.y) + 0.2 * v.x * v.z;
    v = glm::dvec3(v) * r * glm::dvec3(1.5, 1.0, 0.7);
  }
  return mesh;
}

/// The faces on one side of a plane through the origin.
Mesh half_of(const Mesh& mesh, const glm::dvec3& normal) {
  std::vector<UVec3> faces;
  for (const UVec3& f : mesh.faces) {
    const glm::dvec3 sum = glm::dvec3(mesh.vertices[f.x]) + glm::dvec3(mesh.vertices[f.y]) +
                           glm::dvec3(mesh.vertices[f.z]);
    if (glm::dot(sum, normal) > 0) faces.push_back(f);
  }
  return make_mesh("half", mesh.vertices, faces);
}

Mesh in_any_pose(const Mesh& mesh, Random& random, double distance) {
  return translated(rotated(mesh, random.direction(), random.range(0, 6.3)),
                    distance * random.direction());
}

glm::dvec3 moved(const MatrixRows& rows, const glm::dvec3& p) {
  glm::dvec3 to;
  for (int i = 0; i < 3; ++i) {
    const auto& row = rows[static_cast<size_t>(i)];
    to[i] = row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
  }
  return to;
}

/// How far a vertex is at most from where it was before it was posed.
double most_off(const MatrixRows& rows, const Mesh& posed, const Mesh& mesh) {
  double most = 0;
  for (size_t i = 0; i < mesh.vertices.size(); ++i)
    most =
        std::max(most, glm::distance(moved(rows, posed.vertices[i]), glm::dvec3(mesh.vertices[i])));
  return most;
}

/// How far a vertex is at most from a mesh.
double most_beside(const MatrixRows& rows, const Mesh& posed, const Mesh& b) {
  std::vector<DVec3> points;
  for (const DVec3& v : posed.vertices) points.push_back(moved(rows, v));
  const std::vector<double> distances = solver().closest(b, points).upper;
  return *std::max_element(distances.begin(), distances.end());
}

void check_rotation(const MatrixRows& rows) {
  CHECK(stretch_of(rows) <= 1e-15);
  check_matrix("found", rows, false);  // refuses one that mirrors
}

Alignment found(const Mesh& a, const Mesh& b) {
  Alignment alignment = align(solver(), a, b);
  check_rotation(alignment.matrix);
  return alignment;
}

}  // namespace

TEST_CASE("a mesh in any pose comes back, to roundings") {
  const Mesh mesh = lump(4);
  Random random(1);
  for (size_t i = 0; i < kPoses; ++i) {
    const Mesh posed = in_any_pose(mesh, random, 30);
    const Alignment alignment = found(posed, mesh);
    CHECK(most_off(alignment.matrix, posed, mesh) < 1e-12);
    CHECK(alignment.fit.rms < 1e-12);
    CHECK_FALSE(alignment.fit.is_poor);
    CHECK_FALSE(alignment.fit.rival);
  }
}

TEST_CASE("the demo's part comes back, and its coarser twin lies as it did" *
          doctest::skip(kIsSanitized)) {
  const MeshPair pair = default_pair();
  Random random(2);
  const Mesh posed = in_any_pose(pair.a, random, 300);
  CHECK(most_off(found(posed, pair.a).matrix, posed, pair.a) < 1e-9);
  CHECK(most_off(found(posed, pair.b).matrix, posed, pair.a) < 0.01);
}

TEST_CASE("noise moves the place by much less than itself" * doctest::skip(kIsSanitized)) {
  constexpr double kNoise = 0.01;
  const Mesh mesh = lump(4);
  Random random(3);
  for (size_t i = 0; i < kPoses; ++i) {
    const Mesh posed = in_any_pose(noisy(mesh, kNoise, i), random, 10);
    const Alignment alignment = found(posed, mesh);
    CHECK(most_off(alignment.matrix, posed, mesh) < 1.1 * kNoise);
    CHECK(alignment.fit.rms < kNoise);
    CHECK(alignment.fit.share > 0.9);
  }
}

TEST_CASE("a half that is turned by 15 degrees comes back" * doctest::skip(kIsSanitized)) {
  const Mesh mesh = lump(4);
  Random random(4);
  for (size_t i = 0; i < kPoses; ++i) {
    const Mesh half = half_of(mesh, random.direction());
    const Mesh posed = translated(rotated(half, random.direction(), 0.26), {0.05, -0.1, 0.02});
    CHECK(most_off(found(posed, mesh).matrix, posed, half) < 1e-9);
  }
}

TEST_CASE("what A has too much does not move it") {
  const Mesh mesh = lump(4);
  const Mesh a = joined(mesh, translated(cube(0.3), {3, 0, 0}));
  const Mesh posed = translated(rotated(a, {1, 2, 3}, 0.2), {0.1, 0, 0});
  const Alignment alignment = found(posed, mesh);
  CHECK(most_off(alignment.matrix, posed, a) < 1e-9);
  CHECK(alignment.fit.share < 0.95);
}

TEST_CASE("a mesh that lies far off comes back, to the roundings of its coordinates" *
          doctest::skip(kIsSanitized)) {
  const Mesh mesh = lump(3);
  Random random(5);
  for (const double distance : {1e6, 1e9}) {
    const Mesh posed = in_any_pose(mesh, random, distance);
    CHECK(most_off(found(posed, mesh).matrix, posed, mesh) < 4e-15 * distance);
    const Mesh both = translated(mesh, {distance, 0, -distance});
    const Mesh beside = translated(rotated(mesh, {1, 1, 0}, 0.3), {distance, 0.2, -distance});
    CHECK(most_off(found(beside, both).matrix, beside, both) < 4e-15 * distance);
  }
}

TEST_CASE("a symmetric part lies on B, and that it could lie otherwise is told") {
  const Mesh box = cube(0.5);
  Random random(6);
  for (size_t i = 0; i < kPoses; ++i) {
    const Mesh posed = in_any_pose(box, random, 5);
    const Alignment alignment = found(posed, box);
    CHECK(most_beside(alignment.matrix, posed, box) < 1e-12);
    CHECK(alignment.fit.rival);
  }
  const Mesh ball = icosphere(2.0, 3);
  const Alignment rolled = found(in_any_pose(ball, random, 5), ball);
  CHECK(rolled.fit.rms < 0.02);
}

TEST_CASE("where A fits as it lies, it stays") {
  for (const Mesh& mesh : {cube(0.5), icosphere(1.0, 2), lump(3), square_patch(4, 1)}) {
    const MatrixRows rows = found(mesh, mesh).matrix;
    CHECK(rows == MatrixRows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
  }
  const Mesh turned = rotated(cube(0.5), {0, 0, 1}, 0.1);
  CHECK(most_off(found(turned, cube(0.5)).matrix, turned, cube(0.5)) < 1e-12);
}

TEST_CASE("one triangle, and flat meshes") {
  const Mesh triangle = single_triangle({0, 0, 0}, {3, 0, 0}, {0, 1, 0});
  const Mesh corner = joined(square_patch(8, 0), translated(square_patch(8, 0, 0.5), {1, 0, 0}));
  Random random(7);
  for (const Mesh* mesh : {&triangle, &corner}) {
    const Mesh posed = in_any_pose(*mesh, random, 10);
    const Alignment alignment = found(posed, *mesh);
    CHECK(most_beside(alignment.matrix, posed, *mesh) < 1e-6);
  }
}

TEST_CASE("points are laid on a surface") {
  const Mesh mesh = lump(4);
  std::vector<UVec3> faces;
  for (uint32_t i = 0; i < mesh.vertices.size(); ++i) faces.push_back({i, i, i});
  const Mesh points = make_mesh("points", mesh.vertices, faces);
  Random random(8);
  const Mesh posed = in_any_pose(points, random, 10);
  CHECK(most_off(found(posed, mesh).matrix, posed, points) < 1e-9);
}

TEST_CASE("meshes without extent, and of any size, end in a rotation") {
  const Mesh point = single_triangle({1, 2, 3}, {1, 2, 3}, {1, 2, 3});
  const Mesh elsewhere = single_triangle({-4, 0, 9}, {-4, 0, 9}, {-4, 0, 9});
  CHECK(most_off(found(point, elsewhere).matrix, point, elsewhere) < 1e-12);
  found(point, cube(1));
  found(cube(1), point);
  const Mesh line = single_triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  CHECK(most_beside(found(rotated(line, {1, 0, 0}, 1), line).matrix, rotated(line, {1, 0, 0}, 1),
                    line) < 1e-6);
  for (const int exponent : {-1000, -500, 500, 1000}) {
    const Mesh large = scaled(lump(2), exponent);
    found(rotated(large, {1, 2, 0}, 0.1), large);
  }
}

TEST_CASE("a bad fit is told") {
  Mesh rod = cube(0.5);
  for (DVec3& v : rod.vertices) v = glm::dvec3(v) * glm::dvec3(0.2, 0.2, 8);
  CHECK(found(rod, icosphere(1, 1)).fit.is_poor);
}

namespace {

Mesh mirror_image(const Mesh& mesh) {
  std::vector<DVec3> vertices = mesh.vertices;
  std::vector<UVec3> faces = mesh.faces;
  for (DVec3& v : vertices) v.x = -v.x;
  for (UVec3& f : faces) std::swap(f.y, f.z);
  return make_mesh("mirrored", std::move(vertices), std::move(faces));
}

/// A lump that is no mirror image of itself: lump() is, in y.
Mesh twisted_lump(uint32_t subdivisions) {
  Mesh mesh = lump(subdivisions);
  for (DVec3& v : mesh.vertices) v.y += 0.3 * v.x * v.z;
  return mesh;
}

/// A block with a post on one corner and a bar on an edge: it is no mirror image of itself.
Mesh part() {
  Mesh block = cube(0.5);
  for (DVec3& v : block.vertices) v = glm::dvec3(v) * glm::dvec3(4, 2.5, 1);
  const Mesh post = translated(cube(0.25), {1.6, 0.9, 0.7});
  const Mesh bar = translated(cube(0.2), {-1.7, 0.2, -0.6});
  return joined(block, joined(post, bar));
}

}  // namespace

TEST_CASE("a mirror image is told, scanned or not") {
  Random random(9);
  for (const Mesh& mesh : {twisted_lump(4), part()}) {
    for (size_t i = 0; i < kPoses; ++i) {
      const Mesh posed = in_any_pose(mirror_image(mesh), random, 5);
      const Alignment alignment = found(posed, mesh);
      REQUIRE(alignment.fit.mirrored);
      CHECK(*alignment.fit.mirrored < 1e-3);
    }
  }
  if (kIsSanitized) return;
  const Mesh scan = in_any_pose(mirror_image(noisy(twisted_lump(5), 0.01, 3)), random, 5);
  CHECK(found(scan, twisted_lump(4)).fit.mirrored);
}

TEST_CASE("what is no mirror image, or its own, is not told") {
  Random random(10);
  Mesh rod = cube(0.5);
  for (DVec3& v : rod.vertices) v = glm::dvec3(v) * glm::dvec3(0.2, 0.2, 8);
  const std::vector<std::pair<Mesh, Mesh>> pairs = {
      {twisted_lump(4), twisted_lump(4)},
      {mirror_image(lump(4)), lump(4)},
      {part(), part()},
      {noisy(twisted_lump(5), 0.02, 1), twisted_lump(4)},
      {half_of(twisted_lump(4), {1, 0.3, 0.2}), twisted_lump(4)},
      {mirror_image(cube(0.5)), cube(0.5)},
      {mirror_image(icosphere(1, 3)), icosphere(1, 3)},
      {rod, icosphere(1, 1)},
      {cube(0.5), part()},
      {mirror_image(joined(cube(0.5), translated(cube(0.1), {0.5, 0, 0}))),
       joined(cube(0.5), translated(cube(0.1), {0.5, 0, 0}))}};
  for (size_t i = 0; i < (kIsSanitized ? 2 : pairs.size()); ++i) {
    CAPTURE(i);
    CHECK_FALSE(found(in_any_pose(pairs[i].first, random, 3), pairs[i].second).fit.mirrored);
  }
}

TEST_CASE("the same meshes give the same bits, prepared or not") {
  const Mesh mesh = lump(3);
  const Mesh posed = translated(rotated(mesh, {1, 2, 3}, 2), {4, 5, 6});
  const Alignment first = found(noisy(posed, 0.01, 1), mesh);
  const PreparedMesh b = solver().prepare(mesh);
  for (int i = 0; i < (kIsSanitized ? 1 : 3); ++i) {
    const Alignment again = align(solver(), noisy(posed, 0.01, 1), b);
    CHECK(again.matrix == first.matrix);
    CHECK(again.fit == first.fit);
  }
}

TEST_CASE("a fit is called off between its steps") {
  size_t calls = 0;
  const AlignOptions options{.goes_on = [&](size_t) { return ++calls < 3; }};
  CHECK_THROWS_AS(align(solver(), lump(2), lump(2), options), Interrupted);
  CHECK(calls == 3);
  Mesh wrong = lump(2);
  wrong.vertices[5].y = std::nan("");
  CHECK_THROWS_AS(align(solver(), wrong, lump(2)), InputError);
}

TEST_CASE("a matrix that is written is read as the same doubles") {
  Random random(9);
  const Mesh mesh = lump(2);
  const MatrixRows rows = found(in_any_pose(mesh, random, 7), mesh).matrix;
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "vkh_align_test.txt";
  std::ofstream(file, std::ios::binary) << matrix_text(rows);
  CHECK(read_matrix(file) == rows);
  std::filesystem::remove(file);
}

namespace {

/// The squared distance of a point that a matrix places from the surface of cube(0.5).
Rational squared_from_cube(const MatrixRows& rows, const DVec3& p) {
  Rational outside = 0, inside = 1;
  for (const auto& row : rows) {
    const Rational at = Rational(row[0]) * Rational(p.x) + Rational(row[1]) * Rational(p.y) +
                        Rational(row[2]) * Rational(p.z) + Rational(row[3]);
    const Rational beyond = abs(at) - Rational(0.5);
    if (beyond > 0) outside += beyond * beyond;
    inside = std::min<Rational>(inside, -beyond);
  }
  return outside > 0 ? outside : Rational(inside * inside);
}

}  // namespace

TEST_CASE("an interval after a fit holds the distance at its matrix, exactly") {
  Random random(11);
  Question question;
  question.align = true;
  question.tolerance = {.requested = "1e-9", .number = 1e-9};
  Solver* const on[] = {&solver()};
  const auto b = std::make_shared<const ReadMesh>(cube(0.5));
  for (int i = 0; i < (kIsSanitized ? 1 : 2); ++i) {
    const Mesh posed = rotated(noisy(cube(0.5), 0.1, 5 + i), random.direction(), 0.3);
    const Mesh points = make_points("points", translated(posed, random.in_cube(1)).vertices);
    const Answer answer =
        Asking(question, std::make_shared<const ReadMesh>(points), b, on).answer();
    REQUIRE(answer.inputs[0].are_points);
    REQUIRE(answer.placed);
    Rational squared = 0;
    for (const DVec3& p : points.vertices)
      squared = std::max(squared, squared_from_cube(*answer.placed->by.matrix, p));
    CHECK(is_lower_bound(answer.a_to_b.lower, squared));
    CHECK(is_upper_bound(answer.a_to_b.upper, squared));
    CHECK(answer.a_to_b.upper - answer.a_to_b.lower < 1e-7);
  }
}
