// The C API: leaves the contract to the caller (engine/checks.h), translates views, calls the
// recording files.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

#include "engine/checks.h"
#include "engine/record.h"
#include "engine/support.h"
#include "engine/vkhausdorff_experimental.h"

namespace vkh {
namespace {

static_assert(sizeof(VkhReport) == sizeof(gpu::Report));
static_assert(offsetof(VkhReport, upperAbove) == offsetof(gpu::Report, upper_above));
static_assert(offsetof(VkhReport, wanted) == offsetof(gpu::Report, wanted));
static_assert(offsetof(VkhReport, witnessPosition) == offsetof(gpu::Report, witness));
static_assert(offsetof(VkhReport, witnessFaceB) == offsetof(gpu::Report, witness_face));
static_assert(offsetof(VkhReport, witnessBarycentric) == offsetof(gpu::Report, witness_j));
static_assert(offsetof(VkhReport, witnessBarycentricLow) == offsetof(gpu::Report, witness_low_j));
#define VKH_SAME_SWITCH(constant, bit, api, name) static_assert(VKH_SWITCH_##api == gpu::constant);
VKH_SWITCHES(VKH_SAME_SWITCH)
#undef VKH_SAME_SWITCH
#define VKH_SAME_STATUS(constant, value, api) static_assert(VKH_STATUS_##api == gpu::constant);
VKH_STATUSES(VKH_SAME_STATUS)
#undef VKH_SAME_STATUS
static_assert(VKH_CONTEXT_COVERAGE == gpu::kUseCoverage);
static_assert(VKH_CONTEXT_CELLS == gpu::kUseField);
static_assert(VKH_CONTEXT_FINE == gpu::kUseSubroots);
static_assert(VKH_CONTEXT_CHECK_INPUT == gpu::kUseInputCheck);
static_assert(sizeof(VkhCell) == sizeof(gpu::Cell));
static_assert(offsetof(VkhCell, start) == offsetof(gpu::Cell, start));
static_assert(sizeof(VkhCellBounds) == sizeof(gpu::CellBounds));
static_assert(offsetof(VkhCellBounds, squareUpper) == offsetof(gpu::CellBounds, square_upper));
static_assert(offsetof(VkhCellBounds, faceB) == offsetof(gpu::CellBounds, face));
static_assert(offsetof(VkhCellBounds, start) == offsetof(gpu::CellBounds, triangle));
static_assert(sizeof(VkhPoint) == sizeof(gpu::Vertex));
static_assert(offsetof(VkhPoint, low) == offsetof(gpu::Vertex, lo));
static_assert(sizeof(VkhClosestFace) == sizeof(gpu::ClosestFace));
static_assert(offsetof(VkhClosestFace, face) == offsetof(gpu::ClosestFace, face));
static_assert(VKH_CONTEXT_CLOSEST == gpu::kUseClosest);
static_assert(VKH_SWITCH_UNCERTIFIED == gpu::kUseUncertified);
static_assert(VKH_MAX_WAVE_RECORDS == gpu::kMaxWaveRecords && VKH_MAX_CULLS == gpu::kMostCulls);
static_assert(gpu::kCullCount <= gpu::kMostCulls);

// The flags that kernels see, as bits beside the switches; and all flags.
constexpr uint32_t kKernelFlags = VKH_CONTEXT_COVERAGE | VKH_CONTEXT_CELLS | VKH_CONTEXT_FINE |
                                  VKH_CONTEXT_CHECK_INPUT | VKH_CONTEXT_CLOSEST;
constexpr uint32_t kFlags = kKernelFlags | VKH_CONTEXT_BY_ADDRESS | VKH_CONTEXT_CHECK_CALLS;

bool is_known(const VkhContextCreateInfo& info) {
  return info.size == sizeof(info) && (info.flags & ~kFlags) == 0 && (info.switches & kFlags) == 0;
}

// The default switches for each kind of device.
Limits chosen(const VkhContextCreateInfo& info) {
  Limits limits = device_limits(info.device);
  if (info.deviceKind != VKH_DEVICE_KIND_AUTO)
    limits.wide = info.deviceKind == VKH_DEVICE_KIND_WIDE;
  limits.by_address = (info.flags & VKH_CONTEXT_BY_ADDRESS) != 0;
  limits.switches = info.switches & ~uint32_t{VKH_SWITCH_NONE};
  if (info.switches == 0)
    limits.switches = limits.wide ? VKH_SWITCH_DEFAULT_WIDE : VKH_SWITCH_DEFAULT_NARROW;
  limits.switches |= info.flags & kKernelFlags;
  return limits;
}

Threads threads_of(const VkhContextCreateInfo& info) {
  return {.most = info.threads, .run = info.parallelFor, .user = info.parallelUser};
}

bool load_functions(const VkhDeviceInfo& info, const Limits& limits, DeviceFunctions& vk) {
  const auto get_device_proc = reinterpret_cast<PFN_vkGetDeviceProcAddr>(
      info.getInstanceProcAddr(info.instance, "vkGetDeviceProcAddr"));
  if (get_device_proc == nullptr) return false;
  bool complete = true;
#define VKH_LOAD(name)                                                                \
  vk.name = reinterpret_cast<PFN_vk##name>(get_device_proc(info.device, "vk" #name)); \
  complete = complete && vk.name != nullptr;
  VKH_DEVICE_FUNCTIONS(VKH_LOAD)
  if (limits.pushes) {
    VKH_PUSH_FUNCTIONS(VKH_LOAD)
  } else {
    VKH_SET_FUNCTIONS(VKH_LOAD)
  }
  if (limits.by_address) {
    VKH_ADDRESS_FUNCTIONS(VKH_LOAD)
  }
#undef VKH_LOAD
#define VKH_LOAD(name)                                                                      \
  vk.name = reinterpret_cast<PFN_vk##name>(get_device_proc(info.device, "vk" #name "KHR")); \
  if (vk.name == nullptr)                                                                   \
    vk.name = reinterpret_cast<PFN_vk##name>(get_device_proc(info.device, "vk" #name));     \
  complete = complete && vk.name != nullptr;
  VKH_PROMOTED_FUNCTIONS(VKH_LOAD)
#undef VKH_LOAD
  // Asks the instance: a layer may return the device's functions even though the extension is not
  // enabled.
#define VKH_LOAD(name) \
  vk.name = reinterpret_cast<PFN_vk##name>(info.getInstanceProcAddr(info.instance, "vk" #name));
  VKH_OPTIONAL_FUNCTIONS(VKH_LOAD)
#undef VKH_LOAD
  return complete;
}

bool counts_fit(uint32_t vertex_count, uint32_t face_count) {
  return vertex_count >= 1 && face_count >= 1 && vertex_count <= gpu::kMaxTriangles &&
         face_count <= gpu::kMaxTriangles;
}

// Returns 0 for NaN, too: a run does more work then, and its interval still holds.
float not_negative(float x) { return x > 0 ? x : 0; }

// Leaves a B that was not built without counts.
Hierarchy view_built(const VkhContext_T& context, VkhHierarchy b) {
  if (!counts_fit(b.vertexCount, b.faceCount)) b.vertexCount = b.faceCount = 0;
  return view_hierarchy(b, context.limits);
}

// Returns a run's options with wrong values replaced: 0 for a negative number or a NaN, and no
// pause if the workspace cannot grow, since such a run would wait forever.
VkhRunOptions checked(VkhRunOptions options, bool can_grow) {
  for (float* x : {&options.cullTolerance, &options.knownLower, &options.limit, &options.limitUp})
    *x = not_negative(*x);
  if (!can_grow) options.pauseWhenFull = VK_FALSE;
  if (options.sortFrom == 0) options.sortFrom = gpu::kSortFrom;
  return options;
}

// Replaces counts that no mesh has by those of a mesh of one face, or of a B that was not built:
// such a run records only a report of VKH_STATUS_INPUT.
Problem view_problem(const VkhContext_T& context, const VkhProblem& p) {
  const bool has_options = p.options.size == sizeof(VkhRunOptions);
  const VkhRunOptions options = has_options ? p.options : VkhRunOptions{};
  const bool has_a = has_options && counts_fit(p.a.vertexCount, p.a.faceCount);
  const uint32_t vertex_count = has_a ? p.a.vertexCount : 1, face_count = has_a ? p.a.faceCount : 1;
  const Workspace ws = view_workspace(p.workspace, context.limits, vertex_count, face_count);
  const bool can_grow = ws.capacity < largest_capacity(context.limits);
  return {.vertex_count = vertex_count,
          .face_count = face_count,
          .options = checked(options, can_grow),
          .switches = context.limits.switches,
          .wide = context.limits.wide,
          .has_a = has_a,
          .input_fault = layout_fault(p.a),
          .b = view_built(context, p.b),
          .ws = ws,
          .areas = {options.coverageBuffer, options.coverageOffset,
                    2 * sizeof(gpu::Area) * face_count}};
}

// Sets the counts of the BVH, before anything reads them. A mesh without faces or vertices
// leaves it as one that was not built.
void record_hierarchy(Recorder& rec, Rules& rules, const VkhMesh& mesh, VkhHierarchy& hierarchy,
                      const VkhMemory& scratch) {
  if (!rules.build(mesh, hierarchy, &scratch)) return;
  const bool fits = counts_fit(mesh.vertexCount, mesh.faceCount);
  hierarchy.faceCount = fits ? mesh.faceCount : 0;
  hierarchy.vertexCount = fits ? mesh.vertexCount : 0;
  if (!fits) return;
  record_build(rec, mesh, view_scratch(scratch, mesh.faceCount),
               view_hierarchy(hierarchy, rules.context().limits));
}

void record_any_refit(Recorder& rec, Rules& rules, const VkhMesh& mesh,
                      const VkhHierarchy& hierarchy) {
  if (!rules.build(mesh, hierarchy, nullptr)) return;
  if (!counts_fit(hierarchy.vertexCount, hierarchy.faceCount)) return;  // a run's report shows it
  const Hierarchy h = view_hierarchy(hierarchy, rules.context().limits);
  if (mesh.vertexCount == hierarchy.vertexCount && mesh.faceCount == hierarchy.faceCount) {
    record_refit(rec, mesh, h);
  } else {
    rec.fill(h.fault, gpu::kFaultLayout);  // the BVH has no room for another mesh
  }
}

// A BVH that was copied before its build has no counts: the run has no B, and its report shows it.
bool is_built(const Problem& p) { return p.has_a && p.b.face_count > 0; }

// `p`: a view of `problem`.
void record_begin(Recorder& rec, const VkhProblem& problem, const Problem& p) {
  if (!is_built(p)) return;
  // Without twoFloat, B is measured by its high parts alone: A must be, too.
  VkhMesh a = problem.a;
  if (problem.options.twoFloat == VK_FALSE) a.vertexLowBuffer = VK_NULL_HANDLE;
  record_load(rec, a, p.ws.vertices, p.ws.faces);
  record_seed(rec, p);
  record_check(rec, a, as<uint32_t>(p.ws.control), offsetof(gpu::Control, input_fault) / 4);
  if (p.areas.buffer != VK_NULL_HANDLE) rec.fill(p.areas, 0);
  record_first_wave(rec, p);
}

void record_waves(Recorder& rec, const Problem& p, uint32_t waves) {
  if (!is_built(p)) return;
  for (uint32_t wave = 0; wave < waves; ++wave) record_wave(rec, p);
}

Slice<gpu::Report> report_at(VkBuffer buffer, VkDeviceSize offset) {
  return {buffer, offset, sizeof(VkhReport)};
}

// The words of the statistics.
Slice<uint32_t> statistics_at(VkBuffer buffer, VkDeviceSize offset) {
  return {buffer, offset, sizeof(VkhStatistics)};
}

// `order`: of the first command.
void record_any_statistics(Recorder& rec, const Problem& p, const Slice<uint32_t>& to,
                           Order order) {
  if (is_built(p)) {
    record_statistics(rec, p, to, order);
  } else {
    rec.fill(to, 0, order);
  }
}

void record_any_report(Recorder& rec, const Problem& p, const Slice<gpu::Report>& report) {
  if (is_built(p)) {
    record_report(rec, p, report);
  } else {
    record_unbuilt_report(rec, p, report);
  }
}

bool keeps_rules(Rules& rules, const VkhTask& task) {
  const VkhProblem& problem = *task.problem;
  return rules.problem(problem) && (task.begin == VK_FALSE || rules.begin(problem)) &&
         (task.reportBuffer == VK_NULL_HANDLE ||
          rules.report(task.reportBuffer, task.reportOffset)) &&
         (task.statisticsBuffer == VK_NULL_HANDLE ||
          rules.statistics(task.statisticsBuffer, task.statisticsOffset));
}

void record_output(Recorder& rec, const Problem& p, const VkhTask& task) {
  if (task.reportBuffer != VK_NULL_HANDLE)
    record_any_report(rec, p, report_at(task.reportBuffer, task.reportOffset));
  if (task.statisticsBuffer == VK_NULL_HANDLE) return;
  // A report does not change what is copied, so no barrier is needed after it.
  const Order order = task.reportBuffer != VK_NULL_HANDLE ? Order::kIndependent : Order::kAfterAll;
  record_any_statistics(rec, p, statistics_at(task.statisticsBuffer, task.statisticsOffset), order);
}

void record_task(Recorder& rec, Rules rules, const VkhTask& task) {
  if (!rules.task(task) || task.size != sizeof(VkhTask)) return;
  VkhProblem& problem = *task.problem;
  if (task.mesh != nullptr && task.scratch != nullptr) {
    record_hierarchy(rec, rules, *task.mesh, problem.b, *task.scratch);
  } else if (task.mesh != nullptr) {
    record_any_refit(rec, rules, *task.mesh, problem.b);
  }
  if (!keeps_rules(rules, task)) return;
  const Problem p = view_problem(rules.context(), problem);
  if (task.begin != VK_FALSE) record_begin(rec, problem, p);
  record_waves(rec, p, task.waves);
  record_output(rec, p, task);
}

// Returns false if the host has no memory to keep the commands in.
bool record_in_step(Recorder& together, const Rules& rules, const VkhTask* tasks, uint32_t count) {
  std::vector<Track> tracks;
  try {
    tracks.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
      Recorder rec(rules.context(), tracks[i]);
      record_task(rec, rules, tasks[i]);
    }
    together.put_in_step(tracks);
  } catch (...) {  // no exception may cross a C interface; nothing has been written yet
    return false;
  }
  return true;
}

// A call of a survey: its rules, and the problem and the streams that it works on. `cells`: the
// number of cells, now or afterwards; 0: as many as A has faces.
struct SurveyCall {
  SurveyCall(VkhContext context, VkCommandBuffer commands, const VkhProblem* problem,
             const VkhSurvey* survey, uint64_t cells = 0)
      : rules(*context, commands) {
    if (!VKH_POINTERS(rules, "a survey: problem and survey: not null",
                      problem != nullptr && survey != nullptr) ||
        !rules.survey(*problem, *survey, std::max<uint64_t>(cells, problem->a.faceCount)) ||
        !gpu::bounds_cells(context->limits.switches, context->limits.wide) ||
        survey->size != sizeof(VkhSurvey))
      return;
    p = view_problem(*context, *problem);
    streams = view_survey(*survey, p.face_count);
    is_kept = true;
  }

