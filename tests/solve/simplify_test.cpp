// Simplified meshes against the tests' own solver: what is said to be within the limit is, both
// ways; vertices are A's; and what cannot be found is said.
#include "vkhausdorff/simplify.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "host/simplify/collapse.h"
#include "tests/shapes/shapes.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_bench.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/levels.h"

using namespace vkh;
using namespace vkh::test;

namespace {

SimplifyOptions within(double limit) {
  SimplifyOptions options;
  options.max = {limit, limit};
  return options;
}

std::set<std::tuple<double, double, double>> places_of(const Mesh& mesh) {
  std::set<std::tuple<double, double, double>> places;
  for (const DVec3& v : mesh.vertices) places.insert({v.x, v.y, v.z});
  return places;
}

bool has_vertices_of(const Mesh& mesh, const Mesh& a) {
  const auto own = places_of(mesh), all = places_of(a);
  return std::includes(all.begin(), all.end(), own.begin(), own.end());
}

/// Checks the result against the reference solver, which shares no code with the engine.
void check_deviation(const Mesh& a, const Simplified& s, double limit, bool one_way) {
  REQUIRE(s.found);
  CHECK(s.deviation.verdict == Verdict::kWithin);
  CHECK(s.deviation.interval.upper <= limit);
  CHECK(s.deviation.b_to_a.has_value() == !one_way);
  const double tolerance = 1e-4 * limit;
  const Interval there = reference_hausdorff(a, s.mesh, tolerance);
  CHECK(there.lower <= s.deviation.a_to_b.upper);
  CHECK(there.upper >= s.deviation.a_to_b.lower);
  CHECK(there.lower <= limit);
  if (one_way) return;
  const Interval back = reference_hausdorff(s.mesh, a, tolerance);
  CHECK(back.lower <= limit);
  CHECK(std::max(there.upper, back.upper) >= s.deviation.interval.lower);
  CHECK(std::max(there.lower, back.lower) <= s.deviation.interval.upper);
}

/// Edges that only one face has.
std::set<std::pair<uint32_t, uint32_t>> open_edges(const Mesh& mesh) {
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (const UVec3& face : mesh.faces) {
    for (const auto& [from, to] : {std::pair{face.x, face.y}, {face.y, face.z}, {face.z, face.x}})
      if (edges.erase({to, from}) == 0) edges.insert({from, to});
  }
  return edges;
}

std::set<std::tuple<double, double, double>> border_of(const Mesh& mesh) {
  std::set<std::tuple<double, double, double>> border;
  for (const auto& [from, to] : open_edges(mesh)) {
    const DVec3& v = mesh.vertices[from];
    border.insert({v.x, v.y, v.z});
  }
  return border;
}

}  // namespace

TEST_CASE("a smooth mesh loses most of its faces, and stays within the limit both ways") {
  for (const Mesh& a : {torus(2, 0.5, 48, 24), icosphere(1, 4), height_field(32, 1)}) {
    for (const double limit : {0.003, 0.03}) {
      CAPTURE(a.faces.size());
      CAPTURE(limit);
      const Simplified s = simplify(solver(), a, within(limit));
      check_deviation(a, s, limit, false);
      CHECK(s.complete);
      CHECK(s.mesh.faces.size() < a.faces.size());
      CHECK(has_vertices_of(s.mesh, a));
    }
  }
}

TEST_CASE("a flat patch becomes two triangles") {
  const Mesh a = square_patch(20, 0);
  const Simplified s = simplify(solver(), a, within(0.001));
  check_deviation(a, s, 0.001, false);
  CHECK(s.mesh.faces.size() == 2);
}

TEST_CASE("one way, the result alone may be farther from A") {
  const Mesh a = torus(2, 0.5, 48, 24);
  SimplifyOptions options = within(0.02);
  options.one_way = true;
  const Simplified s = simplify(solver(), a, options);
  check_deviation(a, s, 0.02, true);
  CHECK(s.mesh.faces.size() < a.faces.size());
}

TEST_CASE("a locked border keeps each of its vertices") {
  const Mesh a = height_field(24, 1);
  SimplifyOptions options = within(0.02);
  options.lock_borders = true;
  const Simplified locked = simplify(solver(), a, options);
  check_deviation(a, locked, 0.02, false);
  CHECK(border_of(locked.mesh) == border_of(a));
  CHECK(locked.mesh.faces.size() < a.faces.size());
  const Simplified freely = simplify(solver(), a, within(0.02));
  CHECK(border_of(freely.mesh).size() < border_of(a).size());
}

