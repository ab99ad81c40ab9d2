// Budgets: memory, waves, time, the caller's patience, switches. The interval is true no matter
// what ends a run.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using namespace vkh::test;

/// Pairs that need several waves.
const std::vector<ReferencePair>& pairs() {
  static const std::vector<ReferencePair> all = {
      with_reference("spheres", icosphere(1.0, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05})),
      with_reference("V", v_lid(), v_sheet()),
      with_reference("twin", height_field(24, 1), height_field(24, 3)),
      with_reference("soups", soup(1, 60), soup(2, 80)),
      with_reference("plane above a bumpy field", big_plane(1.0, 0.3), height_field(12, 1))};
  return all;
}

SolveOptions with_memory(uint64_t bytes) {
  SolveOptions options;
  options.memory_bytes = bytes;
  return options;
}

SolveOptions with_waves(uint32_t limit) {
  SolveOptions options;
  options.wave_limit = limit;
  return options;
}

SolveOptions without(std::vector<std::string> switches) {
  SolveOptions options;
  options.engine.disabled = std::move(switches);
  options.wave_limit = 200;
  return options;
}

Report check_true(const ReferencePair& pair, const SolveOptions& options) {
  const Report r = solver().distance(pair.a, pair.b, options);
  CAPTURE(pair.name);
  CAPTURE(status_name(r.status));
  CAPTURE(r.lower);
  CAPTURE(r.upper);
  CAPTURE(r.waves);
  CHECK(r.lower <= r.upper);
  CHECK(interval(r).meets(pair.exact));
  if (r.status == Status::kClosed) CHECK(r.upper - r.lower <= r.tolerance);
  return r;
}

}  // namespace

// --- Memory ---

TEST_CASE("the interval is true in the smallest workspace") {
  for (const ReferencePair& pair : pairs()) {
    for (const uint64_t bytes : {uint64_t{1}, uint64_t{64} << 10, uint64_t{256} << 10,
                                 uint64_t{1} << 20, uint64_t{16} << 20}) {
      CAPTURE(bytes);
      const Report r = check_true(pair, with_memory(bytes));
      CHECK((r.status == Status::kClosed || r.status == Status::kMemory));
      CHECK(std::isfinite(r.upper));
      CHECK(r.workspace_bytes >= bytes);  // raised to the least that works, never cut
    }
  }
}

TEST_CASE("a small workspace after a large one, and the other way round") {
  const ReferencePair& pair = pairs()[2];
  const Report large = check_true(pair, {});
  check_true(pair, with_memory(1));
  const Report again = check_true(pair, {});
  CHECK(again.lower == large.lower);
  CHECK(again.upper == large.upper);
}

namespace {

void check_same_run(const Report& grown, const Report& roomy) {
  check_same(grown, roomy);
  CHECK(grown.peak_frontier == roomy.peak_frontier);
}

}  // namespace

TEST_CASE("a run that outgrows its workspace gets a larger one, and is the run that had it") {
  uint32_t outgrown = 0;
  for (const bool is_wide : {false, true}) {
    for (const ReferencePair& pair : pairs()) {
      SolveOptions options;
      if (is_wide) options.engine.enabled = {"wide", "group_walk", "split_twice"};
      if (is_wide) options.engine.disabled = {"centroid", "parent_samples"};
      const Report roomy = check_true(pair, options);
      options.engine.start_memory_bytes = 1;
      const Report grown = check_true(pair, options);
      check_same_run(grown, roomy);
      options.memory_bytes = 1;  // no more than that
      if (check_true(pair, options).workspace_bytes < grown.workspace_bytes) ++outgrown;
    }
  }
  CHECK(outgrown >= 6);
}

TEST_CASE("of pairs side by side, too, each gets the room that it wants") {
  std::vector<PairView> views;
  for (const ReferencePair& pair : pairs()) views.push_back({pair.a, pair.b});
  SolveOptions options;
  const std::vector<Report> roomy = solver().distances(views, options);
  options.engine.start_memory_bytes = 1;
  const std::vector<Report> grown = solver().distances(views, options);
  for (size_t i = 0; i < views.size(); ++i) check_same_run(grown[i], roomy[i]);
}

TEST_CASE("for one triangle, kilobytes") {
  const ReferencePair pair = with_reference(
      "triangle", single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), icosphere(2.0, 1));
  CHECK(check_true(pair, {}).workspace_bytes < 1'000'000);
}

