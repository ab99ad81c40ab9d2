// Polygons as triangles: exact area, no overlap, the fan if it is right, and old files.
#include "vkhausdorff/polygon.h"

#include <doctest/doctest.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "host/read/readers.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

#ifdef VKH_SANITIZED
constexpr int kTimes = 20;  // exact arithmetic is slow there, and the release tree tests it
#else
constexpr int kTimes = 1;
#endif

using Points = std::vector<glm::dvec3>;
using Faces = std::vector<glm::uvec3>;

struct Made {
  PolygonResult result;
  Faces faces;
};

Faces fan_of(size_t corners) {
  Faces faces;
  for (uint32_t i = 2; i < corners; ++i) faces.emplace_back(0, i - 1, i);
  return faces;
}

Made made_of(const Points& points) {
  Made made = {{}, fan_of(points.size())};
  made.result = triangulate_fan(points, made.faces);
  return made;
}

// Twice the area seen along z.
mpq_class cross(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const mpq_class ax(a.x), ay(a.y), bx(b.x), by(b.y), cx(c.x), cy(c.y);
  return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
}

mpq_class area_of(const Points& points) {
  mpq_class sum = 0;
  for (size_t i = 2; i < points.size(); ++i) sum += cross(points[0], points[i - 1], points[i]);
  return sum;
}

// The number of triangles that cover the point, which lies on no edge: by exact signs.
int cover(const Points& points, const Faces& faces, const glm::dvec3& at) {
  int count = 0;
  for (const glm::uvec3& f : faces) {
    std::array<int, 3> signs{};
    for (int k = 0; k < 3; ++k)
      signs[static_cast<size_t>(k)] = sgn(cross(points[f[k]], points[f[(k + 1) % 3]], at));
    const bool is_in = std::all_of(signs.begin(), signs.end(), [&](int s) { return s > 0; }) ||
                       std::all_of(signs.begin(), signs.end(), [&](int s) { return s < 0; });
    count += is_in ? 1 : 0;
  }
  return count;
}

int winding(const Points& points, const glm::dvec3& at) {
  int turns = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 &a = points[i], &b = points[(i + 1) % points.size()];
    if ((a.y <= at.y) == (b.y <= at.y)) continue;
    const int side = sgn(cross(a, b, at));
    if (a.y <= at.y && side > 0) ++turns;
    if (a.y > at.y && side < 0) --turns;
  }
  return turns;
}

// A star seen from its middle, so it is simple; `grid` makes straight and repeated corners.
Points star(std::mt19937& random, size_t count, double radius, bool grid) {
  std::uniform_real_distribution<double> share(0.3, 1.0);
  Points points;
  for (size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const double r = radius * share(random);
    glm::dvec3 p(r * std::cos(angle), r * std::sin(angle), 0);
    if (grid) p = {std::round(p.x * 64) / 64, std::round(p.y * 64) / 64, 0};
    points.push_back(p);
  }
  return points;
}

// The outer ring, over a bridge to the hole, round it the other way, and back.
Points with_hole(std::mt19937& random, size_t count) {
  Points outer = star(random, count, 1, false), hole = star(random, count, 0.25, false);
  std::reverse(hole.begin(), hole.end());
  std::rotate(hole.begin(), hole.end() - 1, hole.end());
  Points points = outer;
  points.push_back(outer[0]);
  points.insert(points.end(), hole.begin(), hole.end());
  points.push_back(hole[0]);
  return points;
}

void check_tiles(std::mt19937& random, const Points& points, const Made& made) {
  REQUIRE(!has_only_fan(made.result.kind));
  mpq_class sum = 0;
  for (const glm::uvec3& f : made.faces)
    sum += abs(cross(points[f[0]], points[f[1]], points[f[2]]));
  CHECK(sum == abs(area_of(points)));
  std::uniform_real_distribution<double> place(-1, 1);
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 at(place(random), place(random), 0);
    CHECK(cover(points, made.faces, at) == std::abs(winding(points, at)));
  }
}

TEST_CASE("random simple polygons, also with holes by bridges, are tiled exactly") {
  std::mt19937 random(32);
  for (int i = 0; i < 4000 / kTimes; ++i) {
    CAPTURE(i);
    const size_t count = 4 + static_cast<size_t>(i) % 20;
    Points points = i % 2 == 0 ? star(random, count, 1, false) : with_hole(random, count);
    if (i % 3 == 0) std::reverse(points.begin(), points.end());
    if (i % 4 < 2) points.insert(points.begin() + 2, points[2]);
    check_tiles(random, points, made_of(points));
  }
}

