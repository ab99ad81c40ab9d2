// The order in which a sorted frontier is refined: the keys of wave_sort against a CPU twin, and
// the places after the sort.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "tests/shapes/shapes.h"
#include "tests/support/kernel_bench.h"

// This comes after the others, and before the headers that it prepares for C++.
#include "tests/verification/model/lib_device.h"
// The headers themselves.
#include "shaders/math/hash.h"
#include "shaders/math/morton.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr uint32_t kSwitches = gpu::kUseAll | VKH_SWITCH_SORT;
using SelectionKey = std::pair<uint32_t, uint32_t>;

struct Sorted {
  std::vector<uint32_t> keys, places;
};

/// A child of up to seven generations, with a random u.
gpu::Candidate random_candidate(Random& random, uint32_t faces) {
  math::Bary3 t = math::whole_root();
  for (uint32_t generation = random.below(8); generation > 0; --generation) {
    const uint32_t split = random.below(2) == 0 ? math::kSplitMidpoint : 1 + random.below(27);
    t = math::child_of(math::split_points(t, split), math::child_points(split, random.below(4)));
  }
  const auto w = math::pack_corners(t);
  gpu::Candidate c{};
  c.corners = {w.x, w.y, w.z, w.w};
  c.root = random.below(faces);
  c.upper = static_cast<float>(random.unit());
  return c;
}

math::Bary3 corners_of(const gpu::Candidate& c) {
  return math::unpack_corners({c.corners.x, c.corners.y, c.corners.z, c.corners.w});
}

/// Smallest u first; of equal ones the smallest in area, then by a hash (candidate/candidate.glsl).
SelectionKey selection_key(const gpu::Candidate& c) {
  const math::Bary3 t = corners_of(c);
  const glm::i64vec2 ab = glm::i64vec2(t.b) - glm::i64vec2(t.a);
  const glm::i64vec2 ac = glm::i64vec2(t.c) - glm::i64vec2(t.a);
  const auto area = static_cast<uint64_t>(std::abs(ab.x * ac.y - ab.y * ac.x));
  uint32_t hash = math::mixed(0, c.root);
  for (const uint32_t word : {c.corners.x, c.corners.y, c.corners.z, c.corners.w})
    hash = math::mixed(hash, word);
  const auto exponent = static_cast<uint32_t>(std::bit_width(area) - 1);
  return {std::bit_cast<uint32_t>(c.upper), (exponent << 26) | (hash >> 6)};
}

/// A frontier in the half that the wave reads, and the plan's decision about it.
struct Wave {
  std::vector<gpu::Candidate> frontier;
  uint32_t waiting = 0;  ///< how many of them, those with the largest keys
  SelectionKey selected{};

  Wave(std::vector<gpu::Candidate> candidates, uint32_t wait)
      : frontier(std::move(candidates)), waiting(wait) {
    std::vector<SelectionKey> keys;
    for (const gpu::Candidate& c : frontier) keys.push_back(selection_key(c));
    std::sort(keys.begin(), keys.end());
    if (waiting < keys.size()) selected = keys[keys.size() - 1 - waiting];
  }
};

gpu::Dispatch groups(uint32_t count) { return {count, count == 0 ? 0u : 1u, 1}; }

Problem put_problem(KernelBench& bench, const Wave& wave, const Mesh& a, const Hierarchy& b) {
  const auto count = static_cast<uint32_t>(wave.frontier.size());
  gpu::Control control{};
  control.capacity = count + 5;
  control.parity = 1;
  control.count[gpu::kCountFrontier] = count;
  control.deferred = wave.waiting;
  control.select_key = wave.selected.first;
  control.select_tie = wave.selected.second;
  std::vector<gpu::Candidate> halves(control.capacity);
  halves.insert(halves.end(), wave.frontier.begin(), wave.frontier.end());
  gpu::WaveSizes sizes{};
  sizes.sort_keys = groups((count + gpu::kGroupSize - 1) / gpu::kGroupSize);
  const uint32_t blocks = (count + gpu::kSortBlock - 1) / gpu::kSortBlock;
  sizes.sort_blocks = groups(blocks);
  sizes.sort_digits = groups(blocks > gpu::kSortFewBlocks ? gpu::kSortDigits : 0);
  Problem p;
  p.switches = kSwitches;
  p.b = b;
  const VkhMesh on = put_mesh(bench, a);
  const auto memory = bench.garbage<uint32_t>(
      workspace_size(on.vertexCount, on.faceCount, count + 64, kSwitches) / 4);
  p.ws = view_workspace({memory.buffer, 0, memory.size}, bench.context()->limits, on.vertexCount,
                        on.faceCount);
  bench.run([&](Recorder& rec) { record_load(rec, on, p.ws.vertices, p.ws.faces); });
  p.ws.control = bench.put(std::vector{control});
  p.ws.frontier = bench.put(halves);
  p.ws.sizes = bench.put(std::vector{sizes});
  return p;
}

