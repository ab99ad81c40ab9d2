#include "engine/checks.h"

#ifndef NDEBUG
#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "engine/workspace.h"

namespace vkh {
namespace {

// The rule is a part of the expression, so that assert prints it.
#define VKH_RULE(rule, holds) assert((rule) && (holds))

bool is_index_type(VkIndexType type) {
  return type == VK_INDEX_TYPE_UINT16 || type == VK_INDEX_TYPE_UINT32;
}

bool is_count(uint32_t count) { return count >= 1 && count <= gpu::kMaxTriangles; }

void check_memory(const VkhMemory& memory) {
  VKH_RULE("VkhMemory::buffer: not null", memory.buffer != VK_NULL_HANDLE);
  VKH_RULE("VkhMemory::offset: a multiple of 256 bytes", memory.offset % 256 == 0);
}

bool overlaps_any(const VkhMemory& memory, const VkhHierarchy& hierarchy) {
  const auto with_it = [&](const VkhMemory& range) { return overlap(memory, range); };
  return with_it(hierarchy.memory) ||
         std::any_of(std::begin(hierarchy.more), std::end(hierarchy.more), with_it);
}

void check_ranges(const VkhHierarchy& hierarchy, const StreamSizes& needed) {
  for (uint32_t i = 0; i < needed.range_count; ++i) {
    const VkhMemory& range = i == 0 ? hierarchy.memory : hierarchy.more[i - 1];
    check_memory(range);
    VKH_RULE(
        "VkhHierarchy::memory and ::more: VkhHierarchyRequirements::rangeCount ranges, each "
        "of its bytes",
        range.size >= needed.ranges[i]);
  }
}

void check_mesh(const VkhMesh& m) {
  VKH_RULE("VkhMesh::vertexBuffer: not null", m.vertexBuffer != VK_NULL_HANDLE);
  VKH_RULE("VkhMesh::vertexOffset: a multiple of 4 bytes", m.vertexOffset % 4 == 0);
  VKH_RULE("VkhMesh::vertexStride: a multiple of 4 bytes", m.vertexStride % 4 == 0);
  VKH_RULE("VkhMesh::vertexStride: at least 12 bytes", m.vertexStride >= 12);
  VKH_RULE("VkhMesh::vertexCount: 1 to 2^28", is_count(m.vertexCount));
  VKH_RULE("VkhMesh::vertexCount * vertexStride: at most 8 GiB",
           uint64_t{m.vertexCount} * m.vertexStride <= kMostVertexBytes);
  VKH_RULE("VkhMesh::indexBuffer: not null", m.indexBuffer != VK_NULL_HANDLE);
  VKH_RULE("VkhMesh::indexType: VK_INDEX_TYPE_UINT16 or _UINT32", is_index_type(m.indexType));
  VKH_RULE("VkhMesh::indexOffset: a multiple of an index's size",
           m.indexOffset % (m.indexType == VK_INDEX_TYPE_UINT16 ? 2 : 4) == 0);
  VKH_RULE("VkhMesh::faceCount: 1 to 2^28", is_count(m.faceCount));
  VKH_RULE("VkhMesh::vertexLowOffset: a multiple of 4 bytes", m.vertexLowOffset % 4 == 0);
}

}  // namespace

void check_build(const Limits& limits, const VkhMesh& mesh, const VkhHierarchy& hierarchy,
                 const VkhMemory* scratch) {
  check_mesh(mesh);
  check_ranges(hierarchy, hierarchy_size(limits, mesh.vertexCount, mesh.faceCount));
  if (scratch == nullptr) {
    VKH_RULE("vkhCmdRefitHierarchy: a mesh with the counts of the build",
             hierarchy.vertexCount == mesh.vertexCount && hierarchy.faceCount == mesh.faceCount);
    return;
  }
  check_memory(*scratch);
  VKH_RULE("scratch: at least scratchSize bytes",
           scratch->size >= scratch_size(mesh.faceCount).all);
  VKH_RULE("scratch and hierarchy: apart", !overlaps_any(*scratch, hierarchy));
}

void check_begin(const VkhProblem& p) {
  const VkhRunOptions& o = p.options;
  check_mesh(p.a);
  VKH_RULE("VkhRunOptions::cullTolerance: at least 0", o.cullTolerance >= 0);
  VKH_RULE("VkhRunOptions::knownLower: at least 0", o.knownLower >= 0);
  VKH_RULE("VkhRunOptions::limit: at least 0", o.limit >= 0);
  VKH_RULE("VkhRunOptions::limitUp: 0 or at least limit", o.limitUp == 0 || o.limitUp >= o.limit);
}

void check_task(const VkhTask& task) {
  VKH_RULE("VkhTask::size: sizeof(VkhTask)", task.size == sizeof(VkhTask));
}

void check_problem(const VkhContext_T& context, const VkhProblem& p) {
  VKH_RULE("VkhRunOptions::size: sizeof(VkhRunOptions)", p.options.size == sizeof(VkhRunOptions));
  VKH_RULE("VkhMesh::vertexCount: 1 to 2^28", is_count(p.a.vertexCount));
  VKH_RULE("VkhMesh::faceCount: 1 to 2^28", is_count(p.a.faceCount));
  VKH_RULE("VkhProblem::b: a hierarchy that was built",
           is_count(p.b.faceCount) && is_count(p.b.vertexCount));
  check_ranges(p.b, hierarchy_size(context.limits, p.b.vertexCount, p.b.faceCount));
  check_memory(p.workspace);
  VKH_RULE("VkhProblem::workspace: at least VkhWorkspaceRequirements::minimum bytes",
           p.workspace.size >= workspace_size(p.a.vertexCount, p.a.faceCount, kSmallestCapacity,
                                              context.limits.switches));
  VKH_RULE("VkhProblem::workspace and ::b: apart", !overlaps_any(p.workspace, p.b));
  const bool covers = gpu::covers_area(context.limits.switches, context.limits.wide);
  VKH_RULE(
      "VkhRunOptions::coverageBuffer: with a context of VKH_CONTEXT_COVERAGE, and with no other",
      (p.options.coverageBuffer != VK_NULL_HANDLE) == covers);
  VKH_RULE("VkhRunOptions::coverageOffset: a multiple of 256 bytes",
           p.options.coverageOffset % 256 == 0);
}

void check_move(const VkhProblem& p, const VkhMemory& to) {
  check_memory(to);
  const bool stays = to.buffer == p.workspace.buffer && to.offset == p.workspace.offset;
  VKH_RULE("vkhCmdMoveRun: the run's own workspace, or one apart from it",
           stays || !overlap(to, p.workspace));
  VKH_RULE("vkhCmdMoveRun: a workspace apart from VkhProblem::b", !overlaps_any(to, p.b));
  VKH_RULE("vkhCmdMoveRun: at least as large as the run's workspace",
           stays ? to.size == p.workspace.size : to.size >= p.workspace.size);
}

void check_report(VkBuffer buffer, VkDeviceSize offset) {
  VKH_RULE("vkhCmdWriteReport: a buffer that is not null", buffer != VK_NULL_HANDLE);
  VKH_RULE("vkhCmdWriteReport: an offset that is a multiple of 256 bytes", offset % 256 == 0);
}

void check_statistics(VkBuffer buffer, VkDeviceSize offset) {
  VKH_RULE("vkhCmdWriteStatistics: a buffer that is not null", buffer != VK_NULL_HANDLE);
  VKH_RULE("vkhCmdWriteStatistics: an offset that is a multiple of 4 bytes", offset % 4 == 0);
}

void check_cells(const VkhContext_T& context, const VkhProblem& p, const VkhCells& cells) {
  VKH_RULE("vkhCmdBoundCells: a context of VKH_CONTEXT_CELLS",
           gpu::bounds_cells(context.limits.switches, context.limits.wide));
  VKH_RULE("VkhCells::count: at least 1", cells.count >= 1);
  VKH_RULE("VkhCells::count: no more than A has faces",
           cells.cellBuffer != VK_NULL_HANDLE ||
               (cells.first < p.a.faceCount && cells.count <= p.a.faceCount - cells.first));
  VKH_RULE("VkhCells::boundsBuffer: not null", cells.boundsBuffer != VK_NULL_HANDLE);
  VKH_RULE("VkhCells::cellOffset, boundsOffset: multiples of 256 bytes",
           cells.cellOffset % 256 == 0 && cells.boundsOffset % 256 == 0);
}

void check_closest(const VkhContext_T& context, const VkhHierarchy& b,
                   const VkhClosestQuery& query) {
  VKH_RULE("vkhCmdFindClosest: a context of VKH_CONTEXT_CLOSEST",
           gpu::finds_closest(context.limits.switches, context.limits.wide));
  VKH_RULE("vkhCmdFindClosest: a hierarchy that was built",
           is_count(b.faceCount) && is_count(b.vertexCount));
  check_ranges(b, hierarchy_size(context.limits, b.vertexCount, b.faceCount));
  VKH_RULE("VkhClosestQuery::count: at least 1", query.count >= 1);
  VKH_RULE("VkhClosestQuery::pointBuffer, closestBuffer: not null",
           query.pointBuffer != VK_NULL_HANDLE && query.closestBuffer != VK_NULL_HANDLE);
  VKH_RULE("VkhClosestQuery::pointOffset, closestOffset: multiples of 256 bytes",
           query.pointOffset % 256 == 0 && query.closestOffset % 256 == 0);
}

void check_profile(const VkhProfile* profile) {
  if (profile == nullptr) return;
  VKH_RULE("VkhProfile::names: not null", profile->names != nullptr);
  VKH_RULE("VkhProfile::count: at most capacity", profile->count <= profile->capacity);
}

}  // namespace vkh
#endif