TEST_CASE("hard meshes give a true result: A itself, if nothing smaller passes") {
  const glm::dvec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  const Mesh one = single_triangle(o, x, y);
  const Mesh point = single_triangle(o, o, o);
  for (const Mesh& a : {one, point, single_triangle(o, x, x), soup(7, 60), needles(7, 40),
                        slivers(7, 40), caps(7, 40), degenerate_faces(7, 30)}) {
    for (const double limit : {1e-6, 0.05}) {
      CAPTURE(a.faces.size());
      CAPTURE(limit);
      const Simplified s = simplify(solver(), a, within(limit));
      check_deviation(a, s, limit, false);
      CHECK(s.mesh.faces.size() <= a.faces.size());
      CHECK(has_vertices_of(s.mesh, a));
    }
  }
  CHECK(simplify(solver(), one, within(0.1)).mesh.faces.size() == 1);
}

TEST_CASE("a limit that is no positive length is refused") {
  const Mesh a = cube(1);
  for (const double limit : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(simplify(solver(), a, within(limit)), UsageError);
}

TEST_CASE("without time, or called off, nothing is found") {
  const Mesh a = icosphere(1, 3);
  SimplifyOptions options = within(0.05);
  options.time_limit_s = 0;
  const Simplified late = simplify(solver(), a, options);
  CHECK_FALSE(late.found);
  CHECK_FALSE(late.complete);
  CHECK(late.mesh.faces.empty());

  SimplifyOptions stopped = within(0.05);
  size_t heard = 0;
  stopped.progress = [&heard](const SimplifyProgress& p) {
    CHECK(p.faces <= 1280);
    ++heard;
    return false;
  };
  const Simplified s = simplify(solver(), a, stopped);
  CHECK(heard == 1);
  CHECK_FALSE(s.found);
  CHECK(s.tried == 0);
}

TEST_CASE("coordinates are rounded to float32 before they are judged") {
  Mesh a = icosphere(1, 3);
  for (DVec3& v : a.vertices) v += DVec3(1000.1, 0, 0);
  SimplifyOptions options = within(0.05);
  options.rounds_to_float = true;
  const Simplified s = simplify(solver(), a, options);
  check_deviation(a, s, 0.05, false);
  CHECK(std::all_of(s.mesh.vertices.begin(), s.mesh.vertices.end(), [](const DVec3& v) {
    return static_cast<double>(static_cast<float>(v.x)) == v.x;
  }));
  options.max = {1e-6, 1e-6};  // a float32 near 1000 is that far from its double
  const Simplified none = simplify(solver(), a, options);
  CHECK_FALSE(none.found);
  CHECK(none.complete);
}

TEST_CASE("a deviation is measured and judged for any mesh") {
  const Mesh a = square_patch(4, 0), b = square_patch(4, 0.25);
  const Deviation within_it = measure_deviation(solver(), a, b, within(0.5));
  CHECK(within_it.verdict == Verdict::kWithin);
  CHECK(within_it.interval.lower <= 0.25);
  CHECK(within_it.interval.upper >= 0.25);
  CHECK(within_it.interval.upper - within_it.interval.lower <= 0.001);
  CHECK(measure_deviation(solver(), a, b, within(0.125)).verdict == Verdict::kBeyond);
}

TEST_CASE("what is judged within a limit of 1e-4 of the diagonal is decided by a gate, too") {
  const Mesh a = square_patch(4, 0);
  const double height = 1e-4 * std::sqrt(2.0);
  const Mesh b = square_patch(4, height);
  CHECK(measure_deviation(solver(), a, b, within(height * 1.0015)).verdict == Verdict::kUndecided);
  const double limit = height * 1.006;
  CHECK(measure_deviation(solver(), a, b, within(limit)).verdict == Verdict::kWithin);
  SolveOptions gate;
  gate.tolerance = 1e-7;
  gate.limit = {limit, limit};
  CHECK(solver().symmetric(a, b, gate).interval().upper <= limit);
}

TEST_CASE("locked vertices stay, and the rest is collapsed") {
  const Collapser collapser(square_patch(20, 0), false, false);
  std::vector<uint32_t> locked;
  for (uint32_t v = 0; v < collapser.vertices().size(); v += 7) locked.push_back(v);
  const Faces faces = collapser.collapse(collapser.faces(), {.error = 0.1}, locked);
  std::set<uint32_t> used;
  for (const UVec3& face : faces) used.insert({face.x, face.y, face.z});
  CHECK(std::includes(used.begin(), used.end(), locked.begin(), locked.end()));
  CHECK(faces.size() < collapser.faces().size() / 2);
}

TEST_CASE("blocks have each face once, and know the vertices between them") {
  const Mesh a = icosphere(1, 3);
  const Blocks blocks = split(a.faces, a.vertices, {DVec3(-1, -1, -1), 0.7});
  CHECK(blocks.size() > 8);
  std::vector<size_t> users(a.vertices.size());
  std::set<std::tuple<uint32_t, uint32_t, uint32_t>> seen;
  for (size_t i = 0; i < blocks.size(); ++i) {
    std::set<uint32_t> own;
    for (const UVec3& face : blocks[i]) {
      CHECK(seen.insert({face.x, face.y, face.z}).second);
      own.insert({face.x, face.y, face.z});
    }
    for (const uint32_t v : own) ++users[v];
  }
  CHECK(seen.size() == a.faces.size());
  for (size_t v = 0; v < users.size(); ++v) CHECK((users[v] > 1) == (blocks.is_shared[v] != 0));
}

TEST_CASE("a small error goes by blocks: the same faces on any number of threads, and fewer") {
  const Collapser collapser(torus(2, 0.5, 400, 200), false, false);
  const CollapseTarget target{.error = 8e-4}, whole{.error = 8e-4, .by_blocks = false};
  const Faces faces = collapser.collapse(collapser.faces(), target, {}, ThreadPool(1, {}, {}));
  CHECK(faces == collapser.collapse(collapser.faces(), target, {}, ThreadPool(7, {}, {})));
  CHECK(faces.size() < collapser.collapse(collapser.faces(), whole).size());
}

TEST_CASE("the result does not depend on the number of threads") {
  const Mesh a = torus(2, 0.5, 48, 24);
  limit_threads(1);
  const Simplified one = simplify(solver(), a, within(0.01));
  limit_threads(5);
  const Simplified five = simplify(solver(), a, within(0.01));
  limit_threads(0);
  REQUIRE(one.found);
  CHECK(one.mesh.vertices == five.mesh.vertices);
  CHECK(one.mesh.faces == five.mesh.faces);
  CHECK(one.tried == five.tried);
}

TEST_CASE("the first candidate of a large mesh is the coarsest" * doctest::skip(kIsSanitized)) {
  const Mesh a = square_patch(260, 0);  // more faces than are collapsed from A each time
  SimplifyOptions stopped = within(0.001);
  std::vector<uint64_t> faces;
  stopped.progress = [&faces](const SimplifyProgress& p) {
    faces.push_back(p.faces_of_next);
    return false;
  };
  const Simplified s = simplify(solver(), a, stopped);
  CHECK_FALSE(s.found);
  CHECK(faces == std::vector<uint64_t>{2});
}

TEST_CASE("vertices at one position are one vertex") {
  Mesh apart;  // two triangles that share an edge, but no vertex
  apart.name = "apart";
  apart.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0, 1, 0}};
  apart.faces = {{0, 1, 2}, {3, 4, 5}};
  const Collapser collapser(apart, false, false);
  CHECK(collapser.vertices().size() == 4);
  CHECK(collapser.faces()[1] == UVec3(1, 3, 2));
}

