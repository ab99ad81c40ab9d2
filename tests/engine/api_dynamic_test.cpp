// Meshes that move: refitted BVHs and warm starts. Each frame's interval is true, with any data
// that the frame before left.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <string>

#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"
#include "tests/verification/model/vec3.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr float kTolerance = 1e-5f;

/// A wave that runs over a mesh.
Mesh rippled(const Mesh& mesh, double time) {
  Mesh out = mesh;
  for (glm::dvec3& v : out.vertices) v.z += 0.08 * std::sin(7 * v.x + 3 * v.y + time);
  return out;
}

using Frame = std::function<void(VkCommandBuffer)>;
Frame finish(ApiPair& on, const Frame& start) {
  return [&on, start](VkCommandBuffer c) {
    start(c);
    on.advance(c, 24);
    on.report(c);
  };
}

VkhReport cold_after_build(ApiPair& on) {
  return on.run(finish(on, [&](VkCommandBuffer c) {
    on.build(c);
    on.begin(c);
  }));
}

VkhReport after_refit(ApiPair& on, bool warm) {
  return on.run(finish(on, [&](VkCommandBuffer c) {
    on.refit(c);
    on.begin(c, warm);
  }));
}

void check_closed(const VkhReport& report) {
  CHECK(report.status == VKH_STATUS_DECIDED);
  CHECK(report.upper - report.lower <= kTolerance + 2e-6f * report.upper);
}

// --- Boxes ---

bool bounds(const gpu::vec3& lo, const gpu::vec3& hi, const std::vector<gpu::Triangle>& triangles,
            uint32_t first, uint32_t last) {
  gpu::vec3 low = triangles[first].a, high = low;
  for (uint32_t i = first; i <= last; ++i) {
    for (const gpu::vec3& p : {triangles[i].a, triangles[i].b, triangles[i].c}) {
      low = test::min(low, p);
      high = test::max(high, p);
    }
  }
  return same(lo, low) && same(hi, high);
}

/// Whether a child's box is that of its triangles; no child has an empty box.
bool fits(const gpu::Child4& child, const std::vector<gpu::Branch>& branches,
          const std::vector<gpu::Triangle>& triangles) {
  if (child.child == gpu::kNone) return child.lo.x > child.hi.x;
  const bool leaf = (child.child & gpu::kLeafFlag) != 0;
  const uint32_t first =
      leaf ? child.child & (gpu::kMaxTriangles - 1) : branches[child.child].first;
  const uint32_t last = leaf ? first + ((child.child >> 28) & 7u) : branches[child.child].last;
  return bounds(child.lo, child.hi, triangles, first, last);
}

