// Sides of cells and insides of meshes against exact integers: winding numbers where there is an
// inside, planes of all closest faces otherwise. Hard meshes, closed and open, hard cells about
// them.
#include "host/survey/sides.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/geometric.hpp>
#include <map>

#include "host/solve/cell_corners.h"
#include "host/solve/held_pairs.h"
#include "tests/shapes/adversarial.h"
#include "tests/shapes/shapes.h"
#include "tests/support/all_cells.h"
#include "tests/support/solver_bench.h"
#include "tests/support/tally.h"
#include "tests/verification/oracle/exact_side.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using glm::dvec3;

Mesh reversed(Mesh mesh) {
  for (UVec3& f : mesh.faces) std::swap(f.y, f.z);
  return mesh;
}

Mesh tetrahedron(const std::array<dvec3, 4>& p) {
  const bool is_left = glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) < 0;
  Mesh mesh = make_mesh("tetrahedron", {p[0], p[1], p[2], p[3]},
                        {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
  return is_left ? mesh : reversed(std::move(mesh));
}

Mesh moved(Mesh mesh, const std::function<dvec3(const dvec3&)>& to) {
  for (DVec3& v : mesh.vertices) v = to(v);
  return mesh;
}

// A tetrahedron whose edges are as sharp as 2^-14, or whose faces are needles.
Mesh sharp(Random& random) {
  const double thin = std::ldexp(1.0, -static_cast<int>(random.below(15)));
  const double narrow = std::ldexp(1.0, -static_cast<int>(random.below(10)));
  return tetrahedron({dvec3(-1, random.range(-0.1, 0.1), 0), dvec3(1, 0, 0),
                      dvec3(random.range(-0.5, 0.5), narrow, thin),
                      dvec3(random.range(-0.5, 0.5), narrow, -thin)});
}

// A sphere with spikes, in and out: edges of every angle.
Mesh spiky(Random& random) {
  Mesh mesh = icosphere(1.0, random.below(3));
  for (DVec3& v : mesh.vertices) v *= std::exp2(random.range(-2.0, 0.5));
  return mesh;
}

// The mesh with a corner on the middle of an edge of one face, and a face without area that closes
// the gap: edges are used as often in both directions as before.
Mesh with_flat_face(const Mesh& mesh, Random& random) {
  std::vector<dvec3> vertices(mesh.vertices.begin(), mesh.vertices.end());
  std::vector<glm::uvec3> faces(mesh.faces.begin(), mesh.faces.end());
  const uint32_t f = random.below(static_cast<uint32_t>(faces.size()));
  const glm::uvec3 t = faces[f];
  const auto m = static_cast<uint32_t>(vertices.size());
  vertices.push_back((vertices[t.x] + vertices[t.y]) * 0.5);
  faces[f] = {t.x, m, t.z};
  faces.push_back({m, t.y, t.z});
  faces.push_back({t.x, t.y, m});
  return make_mesh("flat", std::move(vertices), std::move(faces));
}

Mesh without_a_face(Mesh mesh, Random& random) {
  mesh.faces.erase(mesh.faces.begin() + random.below(static_cast<uint32_t>(mesh.faces.size())));
  return mesh;
}

Mesh cube_at(const dvec3& at, double half = 0.5) { return translated(cube(half), at); }

// Boxes and tetrahedra with corners on a coarse lattice touch and cross in all ways.
Mesh lattice_box(Random& random) {
  const dvec3 lo(random.below(4), random.below(4), random.below(4));
  const dvec3 size(1 + random.below(2), 1 + random.below(2), 1 + random.below(2));
  return moved(cube(0.5), [&](const dvec3& p) { return lo + (p + dvec3(0.5)) * size; });
}
Mesh lattice_tetrahedron(Random& random) {
  for (;;) {
    std::array<dvec3, 4> p{};
    for (dvec3& v : p) v = dvec3(random.below(4), random.below(4), random.below(3));
    if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) != 0) return tetrahedron(p);
  }
}

struct ClosedCase {
  const char* name;
  Mesh mesh;
  std::optional<Inside> inside = {};  // where it is known
};

