// B's BVH, kernel by kernel: codes, topology, boxes.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>

#include "host/mesh/round_to_float.h"
#include "tests/shapes/shapes.h"
#include "tests/support/kernel_bench.h"
#include "tests/verification/model/vec3.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using Words = std::vector<uint32_t>;

constexpr uint32_t kAwkwardSizes[] = {1,  2,  3,  4,  5,   6,   7,   8,    9,    16,
                                      17, 63, 64, 65, 255, 256, 257, 2047, 2048, 2049};

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

Mesh coincident(uint32_t count) {
  const Mesh one = single_triangle({0.25, 0.5, 0.125}, {0.75, 0.5, 0}, {0.5, 0.0, 0.5});
  return make_mesh("coincident", one.vertices, std::vector<glm::uvec3>(count, one.faces[0]));
}

std::vector<NamedMesh> awkward_meshes() {
  std::vector<NamedMesh> meshes;
  for (const uint32_t count : kAwkwardSizes) meshes.push_back({"soup", soup(count, count)});
  for (const uint32_t count : {1u, 2u, 3u, 4u, 5u, 20'000u})
    meshes.push_back({"coincident", coincident(count)});
  meshes.push_back(
      {"two clusters", joined(coincident(300), translated(coincident(500), {2, 0, 0}))});
  meshes.push_back({"coincident in a soup", joined(coincident(1000), soup(3, 1000))});
  meshes.push_back({"flat", square_patch(23, 0.375)});
  meshes.push_back({"needles", needles(5, 500)});
  meshes.push_back({"slivers", slivers(6, 500)});
  meshes.push_back({"degenerate", degenerate_faces(7, 300)});
  meshes.push_back({"sphere", icosphere(1.0, 3)});
  meshes.push_back({"large soup", soup(8, 100'003)});
  meshes.push_back({"soup of float32", in_float32(soup(9, 300))});
  return meshes;
}

gpu::vec3 vertex(const Mesh& mesh, uint32_t v) {
  const glm::dvec3& p = mesh.vertices[v];
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

// --- Codes ---

/// The same formula as in base/face_code.glsl: a sum and a product, correctly rounded everywhere.
float centre(const Mesh& mesh, const glm::uvec3& f, int axis) {
  const auto at = [&](uint32_t v) { return component(vertex(mesh, v), axis); };
  const auto [lo, hi] = std::minmax({at(f.x), at(f.y), at(f.z)});
  return 0.5f * (lo + hi);
}

struct CentreBox {
  float lo[3], hi[3];
};

CentreBox centre_box(const Mesh& mesh) {
  CentreBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = box.hi[axis] = centre(mesh, mesh.faces[0], axis);
    for (const glm::uvec3& f : mesh.faces) {
      box.lo[axis] = std::min(box.lo[axis], centre(mesh, f, axis));
      box.hi[axis] = std::max(box.hi[axis], centre(mesh, f, axis));
    }
  }
  return box;
}

float from_ordered(uint32_t key) {
  return std::bit_cast<float>(key >= 0x80000000u ? key - 0x80000000u : ~key);
}

/// The cell along one axis: every third bit of the code, bit by bit.
uint32_t cell(uint32_t code, int axis) {
  uint32_t out = 0;
  for (uint32_t bit = 0; bit < 10; ++bit)
    out |= ((code >> (3 * bit + 2 - static_cast<uint32_t>(axis))) & 1) << bit;
  return out;
}

/// If faces are few, codes have 8 bits per axis instead of 10.
double coarseness(const Mesh& mesh) { return mesh.faces.size() <= gpu::kFewFaces ? 4 : 1; }

/// The position of a centre in the cube of 1024 cells per side, in double precision.
double place_in_cube(const Mesh& mesh, const CentreBox& box, const glm::uvec3& f, int axis) {
  float side = 0;
  for (int i = 0; i < 3; ++i) side = std::max(side, box.hi[i] - box.lo[i]);
  if (side == 0) return 0;
  const double offset =
      static_cast<double>(centre(mesh, f, axis)) - static_cast<double>(box.lo[axis]);
  return offset / static_cast<double>(side) * 1024;
}

/// Devices may round the division in their own way: within a thousandth of a cell's border either
/// cell is right. Returns whether all three axes were away from it.
bool check_code(const Mesh& mesh, const CentreBox& box, uint32_t face, uint32_t code) {
  CHECK(code < (1u << 30));
  bool sharp = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double coarse = coarseness(mesh);
    const double place = place_in_cube(mesh, box, mesh.faces[face], axis) / coarse;
    const double found = cell(code, axis) / coarse;
    const bool border =
        place > 0 && coarse * place < 1023.5 && std::abs(place - std::round(place)) < 1e-3;
    sharp = sharp && !border;
    const bool right = border ? std::abs(found + 0.5 - place) < 0.502
                              : found == std::min(std::floor(place), std::floor(1023.0 / coarse));
    CHECK_MESSAGE(right,
                  "face " << face << " axis " << axis << ": cell " << found << " for " << place);
  }
  return sharp;
}

void check_codes(const Mesh& mesh) {
  KernelBench bench;
  const BuiltHierarchy built = build_hierarchy(bench, mesh);
  const CentreBox box = centre_box(mesh);
  const gpu::CentroidBox found = bench.get(built.hierarchy.box)[0];
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(from_ordered(found.lo[axis]) == box.lo[axis]);
    CHECK(-from_ordered(found.minus_hi[axis]) == box.hi[axis]);
  }
  const Words codes = bench.get(built.hierarchy.codes);
  const Words order = bench.get(built.scratch.sort.values[0]);
  CHECK(std::is_sorted(codes.begin(), codes.end()));
  size_t sharp = 0;
  for (size_t i = 0; i < codes.size(); ++i) sharp += check_code(mesh, box, order[i], codes[i]);
  CHECK(sharp * 2 >= codes.size());  // the middles of a grid lie on borders
}

// --- Topology ---

struct Ref {
  uint32_t at, first, last, depth;
};

bool is_leaf(uint32_t child) { return (child & gpu::kLeafFlag) != 0; }

std::pair<uint32_t, uint32_t> leaf_range(uint32_t leaf) {
  const uint32_t first = leaf & (gpu::kMaxTriangles - 1);
  return {first, first + ((leaf >> 28) & 7)};
}

/// Traverses from branch 0 and counts how often each triangle is reached; `enter` is called with
/// each branch, its number, and the last triangle of its first child.
template <class Enter>
uint32_t walk(const std::vector<gpu::Branch>& branches, uint32_t count, Words& reached,
              Enter&& enter) {
  reached.assign(count, 0);
  std::vector<Ref> open = {{0, 0, count - 1, 1}};
  uint32_t depth = 0;
  size_t visited = 0;
  while (!open.empty()) {
    const Ref ref = open.back();
    open.pop_back();
    depth = std::max(depth, ref.depth);
    REQUIRE(++visited <= 2 * static_cast<size_t>(count));  // otherwise it is a cycle
    if (is_leaf(ref.at)) {
      const auto [first, last] = leaf_range(ref.at);
      REQUIRE(first == ref.first);
      REQUIRE(last == ref.last);
      REQUIRE(last - first < gpu::kLeafTriangles);
      for (uint32_t i = first; i <= last; ++i) ++reached[i];
      continue;
    }
    REQUIRE(ref.at < branches.size());
    const gpu::Branch& branch = branches[ref.at];
    REQUIRE(branch.first == ref.first);
    REQUIRE(branch.last == ref.last);
    const uint32_t split =
        is_leaf(branch.child0) ? leaf_range(branch.child0).second : branch.child0;
    REQUIRE(split >= ref.first);
    REQUIRE(split < ref.last);
    enter(branch, ref.at, split);
    open.push_back({branch.child0, ref.first, split, ref.depth + 1});
    open.push_back({branch.child1, split + 1, ref.last, ref.depth + 1});
  }
  return depth;
}

std::vector<gpu::Branch> topology_of(const Words& keys) {
  KernelBench bench;
  const auto count = static_cast<uint32_t>(keys.size());
  const auto keys_in = bench.put(keys);
  const auto branches = bench.garbage<gpu::Branch>(std::max(count, 2u) - 1);
  bench.run([&](Recorder& rec) {
    rec.run<k::BvhHierarchy>(Direct<k::BvhHierarchy>{{keys_in, branches}, {count}}, Items{count});
  });
  return bench.get(branches);
}

/// Returns the depth. One triangle has no branch: number 0 refers to it twice.
uint32_t check_topology(const Words& keys) {
  const auto count = static_cast<uint32_t>(keys.size());
  CAPTURE(count);
  const auto branches = topology_of(keys);
  if (count == 1) {
    CHECK(branches[0].child0 == gpu::kLeafFlag);
    CHECK(branches[0].child1 == gpu::kLeafFlag);
    return 1;
  }
  Words reached;
  const uint32_t depth =
      walk(branches, count, reached, [&](const gpu::Branch& b, uint32_t, uint32_t split) {
        // A split separates keys that differ earlier than either half's own do.
        const auto shared = [&](uint32_t i, uint32_t j) {
          return keys[i] != keys[j] ? std::countl_zero(keys[i] ^ keys[j])
                                    : 32 + std::countl_zero(i ^ j);
        };
        const int whole = shared(b.first, b.last);
        if (split > b.first) CHECK(shared(b.first, split) > whole);
        if (split + 1 < b.last) CHECK(shared(split + 1, b.last) > whole);
        CHECK(shared(split, split + 1) == whole);
      });
  CHECK(std::all_of(reached.begin(), reached.end(), [](uint32_t n) { return n == 1; }));
  CHECK(depth <= gpu::kStackDepth);
  return depth;
}

Words random_keys(uint64_t seed, uint32_t count, uint32_t below) {
  Random random(seed);
  Words keys(count);
  for (uint32_t& k : keys) k = random.below(below);
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// 0, 1, 2, 4, .. 2^29: each level splits off one key, and then the ties of the many zeros.
Words deep_keys(uint32_t zeros) {
  Words keys(zeros, 0);
  for (uint32_t bit = 0; bit < 30; ++bit) keys.push_back(1u << bit);
  return keys;
}

// --- Boxes ---

struct Box {
  gpu::vec3 lo{3e38f, 3e38f, 3e38f}, hi{-3e38f, -3e38f, -3e38f};
};

Box box_of(const std::vector<gpu::Triangle>& triangles, uint32_t first, uint32_t last) {
  Box box;
  for (uint32_t i = first; i <= last; ++i) {
    for (const gpu::vec3& p : {triangles[i].a, triangles[i].b, triangles[i].c}) {
      box.lo = min(box.lo, p);
      box.hi = max(box.hi, p);
    }
  }
  return box;
}

gpu::vec3 low_vertex(const Mesh& mesh, uint32_t v) {
  const glm::dvec3 low = mesh.vertices[v] - round_to_float(mesh.vertices[v]);
  return {static_cast<float>(low.x), static_cast<float>(low.y), static_cast<float>(low.z)};
}

void check_triangles(const Mesh& mesh, const std::vector<gpu::Triangle>& triangles,
                     const std::vector<gpu::TriangleLow>& lows) {
  std::vector<bool> seen(mesh.faces.size());
  size_t wrong = 0;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const gpu::Triangle& t = triangles[i];
    REQUIRE(t.face < mesh.faces.size());
    wrong += seen[t.face];
    seen[t.face] = true;
    const glm::uvec3& f = mesh.faces[t.face];
    wrong += !same(t.a, vertex(mesh, f.x)) || !same(t.b, vertex(mesh, f.y)) ||
             !same(t.c, vertex(mesh, f.z));
    wrong += !same(lows[i].a, low_vertex(mesh, f.x)) || !same(lows[i].b, low_vertex(mesh, f.y)) ||
             !same(lows[i].c, low_vertex(mesh, f.z));
  }
  CHECK(wrong == 0);
}

std::pair<uint32_t, uint32_t> range_of(uint32_t child, const std::vector<gpu::Branch>& branches) {
  if (is_leaf(child)) return leaf_range(child);
  return {branches[child].first, branches[child].last};
}

/// The references that a node must have: its branch's grandchildren, or children that are leaves.
Words grandchildren(const gpu::Branch& branch, const std::vector<gpu::Branch>& branches) {
  Words all;
  for (const uint32_t child : {branch.child0, branch.child1}) {
    all.push_back(is_leaf(child) ? child : branches[child].child0);
    all.push_back(is_leaf(child) ? gpu::kNone : branches[child].child1);
  }
  return all;
}

bool holds(const gpu::Child4& child, uint32_t expected, const Box& box) {
  return child.child == expected && same(child.lo, box.lo) && same(child.hi, box.hi);
}

void check_hierarchy(const Mesh& mesh) {
  KernelBench bench;
  const BuiltHierarchy built = build_hierarchy(bench, mesh);
  const auto count = static_cast<uint32_t>(mesh.faces.size());
  const auto nodes = bench.get(built.hierarchy.nodes);
  const auto triangles = bench.get(built.hierarchy.triangles);
  check_triangles(mesh, triangles, bench.get(built.hierarchy.triangle_lows));
  const auto branches = bench.get(built.hierarchy.branches);
  if (count == 1) {
    CHECK(holds(nodes[0].child[0], gpu::kLeafFlag, box_of(triangles, 0, 0)));
    for (int k = 1; k < 4; ++k) CHECK(holds(nodes[0].child[k], gpu::kNone, Box{}));
    return;
  }
  size_t wrong = 0;
  Words reached;
  const uint32_t depth =
      walk(branches, count, reached, [&](const gpu::Branch& b, uint32_t at, uint32_t) {
        const Words expected = grandchildren(b, branches);
        for (size_t k = 0; k < 4; ++k) {
          const auto child = expected[k];
          Box box;
          if (child != gpu::kNone) {
            const auto [first, last] = range_of(child, branches);
            box = box_of(triangles, first, last);
          }
          wrong += !holds(nodes[at].child[k], child, box);
        }
      });
  CHECK(wrong == 0);
  CHECK(depth <= gpu::kStackDepth);
  CHECK(std::all_of(reached.begin(), reached.end(), [](uint32_t n) { return n == 1; }));
}

}  // namespace

TEST_CASE("centroid box and Morton codes are those of a plain loop") {
  for (const auto& [name, mesh] : awkward_meshes()) {
    const auto& called = name;
    CAPTURE(called);
    check_codes(mesh);
  }
}

TEST_CASE("Morton codes far from the origin, and of tiny and huge meshes") {
  check_codes(translated(soup(11, 300), {1000, -2000, 500}));
  check_codes(translated(soup(12, 300), {-3, -3, -3}));  // a box of negative numbers only
  check_codes(scaled(soup(13, 300), -30));
  check_codes(scaled(soup(14, 300), 30));
}

TEST_CASE("the topology reaches each triangle once, whatever the keys") {
  for (const uint32_t count : kAwkwardSizes) {
    check_topology(Words(count, 0));
    check_topology(Words(count, 0xffffffffu >> 2));
    check_topology(random_keys(count, count, 1u << 30));
    check_topology(random_keys(count, count, 4));
    Words ascending(count);
    std::iota(ascending.begin(), ascending.end(), 0u);
    check_topology(ascending);
  }
}

TEST_CASE("the topology of many keys") {
  check_topology(random_keys(1, 100'003, 1u << 30));
  check_topology(random_keys(2, 100'003, 1000));
  check_topology(Words(20'000, 0));
  check_topology(Words(131'072, 77));
}

TEST_CASE("the deepest topology stays within the stack") {
  CHECK(check_topology(deep_keys(1 << 17)) > 40);  // otherwise it is not the intended case
}

TEST_CASE("built hierarchies: triangles, topology and exact boxes") {
  for (const auto& [name, mesh] : awkward_meshes()) {
    const auto& called = name;
    CAPTURE(called);
    check_hierarchy(mesh);
  }
}

TEST_CASE("the same mesh gives the same hierarchy, bit by bit") {
  KernelBench bench;
  const Mesh mesh = soup(21, 3000);
  const auto first = build_hierarchy(bench, mesh).hierarchy,
             again = build_hierarchy(bench, mesh).hierarchy;
  const auto bytes = [&](const Hierarchy& h) {
    Words words = bench.get(as<uint32_t>(h.branches));
    for (const gpu::Triangle& t : bench.get(h.triangles)) words.push_back(t.face);
    return words;
  };
  CHECK(bytes(first) == bytes(again));
}
