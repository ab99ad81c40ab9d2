// Fewer cells and fewer faces lose no bound, and steps lie on neither side.
#include "host/show/page_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "host/show/page_figures.h"
#include "host/solve/cell_corners.h"
#include "shaders/math/triangle.h"
#include "tests/page/invented.h"
#include "tests/shapes/shapes.h"

namespace {

using vkh::Mesh;

// Tiny triangles that share nothing: each vanishes in its cell, and another face has to stand for
// it.
Mesh scattered(size_t count) {
  vkh::test::Random random(7);
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> faces;
  for (size_t i = 0; i < count; ++i) {
    const glm::dvec3 at = random.in_cube(10);
    const auto first = static_cast<uint32_t>(vertices.size());
    for (int corner = 0; corner < 3; ++corner) vertices.push_back(at + random.in_cube(1e-3));
    faces.emplace_back(first, first + 1, first + 2);
  }
  return vkh::make_mesh("scattered", vertices, faces);
}

Mesh one_point(size_t count) {
  const std::vector<glm::dvec3> vertices(3, glm::dvec3(4));
  return vkh::make_mesh("point", vertices, std::vector<glm::uvec3>(count, glm::uvec3(0, 1, 2)));
}

constexpr double kBar = 1;

struct Mapped {
  Mesh mesh;
  vkh::Field field;
  vkh::CellMap map;

  vkh::drawing::MapScale scale() const {
    return {vkh::Picture{.mesh = mesh, .field = field, .interval = {0, 9}, .map = &map}, {}};
  }
};

double wave(const glm::dvec3& p) { return 0.4 + 0.3 * std::sin(3 * p.x) * std::cos(2 * p.y); }

// A part of a face, and its share of the face.
struct Part {
  vkh::lib::Bary3 at;
  uint32_t face;
  double share;
};

// The corner opposite the longest edge.
uint32_t opposite_longest(const Mesh& mesh, const Part& part) {
  const auto place = [&](const glm::uvec2& at) {
    const glm::uvec3 f = mesh.faces[part.face];
    const glm::dvec2 w = glm::dvec2(at) / static_cast<double>(vkh::gpu::kBaryOne);
    const glm::dvec3 a = mesh.vertices[f.x];
    return glm::vec3(a + w.x * (mesh.vertices[f.y] - a) + w.y * (mesh.vertices[f.z] - a));
  };
  return vkh::lib::opposite_longest({place(part.at.a), place(part.at.b), place(part.at.c)});
}

// The faces of a mesh, of which parts are halved at random.
std::vector<Part> halved(const Mesh& mesh, size_t splits, vkh::test::Random& random) {
  std::vector<Part> parts;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) parts.push_back({vkh::lib::whole_root(), f, 1});
  for (size_t i = 0; i < splits; ++i) {
    const auto which = static_cast<size_t>(random.unit() * static_cast<double>(parts.size()));
    Part part = parts[which];
    const uint32_t corner = opposite_longest(mesh, part);
    if (!vkh::lib::has_middle_opposite(part.at, corner)) continue;
    const vkh::lib::Halves halves =
        vkh::lib::halves_of(part.at, corner, vkh::lib::middle_opposite(part.at, corner));
    part.share /= 2;
    part.at = halves.first;
    parts[which] = part;
    part.at = halves.second;
    parts.push_back(part);
  }
  return parts;
}

// Cells that were split at random: each has the wave at its corners, and a width of its own.
Mapped mapped(const Mesh& mesh, size_t splits) {
  vkh::test::Random random(11);
  Mapped out{.mesh = mesh, .field = {}, .map = {}};
  out.map.bar = kBar;
  for (const Part& part : halved(mesh, splits, random)) {
    vkh::gpu::Cell words{};
    vkh::set_corners(words, part.at);
    const auto& c = words.corners;
    vkh::MapCell cell{.corners = {c.x, c.y, c.z, c.w}, .face = part.face};
    const glm::uvec3 f = mesh.faces[cell.face];
    const auto weights = vkh::weights_of(cell);
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3& w = weights[k];
      cell.estimate[k] = static_cast<float>(
          wave(w.x * mesh.vertices[f.x] + w.y * mesh.vertices[f.y] + w.z * mesh.vertices[f.z]));
    }
    cell.width = static_cast<float>(0.1 * random.unit());
    cell.share = static_cast<float>(part.share / static_cast<double>(mesh.faces.size()));
    out.map.cells.push_back(cell);
  }
  return out;
}

