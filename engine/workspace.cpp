#include "engine/workspace.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>

namespace vkh {
namespace {

// The largest value that minStorageBufferOffsetAlignment may have.
constexpr VkDeviceSize kAlignment = 256;

using Ranges = std::array<VkhMemory, VKH_MAX_RANGES>;

// Hands out one stream after the other; without buffers it only adds up. A stream that does not fit
// an allocation goes to the next range. A stream that is larger than any allocation has a range to
// itself, and the streams after it go to the next one.
class Suballocator {
 public:
  explicit Suballocator(const Ranges& memory) : memory_(memory) {}
  Suballocator(const Ranges& memory, const Limits& limits)
      : memory_(memory), by_address_(limits.by_address), allocation_(limits.allocation) {}

  // A stream that must be bound.
  template <class T>
  void operator()(Slice<T>& slice, uint64_t count) {
    take(slice, count);
    largest_ = std::max(largest_, slice.size);
  }
  // A stream that may be given by address (engine/by_address.h).
  template <class T>
  void large(Slice<T>& slice, uint64_t count) {
    take(slice, count);
    if (!by_address_) largest_ = std::max(largest_, slice.size);
  }
  VkDeviceSize used() const { return std::reduce(used_.begin(), used_.end()); }
  StreamSizes sizes() const { return {used(), largest_, range_ + 1, used_}; }

 private:
  template <class T>
  void take(Slice<T>& slice, uint64_t count) {
    const VkDeviceSize size = std::max<uint64_t>(count, 1) * sizeof(T);
    const bool fits = used_[range_] == 0 || used_[range_] + size <= allocation_;
    if (!fits && range_ + 1 < used_.size()) ++range_;
    slice = {memory_[range_].buffer, memory_[range_].offset + used_[range_], size};
    used_[range_] += (size + kAlignment - 1) / kAlignment * kAlignment;
  }