  bool records() const { return is_kept && is_built(p); }

  Rules rules;
  bool is_kept = false;
  Problem p;
  SurveyStreams streams;
};

// Bytes of the largest stream that must be bound and grows with A; the areas, which are not in the
// workspace, count too.
VkDeviceSize largest_of_a(const Limits& limits, uint32_t vertex_count, uint32_t face_count) {
  const bool has_areas = !limits.by_address || gpu::covers_area(limits.switches, limits.wide);
  const VkDeviceSize of_vertex = limits.by_address ? sizeof(uint32_t) : sizeof(gpu::Vertex);
  const VkDeviceSize of_face = has_areas ? 2 * sizeof(gpu::Area) : sizeof(uint32_t);
  return std::max(of_vertex * vertex_count, of_face * face_count);
}

// Whether `to` is the run's own range, or apart from it and at least as large.
bool can_move(const VkhProblem& p, const VkhMemory& to) {
  const bool stays = to.buffer == p.workspace.buffer && to.offset == p.workspace.offset;
  if (stays) return to.size == p.workspace.size;
  return to.size >= p.workspace.size && !overlap(to, p.workspace);
}

}  // namespace
}  // namespace vkh

VkhResult vkhCreateContext(const VkhContextCreateInfo* info, VkhContext* context) {
  *context = nullptr;
  if (!vkh::is_known(*info)) return VKH_ERROR_MISUSE;
  if (vkhQuerySupport(&info->device, nullptr, 0) != VKH_SUCCESS) return VKH_ERROR_UNSUPPORTED;
  try {
    auto created = std::make_unique<VkhContext_T>();
    created->device = info->device.device;
    created->limits = vkh::chosen(*info);
    if (created->limits.by_address && !vkh::has_addresses(info->device))
      return VKH_ERROR_UNSUPPORTED;
    if (!vkh::load_functions(info->device, created->limits, created->vk))
      return VKH_ERROR_NOT_ENABLED;
    if ((info->flags & VKH_CONTEXT_CHECK_CALLS) != 0)
      created->misuses = std::make_shared<vkh::Misuses>(info->onMisuse, info->misuseUser);
    if (!created->limits.pushes) created->sets = std::make_shared<vkh::SetStore>(*created);
    if (vkh::create_kernels(*created, info->pipelineCache, vkh::threads_of(*info)) != VK_SUCCESS) {
      vkh::destroy_kernels(*created);
      return VKH_ERROR_PIPELINE;
    }
    *context = created.release();
    return VKH_SUCCESS;
  } catch (...) {  // no exception may cross a C interface: out of host memory
    return VKH_ERROR_PIPELINE;
  }
}

