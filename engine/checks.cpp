#include "engine/checks.h"

#include <algorithm>
#include <cassert>
#include <cfloat>
#include <cmath>
#include <iterator>

#include "engine/workspace.h"

namespace vkh {
namespace {

// Looks at a rule unless one before it is broken. The rule is a part of the asserted expression, so
// that assert prints it.
#define VKH_RULE(rule, holds)                        \
  do {                                               \
    if (!kept_) break;                               \
    const bool holds_now = (holds);                  \
    assert(is_reporting() || ((rule) && holds_now)); \
    if (!holds_now) broken(rule);                    \
  } while (false)

bool is_index_type(VkIndexType type) {
  return type == VK_INDEX_TYPE_UINT16 || type == VK_INDEX_TYPE_UINT32;
}

bool is_count(uint32_t count) { return count >= 1 && count <= gpu::kMaxTriangles; }

bool overlaps_any(const VkhMemory& memory, const VkhHierarchy& hierarchy) {
  const auto with_it = [&](const VkhMemory& range) { return overlap(memory, range); };
  return with_it(hierarchy.memory) ||
         std::any_of(std::begin(hierarchy.more), std::end(hierarchy.more), with_it);
}

}  // namespace

void Misuses::add(VkCommandBuffer commands, const char* rule) {
  if (callback_ != nullptr) callback_(user_, commands, rule);
  const std::lock_guard lock(mutex_);
  commands_.insert(commands);
}

bool Misuses::has(VkCommandBuffer commands) {
  const std::lock_guard lock(mutex_);
  return commands_.contains(commands);
}

void Misuses::forget(VkCommandBuffer commands) {
  const std::lock_guard lock(mutex_);
  commands_.erase(commands);
}

bool Rules::are_checked() const {
#ifdef NDEBUG
  return is_reporting();
#else
  return true;
#endif
}

void Rules::broken(const char* rule) {
  kept_ = false;
  if (is_reporting()) context_.misuses->add(commands_, rule);
}

bool Rules::pointers(const char* rule, bool are_given) {
  if (is_reporting() && !are_given) broken(rule);
  return kept_;
}

void Rules::memory(const VkhMemory& memory) {
  VKH_RULE("VkhMemory::buffer: not null", memory.buffer != VK_NULL_HANDLE);
  VKH_RULE("VkhMemory::offset: a multiple of 256 bytes", memory.offset % 256 == 0);
}

void Rules::ranges(const VkhHierarchy& hierarchy, const StreamSizes& needed) {
  for (uint32_t i = 0; i < needed.range_count; ++i) {
    const VkhMemory& range = i == 0 ? hierarchy.memory : hierarchy.more[i - 1];
    memory(range);
    VKH_RULE(
        "VkhHierarchy::memory and ::more: VkhHierarchyRequirements::rangeCount ranges, each "
        "of its bytes",
        range.size >= needed.ranges[i]);
  }
}

void Rules::mesh(const VkhMesh& m) {
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

bool Rules::build(const VkhMesh& m, const VkhHierarchy& hierarchy, const VkhMemory* scratch) {
  if (!are_checked()) return true;
  mesh(m);
  if (!kept_) return false;
  ranges(hierarchy, hierarchy_size(context_.limits, m.vertexCount, m.faceCount));
  if (scratch == nullptr) {
    VKH_RULE("vkhCmdRefitHierarchy: a mesh with the counts of the build",
             hierarchy.vertexCount == m.vertexCount && hierarchy.faceCount == m.faceCount);
    return kept_;
  }
  memory(*scratch);
  VKH_RULE("scratch: at least scratchSize bytes", scratch->size >= scratch_size(m.faceCount).all);
  VKH_RULE("scratch and hierarchy: apart", !overlaps_any(*scratch, hierarchy));
  return kept_;
}

bool Rules::begin(const VkhProblem& p) {
  if (!are_checked()) return true;
  const VkhRunOptions& o = p.options;
  mesh(p.a);
  VKH_RULE("VkhRunOptions::cullTolerance: at least 0", o.cullTolerance >= 0);
  VKH_RULE("VkhRunOptions::knownLower: at least 0", o.knownLower >= 0);
  VKH_RULE("VkhRunOptions::limit: at least 0", o.limit >= 0);
  VKH_RULE("VkhRunOptions::limitUp: 0 or at least limit", o.limitUp == 0 || o.limitUp >= o.limit);
  return kept_;
}

bool Rules::task(const VkhTask& task) {
  if (!are_checked()) return true;
  VKH_RULE("VkhTask::size: sizeof(VkhTask)", task.size == sizeof(VkhTask));
  VKH_RULE("VkhTask::problem: not null", task.problem != nullptr);
  return kept_;
}

bool Rules::problem(const VkhProblem& p) {
  if (!are_checked()) return true;
  VKH_RULE("VkhRunOptions::size: sizeof(VkhRunOptions)", p.options.size == sizeof(VkhRunOptions));
  VKH_RULE("VkhMesh::vertexCount: 1 to 2^28", is_count(p.a.vertexCount));
  VKH_RULE("VkhMesh::faceCount: 1 to 2^28", is_count(p.a.faceCount));
  VKH_RULE("VkhProblem::b: a hierarchy that was built",
           is_count(p.b.faceCount) && is_count(p.b.vertexCount));
  if (!kept_) return false;
  ranges(p.b, hierarchy_size(context_.limits, p.b.vertexCount, p.b.faceCount));
  memory(p.workspace);
  VKH_RULE("VkhProblem::workspace: at least VkhWorkspaceRequirements::minimum bytes",
           p.workspace.size >= workspace_size(p.a.vertexCount, p.a.faceCount, kSmallestCapacity,
                                              context_.limits.switches));
  VKH_RULE("VkhProblem::workspace and ::b: apart", !overlaps_any(p.workspace, p.b));
  const bool covers = gpu::covers_area(context_.limits.switches, context_.limits.wide);
  VKH_RULE(
      "VkhRunOptions::coverageBuffer: with a context of VKH_CONTEXT_COVERAGE, and with no other",
      (p.options.coverageBuffer != VK_NULL_HANDLE) == covers);
  VKH_RULE("VkhRunOptions::coverageOffset: a multiple of 256 bytes",
           p.options.coverageOffset % 256 == 0);
  return kept_;
}

bool Rules::move(const VkhProblem& p, const VkhMemory& to) {
  if (!are_checked()) return true;
  memory(to);
  const bool stays = to.buffer == p.workspace.buffer && to.offset == p.workspace.offset;
  VKH_RULE("vkhCmdMoveRun: the run's own workspace, or one apart from it",
           stays || !overlap(to, p.workspace));
  VKH_RULE("vkhCmdMoveRun: a workspace apart from VkhProblem::b", !overlaps_any(to, p.b));
  VKH_RULE("vkhCmdMoveRun: at least as large as the run's workspace",
           stays ? to.size == p.workspace.size : to.size >= p.workspace.size);
  return kept_;
}

bool Rules::report(VkBuffer buffer, VkDeviceSize offset) {
  if (!are_checked()) return true;
  VKH_RULE("vkhCmdWriteReport: a buffer that is not null", buffer != VK_NULL_HANDLE);
  VKH_RULE("vkhCmdWriteReport: an offset that is a multiple of 256 bytes", offset % 256 == 0);
  return kept_;
}

bool Rules::statistics(VkBuffer buffer, VkDeviceSize offset) {
  if (!are_checked()) return true;
  VKH_RULE("vkhCmdWriteStatistics: a buffer that is not null", buffer != VK_NULL_HANDLE);
  VKH_RULE("vkhCmdWriteStatistics: an offset that is a multiple of 4 bytes", offset % 4 == 0);
  return kept_;
}

bool Rules::cells(const VkhProblem& p, const VkhCells& cells) {
  if (!are_checked()) return true;
  VKH_RULE("vkhCmdBoundCells: a context of VKH_CONTEXT_CELLS",
           gpu::bounds_cells(context_.limits.switches, context_.limits.wide));
  VKH_RULE("VkhCells::count: at least 1", cells.count >= 1);
  VKH_RULE("VkhCells::count: no more than A has faces",
           cells.cellBuffer != VK_NULL_HANDLE ||
               (cells.first < p.a.faceCount && cells.count <= p.a.faceCount - cells.first));
  VKH_RULE("VkhCells::boundsBuffer: not null", cells.boundsBuffer != VK_NULL_HANDLE);
  VKH_RULE("VkhCells::cellOffset, boundsOffset: multiples of 256 bytes",
           cells.cellOffset % 256 == 0 && cells.boundsOffset % 256 == 0);
  return kept_;
}

bool Rules::survey(const VkhProblem& p, const VkhSurvey& survey, uint64_t cells) {
  if (!problem(p) || !are_checked()) return kept_;
  VKH_RULE("a survey: a context of VKH_CONTEXT_CELLS",
           gpu::bounds_cells(context_.limits.switches, context_.limits.wide));
  VKH_RULE("VkhSurvey::size: sizeof(VkhSurvey)", survey.size == sizeof(VkhSurvey));
  memory(survey.memory);
  VKH_RULE("VkhSurvey::capacity: at least A's faces, at most vkhGetSurveyCapacity",
           survey.capacity >= p.a.faceCount && survey.capacity <= largest_survey(context_.limits));
  VKH_RULE("VkhSurvey::memory: at least vkhGetSurveySize bytes",
           survey.memory.size >= survey_size(p.a.faceCount, survey.capacity));
  VKH_RULE("VkhSurvey::faceWidth, faceLimit: at least 0, and finite",
           survey.faceWidth >= 0 && survey.faceWidth <= FLT_MAX && survey.faceLimit >= 0 &&
               survey.faceLimit <= FLT_MAX);
  VKH_RULE("a survey: room for all cells", cells >= 1 && cells <= survey.capacity);
  return kept_;
}

bool Rules::survey_output(VkBuffer buffer, VkDeviceSize offset) {
  if (!are_checked()) return true;
  VKH_RULE("a survey's output: a buffer that is not null", buffer != VK_NULL_HANDLE);
  VKH_RULE("a survey's output: an offset that is a multiple of 4 bytes", offset % 4 == 0);
  return kept_;
}

bool Rules::closest(const VkhHierarchy& b, const VkhClosestQuery& query) {
  if (!are_checked()) return true;
  VKH_RULE("vkhCmdFindClosest: a context of VKH_CONTEXT_CLOSEST",
           gpu::finds_closest(context_.limits.switches, context_.limits.wide));
  VKH_RULE("vkhCmdFindClosest: a hierarchy that was built",
           is_count(b.faceCount) && is_count(b.vertexCount));
  if (!kept_) return false;
  ranges(b, hierarchy_size(context_.limits, b.vertexCount, b.faceCount));
  VKH_RULE("VkhClosestQuery::count: at least 1", query.count >= 1);
  VKH_RULE("VkhClosestQuery::pointBuffer, closestBuffer: not null",
           query.pointBuffer != VK_NULL_HANDLE && query.closestBuffer != VK_NULL_HANDLE);
  VKH_RULE("VkhClosestQuery::pointOffset, closestOffset: multiples of 256 bytes",
           query.pointOffset % 256 == 0 && query.closestOffset % 256 == 0);
  return kept_;
}

bool Rules::profile(const VkhProfile* profile) {
  if (!are_checked() || profile == nullptr) return kept_;
  VKH_RULE("VkhProfile::names: not null", profile->names != nullptr);
  VKH_RULE("VkhProfile::count: at most capacity", profile->count <= profile->capacity);
  return kept_;
}

}  // namespace vkh