ClosedCase closed_case(uint32_t family, Random& random) {
  const double by = std::ldexp(1.0, -static_cast<int>(random.below(30)));
  switch (family) {
    case 0:
      return {"cube", cube(random.range(0.1, 1)), Inside::kProven};
    case 1:
      return {"sphere", icosphere(random.range(0.1, 1), random.below(3)), Inside::kProven};
    case 2:
      return {"torus", torus(1, random.range(0.1, 0.7), 9, 6), Inside::kProven};
    case 3:
      return {"sharp", sharp(random), Inside::kProven};
    case 4:
      return {"spiky", spiky(random), {}};
    case 5:
      return {"reversed", reversed(spiky(random)), {}};
    case 6:
      return {"needles",
              moved(icosphere(1, 1), [by](const dvec3& p) { return dvec3(p.x, p.y * by, p.z); }),
              {}};
    case 7:
      return {"cavity", joined(cube(1), reversed(icosphere(random.range(0.2, 0.9), 1))),
              Inside::kProven};
    case 8:
      return {"nested", joined(cube(1), icosphere(random.range(0.2, 0.9), 1)), Inside::kWinding};
    case 9:
      return {"apart", joined(cube_at({0, 0, 0}), cube_at({1 + by, 0.3, 0.1})), Inside::kProven};
    case 10:
      return {"touching in a face", joined(cube_at({0, 0, 0}), cube_at({1, 0.25, 0})),
              Inside::kCrossing};
    case 11:
      return {"touching in an edge", joined(cube_at({0, 0, 0}), cube_at({1, 1, 0})),
              Inside::kProven};
    case 12:
      return {"touching in part of an edge", joined(cube_at({0, 0, 0}), cube_at({1, 1, 0.25})),
              Inside::kProven};
    case 13:
      return {"touching in a corner", joined(cube_at({0, 0, 0}), cube_at({1, 1, 1})),
              Inside::kProven};
    case 14:
      return {"a corner on a face",
              joined(cube(1), tetrahedron({dvec3(1, 0.125, 0.25), dvec3(2, 0, 0), dvec3(2, 1, 0),
                                           dvec3(2, 0, 1)})),
              Inside::kProven};
    case 15:
      return {"crossing", joined(cube_at({0, 0, 0}), cube_at({random.range(0.1, 0.9), 0.2, 0.3})),
              Inside::kCrossing};
    case 16:
      return {"crossing by little", joined(cube_at({0, 0, 0}), cube_at({1 - by, 0.2, 0.3})),
              Inside::kCrossing};
    case 17:
      return {"both kinds", joined(cube_at({0, 0, 0}), reversed(cube_at({3, 0, 0}))),
              Inside::kWinding};
    case 18:
      return {"a flat face",
              with_flat_face(random.below(2) == 0 ? cube(1) : sharp(random), random),
              {}};
    case 19: {
      Mesh mesh = with_flat_face(with_flat_face(icosphere(1, 1), random), random);
      return {"flat faces", std::move(mesh), {}};
    }
    case 20:
      return {"twice", joined(cube(1), cube(1)), Inside::kCrossing};
    case 21:
      return {"there and back", joined(cube(1), reversed(cube(1))), Inside::kCrossing};
    case 22:
      return {"a bare point",
              joined(cube(1), single_triangle(dvec3(1.5, 0.2, 0.1), dvec3(1.5, 0.2, 0.1),
                                              dvec3(1.5, 0.2, 0.1))),
              Inside::kProven};
    case 23:
      return {"a wall",
              joined(cube(1), joined(single_triangle({1, 0, 0}, {2, 0, 0}, {1, 0.5, 0}),
                                     single_triangle({1, 0, 0}, {1, 0.5, 0}, {2, 0, 0}))),
              Inside::kCrossing};
    case 24:
      return {"far away", translated(spiky(random), dvec3(1e6, -3e5, 7)), {}};
    case 25:
      return {"shells in cavities",
              joined(joined(cube(1), reversed(cube(0.75))), icosphere(0.5, 1)), Inside::kProven};
    case 26: {
      Mesh wall = joined(cube(1), reversed(cube(1 - by)));
      return {"a thin wall", std::move(wall), Inside::kProven};
    }
    case 27: {
      Mesh boxes = lattice_box(random);
      for (uint32_t k = 1 + random.below(2); k > 0; --k) boxes = joined(boxes, lattice_box(random));
      return {"boxes of a lattice", std::move(boxes), {}};
    }
    case 28:
      return {"tetrahedra of a lattice",
              joined(lattice_tetrahedron(random), lattice_tetrahedron(random)),
              {}};
    default:
      return {"open", without_a_face(spiky(random), random), Inside::kOpen};
  }
}
constexpr uint32_t kFamilies = 30;

