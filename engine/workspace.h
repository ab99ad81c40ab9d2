// The caller's memory as streams. The size query and the suballocation traverse the same list, so
// that they cannot disagree: a new stream is one line in it.
#pragma once

#include <array>
#include <cstddef>

#include "engine/context.h"
#include "engine/vkhausdorff_experimental.h"
#include "shaders/stages.h"

namespace vkh {

// Limits vertices to the words that an index of 31 bits reaches.
constexpr uint64_t kMostVertexBytes = uint64_t{8} << 30;

inline bool overlap(const VkhMemory& a, const VkhMemory& b) {
  return a.buffer == b.buffer && a.offset < b.offset + b.size && b.offset < a.offset + a.size;
}

// B's BVH, kept between runs.
struct Hierarchy {
  Slice<gpu::Branch> branches;
  Slice<gpu::Node> nodes;
  Slice<uint32_t> ranks;  // of a large B: places of the branches' nodes (bvh_rank); else unused
  Slice<gpu::Box> boxes;  // of the pyramid
  Slice<gpu::Triangle> triangles;
  Slice<gpu::TriangleLow> triangle_lows;
  Slice<uint32_t> codes;  // Morton codes of the triangles, ascending, and the box that they lie in:
  Slice<gpu::CentroidBox> box;  // faces are found by them
  Slice<gpu::Vertex> vertices;  // B as given: the report's lower bound rests on these two alone
  Slice<gpu::uvec3> faces;
  Slice<uint32_t> groups_done;  // 0 between dispatches
  Slice<uint32_t> fault;  // of the mesh that it was built or refitted from: Control::input_fault
  uint32_t face_count = 0;
  bool ranked = false;
};

// The streams of a sort: keys with values, on two sides that it alternates between.
struct SortStreams {
  Slice<uint32_t> keys[2], values[2];
  Slice<uint32_t> counts, totals;
  Slice<uint32_t> count;  // one word, the number of keys if the host does not know it
};

// Workgroups that sort `count` keys, `rounds` of them per invocation.
constexpr uint32_t sort_blocks(uint32_t count, uint32_t rounds) {
  return (count + gpu::kSortGroup * rounds - 1) / (gpu::kSortGroup * rounds);
}
// Rows of counts, one per block, that any way of sorting `count` keys may take (engine/sort.cpp).
uint32_t sort_rows(uint32_t count);

// The scratch streams of a build.
struct BuildScratch {
  SortStreams sort;
};

// One run.
struct Workspace {
  Slice<gpu::Control> control;
  Slice<gpu::WaveSizes> sizes;
  Slice<gpu::Vertex> vertices;  // of A
  Slice<gpu::uvec3> faces;      // of A
  Slice<uint32_t> vertex_nearest;
  Slice<uint32_t> vertex_distance;  // floats, as bits
  Slice<uint32_t> face_shared;      // whether a face of A is also one of B
  Slice<gpu::Candidate> frontier;   // two halves of `capacity`, then the subroots
  Slice<gpu::Split> splits;
  Slice<gpu::Point> points;
  Slice<uint32_t> lower_bits;   // between reports kNone
  Slice<uint32_t> groups_done;  // 0 between dispatches
  // A stream that the switches leave out is `unused`, since a binding must not be empty.
  Slice<uint32_t> unused;
  Slice<uint32_t> centroid_nearest;  // kUseCentroid: beside the frontier
  Slice<uint32_t> survivors;         // kUseFilter
  Slice<gpu::Point> centroids;       // kUseFilter
  Slice<float> u3_bounds;            // kUsePaperU3
  SortStreams sort;                  // kUseSort; otherwise only values[0] is set
  uint32_t capacity = 0;
};

// A survey's cells, and the data that its kernels derive from them.
struct SurveyStreams {
  Slice<gpu::Wide> weights;       // of each face of A
  Slice<uint32_t> faces_reached;  // per face of A, floats as bits: some point is at least so far
  Slice<uint32_t> face_errors;    // per face of A: bounds of its error that the caller reads
  Slice<gpu::Cell> cells;
  Slice<gpu::CellBounds> bounds;             // one per cell
  Slice<gpu::CornerTriangles> near_corners;  // one per cell
  Slice<uint32_t> classes;                   // one per cell
  Slice<gpu::CellAgreement> agreements;      // one per cell
  Slice<uint32_t> keys;                      // one per cell: the bin of its score
  Slice<uint32_t> parents;                   // the places of the cells that a wave has split
  Slice<gpu::SurveyCounts> blocks;           // one per kSurveyBlock cells
  Slice<uint32_t> histogram;                 // one per bin
  Slice<gpu::SurveyPlan> plan;
  Slice<gpu::SurveyTable> table;
  Slice<gpu::SurveyWave> wave;
};
// A wave splits at most a quarter of the cells that fit.
constexpr uint32_t survey_parents(uint32_t capacity) { return capacity / 4 + 1; }
VkDeviceSize survey_size(uint32_t face_count, uint32_t capacity);
// The most cells that the device's bindings reach.
uint32_t largest_survey(const Limits& limits);
SurveyStreams view_survey(const VkhSurvey& survey, uint32_t face_count);

// One of a wave's sizes, by its member.
using WaveSize = gpu::Dispatch gpu::WaveSizes::*;
inline Slice<gpu::Dispatch> size_at(const Slice<gpu::WaveSizes>& sizes, WaveSize size) {
  static constexpr gpu::WaveSizes all{};
  const auto offset =
      reinterpret_cast<const std::byte*>(&(all.*size)) - reinterpret_cast<const std::byte*>(&all);
  return {sizes.buffer, sizes.offset + static_cast<VkDeviceSize>(offset), sizeof(gpu::Dispatch)};
}

// Bytes of the frontier's stream.
uint64_t frontier_places(uint64_t capacity, uint32_t switches);
// The number of boxes in all levels of the pyramid over `face_count` triangles.
uint32_t pyramid_size(uint32_t face_count);
// The boxes of the levels between them, over four boxes of a level each.
uint32_t quads_size(uint32_t face_count);
// Bytes of all streams, of the largest that must be bound, and of their ranges of memory: as a rule
// one.
struct StreamSizes {
  VkDeviceSize all, largest;
  uint32_t range_count;
  std::array<VkDeviceSize, VKH_MAX_RANGES> ranges;
};
StreamSizes hierarchy_size(const Limits& limits, uint32_t vertex_count, uint32_t face_count);
StreamSizes scratch_size(uint32_t face_count);
// `switches`: of the context, since some add streams.
VkDeviceSize workspace_size(uint32_t vertex_count, uint32_t face_count, uint32_t capacity,
                            uint32_t switches);

// Candidates in each half of the frontier that fit `bytes`, at most what the device's bindings
// reach; 0 if not even the fixed streams fit.
uint32_t capacity_for(const Limits& limits, uint32_t vertex_count, uint32_t face_count,
                      VkDeviceSize bytes);
uint32_t largest_capacity(const Limits& limits);
// The capacity of a small workspace that costs most runs little time: as a rule no more waves than
// the recommended one.
uint32_t compact_capacity(const Limits& limits, uint32_t face_count);
// A good capacity for a run to start with.
uint32_t recommended_capacity(uint32_t face_count);
constexpr uint32_t kSmallestCapacity = 4 * gpu::kReserve;

Hierarchy view_hierarchy(const VkhHierarchy& hierarchy, const Limits& limits);
BuildScratch view_scratch(const VkhMemory& memory, uint32_t face_count);
Workspace view_workspace(const VkhMemory& memory, const Limits& limits, uint32_t vertex_count,
                         uint32_t face_count);

}  // namespace vkh