void vkhDestroyContext(VkhContext context) {
  if (context == nullptr) return;
  vkh::destroy_kernels(*context);
  delete context;
}

VkhResult vkhGetRecordingResult(VkhContext context, VkCommandBuffer commandBuffer) {
  if (context->misuses != nullptr && context->misuses->has(commandBuffer)) return VKH_ERROR_MISUSE;
  const bool complete = context->sets == nullptr || context->sets->is_complete(commandBuffer);
  return complete ? VKH_SUCCESS : VKH_ERROR_MEMORY;
}

void vkhReleaseCommandBuffer(VkhContext context, VkCommandBuffer commandBuffer) {
  if (context->sets != nullptr) context->sets->release(commandBuffer);
  if (context->misuses != nullptr) context->misuses->forget(commandBuffer);
}

VkhResult vkhGetHierarchyRequirements(VkhContext context, uint32_t vertexCount, uint32_t faceCount,
                                      VkhHierarchyRequirements* requirements) {
  if (!vkh::counts_fit(vertexCount, faceCount)) return VKH_ERROR_TOO_LARGE;
  const vkh::Limits& limits = context->limits;
  const vkh::StreamSizes hierarchy = vkh::hierarchy_size(limits, vertexCount, faceCount);
  const vkh::StreamSizes scratch = vkh::scratch_size(faceCount);
  if (std::max(hierarchy.largest, scratch.largest) > limits.storage_range)
    return VKH_ERROR_TOO_LARGE;
  *requirements = {hierarchy.all, scratch.all, hierarchy.range_count, {}};
  std::copy(hierarchy.ranges.begin(), hierarchy.ranges.end(), requirements->ranges);
  return VKH_SUCCESS;
}

