#include "engine/workspace.h"

#include <algorithm>
#include <limits>

namespace vkh {
namespace {

// The largest value that minStorageBufferOffsetAlignment may have.
constexpr VkDeviceSize kAlignment = 256;

// Hands out one stream after the other; without a buffer it only adds up.
class Suballocator {
 public:
  explicit Suballocator(const VkhMemory& memory) : memory_(memory) {}

  template <class T>
  void operator()(Slice<T>& slice, uint64_t count) {
    const VkDeviceSize size = std::max<uint64_t>(count, 1) * sizeof(T);
    slice = {memory_.buffer, memory_.offset + used_, size};
    used_ += (size + kAlignment - 1) / kAlignment * kAlignment;
  }
  VkDeviceSize used() const { return used_; }

 private:
  VkhMemory memory_;
  VkDeviceSize used_ = 0;
};

void list(Suballocator& take, Hierarchy& h, uint32_t vertex_count, uint32_t face_count) {
  take(h.branches, std::max(face_count, 2u) - 1);
  take(h.nodes, std::max(face_count, 2u) - 1);
  take(h.boxes, pyramid_size(face_count) + quads_size(face_count));
  take(h.triangles, face_count);
  take(h.triangle_lows, face_count);
  take(h.codes, face_count);
  take(h.box, 1);
  take(h.vertices, vertex_count);
  take(h.faces, face_count);
  take(h.groups_done, 1);
  h.face_count = face_count;
}

void list(Suballocator& take, SortStreams& s, uint32_t key_count) {
  for (int side = 0; side < 2; ++side) {
    take(s.keys[side], key_count);
    take(s.values[side], key_count);
  }
  take(s.counts, 1ull * sort_rows(key_count) * gpu::kSortDigits);
  take(s.totals, gpu::kSortDigits);
  take(s.count, 1);
}

void list(Suballocator& take, BuildScratch& s, uint32_t face_count) {
  list(take, s.sort, face_count);
}

// What a workspace is laid out by, besides its meshes.
struct Room {
  uint32_t capacity, switches;
};

void list(Suballocator& take, Workspace& w, uint32_t vertex_count, uint32_t face_count, Room room) {
  const uint32_t capacity = room.capacity;
  // Refined candidates of a wave: the plan keeps deferred + 4 parents <= capacity; split twice, 20
  // parents.
  const uint64_t parents = capacity / 4 + 1;
  take(w.control, 1);
  take(w.sizes, 1);
  take(w.vertices, vertex_count);
  take(w.faces, face_count);
  take(w.vertex_nearest, vertex_count);
  take(w.vertex_distance, vertex_count);
  take(w.face_shared, face_count);
  take(w.frontier, 2ull * capacity);
  take(w.splits, parents);
  take(w.points, 3 * parents);
  take(w.lower_bits, 1);
  take(w.groups_done, 1);
  take(w.unused, 1);
  const auto take_if = [&]<class T>(uint32_t switches, Slice<T>& slice, uint64_t count) {
    if ((room.switches & switches) != 0) {
      take(slice, count);
    } else {
      slice = as<T>(w.unused);
    }
  };
  take_if(gpu::kUseCentroid, w.centroid_nearest, 2ull * capacity);
  take_if(gpu::kUseFilter, w.survivors, capacity);
  take_if(gpu::kUseFilter, w.centroids, capacity);
  take_if(gpu::kUsePaperU3, w.u3_bounds, capacity);
  if ((room.switches & gpu::kUseSort) != 0) {
    list(take, w.sort, capacity);
  } else {
    w.sort.values[0] = w.unused;
  }
  w.capacity = capacity;
}

}  // namespace

uint32_t sort_rows(uint32_t count) {
  constexpr uint32_t most_passes = 4;  // of few blocks, each has counts of its own
  const uint32_t few = std::min(sort_blocks(count, gpu::kFewestSortRounds), gpu::kSortFewBlocks);
  return std::max(most_passes * few, sort_blocks(count, gpu::kSortRounds));
}

uint32_t pyramid_size(uint32_t face_count) {
  uint32_t boxes = 0;
  for (uint32_t level = face_count; level > 1;) {
    level = (level + gpu::kPyramidFan - 1) / gpu::kPyramidFan;
    boxes += level;
  }
  return boxes;
}

uint32_t quads_size(uint32_t face_count) {
  uint32_t boxes = 0;
  for (uint32_t level = face_count; level > 1;) {
    boxes += (level + 3) / 4;
    level = (level + gpu::kPyramidFan - 1) / gpu::kPyramidFan;
  }
  return boxes;
}

VkDeviceSize hierarchy_size(uint32_t vertex_count, uint32_t face_count) {
  Suballocator count({});
  Hierarchy h;
  list(count, h, vertex_count, face_count);
  return count.used();
}

VkDeviceSize scratch_size(uint32_t face_count) {
  Suballocator count({});
  BuildScratch s;
  list(count, s, face_count);
  return count.used();
}

VkDeviceSize workspace_size(uint32_t vertex_count, uint32_t face_count, uint32_t capacity,
                            uint32_t switches) {
  Suballocator count({});
  Workspace w;
  list(count, w, vertex_count, face_count, {capacity, switches});
  return count.used();
}

uint32_t largest_capacity(const Limits& limits) {
  const VkDeviceSize reach = limits.storage_range / (2 * sizeof(gpu::Candidate));
  return static_cast<uint32_t>(std::min<VkDeviceSize>(reach, 1u << 28));
}

// A frontier is refined whole while four times its length fits; few pairs of meshes hold more than
// 2^18 candidates at once, and few faces no more than some thousand each.
uint32_t recommended_capacity(uint32_t face_count) {
  constexpr uint32_t kOfFace = 1u << 12, kOfPair = 1u << 20;
  return std::max(5 * face_count, kOfFace * std::min(face_count, kOfPair / kOfFace));
}

uint32_t capacity_for(const Limits& limits, uint32_t vertex_count, uint32_t face_count,
                      VkDeviceSize bytes) {
  uint32_t fits = 0;
  uint32_t too_many = largest_capacity(limits) + 1;
  while (too_many - fits > 1) {
    const uint32_t middle = fits + (too_many - fits) / 2;
    const VkDeviceSize needed = workspace_size(vertex_count, face_count, middle, limits.switches);
    (needed <= bytes ? fits : too_many) = middle;
  }
  return fits;
}

Hierarchy view_hierarchy(const VkhHierarchy& hierarchy) {
  Suballocator take(hierarchy.memory);
  Hierarchy h;
  list(take, h, hierarchy.vertexCount, hierarchy.faceCount);
  return h;
}

BuildScratch view_scratch(const VkhMemory& memory, uint32_t face_count) {
  Suballocator take(memory);
  BuildScratch s;
  list(take, s, face_count);
  return s;
}

Workspace view_workspace(const VkhMemory& memory, const Limits& limits, uint32_t vertex_count,
                         uint32_t face_count) {
  Suballocator take(memory);
  Workspace w;
  list(take, w, vertex_count, face_count,
       {capacity_for(limits, vertex_count, face_count, memory.size), limits.switches});
  return w;
}

}  // namespace vkh