// A small triangle somewhere about a mesh: at a corner, an edge or a face of it, or anywhere.
std::array<dvec3, 3> triangle_about(const Mesh& mesh, Random& random) {
  const auto t = corners(mesh, random.below(static_cast<uint32_t>(mesh.faces.size())));
  const double size = diagonal(mesh) * std::ldexp(1.0, -static_cast<int>(random.below(24)));
  const double away = size * std::exp2(random.range(-3, 4));
  const dvec3 weights = barycentrics(random);
  const dvec3 at = t[0] * weights.x + t[1] * weights.y + t[2] * weights.z +
                   (random.below(8) == 0 ? dvec3(0) : random.direction() * away);
  std::array<dvec3, 3> corners{};
  for (dvec3& p : corners) p = at + random.in_cube(size);
  if (random.below(8) == 0) corners[1] = corners[0];
  return corners;
}

// The corners of a cell, and random points of it, as barycentrics with the sum 2^24.
std::vector<glm::uvec3> points_of(const gpu::Cell& cell, Random& random) {
  const lib::Bary3 t = corners_of(cell);
  const auto mixed = [&](const glm::uvec3& w) {
    const glm::uvec2 sum = t.a * w.x + t.b * w.y + t.c * w.z;
    return glm::uvec3((1u << ExactSides::kBits) - sum.x - sum.y, sum.x, sum.y);
  };
  std::vector<glm::uvec3> points = {mixed({16, 0, 0}), mixed({0, 16, 0}), mixed({0, 0, 16}),
                                    mixed({5, 5, 6})};
  const uint32_t x = random.below(17), y = random.below(17 - x);
  points.push_back(mixed({x, y, 16 - x - y}));
  return points;
}

struct Attack {
  test::Tally tally;
  std::map<std::string, std::array<int, 2>> of_family = {};  // cells, and those with a side
};

// A cell, and what was told of it: by planes alone, and by all that is known of B.
struct ToldCell {
  gpu::Cell cell;
  CellSide by_planes, told;
};

// Checks one claim at some points of the cell.
void check_cell(Attack& attack, const ExactSides& oracle, const ClosedCase& b, const ToldCell& of,
                const Sides& sides, const SurveyedPair& pair, Random& random) {
  const auto& [cell, by_planes, told] = of;
  auto& counts = attack.of_family[b.name];
  ++counts[0];
  counts[1] += told.side != SurfaceSide::kUnsigned ? 1 : 0;
  test::Tally& tally = attack.tally;
  const auto describe = [&] { return std::string(b.name); };
  tally.require((told.side == SurfaceSide::kUnsigned) == (told.doubt != Doubt::kNone),
                "a doubt where there is no side", describe);
  const double off = 1e-12 * (diagonal(pair.b) + glm::length(dvec3(pair.b.vertices[0])));
  for (const glm::uvec3& w : points_of(cell, random)) {
    const exact::Vector p = oracle.point(cell.face, w);
    if (sides.is_solid()) {
      const std::optional<int> winding = oracle.winding(p);
      tally.count("points on B, or behind edges along all axes", !winding);
      if (!winding) continue;
      const bool is_outward = b.name != std::string("reversed");
      tally.require(*winding == 0 || *winding == (is_outward ? 1 : -1), "an inside", describe);
      const bool is_over = *winding == (is_outward ? 0 : -1);
      tally.require(
          told.side == SurfaceSide::kUnsigned || (told.side == SurfaceSide::kOver) == is_over,
          "the side by parity", describe);
      tally.count("points with a side by parity", told.side != SurfaceSide::kUnsigned);
    }
    if (by_planes.side == SurfaceSide::kUnsigned) continue;
    const glm::uvec3& f = pair.a.faces[cell.face];
    const dvec3 near = (pair.a.vertices[f.x] * double(w.x) + pair.a.vertices[f.y] * double(w.y) +
                        pair.a.vertices[f.z] * double(w.z)) *
                       0x1p-24;
    const ExactSides::Closest closest = oracle.closest(p, near, off);
    const bool is_over = by_planes.side == SurfaceSide::kOver;
    tally.require((is_over ? closest.below : closest.above) == 0 && closest.in_plane == 0 &&
                      (is_over ? closest.above : closest.below) > 0,
                  "the side by all closest faces", describe);
  }
}

