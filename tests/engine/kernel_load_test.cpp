// mesh_load against a plain loop: strides, offsets, 16- and 32-bit indices, sizes around workgroups
// and beyond one row of them.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>

#include "tests/shapes/shapes.h"
#include "tests/support/kernel_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using Bytes = std::vector<uint8_t>;

struct Layout {
  uint32_t stride = 12;
  uint32_t vertex_offset = 0;
  uint32_t index_offset = 0;
  bool is_16bit = false;
  bool has_low = false;
  uint32_t low_offset = 0;
};

struct Content {
  std::vector<float> positions, lows;
  std::vector<uint32_t> indices;
};

Content make_content(uint32_t vertices, uint32_t faces, bool is_16bit, uint64_t seed) {
  Random random(seed);
  Content c;
  for (uint32_t i = 0; i < 3 * vertices; ++i) {
    c.lows.push_back(static_cast<float>(random.range(-1e-8, 1e-8)));
    const double size = std::pow(2.0, random.range(-100.0, 100.0));
    c.positions.push_back(
        static_cast<float>(random.below(9) == 0 ? -0.0 : random.range(-1, 1) * size));
  }
  // All values occur, the largest first; of three two are in range.
  for (uint32_t i = 0; i < 3 * faces; ++i) {
    const uint32_t any = i == 0 ? 0xffffffffu : static_cast<uint32_t>(random.bits());
    const uint32_t some = i % 3 == 0 ? any : any % vertices;
    c.indices.push_back(is_16bit ? some & 0xffffu : some);
  }
  return c;
}

/// `size` bytes of noise, a whole number of words.
Bytes noise(size_t size) {
  Random random(size);
  Bytes bytes((size + 3) / 4 * 4);
  for (uint8_t& b : bytes) b = static_cast<uint8_t>(random.bits());
  return bytes;
}

Bytes lay_out_vertices(const std::vector<float>& positions, uint32_t stride, uint32_t offset) {
  const size_t count = positions.size() / 3;
  Bytes bytes = noise(offset + (count - 1) * stride + 12);
  for (size_t v = 0; v < count; ++v)
    std::memcpy(&bytes[offset + v * stride], &positions[3 * v], 12);
  return bytes;
}

Bytes lay_out_indices(const Content& c, const Layout& layout) {
  const size_t width = layout.is_16bit ? 2 : 4;
  Bytes bytes = noise(layout.index_offset + c.indices.size() * width);
  for (size_t i = 0; i < c.indices.size(); ++i) {
    // Little-endian, so the low half comes first.
    std::memcpy(&bytes[layout.index_offset + i * width], &c.indices[i], width);
  }
  return bytes;
}

void check_load(KernelBench& bench, uint32_t vertices, uint32_t faces, const Layout& layout) {
  CAPTURE(vertices);
  CAPTURE(faces);
  CAPTURE(layout.stride);
  CAPTURE(layout.vertex_offset);
  CAPTURE(layout.index_offset);
  CAPTURE(layout.is_16bit);
  const Content c = make_content(vertices, faces, layout.is_16bit, vertices + faces);
  const VkhMesh mesh{
      .vertexBuffer =
          bench.put(lay_out_vertices(c.positions, layout.stride, layout.vertex_offset)).buffer,
      .vertexOffset = layout.vertex_offset,
      .vertexStride = layout.stride,
      .vertexCount = vertices,
      .indexBuffer = bench.put(lay_out_indices(c, layout)).buffer,
      .indexOffset = layout.index_offset,
      .indexType = layout.is_16bit ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32,
      .faceCount = faces,
      .vertexLowBuffer =
          layout.has_low
              ? bench.put(lay_out_vertices(c.lows, layout.stride, layout.low_offset)).buffer
              : VK_NULL_HANDLE,
      .vertexLowOffset = layout.low_offset};
  const auto loaded = bench.garbage<gpu::Vertex>(vertices);
  const auto corners = bench.garbage<gpu::uvec3>(faces);
  bench.run([&](Recorder& rec) { record_load(rec, mesh, loaded, corners); });
  const auto got = bench.get(loaded);
  size_t wrong = 0;
  for (uint32_t v = 0; v < vertices; ++v) {
    const float zero[3] = {};
    wrong += std::memcmp(&got[v].hi, &c.positions[3 * v], 12) != 0;
    wrong += std::memcmp(&got[v].lo, layout.has_low ? &c.lows[3 * v] : zero, 12) != 0;
  }
  CHECK(wrong == 0);
  std::vector<uint32_t> expected = c.indices;
  for (uint32_t& index : expected) index = std::min(index, vertices - 1);
  const auto got_corners = bench.get(corners);
  CHECK(std::memcmp(got_corners.data(), expected.data(), 12 * faces) == 0);
}

