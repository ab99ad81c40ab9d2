// A consumer that has GLM align its vectors, as renderers do: sizes of GLM's own types differ from
// those of the library, which was compiled without. The public headers come first.
#define GLM_FORCE_DEFAULT_ALIGNED_GENTYPES
#define GLM_FORCE_INTRINSICS
#include <doctest/doctest.h>

#include <cstddef>

#include "vkhausdorff/frame.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/prover.h"
#include "vkhausdorff/solver.h"

static_assert(sizeof(glm::dvec3) == 32, "GLM aligns here");
static_assert(sizeof(vkh::DVec3) == 24 && sizeof(vkh::UVec3) == 12);
static_assert(sizeof(vkh::Box) == 48, "boxes are in answers");

TEST_CASE("a program with aligned GLM gets the right answer") {
  const std::vector<glm::dvec3> square{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  vkh::Mesh a{.name = "a", .vertices = {}, .faces = {{0, 1, 2}, {0, 2, 3}}, .counts = {}};
  for (const glm::dvec3& p : square) a.vertices.push_back(p);
  vkh::Mesh b = a;
  for (vkh::DVec3& p : b.vertices) p.z = 0.25;
  vkh::Device device;
  vkh::Solver solver(device);
  const vkh::Report r = solver.distance(a, b);
  CHECK(r.lower <= 0.75);
  CHECK(r.upper >= 0.75);
  CHECK(r.upper - r.lower < 1e-4);
  const glm::dvec3 witness = r.witness_a.point;
  CHECK(witness.z == doctest::Approx(1));
  const vkh::Mesh made = vkh::make_mesh("made", b.vertices, b.faces);
  CHECK(made.vertices[2].z == 0.25);
}