VkhResult vkhGetWorkspaceRequirements(VkhContext context, uint32_t vertexCount, uint32_t faceCount,
                                      VkhWorkspaceRequirements* requirements) {
  if (!vkh::counts_fit(vertexCount, faceCount) ||
      vkh::largest_of_a(context->limits, vertexCount, faceCount) > context->limits.storage_range)
    return VKH_ERROR_TOO_LARGE;
  const uint32_t largest = vkh::largest_capacity(context->limits);
  const uint32_t recommended = std::min(largest, vkh::recommended_capacity(faceCount));
  const uint32_t compact = std::min(largest, vkh::compact_capacity(context->limits, faceCount));
  const auto workspace_size = [&](uint32_t capacity) {
    return vkh::workspace_size(vertexCount, faceCount, capacity, context->limits.switches);
  };
  *requirements = {workspace_size(vkh::kSmallestCapacity), workspace_size(compact),
                   workspace_size(recommended), workspace_size(largest)};
  return VKH_SUCCESS;
}

VkDeviceSize vkhGetWorkspaceSize(VkhContext context, uint32_t vertexCount, uint32_t faceCount,
                                 uint32_t candidates) {
  const uint32_t capacity =
      std::clamp(candidates, vkh::kSmallestCapacity, vkh::largest_capacity(context->limits));
  return vkh::workspace_size(vertexCount, faceCount, capacity, context->limits.switches);
}