constexpr uint32_t kSizes[] = {1, 2, 3, 21, 22, 63, 64, 65, 255, 256, 257, 2047, 2048, 2049};

}  // namespace

TEST_CASE("mesh_load at awkward sizes") {
  KernelBench bench;
  for (const bool is_16bit : {false, true}) {
    for (const uint32_t size : kSizes) {
      check_load(bench, size, size, {.is_16bit = is_16bit});
      check_load(bench, size, 1, {.is_16bit = is_16bit});
      check_load(bench, 1, size, {.is_16bit = is_16bit});
      check_load(bench, size, size, {.is_16bit = is_16bit, .has_low = true});
    }
  }
}

TEST_CASE("mesh_load at every stride and vertex offset") {
  for (const uint32_t stride : {12u, 16u, 28u, 32u, 260u}) {
    KernelBench bench;
    for (const uint32_t offset : {0u, 4u, 8u, 12u, 252u, 256u, 260u, 1000u, 4096u}) {
      check_load(bench, 1, 3, {.stride = stride, .vertex_offset = offset});
      check_load(bench, 67, 30, {.stride = stride, .vertex_offset = offset});
    }
  }
}

TEST_CASE("mesh_load of low parts, which have an offset of their own and the positions' stride") {
  for (const uint32_t stride : {12u, 16u, 28u, 260u}) {
    KernelBench bench;
    for (const uint32_t offset : {0u, 4u, 252u, 256u, 260u, 1000u}) {
      check_load(bench, 1, 3, {.stride = stride, .has_low = true, .low_offset = offset});
      check_load(bench, 67, 30,
                 {.stride = stride, .vertex_offset = 36, .has_low = true, .low_offset = offset});
    }
  }
}

TEST_CASE("mesh_load at every index offset") {
  for (const bool is_16bit : {false, true}) {
    KernelBench bench;
    for (uint32_t offset :
         {0u, 2u, 4u, 6u, 250u, 252u, 254u, 256u, 258u, 510u, 512u, 514u, 1022u}) {
      if (!is_16bit) offset *= 2;
      for (const uint32_t faces : {1u, 2u, 65u}) {
        check_load(bench, 5, faces, {.index_offset = offset, .is_16bit = is_16bit});
      }
    }
  }
}

TEST_CASE("mesh_load of large meshes") {
  KernelBench bench;
  check_load(bench, 100'001, 200'003, {.stride = 28, .vertex_offset = 36, .index_offset = 4});
  check_load(bench, 65'536, 131'071, {.stride = 16, .index_offset = 2, .is_16bit = true});
}

TEST_CASE("mesh_load beyond one row of workgroups") {
  KernelBench bench;
  const uint32_t items = gpu::kMaxGroupsX * gpu::kGroupSize + 1000;
  check_load(bench, 3, items / 3 + 1, {.is_16bit = true});
  check_load(bench, items, 1, {});
}

TEST_CASE("mesh_load of nothing but vertices, or nothing but indices") {
  // This is not reached through record_load, whose meshes have a face; it is the kernel's own edge
  // case.
  KernelBench bench;
  const auto words = bench.put(std::vector<uint32_t>{1, 2, 3, 4});
  const auto loaded = bench.garbage<gpu::Vertex>(1);
  const auto indices = bench.garbage<uint32_t>(3);
  const auto load = [&](uint32_t vertices, uint32_t corners) {
    const gpu::LoadPush push{.vertex_word = 0,
                             .stride_words = 3,
                             .vertex_count = vertices,
                             .index_half = 2,
                             .index_count = corners,
                             .index_is_16bit = 0,
                             .has_low = 0,
                             .low_word = 0,
                             .fault_word = 0};
    bench.run([&](Recorder& rec) {
      rec.run<k::MeshLoad>(Direct<k::MeshLoad>{{.vertex_words = words,
                                                .index_words = words,
                                                .low_words = words,
                                                .vertices = loaded,
                                                .indices = indices},
                                               push},
                           Items{1});
    });
  };
  load(0, 0);
  CHECK(bench.get(indices) == std::vector<uint32_t>(3, 0xa5a5a5a5u));
  load(0, 2);
  CHECK(bench.get(indices) == std::vector<uint32_t>{2, 3, 0xa5a5a5a5u});
  CHECK(std::bit_cast<uint32_t>(bench.get(loaded)[0].hi.x) == 0xa5a5a5a5u);
}