// Barycentrics of a random point of a cell.
glm::dvec3 point_in(const std::array<glm::dvec3, 3>& cell, vkh::test::Random& random) {
  const double s = random.unit(), t = random.unit() * (1 - s);
  return (1 - s - t) * cell[0] + s * cell[1] + t * cell[2];
}

// The weights of a point in a triangle of barycentrics.
glm::dvec3 weights_in(const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) {
  const auto area = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
  };
  const double all = area(t[0], t[1], t[2]);
  return {area(p, t[1], t[2]) / all, area(t[0], p, t[2]) / all, area(t[0], t[1], p) / all};
}

template <class Value>
double affine(const Value& values, const glm::dvec3& w) {
  return w.x * static_cast<double>(values[0]) + w.y * static_cast<double>(values[1]) +
         w.z * static_cast<double>(values[2]);
}

size_t cell_with(const std::vector<vkh::ShownCell>& cells, uint32_t face, const glm::dvec3& at) {
  for (size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].face != face) continue;
    const glm::dvec3 w = weights_in(vkh::weights_of({.corners = cells[i].corners}), at);
    if (std::min({w.x, w.y, w.z}) >= -1e-9) return i;
  }
  return cells.size();
}

// Each point has the values of its map's cell within what is shown there.
void check_covers(const Mapped& of, size_t most, double sign) {
  const std::vector<vkh::ShownCell> shown = vkh::shown_cells(of.mesh, of.map, of.scale(), most);
  CHECK(shown.size() <= std::max(most, of.mesh.faces.size()));
  vkh::test::Random random(5);
  for (const vkh::MapCell& cell : of.map.cells) {
    const auto corners = vkh::weights_of(cell);
    const glm::dvec3 at = point_in(corners, random);
    const size_t found = cell_with(shown, cell.face, at);
    REQUIRE(found < shown.size());
    const auto& value = shown[found].value;
    const double there =
        affine(value.at, weights_in(vkh::weights_of({.corners = shown[found].corners}), at));
    const double known = sign * affine(cell.estimate, weights_in(corners, at));
    CHECK(std::abs(there - known) + static_cast<double>(cell.width) <= value.width + 1e-9);
  }
}

TEST_CASE("fewer cells are no less true") {
  Mapped of = mapped(vkh::test::torus(2, 1, 12, 8), 3000);
  const size_t count = of.map.cells.size();
  for (const size_t most : {size_t{1}, size_t{192}, size_t{400}, count / 2, count})
    check_covers(of, most, 1);
  of.map.has_sides = true;
  for (vkh::MapCell& cell : of.map.cells) cell.side = vkh::SurfaceSide::kUnder;
  check_covers(of, 700, -1);
}

TEST_CASE("cells become one first where nobody sees it") {
  Mapped of = mapped(vkh::test::square_patch(4, 0), 2000);
  for (vkh::MapCell& cell : of.map.cells) cell.estimate = {0.3f, 0.3f, 0.3f};
  CHECK(vkh::shown_cells(of.mesh, of.map, of.scale(), 100000).size() == of.mesh.faces.size());
  of.map.cells[0].estimate[0] = 0.8f;  // a peak stays as long as there is room
  const auto shown = vkh::shown_cells(of.mesh, of.map, of.scale(), of.mesh.faces.size() + 40);
  double most = 0;
  for (const vkh::ShownCell& cell : shown)
    for (const double at : cell.value.at) most = std::max(most, at);
  CHECK(most > 0.79);
}

