// vkhCmdBoundCells through the C API alone: true in every way to run, the same bits by address, and
// the run does not change.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "host/solve/run.h"
#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

ContextHandle make_context(VkhDeviceKind kind, VkBool32 by_address = VK_FALSE) {
  const uint32_t defaults = kind == VKH_DEVICE_KIND_WIDE ? uint32_t{VKH_SWITCH_DEFAULT_WIDE}
                                                         : uint32_t{VKH_SWITCH_DEFAULT_NARROW};
  const VkhContextCreateInfo info = create_info(defaults | VKH_CONTEXT_CELLS, kind, by_address);
  VkhContext context = nullptr;
  REQUIRE(vkhCreateContext(&info, &context) == VKH_SUCCESS);
  return {context, vkhDestroyContext};
}

/// Room for bounds, and for the cells.
struct CellBuffers {
  explicit CellBuffers(uint32_t count)
      : cells(test_device(), count * sizeof(VkhCell), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
              Placement::kUpload),
        bounds(test_device(), count * sizeof(VkhCellBounds), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
               Placement::kReadback) {}

  VkhCells faces(uint32_t first, uint32_t count) const {
    return {VK_NULL_HANDLE, 0, first, count, bounds.handle(), 0};
  }
  VkhCells given(const std::vector<VkhCell>& some) {
    std::memcpy(cells.mapped(), some.data(), some.size() * sizeof(VkhCell));
    return {cells.handle(), 0, 0, static_cast<uint32_t>(some.size()), bounds.handle(), 0};
  }
  std::vector<VkhCellBounds> read(uint32_t count) const {
    std::vector<VkhCellBounds> all(count);
    std::memcpy(all.data(), bounds.mapped(), count * sizeof(VkhCellBounds));
    return all;
  }

  Buffer cells, bounds;
};

void bound(ApiPair& pair, const VkhCells& cells) {
  pair.run([&](VkCommandBuffer c) {
    vkhCmdBoundCells(pair.context(), c, &pair.problem(), &cells, nullptr);
    record_host_barrier(c);
  });
}

bool same(const std::vector<VkhCellBounds>& x, const std::vector<VkhCellBounds>& y) {
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
}

Mesh shape_a() { return icosphere(1.0, 2); }
Mesh shape_b() { return translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}); }

/// Computes for every face its corners' distances, and h of the face alone.
void check_true_of_faces(const std::vector<VkhCellBounds>& bounds, const Mesh& a, const Mesh& b) {
  REQUIRE(bounds.size() == a.faces.size());
  for (size_t f = 0; f < bounds.size(); ++f) {
    const glm::uvec3 face = a.faces[f];
    const VkhCellBounds& found = bounds[f];
    double most = 0;
    for (int i = 0; i < 3; ++i) {
      const double d = point_mesh_distance(a.vertices[face[i]], b);
      CHECK(static_cast<double>(found.lower[i]) <= d);
      CHECK(static_cast<double>(found.upper[i]) >= d);
      most = std::max(most, d);
    }
    CHECK(static_cast<double>(found.highest) >= most);
    CHECK(found.reached <= found.highest);
    CHECK(found.meanUpper <= found.highest);
    CHECK(found.faceB < b.faces.size());
  }
}

TEST_CASE("faces of A are bounded, on wide and on narrow devices, and the run goes on as it was") {
  for (const VkhDeviceKind kind : {VKH_DEVICE_KIND_NARROW, VKH_DEVICE_KIND_WIDE}) {
    const ContextHandle context = make_context(kind);
    ApiMesh a(shape_a()), b(shape_b());
    ApiPair pair(a, b, 1e-5f, context.get()), other(a, b, 1e-5f, context.get());
    const auto start = [](ApiPair& one) {
      one.run([&](VkCommandBuffer c) {
        one.build(c);
        one.begin(c);
        one.report(c);
      });
    };
    const auto finish = [](ApiPair& one) {
      return one.run([&](VkCommandBuffer c) {
        one.advance(c, 20);
        one.report(c);
      });
    };
    start(pair);
    start(other);
    const auto count = static_cast<uint32_t>(a.mesh().faces.size());
    CellBuffers buffers(count);
    bound(pair, buffers.faces(0, count));
    const std::vector<VkhCellBounds> all = buffers.read(count);
    check_true_of_faces(all, a.mesh(), b.mesh());
    bound(pair, buffers.faces(7, 5));
    const std::vector<VkhCellBounds> some = buffers.read(5);
    for (size_t i = 0; i < some.size(); ++i) CHECK(some[i].highest == all[7 + i].highest);
    CHECK(is_same(finish(pair), finish(other)));
  }
}

TEST_CASE("a face given as a cell has the face's bounds; its halves are no wider") {
  const ContextHandle context = make_context(VKH_DEVICE_KIND_NARROW);
  ApiMesh a(shape_a()), b(shape_b());
  ApiPair pair(a, b, 1e-5f, context.get());
  pair.run([&](VkCommandBuffer c) {
    pair.build(c);
    pair.begin(c);
  });
  CellBuffers buffers(3);
  bound(pair, buffers.faces(3, 1));
  const VkhCellBounds face = buffers.read(1)[0];
  // Corner 0 at (0, 0), 1 at (2^20, 0), 2 at (0, 2^20); and halves at the middle of edge 1 2.
  const VkhCell whole{{0, 1u << 30, 0, 1u << 29}, 3, 0xffffffffu};
  const uint32_t half = 1u << 19;
  const VkhCell first{{0, 1u << 30, half << 20, (half >> 12) | (half << 9)}, 3, face.start};
  bound(pair, buffers.given({whole, first}));
  const std::vector<VkhCellBounds> given = buffers.read(2);
  CHECK(given[0].highest == doctest::Approx(face.highest).epsilon(1e-5));
  CHECK(given[1].highest <= face.highest * 1.00001f);
  CHECK(given[1].lower[0] == doctest::Approx(face.lower[0]).epsilon(0.2));
}

TEST_CASE("by address, every bit is the same") {
  if (!test_device().has_addresses()) {
    MESSAGE("SKIP: the device has no bufferDeviceAddress");
    return;
  }
  std::vector<std::vector<VkhCellBounds>> found;
  for (const VkBool32 by_address : {VK_FALSE, VK_TRUE}) {
    const ContextHandle context = make_context(VKH_DEVICE_KIND_NARROW, by_address);
    ApiMesh a(shape_a()), b(shape_b());
    ApiPair pair(a, b, 1e-5f, context.get());
    const auto count = static_cast<uint32_t>(a.mesh().faces.size());
    CellBuffers buffers(count);
    pair.run([&](VkCommandBuffer c) {
      pair.build(c);
      pair.begin(c);
    });
    bound(pair, buffers.faces(0, count));
    found.push_back(buffers.read(count));
  }
  CHECK(same(found[0], found[1]));
}

TEST_CASE("after a refit the bounds are of the B that has moved") {
  const ContextHandle context = make_context(VKH_DEVICE_KIND_NARROW);
  ApiMesh a(shape_a()), b(shape_b());
  ApiPair pair(a, b, 1e-5f, context.get());
  pair.run([&](VkCommandBuffer c) { pair.build(c); });
  b.move(translated(icosphere(1.2, 3), {0.3, -0.1, 0.2}));
  const auto count = static_cast<uint32_t>(a.mesh().faces.size());
  CellBuffers buffers(count);
  pair.run([&](VkCommandBuffer c) {
    pair.refit(c);
    pair.begin(c);
  });
  bound(pair, buffers.faces(0, count));
  check_true_of_faces(buffers.read(count), a.mesh(), b.mesh());
}

}  // namespace