// The same of a cell whose part that is nearer than `near` needs no side.
void check_near(test::Tally& tally, const ExactSides& oracle, const ClosedCase& b,
                const SurveyedPair& pair, const gpu::Cell& cell, SurfaceSide told, double near,
                Random& random) {
  if (told == SurfaceSide::kUnsigned) return;
  const glm::uvec3& f = pair.a.faces[cell.face];
  const double sure = near + 1e-6 * (near + diagonal(b.mesh));
  for (const glm::uvec3& w : points_of(cell, random)) {
    const exact::Vector p = oracle.point(cell.face, w);
    const std::optional<int> winding = oracle.winding(p);
    const dvec3 at = (pair.a.vertices[f.x] * double(w.x) + pair.a.vertices[f.y] * double(w.y) +
                      pair.a.vertices[f.z] * double(w.z)) *
                     0x1p-24;
    if (!winding || point_mesh_distance(at, pair.b) < sure) continue;
    const bool is_over = *winding == (b.name != std::string("reversed") ? 0 : -1);
    tally.require((told == SurfaceSide::kOver) == is_over, "the side of what is not near",
                  [&] { return std::string(b.name); });
    tally.count("points that are not near, with a side by parity", true);
  }
}

void attack(Attack& attack, uint64_t seed, uint32_t cells) {
  Random random(seed);
  const ClosedCase b = closed_case(static_cast<uint32_t>(seed % kFamilies), random);
  std::vector<dvec3> vertices;
  std::vector<glm::uvec3> faces;
  for (uint32_t k = 0; k < 40; ++k) {
    for (const dvec3& p : triangle_about(b.mesh, random)) vertices.push_back(p);
    faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  const Mesh a = make_mesh("cells", std::move(vertices), std::move(faces));
  hold_pair(solver(), {a, b.mesh}, {}, [&](const SurveyedPair& pair) {
    const Sides sides(pair);
    attack.tally.require(
        !b.inside || sides.shells().inside() == *b.inside, "the kind of inside",
        [&] { return std::string(b.name) + ": " + inside_name(sides.shells().inside()); });
    const ExactSides oracle(a, b.mesh);
    const size_t at_least = size_t{1} << (6 + random.below(6));
    SideSearch by_planes = sides.search();
    by_planes.is_solid = false;
    const std::span<const uint32_t> found = sided_cells(pair, by_planes, at_least).classes;
    const std::vector<uint32_t> classes(found.begin(), found.end());
    const CellsRead told = sided_cells(pair, sides.search(), at_least);
    REQUIRE(classes.size() == told.cells.size());
    for (uint32_t k = 0; k < cells; ++k) {
      const size_t i = random.below(static_cast<uint32_t>(classes.size()));
      check_cell(attack, oracle, b,
                 {told.cells[i], side_of_class(classes[i]), side_of_class(told.classes[i])}, sides,
                 pair, random);
    }
    if (!sides.is_solid()) return;
    SideSearch but_near = sides.search();
    const double near = std::exp2(random.range(-12, -2)) * diagonal(b.mesh);
    but_near.near = static_cast<float>(pair.frame.to_frame(near));
    const std::vector<uint32_t> strictly(told.classes.begin(), told.classes.end());
    const CellsRead more = sided_cells(pair, but_near, at_least);
    for (size_t i = 0; i < strictly.size(); ++i) {
      const SurfaceSide side = side_of_class(more.classes[i]).side;
      if (side_of_class(strictly[i]).side == side) continue;
      attack.tally.count("cells with the side of what is not near", true);
      check_near(attack.tally, oracle, b, pair, more.cells[i], side, near, random);
    }
  });
}

TEST_CASE("sides of cells about hard meshes, by exact integers") {
  const char* count = std::getenv("VKH_SIDES_MESHES");
  const int meshes = count != nullptr ? std::atoi(count) : 112;
  Attack all{test::Tally("sides")};
  for (int seed = 0; seed < meshes && !all.tally.hopeless(); ++seed)
    attack(all, static_cast<uint64_t>(seed), 60);
  for (const auto& [name, counts] : all.of_family)
    MESSAGE(name << ": " << counts[1] << " of " << counts[0] << " cells have a side");
  all.tally.conclude(static_cast<uint64_t>(meshes) * 60);
}

TEST_CASE("an edge of two faces in one direction is refused, by its faces") {
  Mesh b = cube(1);
  std::swap(b.faces[5].y, b.faces[5].z);
  const Mesh a = single_triangle({2, 0, 0}, {2, 1, 0}, {2, 0, 1});
  const FramedPair framed = frame_pair(a, b);
  const Sides sides({a, b, framed.frame, 0, 10, true});
  CHECK(sides.shells().edges().conflicts == 3);
  CHECK_FALSE(sides.is_solid());
  REQUIRE(sides.shells().edges().first);
  const auto [first, second] = sides.shells().edges().first->faces;
  CHECK((first == 5 || second == 5));
  CHECK_THROWS_AS(refuse_conflicts(b), InputError);
}

Shells shells_of(const Mesh& mesh) {
  return Shells({mesh.vertices.begin(), mesh.vertices.end()}, mesh.faces);
}

TEST_CASE("how much of a mesh is inside out, by winding numbers") {
  const auto of = [](const Mesh& mesh) { return shells_of(mesh).inside_out(); };
  const Mesh solid = cube(1), inner = cube(0.5), beside = cube_at({5, 0, 0});
  const Mesh hollow = joined(solid, reversed(inner));
  for (const Mesh& right : {solid, joined(solid, beside), hollow, joined(solid, inner)})
    CHECK(of(right) == InsideOut::kNone);
  for (const Mesh& wrong : {reversed(solid), reversed(joined(solid, beside)), reversed(hollow)})
    CHECK(of(wrong) == InsideOut::kAll);
  CHECK(of(moved(solid, [](const dvec3& p) { return dvec3(-p.x, p.y, p.z); })) == InsideOut::kAll);
  for (const Mesh& one : {joined(solid, reversed(beside)), joined(reversed(solid), beside)})
    CHECK(of(one) == InsideOut::kPart);
  Random random(3);
  CHECK(of(reversed(without_a_face(solid, random))) == InsideOut::kNone);  // an open one has none
}

// Six times what the tetrahedra from the origin to the faces add up to. Corners are small integers.
int64_t six_volumes(const Mesh& mesh) {
  int64_t sum = 0;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto t = corners(mesh, f);
    const auto at = [&](size_t i, int axis) { return static_cast<int64_t>(t[i][axis]); };
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      sum += at(0, i) * (at(1, j) * at(2, k) - at(1, k) * at(2, j));
    }
  }
  return sum;
}