// Vulkan's own commands have six parameters, too.
// NOLINTNEXTLINE(readability-function-size)
void vkhCmdBuildHierarchy(VkhContext context, VkCommandBuffer commandBuffer, const VkhMesh* mesh,
                          VkhHierarchy* hierarchy, const VkhMemory* scratch, VkhProfile* profile) {
  vkh::Rules rules(*context, commandBuffer);
  if (!VKH_POINTERS(rules, "vkhCmdBuildHierarchy: mesh, hierarchy and scratch: not null",
                    mesh != nullptr && hierarchy != nullptr && scratch != nullptr) ||
      !rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  vkh::record_hierarchy(rec, rules, *mesh, *hierarchy, *scratch);
}

void vkhCmdRefitHierarchy(VkhContext context, VkCommandBuffer commandBuffer, const VkhMesh* mesh,
                          const VkhHierarchy* hierarchy, VkhProfile* profile) {
  vkh::Rules rules(*context, commandBuffer);
  if (!VKH_POINTERS(rules, "vkhCmdRefitHierarchy: mesh and hierarchy: not null",
                    mesh != nullptr && hierarchy != nullptr) ||
      !rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  vkh::record_any_refit(rec, rules, *mesh, *hierarchy);
}

void vkhCmdBegin(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                 VkhProfile* profile) {
  vkh::Rules rules(*context, commandBuffer);
  if (!VKH_POINTERS(rules, "vkhCmdBegin: problem: not null", problem != nullptr) ||
      !rules.problem(*problem) || !rules.begin(*problem) || !rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  vkh::record_begin(rec, *problem, vkh::view_problem(*context, *problem));
}

void vkhCmdAdvance(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                   uint32_t waves, VkhProfile* profile) {
  vkh::Rules rules(*context, commandBuffer);
  if (!VKH_POINTERS(rules, "vkhCmdAdvance: problem: not null", problem != nullptr) ||
      !rules.problem(*problem) || !rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  vkh::record_waves(rec, vkh::view_problem(*context, *problem), waves);
}

void vkhCmdMoveRun(VkhContext context, VkCommandBuffer commandBuffer, VkhProblem* problem,
                   const VkhMemory* workspace, VkhProfile* profile) {
  vkh::Rules rules(*context, commandBuffer);
  if (!VKH_POINTERS(rules, "vkhCmdMoveRun: problem and workspace: not null",
                    problem != nullptr && workspace != nullptr) ||
      !rules.move(*problem, *workspace) || !rules.problem(*problem) || !rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  const vkh::Problem from = vkh::view_problem(*context, *problem);
  if (!vkh::can_move(*problem, *workspace)) return;
  problem->workspace = *workspace;
  if (!vkh::is_built(from)) return;
  vkh::record_move(rec, from, vkh::view_problem(*context, *problem));
}

// NOLINTNEXTLINE(readability-function-size)
void vkhCmdWriteReport(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                       VkBuffer buffer, VkDeviceSize offset, VkhProfile* profile) {
  vkh::Rules rules(*context, commandBuffer);
  if (!VKH_POINTERS(rules, "vkhCmdWriteReport: problem: not null", problem != nullptr) ||
      !rules.problem(*problem) || !rules.report(buffer, offset) || !rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  vkh::record_any_report(rec, vkh::view_problem(*context, *problem),
                         vkh::report_at(buffer, offset));
}

// NOLINTNEXTLINE(readability-function-size)
void vkhCmdWriteStatistics(VkhContext context, VkCommandBuffer commandBuffer,
                           const VkhProblem* problem, VkBuffer buffer, VkDeviceSize offset,
                           VkhProfile* profile) {
  vkh::Rules rules(*context, commandBuffer);
  if (!VKH_POINTERS(rules, "vkhCmdWriteStatistics: problem: not null", problem != nullptr) ||
      !rules.problem(*problem) || !rules.statistics(buffer, offset) || !rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  vkh::record_any_statistics(rec, vkh::view_problem(*context, *problem),
                             vkh::statistics_at(buffer, offset), vkh::Order::kAfterAll);
  rec.stage("statistics");
}

void vkhCmdBoundCells(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                      const VkhCells* cells, VkhProfile* profile) {
  vkh::Rules rules(*context, commandBuffer);
  if (!VKH_POINTERS(rules, "vkhCmdBoundCells: problem and cells: not null",
                    problem != nullptr && cells != nullptr) ||
      !rules.cells(*problem, *cells) || !rules.problem(*problem) || !rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  const vkh::Problem p = vkh::view_problem(*context, *problem);
  const bool has_kernel = vkh::gpu::bounds_cells(context->limits.switches, context->limits.wide);
  if (!has_kernel || cells->count == 0) return;
  vkh::record_cells(rec, p,
                    {.cells = {cells->cellBuffer, cells->cellOffset,
                               VkDeviceSize{cells->count} * sizeof(VkhCell)},
                     .bounds = {cells->boundsBuffer, cells->boundsOffset,
                                VkDeviceSize{cells->count} * sizeof(VkhCellBounds)},
                     .first = cells->first,
                     .count = cells->count,
                     .has_run = vkh::is_built(p)});
}

void vkhCmdFindClosest(VkhContext context, VkCommandBuffer commandBuffer, const VkhHierarchy* b,
                       const VkhClosestQuery* query, VkhProfile* profile) {
  vkh::Rules rules(*context, commandBuffer);
  if (!VKH_POINTERS(rules, "vkhCmdFindClosest: b and query: not null",
                    b != nullptr && query != nullptr) ||
      !rules.closest(*b, *query) || !rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  const bool has_kernel = vkh::gpu::finds_closest(context->limits.switches, context->limits.wide);
  if (!has_kernel || query->count == 0) return;
  vkh::record_closest(rec, vkh::view_built(*context, *b),
                      {.asked = {query->pointBuffer, query->pointOffset,
                                 VkDeviceSize{query->count} * sizeof(VkhPoint)},
                       .found = {query->closestBuffer, query->closestOffset,
                                 VkDeviceSize{query->count} * sizeof(VkhClosestFace)},
                       .count = query->count,
                       .two_float = query->twoFloat != VK_FALSE});
}

void vkhCmdRunTasks(VkhContext context, VkCommandBuffer commandBuffer, uint32_t taskCount,
                    const VkhTask* tasks, VkhProfile* profile) {
  vkh::Rules rules(*context, commandBuffer);
  if (!VKH_POINTERS(rules, "vkhCmdRunTasks: tasks: not null", tasks != nullptr || taskCount == 0) ||
      !rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  const auto scope = rec.scope("tasks");
  if (taskCount > 1 && vkh::record_in_step(rec, rules, tasks, taskCount)) {
    rec.stage("tasks");
    return;
  }
  for (uint32_t i = 0; i < taskCount; ++i) vkh::record_task(rec, rules, tasks[i]);
}

uint32_t vkhGetSurveyCapacity(VkhContext context) { return vkh::largest_survey(context->limits); }

VkDeviceSize vkhGetSurveySize(VkhContext, uint32_t faceCount, uint32_t capacity) {
  return vkh::survey_size(faceCount, capacity);
}

void vkhCmdBeginSurvey(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                       const VkhSurvey* survey, VkhProfile* profile) {
  vkh::SurveyCall call(context, commandBuffer, problem, survey);
  if (!call.records() || !call.rules.profile(profile)) return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  vkh::record_survey_begin(rec, call.p, call.streams);
}

// NOLINTNEXTLINE(readability-function-size)
void vkhCmdAdvanceSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                         const VkhProblem* problem, const VkhSurvey* survey, uint32_t waves,
                         VkhProfile* profile) {
  vkh::SurveyCall call(context, commandBuffer, problem, survey);
  if (!call.records() || !call.rules.profile(profile)) return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  vkh::record_survey_waves(rec, call.p, call.streams, *survey, waves);
}

// NOLINTNEXTLINE(readability-function-size)
void vkhCmdWriteSurvey(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                       const VkhSurvey* survey, VkBuffer buffer, VkDeviceSize offset,
                       VkhProfile* profile) {
  vkh::SurveyCall call(context, commandBuffer, problem, survey);
  if (!call.is_kept || !call.rules.survey_output(buffer, offset) || !call.rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  const vkh::Slice<vkh::gpu::SurveyWave> report{buffer, offset, sizeof(VkhSurveyReport)};
  if (call.records()) {
    vkh::record_survey_report(rec, call.p, call.streams, *survey, report);
  } else {
    vkh::record_unbuilt_survey_report(rec, report);
  }
}

// NOLINTNEXTLINE(readability-function-size)
void vkhCmdWriteSurveyFaces(VkhContext context, VkCommandBuffer commandBuffer,
                            const VkhProblem* problem, const VkhSurvey* survey, VkBuffer buffer,
                            VkDeviceSize offset, VkhProfile* profile) {
  vkh::SurveyCall call(context, commandBuffer, problem, survey);
  if (!call.is_kept || !call.rules.survey_output(buffer, offset) || !call.rules.profile(profile))
    return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  if (call.records()) {
    const VkhSurveyFaces all{survey->capacity, vkh::gpu::kAllClasses, vkh::gpu::kAllClasses, buffer,
                             offset};
    vkh::record_survey_faces(rec, call.p, call.streams, all);
  } else {
    vkh::record_unbuilt_faces(
        rec, {buffer, offset, 2 * sizeof(float) * VkDeviceSize{problem->a.faceCount}});
  }
}

void vkhCmdBeginSurveyCells(VkhContext context, VkCommandBuffer commandBuffer,
                            const VkhProblem* problem, const VkhSurvey* survey,
                            const VkhSurveyCells* cells) {
  const vkh::SurveyCall call(context, commandBuffer, problem, survey);
  if (!call.records()) return;
  vkh::Recorder rec(*context, commandBuffer, nullptr);
  vkh::record_survey_cells(rec, call.p, call.streams,
                           {cells->weightBuffer, cells->weightOffset, call.streams.weights.size},
                           cells->farthest);
}

void vkhCmdScoreSurvey(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                       const VkhSurvey* survey, const VkhSurveyScore* score) {
  const vkh::SurveyCall call(context, commandBuffer, problem, survey,
                             uint64_t{score->first} + score->count);
  if (!call.records()) return;
  vkh::Recorder rec(*context, commandBuffer, nullptr);
  vkh::record_survey_score(rec, call.p, call.streams, *score);
}

void vkhCmdSplitSurvey(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                       const VkhSurvey* survey, const VkhSurveySplit* split) {
  const uint64_t parents = uint64_t{split->above} + split->ties;
  const uint64_t cells = split->cells + (split->parts - 1) * parents;
  const vkh::SurveyCall call(context, commandBuffer, problem, survey, cells);
  if (!call.records() || parents > vkh::survey_parents(survey->capacity)) return;
  vkh::Recorder rec(*context, commandBuffer, nullptr);
  vkh::record_survey_split(rec, call.p, call.streams, *split);
}

// NOLINTNEXTLINE(readability-function-size)
void vkhCmdBoundSurvey(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                       const VkhSurvey* survey, const VkhSurveyBound* bound, VkhProfile* profile) {
  vkh::SurveyCall call(context, commandBuffer, problem, survey);
  if (!call.records() || !call.rules.profile(profile) || bound->count == 0) return;
  vkh::Recorder rec(*context, commandBuffer, profile);
  vkh::record_survey_bound(rec, call.p, call.streams, *bound);
}

void vkhCmdTallySurvey(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                       const VkhSurvey* survey, const VkhSurveyTally* tally) {
  const vkh::SurveyCall call(context, commandBuffer, problem, survey,
                             uint64_t{tally->first} + tally->count);
  if (!call.records()) return;
  vkh::Recorder rec(*context, commandBuffer, nullptr);
  vkh::record_survey_tally(rec, call.p, call.streams, *tally);
}

void vkhCmdFindSurveySides(VkhContext context, VkCommandBuffer commandBuffer,
                           const VkhProblem* problem, const VkhSurvey* survey,
                           const VkhSurveySides* sides) {
  const vkh::SurveyCall call(context, commandBuffer, problem, survey,
                             uint64_t{sides->first} + sides->count);
  if (!call.records() || sides->count == 0) return;
  vkh::Recorder rec(*context, commandBuffer, nullptr);
  vkh::record_survey_sides(rec, call.p, call.streams, *sides);
}

void vkhCmdFindSurveyNormals(VkhContext context, VkCommandBuffer commandBuffer,
                             const VkhProblem* problem, const VkhSurvey* survey,
                             const VkhSurveyNormals* normals) {
  const vkh::SurveyCall call(context, commandBuffer, problem, survey,
                             uint64_t{normals->first} + normals->count);
  if (!call.records() || normals->count == 0) return;
  vkh::Recorder rec(*context, commandBuffer, nullptr);
  vkh::record_survey_normals(rec, call.p, call.streams, *normals);
}

void vkhCmdFindSurveyFaces(VkhContext context, VkCommandBuffer commandBuffer,
                           const VkhProblem* problem, const VkhSurvey* survey,
                           const VkhSurveyFaces* faces) {
  const vkh::SurveyCall call(context, commandBuffer, problem, survey, faces->cells);
  if (!call.records()) return;
  vkh::Recorder rec(*context, commandBuffer, nullptr);
  vkh::record_survey_faces(rec, call.p, call.streams, *faces);
}

void vkhCmdReadSurvey(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                      const VkhSurvey* survey, const VkhSurveyRead* read) {
  const vkh::SurveyCall call(context, commandBuffer, problem, survey,
                             uint64_t{read->first} + read->count);
  if (!call.records()) return;
  vkh::Recorder rec(*context, commandBuffer, nullptr);
  vkh::record_survey_read(rec, call.streams, *read);
}

void vkhCmdNarrowSurvey(VkhContext context, VkCommandBuffer commandBuffer,
                        const VkhProblem* problem, const VkhSurvey* survey,
                        const VkhSurveyWrite* write) {
  const vkh::SurveyCall call(context, commandBuffer, problem, survey,
                             uint64_t{write->first} + write->count);
  if (!call.records()) return;
  vkh::Recorder rec(*context, commandBuffer, nullptr);
  vkh::record_survey_write(rec, call.streams, *write);
}

// NOLINTNEXTLINE(readability-function-size)
void vkhCmdMoveSurvey(VkhContext context, VkCommandBuffer commandBuffer, const VkhProblem* problem,
                      const VkhSurvey* from, const VkhSurvey* to, uint32_t cells) {
  const vkh::SurveyCall call(context, commandBuffer, problem, from, cells);
  vkh::SurveyCall target(context, commandBuffer, problem, to, cells);
  if (!call.records() || !target.records()) return;
  vkh::Recorder rec(*context, commandBuffer, nullptr);
  vkh::record_survey_move(rec, call.streams, target.streams, cells);
}
