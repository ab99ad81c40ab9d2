// B's BVH: a linear one over Morton-sorted triangles, built and refitted on the GPU.
#include <algorithm>

#include "engine/record.h"

namespace vkh {
namespace {

// A binding that covers [offset, offset + bytes) of a buffer and starts at a multiple of 256 bytes;
// `skip` is how far into it the range starts.
struct AlignedRange {
  Slice<uint32_t> words;
  uint32_t skip;
};

AlignedRange align(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize bytes) {
  const VkDeviceSize start = offset / 256 * 256;
  const VkDeviceSize end = (offset + bytes + 3) / 4 * 4;
  return {{buffer, start, end - start}, static_cast<uint32_t>(offset - start)};
}

uint32_t over(uint32_t count, uint32_t fan) { return (count + fan - 1) / fan; }

// The kernels' buffers: the BVH's, and each kernel's others.
struct Count : Hierarchy {
  gpu::CountPush push;
};
struct Level : Hierarchy {
  gpu::PyramidPush push;
};
struct Refit : Hierarchy {
  gpu::RefitPush push;
};
struct Keys : Hierarchy {
  gpu::MortonPush push;
  Slice<uint32_t> keys, values, counts;
};
struct Sorted : Hierarchy {
  gpu::PyramidPush push;
  Slice<uint32_t> keys, values;
};
struct SortedCount : Hierarchy {
  gpu::CountPush push;
  Slice<uint32_t> keys;
};
struct Ranked : Hierarchy {
  gpu::CountPush push;
  Slice<uint32_t> next_rank;
};
// The caller's buffers.
struct Words {
  gpu::LoadPush push;
  Slice<uint32_t> vertex_words, index_words, low_words;
};
struct Load : Words {
  Slice<gpu::Vertex> vertices;
  Slice<uint32_t> indices;
};
struct Check : Words {
  Slice<uint32_t> fault_words;
};

// The levels over the triangles: the levels over 4, 64, .. triangles stand behind the levels over
// 16, 256, ..
gpu::PyramidPush first_levels(const Hierarchy& h) {
  return {.from = 0, .count = h.face_count, .quads = pyramid_size(h.face_count), .sixteens = 0};
}

// The levels above the ones that the triangles' kernel wrote, of 256 triangles a box, 65,536, ... A
// small B has none, since the last workgroup of that kernel writes them all; otherwise they go on
// until a run holds a level.
void record_pyramid(Recorder& rec, const Hierarchy& h) {
  gpu::PyramidPush push = first_levels(h);
  while (push.count > gpu::kRun * gpu::kRun) {
    const uint32_t count = over(push.count, gpu::kPyramidFan);
    push = {.from = push.sixteens + count,
            .count = over(push.count, gpu::kRun),
            .quads = push.quads + over(push.count, 4) + over(count, 4),
            .sixteens = push.sixteens + count + over(push.count, gpu::kRun)};
    rec.run<k::BvhPyramid>(Level{h, push}, Items{push.count});
  }
}

// Computes all boxes of the nodes from the triangles, the boxes over runs of them, and the
// topology.
void record_boxes(Recorder& rec, const Hierarchy& h) {
  record_pyramid(rec, h);
  rec.run<k::BvhRefit>(Refit{h,
                             {.count = h.face_count,
                              .ranked = h.ranked ? 1u : 0u,
                              .quads = pyramid_size(h.face_count)}},
                       Items{4 * (std::max(h.face_count, 2u) - 1)});
}

// Finds the nodes' places, which a refit does not change.
void record_ranks(Recorder& rec, const Hierarchy& h, const Slice<uint32_t>& next_rank) {
  rec.fill(next_rank, 1);
  rec.run<k::BvhRank>(Ranked{h, {h.face_count}, next_rank}, Items{h.face_count - 1});
}

Words words_of(const VkhMesh& mesh) {
  const bool is_16bit = mesh.indexType == VK_INDEX_TYPE_UINT16;
  const VkDeviceSize index_bytes = 3ull * mesh.faceCount * (is_16bit ? 2 : 4);
  const VkDeviceSize vertex_bytes =
      static_cast<VkDeviceSize>(mesh.vertexCount - 1) * mesh.vertexStride + 12;
  const AlignedRange high = align(mesh.vertexBuffer, mesh.vertexOffset, vertex_bytes);
  const bool has_low = mesh.vertexLowBuffer != VK_NULL_HANDLE;
  const AlignedRange low =
      has_low ? align(mesh.vertexLowBuffer, mesh.vertexLowOffset, vertex_bytes) : high;
  const AlignedRange indices = align(mesh.indexBuffer, mesh.indexOffset, index_bytes);
  const gpu::LoadPush push{.vertex_word = high.skip / 4,
                           .stride_words = mesh.vertexStride / 4,
                           .vertex_count = mesh.vertexCount,
                           .index_half = indices.skip / 2,
                           .index_count = 3 * mesh.faceCount,
                           .index_is_16bit = is_16bit ? 1u : 0u,
                           .has_low = has_low ? 1u : 0u,
                           .low_word = low.skip / 4,
                           .fault_word = 0};
  return {push, high.words, indices.words, low.words};
}

// Stores in the BVH whether B is a valid mesh, at a build or a refit.
void record_fault(Recorder& rec, const VkhMesh& b, const Hierarchy& h) {
  rec.fill(h.fault, layout_fault(b), Order::kIndependent);
  record_check(rec, b, h.fault, 0);
}

}  // namespace

uint32_t layout_fault(const VkhMesh& m) {
  const bool is_16bit = m.indexType == VK_INDEX_TYPE_UINT16;
  const bool has_buffers = m.vertexBuffer != VK_NULL_HANDLE && m.indexBuffer != VK_NULL_HANDLE;
  const bool has_vertices = m.vertexCount >= 1 && m.vertexCount <= gpu::kMaxTriangles &&
                            m.vertexStride >= 12 && m.vertexStride % 4 == 0 &&
                            uint64_t{m.vertexCount} * m.vertexStride <= kMostVertexBytes &&
                            m.vertexOffset % 4 == 0 && m.vertexLowOffset % 4 == 0;
  const bool has_faces = m.faceCount >= 1 && m.faceCount <= gpu::kMaxTriangles &&
                         (is_16bit || m.indexType == VK_INDEX_TYPE_UINT32) &&
                         m.indexOffset % (is_16bit ? 2 : 4) == 0;
  return has_buffers && has_vertices && has_faces ? gpu::kNone : gpu::kFaultLayout;
}

void record_check(Recorder& rec, const VkhMesh& mesh, const Slice<uint32_t>& words, uint32_t word) {
  if (!rec.checks_input() || layout_fault(mesh) != gpu::kNone) return;
  Check check{words_of(mesh), words};
  check.push.fault_word = word;
  rec.run<k::MeshCheck>(check, Items{3 * mesh.faceCount});
}

void record_load(Recorder& rec, const VkhMesh& mesh, const Slice<gpu::Vertex>& vertices,
                 const Slice<gpu::uvec3>& faces) {
  if (layout_fault(mesh) != gpu::kNone) {
    rec.fill(vertices, 0);
    rec.fill(faces, 0, Order::kIndependent);
    return;
  }
  rec.run<k::MeshLoad>(Load{words_of(mesh), vertices, as<uint32_t>(faces)},
                       Items{std::max(mesh.vertexCount, 3 * mesh.faceCount)});
}

void record_build(Recorder& rec, const VkhMesh& b, const BuildScratch& s, const Hierarchy& h) {
  const auto scope = rec.scope("hierarchy");
  const Items faces{b.faceCount};
  const uint32_t first_bit = b.faceCount <= gpu::kFewFaces ? gpu::kFewFacesFirstBit : 0;
  const uint32_t side = sort_side(first_bit);
  record_load(rec, b, h.vertices, h.faces);
  rec.fill(h.box, 0xffffffffu, Order::kIndependent);
  record_fault(rec, b, h);
  const uint32_t block =
      record_empty_counts(rec, s.sort, b.faceCount, first_bit, Order::kIndependent);
  const Keys unsorted{
      h, {b.faceCount, block, first_bit}, s.sort.keys[side], s.sort.values[side], s.sort.counts};
  const Sorted sorted{h, first_levels(h), s.sort.keys[0], s.sort.values[0]};
  rec.run<k::BvhBox>(Count{h, {b.faceCount}}, Items{over(b.faceCount, gpu::kBoxFaces)});
  rec.run<k::BvhMorton>(unsorted, faces);
  rec.stage("morton");
  record_sort(rec, s.sort, b.faceCount, first_bit, block > 0 ? Counted::kYes : Counted::kNo);
  rec.stage("sort");
  rec.run<k::BvhLeaves>(sorted, faces);
  rec.run<k::BvhHierarchy>(SortedCount{h, {b.faceCount}, sorted.keys}, faces, Order::kIndependent);
  if (h.ranked) record_ranks(rec, h, s.sort.count);
  record_boxes(rec, h);
  rec.stage("hierarchy");
}

void record_refit(Recorder& rec, const VkhMesh& b, const Hierarchy& h) {
  const auto scope = rec.scope("refit");
  record_load(rec, b, h.vertices, h.faces);
  record_fault(rec, b, h);
  rec.run<k::BvhMove>(Level{h, first_levels(h)}, Items{b.faceCount});
  record_boxes(rec, h);
  rec.stage("refit");
}

}  // namespace vkh