TEST_CASE("polygons on a grid are tiled, or said to cross themselves") {
  std::mt19937 random(33);
  size_t tiled = 0;
  for (int i = 0; i < 2000 / kTimes; ++i) {
    CAPTURE(i);
    const Points points = star(random, 4 + static_cast<size_t>(i) % 12, 1, true);
    const Made made = made_of(points);
    if (has_only_fan(made.result.kind)) continue;
    ++tiled;
    check_tiles(random, points, made);
  }
  CHECK(tiled > 1900 / kTimes);
}

TEST_CASE("random corners are refused where the outline winds twice or backwards") {
  std::mt19937 random(34);
  std::uniform_real_distribution<double> place(-1, 1);
  size_t none = 0;
  for (int i = 0; i < 4000 / kTimes; ++i) {
    CAPTURE(i);
    Points points;
    for (size_t k = 0; k < 4 + static_cast<size_t>(i) % 5; ++k)
      points.emplace_back(place(random), place(random), 0);
    const Made made = made_of(points);
    if (has_only_fan(made.result.kind)) {
      ++none;
      CHECK(made.faces == fan_of(points.size()));
    } else {
      check_tiles(random, points, made);
    }
  }
  CHECK(none > 2000 / kTimes);
}

TEST_CASE("spikes of random outlines are segments: inside, outside, and on each other") {
  std::mt19937 random(36);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (int i = 0; i < 2000 / kTimes; ++i) {
    CAPTURE(i);
    Points points = star(random, 5 + static_cast<size_t>(i) % 12, 1, false);
    for (int spikes = 1 + i % 3; spikes > 0; --spikes) {
      const size_t at = random() % points.size();
      const glm::dvec3 from = points[at], tip(place(random), place(random), 0);
      const std::array<glm::dvec3, 2> spike = {tip, from};
      points.insert(points.begin() + static_cast<std::ptrdiff_t>(at) + 1, spike.begin(),
                    spike.end());
    }
    if (i % 2 == 0) std::reverse(points.begin(), points.end());
    check_tiles(random, points, made_of(points));
  }
}

TEST_CASE("what is convex or on a line keeps its fan") {
  for (const Points& points :
       {Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
        Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
        Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}},
        Points{{0, 0, 0}, {3, 3, 3}, {1, 1, 1}, {2, 2, 2}},
        Points{{0, 0, 0}, {1e300, 0, 0}, {1e300, 1e300, 0}, {0, 1e300, 0}},
        Points{{0, 0, 0}, {0, 0, 5e-324}, {0, 1e-323, 1e-323}, {0, 5e-324, 0}}}) {
    const Made made = made_of(points);
    CHECK(made.result.kind == PolygonKind::kFan);
    CHECK(made.faces == fan_of(points.size()));
  }
}