/// Builds for `before`, refits to `after`.
void check_refit(const Mesh& before, const Mesh& after) {
  KernelBench bench;
  const Hierarchy h = build_hierarchy(bench, before).hierarchy;
  const auto order = bench.get(h.triangles);
  const VkhMesh moved = put_mesh(bench, after);
  bench.run([&](Recorder& rec) { record_refit(rec, moved, h); });

  const auto triangles = bench.get(h.triangles);
  const auto nodes = bench.get(h.nodes);
  size_t wrong = 0;
  for (size_t i = 0; i < triangles.size(); ++i) {
    wrong += triangles[i].face != order[i].face;
    const glm::dvec3& a = after.vertices[after.faces[order[i].face].x];
    wrong += static_cast<float>(a.x) != triangles[i].a.x;
  }
  const auto branches = bench.get(h.branches);
  for (size_t i = 0; i < nodes.size(); ++i) {
    // Nodes within a leaf are not written.
    if (i > 0 && branches[i].last - branches[i].first < gpu::kLeafTriangles) continue;
    for (const gpu::Child4& child : nodes[i].child) wrong += !fits(child, branches, triangles);
  }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("a refit keeps the order, takes the new positions and fits every box") {
  for (const uint32_t count : {1u, 2u, 3u, 15u, 16u, 17u, 64u, 65u, 257u, 1500u}) {
    CAPTURE(count);
    check_refit(in_float32(soup(count, count)), in_float32(rippled(soup(count, count), 1.0)));
    Mesh scattered = soup(count, count);  // nothing is where it was
    scattered.vertices = soup(count + 1, count).vertices;
    check_refit(in_float32(soup(count, count)), in_float32(scattered));
  }
}

TEST_CASE("B moves: a report after a refit is as true and as tight as after a build") {
  const Mesh rest_a = height_field(20, 1), rest_b = height_field(20, 2);
  ApiMesh a(rest_a), b(rest_b);
  ApiPair refitted(a, b, kTolerance), built(a, b, kTolerance);
  cold_after_build(refitted);
  for (int frame = 1; frame <= 4; ++frame) {
    CAPTURE(frame);
    b.move(rippled(rest_b, 0.7 * frame));
    const VkhReport refit = after_refit(refitted, false);
    const VkhReport build = cold_after_build(built);
    check_true(refit, a, b);
    check_closed(refit);
    CHECK(interval(refit).meets(interval(build)));
  }
}

TEST_CASE("a refit to another shape altogether is true") {
  Mesh other = soup(5, 90);
  const Mesh rest = soup(4, 90);
  ApiMesh a(translated(icosphere(0.5, 1), {0.1, 0, 0})), b(rest);
  ApiPair on(a, b, kTolerance);
  cold_after_build(on);
  b.move(other);
  const VkhReport report = after_refit(on, false);
  check_true(report, a, b);
  check_closed(report);
}

TEST_CASE("A and B move: refit and warm start, certified in each frame") {
  const Mesh rest_a = height_field(20, 1), rest_b = height_field(20, 4);
  ApiMesh a(rest_a), b(rest_b);
  ApiPair on(a, b, kTolerance), cold(a, b, kTolerance);
  cold_after_build(on);
  for (int frame = 1; frame <= 6; ++frame) {
    CAPTURE(frame);
    a.move(rippled(rest_a, 0.2 * frame));
    b.move(rippled(rest_b, 0.2 * frame));
    const VkhReport warm = after_refit(on, true);
    check_true(warm, a, b);
    check_closed(warm);
    const VkhReport reference = cold_after_build(cold);
    REQUIRE(cold.statistics().candidateTotal > 0);
    CHECK(interval(warm).meets(interval(reference)));
    // The benefit of a warm start: the old witness culls from the start on.
    CHECK(on.statistics().candidateTotal <= cold.statistics().candidateTotal);
  }
}

TEST_CASE("the old witness, moved along, is the first lower bound") {
  // All vertices of the lid lie on the sheet: a cold begin knows no distance, a warm one all of it.
  ApiMesh a(v_lid()), b(v_sheet());
  ApiPair on(a, b, kTolerance);
  const auto only_begin = [&](bool warm) {
    return on.run([&](VkCommandBuffer c) {
      on.begin(c, warm);
      on.report(c);
    });
  };
  const VkhReport whole = cold_after_build(on);
  const VkhReport warm = only_begin(true);
  CHECK(warm.lower == doctest::Approx(v_lid_distance()).epsilon(1e-4));
  // The base of distances differs, and the last bits with it.
  CHECK(warm.lower == doctest::Approx(whole.lower).epsilon(1e-6));
  CHECK(warm.witnessFaceA == whole.witnessFaceA);
  a.move(translated(v_lid(), {0, 0, 0.25}));
  check_true(only_begin(true), a, b);
  CHECK(only_begin(true).lower > whole.lower);
  a.move(v_lid());
  CHECK(only_begin(false).lower < 1e-3f);
}

TEST_CASE("a warm start from garbage costs time, not truth") {
  // A is nearer to the origin than to B: a triangle that does not exist, read as zeros, would win.
  Mesh with_stray = translated(scaled(height_field(12, 1), -2), {-0.125, -0.125, 0});
  with_stray.vertices.push_back({900, 900, 900});  // no face uses it, so it is not part of A
  ApiMesh a(with_stray), b(translated(height_field(12, 3), {0, 0, 0.75}));
  ApiPair on(a, b, kTolerance);
  const VkhReport cold = cold_after_build(on);
  check_closed(cold);
  const Interval exact = reference_hausdorff(in_float32(a.mesh()), b.mesh(), 1e-8);
  const auto warm_from = [&](const std::function<uint32_t(size_t)>& word) {
    auto* words = reinterpret_cast<uint32_t*>(on.workspace());
    for (size_t i = 0; i < on.workspace_size() / 4; ++i) words[i] = word(i);
    const VkhReport warm = on.run(finish(on, [&](VkCommandBuffer c) { on.begin(c, true); }));
    CHECK(interval(warm).meets(interval(cold)));
    check_true(warm, exact);
    check_closed(warm);
  };
  for (const uint32_t word :
       {0u, 1u, 0xffffffffu, 0x7f800000u, 0xbf800000u, 1u << 20, 0xa5a5a5a5u}) {
    CAPTURE(word);
    warm_from([&](size_t) { return word; });
  }
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    // Small numbers are triangles and faces that exist, and are the wrong ones; alternating with
    // large ones they name places outside a face.
    warm_from([&](size_t i) {
      const bool small = seed % 3 == 0 || i % 2 == seed % 3 - 1;
      return small ? random.below(30) : static_cast<uint32_t>(random.bits());
    });
  }
}

TEST_CASE("a warm start from another pair's run is true") {
  ApiMesh a(height_field(12, 1)), b(height_field(12, 3));
  ApiPair on(a, b, kTolerance);
  cold_after_build(on);
  // The same counts, another shape, and B built anew: its triangles are numbered differently.
  a.move(translated(height_field(12, 1, 0.4), {0.3, 0.2, 0.1}));
  b.move(permuted(height_field(12, 3, 0.3), 7));
  const VkhReport warm = on.run(finish(on, [&](VkCommandBuffer c) {
    on.build(c);
    on.begin(c, true);
  }));
  check_true(warm, a, b);
  check_closed(warm);
}