TEST_CASE("a part without a side is on either side of B where it is shown with others") {
  Mapped of = mapped(vkh::test::square_patch(2, 0), 300);
  of.map.has_sides = true;
  std::vector<bool> has_sideless(of.mesh.faces.size());
  for (size_t i = 0; i < of.map.cells.size(); ++i) {
    of.map.cells[i].side = i % 2 == 0 ? vkh::SurfaceSide::kUnsigned : vkh::SurfaceSide::kOver;
    if (i % 2 == 0) has_sideless[of.map.cells[i].face] = true;
  }
  size_t mixed = 0;
  for (const auto& cell : vkh::shown_cells(of.mesh, of.map, of.scale(), 1)) {
    if (cell.value.is_sideless || !has_sideless[cell.face]) continue;
    ++mixed;
    for (const double at : cell.value.at) CHECK(at - cell.value.width < -0.1);
  }
  CHECK(mixed > 0);
}

TEST_CASE("what is left out beside something that is not hides it nowhere") {
  Mapped of = mapped(vkh::test::square_patch(3, 0), 400);
  of.map.max_distance = 0.5;
  for (size_t i = 0; i < of.map.cells.size(); ++i) {
    const float at = i % 3 == 0 ? 4.0f : 0.25f;
    of.map.cells[i].estimate = {at, at, at};
  }
  std::vector<int> kept(of.mesh.faces.size()), left_out(of.mesh.faces.size());
  for (const vkh::MapCell& cell : of.map.cells)
    ++(of.map.is_left_out(cell) ? left_out : kept)[cell.face];
  for (const auto& cell : vkh::shown_cells(of.mesh, of.map, of.scale(), 1))
    CHECK(cell.value.is_left_out == (kept[cell.face] == 0));
}

TEST_CASE("fewer points are as far as the farthest of what they stand for") {
  vkh::test::Random random(12);
  std::vector<vkh::DVec3> points;
  for (int i = 0; i < 4000; ++i) points.push_back(random.in_cube(1));
  Mapped of = mapped(vkh::make_points("points", points), 0);
  of.map.max_distance = 0.6;
  of.map.cells[17].estimate = {9, 9, 9};
  for (const size_t most : {size_t{1}, size_t{300}, size_t{5000}}) {
    const vkh::ShownMesh shown = vkh::shown_mesh(of.mesh, of.map, of.scale(), most);
    CHECK(shown.faces.size() <= std::min<size_t>(most, 4000));
    CHECK(shown.faces.size() * 3 >= std::min<size_t>(most, 4000));
    CHECK(shown.spacing > 0);
    double farthest = 0, of_all = 0;
    for (size_t f = 0; f < shown.faces.size(); ++f) {
      CHECK(shown.faces[f].x == shown.faces[f].z);
      if (!shown.values[f].is_left_out) farthest = std::max(farthest, shown.values[f].at[0]);
    }
    for (const vkh::MapCell& cell : of.map.cells) {
      if (!of.map.is_left_out(cell))
        of_all = std::max({of_all, static_cast<double>(cell.estimate[0]),
                           static_cast<double>(cell.estimate[1]),
                           static_cast<double>(cell.estimate[2])});
    }
    CHECK(farthest == of_all);
  }
}

void check_stands_for(const Mesh& mesh, size_t most) {
  const Mapped of = mapped(mesh, mesh.faces.size() / 4);
  const vkh::Shown few = vkh::shown_of(mesh, most);
  const vkh::ShownMesh shown = vkh::shown_mesh(mesh, of.map, of.scale(), most);
  CHECK(shown.faces.size() == shown.values.size());
  CHECK(shown.is_decimated == (mesh.faces.size() > most));
  for (const glm::uvec3& face : shown.faces)
    CHECK(std::max({face.x, face.y, face.z}) < shown.vertices.size());
  if (!shown.is_decimated) return;
  CHECK(shown.faces.size() <= most);
  REQUIRE(few.face_of.size() == mesh.faces.size());
  for (const vkh::MapCell& cell : of.map.cells) {
    const vkh::ShownValue& value = shown.values[few.face_of[cell.face]];
    for (const float estimate : cell.estimate) {
      CHECK(static_cast<double>(estimate) <= value.at[0]);
      CHECK(static_cast<double>(estimate) - static_cast<double>(cell.width) >=
            value.at[0] - value.width - 1e-12);
    }
  }
}