TEST_CASE("each level of a chain is measured against A, and the limit ends the chain") {
  const Mesh a = icosphere(1, 4);
  const LevelsOptions options{.simplify = within(0.1), .levels = 8, .ratio = 0.25};
  const std::vector<Simplified> levels = simplify_levels(solver(), a, options);
  REQUIRE(levels.size() >= 2);
  CHECK(levels.size() < 8);
  size_t before = a.faces.size();
  for (const Simplified& level : levels) {
    check_deviation(a, level, 0.1, false);
    CHECK(level.complete);
    CHECK(level.mesh.faces.size() < before);
    before = level.mesh.faces.size();
  }
  CHECK(levels[0].mesh.faces.size() <= a.faces.size() / 4);
  CHECK(levels[0].deviation.interval.upper < levels[1].deviation.interval.lower);
}

TEST_CASE("a chain without time, of a single face or of a wrong ratio") {
  const Mesh a = icosphere(1, 3);
  LevelsOptions options{.simplify = within(0.1)};
  options.simplify.time_limit_s = 0;
  CHECK(simplify_levels(solver(), a, options).empty());
  const LevelsOptions any{.simplify = within(10)};
  const Mesh one = single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  CHECK(simplify_levels(solver(), one, any).empty());
  for (const double ratio : {0.0, 1.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(simplify_levels(solver(), a, {.simplify = within(0.1), .ratio = ratio}),
                    UsageError);
}