Sorted sort_wave(KernelBench& bench, const Wave& wave, const Mesh& a, const Hierarchy& b) {
  const Problem p = put_problem(bench, wave, a, b);
  bench.run([&](Recorder& rec) { record_order(rec, RunBuffers(p)); });
  Sorted out{bench.get(p.ws.sort.keys[0]), bench.get(p.ws.sort.values[0])};
  out.keys.resize(wave.frontier.size());
  out.places.resize(wave.frontier.size());
  return out;
}

math::vec3 rounded(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

/// One axis of a Morton code.
uint32_t axis_of(uint32_t code, uint32_t axis) {
  uint32_t cell = 0;
  for (uint32_t bit = 0; bit < 10; ++bit) cell |= (code >> (3 * bit + axis) & 1u) << bit;
  return cell;
}

struct Box {
  glm::dvec3 lo, hi;
};

/// The device may round a centroid into the next cell, and a quality across the threshold.
void check_key(uint32_t key, const gpu::Candidate& c, const Wave& wave, const Mesh& a,
               const Box& box) {
  const auto [pa, pb, pc] = corners(a, c.root);
  const math::Root root =
      math::make_root(math::two(rounded(pa)), math::two(rounded(pb)), math::two(rounded(pc)));
  const math::Bary3 t = corners_of(c);
  CHECK(((key & gpu::kKeyDeferred) != 0) == (wave.waiting > 0 && selection_key(c) > wave.selected));
  const float quality = math::quality(math::local_corners(root, t).at);
  if (std::abs(quality - gpu::kPaperThinQuality) > 1e-5f)
    CHECK(((key & gpu::kKeyThin) != 0) == (quality < gpu::kPaperThinQuality));
  const glm::dvec3 extent = box.hi - box.lo;
  const double side = std::max({extent.x, extent.y, extent.z});
  const glm::dvec3 at =
      (glm::dvec3(math::position_of(root, math::centroid_of(t)).hi) - box.lo) / side;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const double cell = std::clamp(1024.0 * at[static_cast<int>(axis)], 0.0, 1023.0);
    const double found = axis_of(key, 2 - axis);
    CHECK(found >= std::floor(cell - 0.01));
    CHECK(found <= std::floor(cell + 0.01));
  }
}

void check_order(const Sorted& sorted, const Wave& wave, const Mesh& a, const Box& box) {
  std::vector<uint32_t> places = sorted.places;
  std::sort(places.begin(), places.end());
  for (uint32_t i = 0; i < places.size(); ++i) REQUIRE(places[i] == i);
  for (size_t i = 0; i < places.size(); ++i) {
    check_key(sorted.keys[i], wave.frontier[sorted.places[i]], wave, a, box);
    if (i == 0) continue;
    REQUIRE(sorted.keys[i - 1] <= sorted.keys[i]);
    if (sorted.keys[i - 1] == sorted.keys[i]) CHECK(sorted.places[i - 1] < sorted.places[i]);
  }
  const auto is_parent = [](uint32_t key) { return (key & gpu::kKeyDeferred) == 0; };
  const auto parents = std::count_if(sorted.keys.begin(), sorted.keys.end(), is_parent);
  CHECK(static_cast<size_t>(parents) == wave.frontier.size() - wave.waiting);
}

}  // namespace

TEST_CASE("the frontier is sorted by defer, mode and Morton code of the centroid") {
  // A sticks out of B's box, so that codes are clamped, and has thin faces.
  const Mesh a = in_float32(joined(soup(1, 200), translated(needles(2, 100), {0.5, 0.5, 0.5})));
  const Mesh b = in_float32(soup(3, 300));
  KernelBench bench(kSwitches);
  const Hierarchy h = build_hierarchy(bench, b).hierarchy;
  const auto [lo, hi] = bounding_box(b);
  Random random(4);
  for (const uint32_t count : {0u, 1u, 63u, 64u, 65u, 255u, 256u, 257u, 2049u, 5000u}) {
    CAPTURE(count);
    std::vector<gpu::Candidate> candidates;
    for (uint32_t i = 0; i < count; ++i)
      candidates.push_back(random_candidate(random, static_cast<uint32_t>(a.faces.size())));
    for (const uint32_t waiting : {0u, count / 3}) {
      const Wave wave(candidates, waiting);
      check_order(sort_wave(bench, wave, a, h), wave, a, {lo, hi});
    }
  }
}

TEST_CASE("equal keys stay in their order") {
  const Mesh a = in_float32(soup(5, 10));
  KernelBench bench(kSwitches);
  const Hierarchy h = build_hierarchy(bench, a).hierarchy;
  Random random(6);
  for (const uint32_t count : {2u, 64u, 257u, 4097u}) {
    const Wave wave(std::vector(count, random_candidate(random, 10)), 0);
    const Sorted sorted = sort_wave(bench, wave, a, h);
    for (uint32_t i = 0; i < count; ++i) CHECK(sorted.places[i] == i);
  }
}