namespace {

// The switches for every stream, for those of a GPU, and for those of a CPU device.
constexpr uint32_t kSwitchSets[] = {gpu::kUseAll | VKH_SWITCH_SORT | VKH_SWITCH_U3_PAPER,
                                    VKH_SWITCH_DEFAULT_WIDE, VKH_SWITCH_DEFAULT_NARROW};

void check_sizes(const Limits& limits) {
  for (const uint32_t vertices : {1u, 3u, 1000u, 100'000u}) {
    for (const uint32_t faces : {1u, 2u, 65u, 200'000u}) {
      for (const uint32_t capacity : {64u, 65u, 1000u, 12'345u, 1u << 20}) {
        const VkDeviceSize bytes = workspace_size(vertices, faces, capacity, limits.switches);
        CHECK(capacity_for(limits, vertices, faces, bytes) >= capacity);
        CHECK(capacity_for(limits, vertices, faces, bytes - 256) < capacity + 64);
        const Workspace ws = view_workspace({VK_NULL_HANDLE, 512, bytes}, limits, vertices, faces);
        CHECK(ws.unused.offset + ws.unused.size <= 512 + bytes);
        CHECK(ws.centroid_nearest.offset + ws.centroid_nearest.size <= 512 + bytes);
        CHECK(ws.centroids.offset + ws.centroids.size <= 512 + bytes);
        CHECK(ws.survivors.offset + ws.survivors.size <= 512 + bytes);
        CHECK(ws.u3_bounds.offset + ws.u3_bounds.size <= 512 + bytes);
        CHECK(ws.sort.count.offset + ws.sort.count.size <= 512 + bytes);
        CHECK(ws.sort.values[0].offset + ws.sort.values[0].size <= 512 + bytes);
        CHECK(ws.frontier.size == 2ull * ws.capacity * sizeof(gpu::Candidate));
        CHECK(ws.points.size >= 3ull * (ws.capacity / 4) * sizeof(gpu::Point));
        CHECK(ws.frontier.offset % 256 == 0);
        CHECK(ws.sizes.offset % 4 == 0);
      }
    }
  }
  CHECK(capacity_for(limits, 1000, 1000, 100) == 0);  // not even the fixed streams
}

}  // namespace

TEST_CASE("sizes and views agree for every capacity and set of switches") {
  KernelBench bench;
  Limits limits = bench.context()->limits;
  for (const uint32_t switches : kSwitchSets) {
    limits.switches = switches;
    check_sizes(limits);
  }
}

TEST_CASE("a candidate takes 36 bytes, and a place in the workspace of a GPU's run under 100") {
  static_assert(sizeof(gpu::Candidate) == 36);
  const uint32_t capacity = 1u << 20;
  const auto each = [&](uint32_t switches) {
    return static_cast<double>(workspace_size(1, 1, capacity, switches)) / capacity;
  };
  CHECK(each(VKH_SWITCH_DEFAULT_WIDE) < 100);
  CHECK(each(VKH_SWITCH_DEFAULT_NARROW) > 140);  // centroids
}

TEST_CASE("no binding of a workspace exceeds what the device can bind") {
  KernelBench bench;
  const Limits& limits = bench.context()->limits;
  const uint32_t capacity = largest_capacity(limits);
  const VkDeviceSize bytes = workspace_size(1, 1, capacity, limits.switches);
  const Workspace ws = view_workspace({VK_NULL_HANDLE, 0, bytes}, limits, 1, 1);
  CHECK(ws.capacity == capacity);
  for (const VkDeviceSize size :
       {ws.frontier.size, ws.points.size, ws.splits.size, ws.survivors.size, ws.centroids.size})
    CHECK(size <= limits.storage_range);
}

TEST_CASE("the pyramid has room for every level") {
  CHECK(pyramid_size(1) == 0);
  CHECK(pyramid_size(2) == 1);
  CHECK(pyramid_size(16) == 1);
  CHECK(pyramid_size(17) == 3);
  CHECK(pyramid_size(256) == 17);
  CHECK(pyramid_size(257) == 17 + 2 + 1);
  CHECK(quads_size(1) == 0);
  CHECK(quads_size(2) == 1);
  CHECK(quads_size(17) == 5 + 1);
  CHECK(quads_size(257) == 65 + 5 + 1);
}

TEST_CASE("a compact workspace bounds all faces of A at once, and gives the same answer") {
  for (const uint32_t halvings : {0u, 2u, 3u}) {
    CAPTURE(halvings);
    ApiMesh a(icosphere(1.0, halvings)), b(translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}));
    ApiPair pair(a, b, 1e-4f);
    VkhWorkspaceRequirements needed{};
    REQUIRE(vkhGetWorkspaceRequirements(pair.context(), a.view().vertexCount, a.view().faceCount,
                                        &needed) == VKH_SUCCESS);
    REQUIRE(needed.compact <= pair.workspace_size());
    pair.problem().workspace.size = needed.compact;
    pair.run([&](VkCommandBuffer commands) {
      pair.build(commands);
      pair.begin(commands);
      pair.report(commands, 1);
      pair.advance(commands, 20);
      pair.report(commands);
    });
    CHECK(pair.read(1).upper < 1e38f);  // no face waits
    CHECK(pair.read().status == VKH_STATUS_DECIDED);
    check_true(pair.read(), a, b);
  }
}

namespace {

// Runs a pair on the GPU profile in `bytes` bytes of its workspace.
VkhReport run_in(ApiPair& pair, VkDeviceSize bytes) {
  pair.problem().workspace.size = bytes;
  return pair.run([&](VkCommandBuffer commands) {
    pair.build(commands);
    pair.begin(commands);
    pair.advance(commands, 20);
    pair.report(commands);
  });
}

}  // namespace

TEST_CASE("on a GPU a compact workspace costs a small pair no wave") {
  const std::vector<std::pair<Mesh, Mesh>> meshes = {
      {icosphere(1.0, 1), translated(icosphere(1.1, 4), {0.003, 0.002, 0.001})},
      {icosphere(1.0, 3), icosphere(1.01, 3)}};
  for (const auto& [mesh_a, mesh_b] : meshes) {
    CAPTURE(mesh_a.faces.size());
    ApiMesh a(mesh_a), b(mesh_b);
    ApiPair pair(a, b, 3e-6f);
    VkhWorkspaceRequirements needed{};
    REQUIRE(vkhGetWorkspaceRequirements(pair.context(), a.view().vertexCount, a.view().faceCount,
                                        &needed) == VKH_SUCCESS);
    CHECK(needed.compact < 4'000'000);
    CHECK(needed.compact < pair.workspace_size());
    const VkhReport ample = run_in(pair, pair.workspace_size());
    const VkhReport compact = run_in(pair, needed.compact);
    CHECK(ample.status == VKH_STATUS_DECIDED);
    CHECK(compact.status == VKH_STATUS_DECIDED);
    CHECK(compact.waves == ample.waves);
    CHECK(ample.waves > 2);
  }
}

// --- Waves and time ---

TEST_CASE("after every wave the interval holds the distance, and never widens") {
  for (const ReferencePair& pair : pairs()) {
    Interval last{0, INFINITY};
    uint32_t waves = 0;
    for (uint32_t limit = 1; limit <= 40; ++limit) {
      const Report r = check_true(pair, with_waves(limit));
      CAPTURE(pair.name);
      CAPTURE(limit);
      CHECK((r.status == Status::kClosed || r.status == Status::kWaves));
      // Bounds of a later wave are taken from finer candidates, and rounding may cost a little.
      CHECK(r.lower >= last.lower - 1e-9);
      CHECK(r.upper <= last.upper + 1e-9);
      CHECK(r.waves >= waves);
      last = interval(r);
      waves = r.waves;
      if (r.status == Status::kClosed) break;
    }
    CHECK(last.upper - last.lower <= 1e-6 * diagonal(pair.a));
  }
}

TEST_CASE("no time at all still gives a true interval") {
  for (const ReferencePair& pair : pairs()) {
    SolveOptions options;
    options.time_limit_s = 0;
    const Report r = check_true(pair, options);
    CHECK((r.status == Status::kClosed || r.status == Status::kTime));
  }
}

TEST_CASE("a caller who cancels gets the interval so far") {
  for (const ReferencePair& pair : pairs()) {
    int calls = 0;
    SolveOptions options;
    options.progress = [&](const Progress&) { return ++calls < 1; };
    const Report r = check_true(pair, options);
    CHECK((r.status == Status::kClosed || r.status == Status::kCancelled));
    CHECK(calls <= 1);
    if (r.status == Status::kCancelled) CHECK(calls == 1);
  }
}

TEST_CASE("in any memory, a run again is the same run, bit by bit") {
  for (const ReferencePair& pair : pairs()) {
    for (const uint64_t bytes : {1ull, 64ull << 10, 256ull << 10}) {
      CAPTURE(bytes);
      const Report first = check_true(pair, with_memory(bytes));
      for (int repeat = 0; repeat < 2; ++repeat) {
        const Report again = check_true(pair, with_memory(bytes));
        CHECK(again.lower == first.lower);
        CHECK(again.upper == first.upper);
        CHECK(again.waves == first.waves);
        CHECK(again.candidates == first.candidates);
        CHECK(again.witness_a.point == first.witness_a.point);
      }
    }
  }
}

TEST_CASE("with a GPU's switches, too, in any memory, a run again is the same run") {
  for (const ReferencePair& pair : pairs()) {
    for (const uint64_t bytes : {0ull, 1ull, 64ull << 10, 256ull << 10}) {
      CAPTURE(bytes);
      SolveOptions options = with_memory(bytes);
      options.engine.enabled = {"wide", "group_walk", "split_twice"};
      options.engine.disabled = {"centroid", "parent_samples"};
      const Report first = check_true(pair, options);
      const Report again = check_true(pair, options);
      CHECK(first.status == Status::kClosed);
      CHECK(again.lower == first.lower);
      CHECK(again.upper == first.upper);
      CHECK(again.waves == first.waves);
      CHECK(again.candidates == first.candidates);
    }
  }
}

namespace {

bool has_stage(const Report& r, const std::string& name) {
  return std::any_of(r.stages.begin(), r.stages.end(),
                     [&](const StageStats& s) { return s.name == name; });
}

}  // namespace

/// A wave is then two dispatches: `query` splits, wave_bound plans. A frontier that may be sorted
/// takes four, though it is not sorted here.
TEST_CASE("with a GPU's switches, a wave of two dispatches and one of four are the same") {
  for (const ReferencePair& pair : pairs()) {
    for (const uint64_t bytes : {0ull, 1ull}) {  // the recommended capacity, and the smallest
      for (const double tolerance : {1e-6, 1e-8}) {
        CAPTURE(bytes);
        CAPTURE(tolerance);
        SolveOptions options = with_memory(bytes);
        options.tolerance = tolerance;
        options.wave_limit = 400;
        options.engine.enabled = {"wide", "group_walk", "split_twice"};
        options.engine.disabled = {"centroid", "parent_samples"};
        const Report two = check_true(pair, options);
        CHECK(!has_stage(two, "subdivide"));
        CHECK(!has_stage(two, "plan"));
        options.engine.enabled.push_back("sort");
        options.engine.sort_from = ~0u;
        const Report four = check_true(pair, options);
        // This holds only if the begin did not end the run.
        CHECK((four.waves <= 1 || has_stage(four, "subdivide")));
        CHECK((four.waves <= 1 || has_stage(four, "plan")));
        check_same(two, four);
      }
    }
  }
}

/// If nothing may wait, a frontier that does not fit is spilled as a whole.
TEST_CASE("with a GPU's switches, what is spilled for want of memory keeps its bound") {
  for (const ReferencePair& pair : pairs()) {
    SolveOptions options = with_memory(1);
    options.engine.enabled = {"wide", "group_walk", "split_twice"};
    options.engine.disabled = {"centroid", "parent_samples", "defer"};
    check_true(pair, options);
  }
}

TEST_CASE("progress tells of intervals that are true and shrink") {
  // Little memory: many waves, so that there are many submissions.
  for (const ReferencePair& pair : pairs()) {
    Interval last{0, INFINITY};
    uint32_t waves = 0;
    bool is_first = true;  // when only the BVH may be there
    SolveOptions options = with_memory(64 << 10);
    options.progress = [&](const Progress& p) {
      CHECK((p.wave > waves || is_first));
      is_first = false;
      CHECK(Interval{p.lower, p.upper}.meets(pair.exact));
      CHECK(p.lower >= last.lower - 1e-9);
      CHECK(p.upper <= last.upper + 1e-9);
      CHECK(p.gap >= 0);
      last = {p.lower, p.upper};
      waves = p.wave;
      return true;
    };
    const Report r = check_true(pair, options);
    CHECK(r.waves >= waves);
  }
}

// --- Switches ---

TEST_CASE("each switch off, or all, gives a true interval") {
  const std::vector<std::string> names = switch_names();
  CHECK(names.size() == 17);
  for (const ReferencePair& pair : pairs()) {
    for (const std::string& name : names) {
      CAPTURE(name);
      const Report r = check_true(pair, without({name}));
      CHECK(std::count(r.switched_off.begin(), r.switched_off.end(), name) == 1);
      CHECK(r.status == Status::kClosed);
    }
    CHECK(check_true(pair, without(names)).switched_off == names);
  }
}

TEST_CASE("what does not pay on a CPU device is off unless asked for") {
  const std::vector<std::string> off = {
      "u4", "group_walk", "sort", "packet", "largest_first", "u3_paper", "split_twice", "wide"};
  for (const ReferencePair& pair : pairs()) {
    CHECK(check_true(pair, {}).switched_off == off);
    SolveOptions options;
    options.engine.enabled = off;
    CHECK(check_true(pair, options).switched_off.empty());
  }
}

TEST_CASE("an unknown switch is refused by its name") {
  const ReferencePair& pair = pairs()[1];
  try {
    solver().distance(pair.a, pair.b, without({"u3", "u9"}));
    FAIL("accepted");
  } catch (const UsageError& error) {
    CHECK(std::string(error.what()).find("'u9'") != std::string::npos);
  }
  SolveOptions options;
  options.engine.enabled = {"u9"};
  CHECK_THROWS_AS(solver().distance(pair.a, pair.b, options), UsageError);
}