TEST_CASE("every face is covered by the one shown face that stands for it") {
  const Mesh torus = vkh::test::torus(20, 6, 120, 60);
  for (const size_t most : {1u, 2u, 10u, 500u, 5000u, 14400u}) check_stands_for(torus, most);
  for (const size_t most : {1u, 100u, 3000u}) check_stands_for(scattered(4000), most);
  check_stands_for(one_point(50), 7);
  check_stands_for(vkh::test::square_patch(80, 1), 900);
}

TEST_CASE("a decimated mesh uses most of the faces that it may have") {
  const Mesh torus = vkh::test::torus(20, 6, 400, 200);
  for (const size_t most : {2000u, 20000u}) {
    const size_t faces = vkh::shown_of(torus, most).faces.size();
    CHECK(faces > most / 2);
  }
}

TEST_CASE("coordinates whose differences overflow have a place, too") {
  const double far = std::numeric_limits<double>::max();
  const Mesh mesh = vkh::test::single_triangle({-far, 0, 0}, {far, 0, 0}, {0, far, 0});
  const vkh::Place place = vkh::place_of(mesh);
  for (const glm::dvec3& v : mesh.vertices) {
    for (int i = 0; i < 3; ++i) CHECK((place.unit(v)[i] >= 0 && place.unit(v)[i] <= 2));
  }
}

TEST_CASE("steps ascend from 0 to the largest distance, few and short") {
  for (const double top : {1e-300, 3e-7, 0.0441, 1.0, 9.99, 12345.0, 1e300}) {
    const std::vector<vkh::Step> steps = vkh::tolerance_steps(top, top, std::nullopt);
    CHECK(steps.front().value == 0);
    CHECK(steps.back().limit.within >= top);
    CHECK(steps.size() < 2000);
    for (size_t k = 1; k < steps.size(); ++k) {
      CHECK(steps[k].value > steps[k - 1].value);
      CHECK(steps[k].limit.within < steps[k].limit.beyond);
      CHECK(steps[k].label.size() <= 12);
      CHECK(std::stod(steps[k].label) == steps[k].value);
    }
  }
  CHECK(vkh::tolerance_steps(0, 0, std::nullopt).size() == 1);
}

TEST_CASE("steps are even up to a finer end, and reach the largest distance all the same") {
  const std::vector<vkh::Step> steps = vkh::tolerance_steps(100, 0.15, std::nullopt);
  CHECK(steps.back().limit.within >= 100);
  CHECK(std::count_if(steps.begin(), steps.end(), [](const vkh::Step& step) {
          return step.is_linear && step.value <= 0.15;
        }) > 500);
  CHECK(std::none_of(steps.begin(), steps.end(),
                     [](const vkh::Step& step) { return step.is_linear && step.value > 0.16; }));
}

TEST_CASE("the limit that was asked about is a step, as it was asked") {
  const vkh::Limit odd = {0.123456, 0.123457},
                   round = {std::nextafter(0.1, 0), std::nextafter(0.1, 1)};
  for (const vkh::Limit& limit : {odd, round, vkh::Limit{7, 7.1}}) {
    const std::vector<vkh::Step> steps = vkh::tolerance_steps(1, 1, limit);
    CHECK(std::count_if(steps.begin(), steps.end(), [&](const vkh::Step& step) {
            return step.limit.within == limit.within && step.limit.beyond == limit.beyond;
          }) == 1);
  }
}

TEST_CASE("a limit in the place of the last step leaves none out") {
  const double top = 0.5;
  const std::vector<vkh::Step> steps =
      vkh::tolerance_steps(top, top, vkh::Limit{0.4999999, 0.50001});
  CHECK(steps.back().limit.within >= top);
  for (size_t k = 1; k < steps.size(); ++k) {
    CHECK(steps[k].limit.within > steps[k - 1].limit.within);
    CHECK(steps[k].limit.beyond > steps[k - 1].limit.beyond);
  }
}

}  // namespace