TEST_CASE("a mesh whose faces cross is inside out if its volume is negative") {
  Random random(11);
  int crossing = 0, inward = 0;
  for (int i = 0; i < 400; ++i) {
    Mesh first = lattice_tetrahedron(random), second = lattice_box(random);
    if (random.below(2) == 0) first = reversed(std::move(first));
    if (random.below(2) == 0) second = reversed(std::move(second));
    const Mesh mesh = joined(first, second);
    const Shells shells = shells_of(mesh);
    if (shells.inside() != Inside::kCrossing) continue;
    ++crossing;
    const bool is_negative = six_volumes(mesh) < 0;
    inward += is_negative ? 1 : 0;
    CHECK((shells.inside_out() == InsideOut::kAll) == is_negative);
  }
  CHECK(crossing > 40);
  CHECK(inward > 10);
  CHECK(inward < crossing - 10);
}

// Three faces at an edge, or four, are no conflict.
TEST_CASE("edges of three faces leave no inside, of four they may") {
  const Mesh fin = joined(cube(1), single_triangle({1, 1, 1}, {1, 1, -1}, {3, 3, 0}));
  const Mesh a = single_triangle({2, 0, 0}, {2, 1, 0}, {2, 0, 1});
  const FramedPair framed = frame_pair(a, fin);
  const Sides sides({a, fin, framed.frame, 0, 10, true});
  CHECK(sides.shells().edges().uneven == 1);
  CHECK(sides.shells().edges().conflicts == 0);
  CHECK(sides.shells().inside() == Inside::kOpen);
  CHECK_NOTHROW(refuse_conflicts(fin));
}

}  // namespace
