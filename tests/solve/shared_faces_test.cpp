// Faces of A that are faces of B too: h of them is 0, whatever the order of corners and faces, and
// only of those whose coordinates are the same to the bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

SolveOptions on_a_gpu() {
  SolveOptions options;
  options.engine.enabled = {"wide", "group_walk", "split_twice"};
  options.engine.disabled = {"centroid", "parent_samples"};
  return options;
}

/// The same surface: faces backwards, corners of each turned, 0 as -0.
Mesh told_otherwise(const Mesh& mesh) {
  Mesh out = mesh;
  std::reverse(out.faces.begin(), out.faces.end());
  for (size_t i = 0; i < out.faces.size(); ++i) {
    glm::uvec3& f = out.faces[i];
    f = i % 3 == 0 ? glm::uvec3(f.y, f.z, f.x) : i % 3 == 1 ? glm::uvec3(f.z, f.y, f.x) : f;
  }
  for (glm::dvec3& v : out.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      if (v[axis] == 0) v[axis] = -0.0;
    }
  }
  return out;
}

void check_zero(const Mesh& a, const Mesh& b, const SolveOptions& options) {
  const Report r = solver().distance(a, b, options);
  CHECK(r.lower == 0);
  CHECK(r.upper == 0);
  CHECK(r.status == Status::kClosed);
  CHECK(r.waves == 1);
  CHECK(r.queries == 0);
}

}  // namespace

TEST_CASE("a mesh and the same mesh told otherwise are at distance 0, without a query") {
  for (const SolveOptions& options : {SolveOptions{}, on_a_gpu()}) {
    for (const Mesh& mesh : {soup(1, 500), icosphere(1.0, 3), height_field(20, 1), needles(2, 300),
                             degenerate_faces(3, 200), scaled(soup(4, 100), -90)}) {
      check_zero(mesh, told_otherwise(mesh), options);
      check_zero(mesh, joined(mesh, mesh), options);  // every face twice
    }
  }
}

TEST_CASE("a vertex moved by an ulp, or a subnormal, is not the same vertex") {
  for (const SolveOptions& options : {SolveOptions{}, on_a_gpu()}) {
    for (const double by : {0x1p-20, 0x1p-52, 1e-40, 5e-324}) {
      CAPTURE(by);
      const Mesh b = single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
      Mesh a = b;
      a.vertices[2].z = by;
      const Report r = solver().distance(a, b, options);
      CHECK(r.lower <= by);
      CHECK(r.upper >= by);
      CHECK(r.upper <= by + 1e-6 * diagonal(a));
    }
  }
}

TEST_CASE("faces shared and faces moved: the moved ones decide") {
  const Mesh b = height_field(16, 1);
  for (const SolveOptions& options : {SolveOptions{}, on_a_gpu()}) {
    for (const double by : {1e-1, 1e-3, 1e-5}) {
      CAPTURE(by);
      Mesh a = told_otherwise(b);
      a.vertices[a.faces[7].x].z += by;
      const Report r = solver().distance(a, b, options);
      const Interval exact = reference_hausdorff(a, b, 1e-9);
      CHECK(interval(r).meets(exact));
      CHECK(r.lower > 0);
      CHECK(r.status == Status::kClosed);
      SolveOptions none = options;
      none.engine.disabled.emplace_back("shared_faces");
      CHECK(interval(solver().distance(a, b, none)).meets(exact));
    }
  }
}

TEST_CASE("a mesh that is off its exact place widens the interval by that, both ways") {
  const Mesh a = square_patch(8, 0.25), b = square_patch(8, 0);
  const Report exact = solver().distance(a, b);
  REQUIRE(exact.lower <= 0.25);
  REQUIRE(exact.upper >= 0.25);
  Mesh off_a = a, off_b = b;
  off_a.delta = 0x1p-10;
  off_b.delta = 0x1p-12;
  off_b.unit = "m";
  const double both = off_a.delta + off_b.delta;
  const PreparedMesh kept = solver().prepare(off_b);
  for (const Report& r : {solver().distance(off_a, off_b), solver().distance(off_a, kept)}) {
    CHECK(r.lower <= 0.25 - both);
    CHECK(r.upper >= 0.25 + both);
    CHECK(r.lower >= 0.25 - both - 1e-5);
    CHECK(r.upper <= 0.25 + both + 1e-5);
    CHECK(r.status == Status::kPrecision);
    CHECK(r.place_a.delta == off_a.delta);
    CHECK(r.place_b.delta == off_b.delta);
    CHECK(r.place_b.unit == "m");
  }
  // The same faces are 0 apart only where they are exact.
  CHECK(solver().distance(a, a).upper == 0);
  const Report same = solver().distance(off_a, off_a);
  CHECK(same.lower == 0);
  CHECK(same.upper >= 2 * off_a.delta);
  CHECK(same.upper <= 2 * off_a.delta + 1e-5);
}