  Ranges memory_;
  bool by_address_ = false;
  VkDeviceSize allocation_ = ~VkDeviceSize{0};
  uint32_t range_ = 0;
  std::array<VkDeviceSize, VKH_MAX_RANGES> used_{};
  VkDeviceSize largest_ = 0;
};

// Whether the nodes are ranked. If the nodes of all of B's branches fit 128 MiB, which any device
// can bind, every branch has one: to give the nodes their places takes a dispatch. Whether a B is
// ranked depends on the device's limits alone.
constexpr VkDeviceSize kMostUnranked = VkDeviceSize{128} << 20;

bool is_ranked(const Limits& limits, uint32_t face_count) {
  const VkDeviceSize most = std::min(limits.storage_range, kMostUnranked);
  return (std::max(face_count, 2u) - 1) * sizeof(gpu::Node) > most;
}

// Places for nodes. Proof for ranked ones, of at most n triangles: let f(n) be the most branches at
// even depth that are no leaf, of a tree whose root is at even depth, g(n) where it is at odd
// depth. f(n) = g(n) = 0 up to n = 4; else, for some a + b = n, f(n) = 1 + g(a) + g(b), g(n) = f(a)
// + f(b). Then f(n) <= (n - 3) / 2 and g(n) <= (n - 4) / 2 from n = 5 on, by induction: where both
// have 5 or more, f(n) <= 1 + (n - 8) / 2, g(n) <= (n - 6) / 2; where one has fewer, f(n) <= 1 + (n
// - 1 - 4) / 2, g(n) <= (n - 1 - 3) / 2.
uint32_t nodes_of(uint32_t face_count, bool ranked) {
  return ranked ? face_count / 2 : std::max(face_count, 2u) - 1;
}

void list(Suballocator& take, Hierarchy& h, uint32_t vertex_count, uint32_t face_count) {
  take.large(h.branches, std::max(face_count, 2u) - 1);
  take.large(h.nodes, nodes_of(face_count, h.ranked));
  take(h.ranks, h.ranked ? face_count - 1 : 1);
  take.large(h.boxes, pyramid_size(face_count) + quads_size(face_count));
  take.large(h.triangles, face_count);
  take.large(h.triangle_lows, face_count);
  take(h.codes, face_count);
  take(h.box, 1);
  take.large(h.vertices, vertex_count);
  take.large(h.faces, face_count);
  take(h.groups_done, 1);
  take(h.fault, 1);
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

// The parameters of a workspace's layout, besides its meshes.
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
  take.large(w.vertices, vertex_count);
  take.large(w.faces, face_count);
  take(w.vertex_nearest, vertex_count);
  take(w.vertex_distance, vertex_count);
  take(w.face_shared, face_count);
  take(w.frontier, frontier_places(capacity, room.switches));
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

void list(Suballocator& take, SurveyStreams& s, uint32_t face_count, uint32_t capacity) {
  take(s.weights, face_count);
  take(s.faces_reached, face_count);
  take(s.face_errors, face_count);
  take(s.cells, capacity);
  take(s.bounds, capacity);
  take(s.classes, capacity);
  take(s.near_corners, capacity);
  take(s.agreements, capacity);
  take(s.keys, capacity);
  take(s.parents, survey_parents(capacity));
  take(s.blocks, capacity / gpu::kSurveyBlock + 1);
  take(s.histogram, gpu::kScoreBins);
  take(s.plan, 1);
  take(s.table, 1);
  take(s.wave, 1);
}

// The same as kMaySplitTwice of shaders/wave/split_counts.glsl.
bool may_split_twice(uint32_t switches) {
  return (switches & (gpu::kUseSplitTwice | gpu::kUseFilter | gpu::kUsePacket)) ==
         gpu::kUseSplitTwice;
}

}  // namespace

uint64_t frontier_places(uint64_t capacity, uint32_t switches) {
  const bool has_subroots = gpu::has_subroots(switches, false);
  return 2 * capacity + (has_subroots ? std::min<uint64_t>(capacity / 4, gpu::kMostSubroots) : 0);
}

uint32_t sort_rows(uint32_t count) {
  constexpr uint32_t most_passes = 4;  // if blocks are few, each has counts of its own
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

StreamSizes hierarchy_size(const Limits& limits, uint32_t vertex_count, uint32_t face_count) {
  Suballocator count({}, limits);
  Hierarchy h;
  h.ranked = is_ranked(limits, face_count);
  list(count, h, vertex_count, face_count);
  return count.sizes();
}

StreamSizes scratch_size(uint32_t face_count) {
  Suballocator count(Ranges{});
  BuildScratch s;
  list(count, s, face_count);
  return count.sizes();
}

VkDeviceSize workspace_size(uint32_t vertex_count, uint32_t face_count, uint32_t capacity,
                            uint32_t switches) {
  Suballocator count(Ranges{});
  Workspace w;
  list(count, w, vertex_count, face_count, {capacity, switches});
  return count.used();
}

uint32_t largest_capacity(const Limits& limits) {
  const VkDeviceSize places = limits.storage_range / sizeof(gpu::Candidate);
  VkDeviceSize reach = places / 2;
  // Subroots stand behind the halves: a quarter of one half, or kMostSubroots, whichever is less.
  if (gpu::has_subroots(limits.switches, limits.wide)) {
    constexpr VkDeviceSize most = gpu::kMostSubroots;
    reach = std::max(4 * places / 9, places > most ? (places - most) / 2 : 0);
  }
  return static_cast<uint32_t>(std::min<VkDeviceSize>(reach, 1u << 28));
}

// A frontier is refined whole while four times its length fits; few pairs of meshes hold more than
// 2^18 candidates at once, and a mesh of few faces holds at most some thousand per face.
uint32_t recommended_capacity(uint32_t face_count) {
  constexpr uint32_t kOfFace = 1u << 12, kOfPair = 1u << 20;
  return std::max(5 * face_count, kOfFace * std::min(face_count, kOfPair / kOfFace));
}

// The first waves refine all of A's faces, as four children each, and twice as many. Measured on
// lavapipe with tools/bench/workspace_bench.cpp: 3.2 places a face cost balls 1.25 times the time,
// 12 places none.
//   A GPU splits up to kSplitTwiceParents candidates twice, which takes 20 places each
// (shaders/wave/room.glsl). Without that room a small pair takes up to twice as many waves, and
// waves are most of its time. Few faces may hold more candidates than faces: 80 faces of a coarse
// ball against a fine one hold 1,052. By waves, --gpu-profile: 20,480 places cost that pair 1.2
// times the waves and balls of 1,280 faces 1.57 times; 28,672 cost neither more waves.
uint32_t compact_capacity(const Limits& limits, uint32_t face_count) {
  constexpr uint32_t kOfFew = 512, kFew = 64, kOfFace = 24;
  constexpr uint32_t kMostFaces = (20 * gpu::kSplitTwiceParents + 1024) / kOfFace;
  const uint32_t once = 8 * face_count + 1024;
  const uint32_t twice = std::max(kOfFew * std::min(face_count, kFew),  //
                                  kOfFace * std::min(face_count, kMostFaces));
  const uint32_t wanted = may_split_twice(limits.switches) ? std::max(once, twice) : once;
  return std::min(wanted, recommended_capacity(face_count));
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

VkDeviceSize survey_size(uint32_t face_count, uint32_t capacity) {
  Suballocator count(Ranges{});
  SurveyStreams s;
  list(count, s, face_count, capacity);
  return count.used();
}

uint32_t largest_survey(const Limits& limits) {
  const VkDeviceSize most = limits.storage_range / sizeof(gpu::CellBounds);
  return static_cast<uint32_t>(std::min<VkDeviceSize>(most, gpu::kMaxTriangles));
}

SurveyStreams view_survey(const VkhSurvey& survey, uint32_t face_count) {
  Suballocator take(Ranges{survey.memory});
  SurveyStreams s;
  list(take, s, face_count, survey.capacity);
  return s;
}

Hierarchy view_hierarchy(const VkhHierarchy& hierarchy, const Limits& limits) {
  Ranges ranges{hierarchy.memory};
  std::copy(std::begin(hierarchy.more), std::end(hierarchy.more), ranges.begin() + 1);
  Suballocator take(ranges, limits);
  Hierarchy h;
  h.ranked = is_ranked(limits, hierarchy.faceCount);
  list(take, h, hierarchy.vertexCount, hierarchy.faceCount);
  return h;
}

BuildScratch view_scratch(const VkhMemory& memory, uint32_t face_count) {
  Suballocator take(Ranges{memory});
  BuildScratch s;
  list(take, s, face_count);
  return s;
}

Workspace view_workspace(const VkhMemory& memory, const Limits& limits, uint32_t vertex_count,
                         uint32_t face_count) {
  Suballocator take(Ranges{memory});
  Workspace w;
  list(take, w, vertex_count, face_count,
       {capacity_for(limits, vertex_count, face_count, memory.size), limits.switches});
  return w;
}

}  // namespace vkh