TEST_CASE("what crosses itself or has no area is said") {
  Points pentagram;
  for (int i = 0; i < 5; ++i)
    pentagram.emplace_back(std::cos(i * 0.8 * std::numbers::pi),
                           std::sin(i * 0.8 * std::numbers::pi), 0);
  // A spiral over itself has positive ears, which overlap.
  const Points twice = {{2, 0, 0}, {0, 2, 0}, {-2, 0, 0}, {0, -2, 0},
                        {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const Points eight = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const Points back = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  for (const auto& [points, kind] : {std::pair{pentagram, PolygonKind::kCrossing},
                                     {twice, PolygonKind::kCrossing},
                                     {eight, PolygonKind::kNoArea},
                                     {back, PolygonKind::kNoArea}}) {
    const Made made = made_of(points);
    CHECK(made.result.kind == kind);
    CHECK(made.faces == fan_of(points.size()));
  }
}

TEST_CASE("what crosses along the axis that it faces most may be simple along another") {
  // A face of OpenSubdiv's catmark_square_hedit1: convex along z, and a bow tie along x and y.
  const Points bent = {{0, -0.333333135, 1},
                       {0.0208333209, -0.333333135, 0.928894043},
                       {0.0208333209, -0.312499821, 0.932861328},
                       {0, -0.312499821, 0.928894043}};
  const Made made = made_of(bent);
  CHECK(made.result.kind == PolygonKind::kFan);
  CHECK(made.result.axis == 2);
  CHECK(made.faces == fan_of(4));
  CHECK(made.result.ambiguity > 0.03);  // the diagonals' middles are 0.034 apart along z
  CHECK(made.result.ambiguity < 0.08);
  // Seen from its edge this one is a simple sliver, too, and crosses itself nevertheless.
  const Points bow = {{0, 0, 0}, {1, 1, 0.01}, {1, 0, 0}, {0, 1.2, 0.02}};
  CHECK(made_of(bow).result.kind == PolygonKind::kCrossing);
}

TEST_CASE("the ambiguity holds both diagonals of a quad, and is 0 in a plane of the axes") {
  CHECK(made_of({{0, 0, 3}, {1, 0, 3}, {1, 1, 3}, {0, 1, 3}}).result.ambiguity == 0);
  // The diagonals' middles are 1/2 apart.
  const double bent = made_of({{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 0}}).result.ambiguity;
  CHECK(bent >= 0.5);
  CHECK(bent <= 1.01);
  const double tilted =
      made_of({{0, 0, 0}, {1, 0, 0.3}, {1, 1, 0.4}, {0, 1, 0.1}}).result.ambiguity;
  CHECK(tilted < 1e-14);
}

// So no interval that is wider by it misses any triangulation's.
TEST_CASE("neither triangulation of a quad is farther from the other than the ambiguity") {
  std::mt19937 random(14);
  std::uniform_real_distribution<double> off(-0.2, 0.2);
  int near = 0;
  for (int i = 0; i < 200 / kTimes; ++i) {
    Points quad = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (glm::dvec3& p : quad) p += glm::dvec3(off(random), off(random), off(random));
    const double ambiguity = made_of(quad).result.ambiguity;
    const std::vector<DVec3> corners(quad.begin(), quad.end());
    const Mesh one = make_mesh("one", corners, {{0, 1, 2}, {0, 2, 3}});
    const Mesh other = make_mesh("other", corners, {{1, 2, 3}, {1, 3, 0}});
    const double apart = std::max(test::reference_hausdorff(one, other, 1e-6).lower,
                                  test::reference_hausdorff(other, one, 1e-6).lower);
    CHECK(apart <= ambiguity);
    near += ambiguity < 2 * apart ? 1 : 0;
  }
  CHECK(near > 100 / kTimes);
}

TEST_CASE("20,000 spikes are cut; 100,000 are given up within a bound, and keep the fan") {
  std::mt19937 random(35);
  CHECK(made_of(star(random, 20000 / kTimes, 1, false)).result.kind == PolygonKind::kClipped);
  if (kTimes > 1) return;
  const Made made = made_of(star(random, 100000, 1, false));
  CHECK(made.result.kind == PolygonKind::kIntricate);
  CHECK(made.faces == fan_of(100000));
}

TEST_CASE("a plate keeps its hole: the bridge's polygon is cut round it") {
  const std::string file =
      "v 0 0 0\nv 30 0 0\nv 30 30 0\nv 0 30 0\nv 10 10 0\nv 20 10 0\nv 20 20 0\nv 10 20 0\n"
      "f 1 2 3 4 1 5 8 7 6 5\n";
  const ReadMesh mesh = parse_mesh({.name = "plate.obj", .bytes = file});
  CHECK(cover(mesh.vertices, mesh.faces, {15, 14, 0}) == 0);
  CHECK(cover(mesh.vertices, mesh.faces, {5, 14, 0}) == 1);
  CHECK(mesh.polygons.clipped == 1);
  CHECK(mesh.polygons.fanned == 0);
  CHECK(mesh.polygons.ambiguity == 0);
}

std::string refusal_of(const MeshSource& source) {
  try {
    parse_mesh(source);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

using Exact3 = std::array<mpq_class, 3>;

mpq_class dot(const Exact3& a, const Exact3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Exact3 between(const glm::dvec3& from, const glm::dvec3& to) {
  return {mpq_class(to.x) - from.x, mpq_class(to.y) - from.y, mpq_class(to.z) - from.z};
}

/// The greatest squared distance between the corners' feet on a plane across a line along `line`.
mpq_class squared_width(const Points& points, const Exact3& line) {
  std::vector<Exact3> feet;
  for (const glm::dvec3& p : points) {
    Exact3 d = between(points[0], p);
    const mpq_class s = dot(d, line) / dot(line, line);
    for (size_t k = 0; k < 3; ++k) d[k] -= s * line[k];
    feet.push_back(d);
  }
  mpq_class most = 0;
  for (const Exact3& a : feet) {
    for (const Exact3& b : feet) {
      const Exact3 d = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
      if (dot(d, d) > most) most = dot(d, d);
    }
  }
  return most;
}

/// The difference that the product takes as the line: the longest from the first corner.
Exact3 line_of_corners(const Points& points) {
  glm::dvec3 line(0);
  for (const glm::dvec3& p : points) {
    const glm::dvec3 d = p - points[0];
    if (d.x * d.x + d.y * d.y + d.z * d.z > line.x * line.x + line.y * line.y + line.z * line.z)
      line = d;
  }
  return {line.x, line.y, line.z};
}

Points near_a_line(std::mt19937& random, double width) {
  std::uniform_real_distribution<double> any(-1, 1);
  const glm::dvec3 from(any(random), any(random), any(random));
  const glm::dvec3 along(any(random), any(random), any(random));
  Points points;
  for (int corners = 4 + static_cast<int>(random() % 4); corners > 0; --corners) {
    const double at = any(random);
    points.push_back(from + at * along + width * glm::dvec3(any(random), any(random), any(random)));
  }
  return points;
}

TEST_CASE("slivers are ambiguous by their width at most, not by their length") {
  std::mt19937 random(55);
  int slivers = 0;
  for (int i = 0; i < 20000 / kTimes; ++i) {
    const double width = std::ldexp(1.0, -20 - static_cast<int>(random() % 40));
    const Points points = near_a_line(random, random() % 3 == 0 ? 0 : width);
    const Made made = made_of(points);
    if (made.result.ambiguity == 0) continue;  // all corners on a line, exactly
    const Exact3 line = line_of_corners(points);
    const mpq_class exact = squared_width(points, line), said = made.result.ambiguity;
    // A polygon that has triangles keeps the bound by its plane up to 2^-20 of an extent below 8.
    if (has_only_fan(made.result.kind)) {
      CHECK(exact <= said * said);
      CHECK(said <= 8 * width + 1e-13);
      ++slivers;
    } else {
      CHECK(said <= 8 * width + 0x1p-17);
    }
  }
  CHECK(slivers > 1000 / kTimes);
}

TEST_CASE("corners on a line leave nothing open, whatever their order") {
  std::mt19937 random(56);
  for (int i = 0; i < 1000; ++i) {
    const auto whole = [&] {
      return static_cast<double>(static_cast<int>(random() % 2001) - 1000);
    };
    const glm::dvec3 from(whole(), whole(), whole()), along(whole(), whole(), whole());
    Points points;
    for (int corners = 4 + static_cast<int>(random() % 4); corners > 0; --corners)
      points.push_back(from + whole() * along);
    const Made made = made_of(points);
    CHECK(made.result.kind == PolygonKind::kFan);
    CHECK(made.result.ambiguity == 0);
  }
}

TEST_CASE("a sliver that crosses itself is read as a fan, and is said with its width") {
  const std::string box = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3\nf 2 3 4\n";
  const std::string bow = "v 0.1 0.1 0\nv 0.2 0.1 5e-6\nv 0.2 0.1 0\nv 0.1 0.1 2e-6\n";
  const Mesh mesh = parse_mesh({.name = "x.obj", .bytes = box + bow + "f 5 6 7 8\n"});
  CHECK(mesh.polygons.fanned == 1);
  CHECK(mesh.polygons.first_fanned == 2);
  CHECK(mesh.polygons.ambiguous_face == 2);
  CHECK(mesh.polygons.ambiguity >= 5e-6);
  CHECK(mesh.polygons.ambiguity < 7.1e-6);
  CHECK(mesh.delta == 0);
  const Mesh any = parse_mesh(
      {.name = "x.obj", .bytes = box + bow + "f 5 6 7 8\n", .limits = {.any_triangulation = true}});
  CHECK(any.delta == any.polygons.ambiguity);
  // As wide as a thousandth of the mesh it is no sliver.
  CHECK(refusal_of({.name = "x.obj",
                    .bytes = box + "v 0.1 0.1 0\nv 0.2 0.1 5e-3\nv 0.2 0.1 0\nv 0.1 0.1 2e-3\n" +
                             "f 5 6 7 8\n"})
            .starts_with("x.obj: face 2: an outline that crosses itself"));
}

TEST_CASE("a polygon without a triangulation is refused by its face, or fanned and noted") {
  const std::string corners = "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nv 0 3 0\n";
  const std::string crossing = corners + "f 1 2 3\nf 1 2 5 3 4\n";
  const std::string flat = corners + "f 1 2 3\nf 1 2 3 4\nf 1 3 4 3\n";
  CHECK(refusal_of({.name = "x.obj", .bytes = crossing}) ==
        "x.obj: face 1: an outline that crosses itself; expected a polygon that does not cross "
        "itself, or --polygons fan, which measures the fan of its corners");
  CHECK(refusal_of({.name = "x.obj", .bytes = flat}) ==
        "x.obj: face 1: an outline that encloses no area, the first of 2 such faces; expected a "
        "polygon that does not cross itself, or --polygons fan, which measures the fan of its "
        "corners");
  const ReadMesh mesh = parse_mesh(
      {.name = "x.obj", .bytes = flat, .limits = {.odd_polygons = OddPolygons::kFanned}});
  CHECK(mesh.faces == Faces{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 2, 3}, {0, 3, 2}});
  CHECK(mesh.polygons.fanned == 2);
  CHECK(line_of(mesh.notes.back()) ==
        "polygons: fanned: 2 faces without a triangulation of their outline; what is measured may "
        "leave it; at face 1 it encloses no area");
}

}  // namespace
}  // namespace vkh
