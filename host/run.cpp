#include "host/run.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstring>
#include <string>
#include <tuple>

#include "host/error.h"

namespace vkh {
namespace {

constexpr VkBufferUsageFlags kWorking =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
// Waves of the first submission: enough for most pairs on a GPU; on a CPU one wave can take
// seconds.
constexpr uint32_t kFirstWaves = 6;
constexpr uint32_t kFirstWavesOnCpu = 2;
// Later submissions aim at this long, so that budgets and Ctrl-C are heard. An empty wave costs an
// H200 17 us, another report 22: so the second submission is short, and long runs get longer ones.
constexpr double kSubmissionMs = 100;
constexpr uint32_t kSecondWaves = 2;
constexpr uint32_t kMostWaves = 8;

uint32_t next_waves(uint32_t submissions, uint32_t last, double last_ms) {
  const double per_wave = std::max(last_ms / last, 1e-3);
  const uint32_t most = std::min(kSecondWaves << std::min(submissions - 1, 2u), kMostWaves);
  return static_cast<uint32_t>(
      std::clamp(kSubmissionMs / per_wave, 1.0, static_cast<double>(most)));
}

double now_ms() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

// Room for the next, somewhat larger mesh: a driver takes tenths of milliseconds to allocate.
VkDeviceSize roomy(VkDeviceSize bytes) {
  constexpr VkDeviceSize kLargest = VkDeviceSize{64} << 20;
  return bytes > kLargest ? bytes : std::bit_ceil(bytes);
}

VkDeviceSize aligned(VkDeviceSize bytes) { return (bytes + 255) / 256 * 256; }

void check_engine(VkhResult result, const char* what) {
  if (result == VKH_SUCCESS) return;
  const char* reason = result == VKH_ERROR_TOO_LARGE ? "too large for the device's buffer bindings"
                       : result == VKH_ERROR_UNSUPPORTED ? "the device is not supported"
                                                         : "the driver refused a pipeline";
  throw DeviceError(std::string(what) + ": " + reason);
}

// High parts, low parts, faces, one after the other.
struct MeshBytes {
  VkDeviceSize vertices, faces;
  explicit MeshBytes(const Mesh& m)
      : vertices(aligned(m.vertices.size() * 12)), faces(aligned(m.faces.size() * 12)) {}
  VkDeviceSize total() const { return 2 * vertices + faces; }
};

VkhMesh view(VkBuffer buffer, VkDeviceSize offset, const MeshData& m) {
  const MeshBytes bytes(*m.mesh);
  return {.vertexBuffer = buffer,
          .vertexOffset = offset,
          .vertexStride = 12,
          .vertexCount = static_cast<uint32_t>(m.mesh->vertices.size()),
          .indexBuffer = buffer,
          .indexOffset = offset + 2 * bytes.vertices,
          .indexType = VK_INDEX_TYPE_UINT32,
          .faceCount = static_cast<uint32_t>(m.mesh->faces.size()),
          .vertexLowBuffer = m.stored->has_low ? buffer : VK_NULL_HANDLE,
          .vertexLowOffset = offset + bytes.vertices};
}

void write(std::byte* to, const MeshData& m) {
  const MeshBytes bytes(*m.mesh);
  const auto& [high, low] = std::tie(m.stored->high, m.stored->low);
  std::memcpy(to, high.data(), high.size() * sizeof(float));
  std::memcpy(to + bytes.vertices, low.data(), low.size() * sizeof(float));
  std::memcpy(to + 2 * bytes.vertices, m.mesh->faces.data(),
              m.mesh->faces.size() * sizeof(m.mesh->faces[0]));
}

// Makes what one stage wrote visible to the next: copies before and after the engine's commands.
void full_barrier(const VulkanApi& vk, VkCommandBuffer commands, VkPipelineStageFlags to) {
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  vk.CmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, to, 0, 1, &barrier, 0,
                        nullptr, 0, nullptr);
}

}  // namespace

uint32_t default_switches(const Device& device) {
  const bool is_cpu = device.description().type == "cpu";
  return is_cpu ? VKH_SWITCH_DEFAULT_CPU : VKH_SWITCH_DEFAULT;
}

Runner::Runner(const Device& device, const std::filesystem::path& cache_folder)
    : device_(device),
      cache_(device, cache_folder),
      submitter_(device),
      names_(Submitter::kTimestamps) {}

VkhContext Runner::context_for(uint32_t switches) {
  const auto known = contexts_.find(switches);
  if (known != contexts_.end()) return known->second.get();
  const VkhContextCreateInfo info{device_.engine_info(), cache_.handle(), switches};
  VkhContext context = nullptr;
  check_engine(vkhCreateContext(&info, &context), "creating the pipelines");
  cache_.save();
  contexts_.emplace(switches, ContextHandle(context, vkhDestroyContext));
  return context;
}

VkhHierarchyRequirements Runner::hierarchy_requirements() const {
  VkhHierarchyRequirements needed{};
  check_engine(
      vkhGetHierarchyRequirements(context_, mesh_b_.vertexCount, mesh_b_.faceCount, &needed),
      "mesh B");
  return needed;
}

// Either may be missing.
void Runner::upload(const MeshData& a, const MeshData& b) {
  const VkDeviceSize bytes_a = a.mesh != nullptr ? MeshBytes(*a.mesh).total() : 0;
  const VkDeviceSize bytes_b = b.mesh != nullptr ? MeshBytes(*b.mesh).total() : 0;
  uploaded_bytes_ = bytes_a + bytes_b;
  grow(staging_, device_, roomy(uploaded_bytes_), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
       Placement::kUpload);
  grow(meshes_, device_, roomy(uploaded_bytes_), kWorking, Placement::kDevice);
  if (bytes_a > 0) write(staging_.mapped(), a);
  if (bytes_a > 0) problem_.a = view(meshes_.handle(), 0, a);
  if (bytes_b > 0) write(staging_.mapped() + bytes_a, b);
  if (bytes_b > 0) mesh_b_ = view(meshes_.handle(), bytes_a, b);
}

// Where B's hierarchy is or will be built; returns the scratch that building needs.
VkDeviceSize Runner::place_b(const RunInput& in) {
  if (in.resident != nullptr) {
    const ResidentMesh& b = *in.resident;
    problem_.b = {{b.hierarchy.handle(), 0, b.hierarchy.size()}, b.face_count, b.vertex_count};
    return 0;
  }
  const VkhHierarchyRequirements needed = hierarchy_requirements();
  grow(hierarchy_, device_, roomy(needed.hierarchySize), kWorking, Placement::kDevice);
  problem_.b = {
      {hierarchy_.handle(), 0, hierarchy_.size()}, mesh_b_.faceCount, mesh_b_.vertexCount};
  return needed.scratchSize;
}

void Runner::place(const RunInput& in, RunOutput& out) {
  VkhWorkspaceRequirements workspace{};
  check_engine(vkhGetWorkspaceRequirements(context_, problem_.a.vertexCount, problem_.a.faceCount,
                                           &workspace),
               "mesh A");
  VkDeviceSize bytes = in.memory_bytes == 0 ? workspace.recommended : in.memory_bytes;
  bytes = std::clamp(bytes, workspace.minimum, workspace.maximum);
  out.workspace_bytes = bytes;
  const VkDeviceSize scratch = place_b(in);
  grow(workspace_, device_, std::max(bytes, scratch), kWorking, Placement::kDevice);
  grow(report_, device_, sizeof(VkhReport), kWorking, Placement::kDevice);
  grow(readback_, device_, sizeof(VkhReport), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
       Placement::kReadback);
  problem_.workspace = {workspace_.handle(), 0, bytes};
  problem_.cullTolerance = in.cull_tolerance;
  problem_.knownLower = in.known_lower;
  problem_.sortFrom = in.sort_from;
  problem_.twoFloat = in.two_float ? VK_TRUE : VK_FALSE;
  place_areas(in, out);
  scratch_ = {workspace_.handle(), 0, workspace_.size()};
}

void Runner::place_areas(const RunInput& in, RunOutput& out) {
  problem_.coverageBuffer = VK_NULL_HANDLE;
  if (!in.coverage) return;
  out.areas.resize(2 * in.a.mesh->faces.size());
  const VkDeviceSize bytes = out.areas.size() * sizeof(uint64_t);
  grow(areas_, device_, bytes, kWorking, Placement::kDevice);
  grow(areas_readback_, device_, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kReadback);
  problem_.coverageBuffer = areas_.handle();
}

VkCommandBuffer Runner::begin() {
  const VkCommandBuffer commands = submitter_.begin();
  profile_ = {submitter_.timestamps(), Submitter::kTimestamps, 0, names_.data()};
  return commands;
}

void Runner::record_upload(VkCommandBuffer commands) {
  const VkBufferCopy copy{0, 0, uploaded_bytes_};
  device_.vk().CmdCopyBuffer(commands, staging_.handle(), meshes_.handle(), 1, &copy);
  full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
}

// A timestamp, where the library writes none.
void Runner::stamp(VkCommandBuffer commands, const char* name) {
  if (stage_times_ || !device_.has_timestamps()) return;
  device_.vk().CmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, profile_.pool,
                                 profile_.count);
  names_[profile_.count++] = name;
}

ResidentMesh Runner::build(const MeshData& b) {
  // A hierarchy is the same whatever the switches: it is built with pipelines that runs need too.
  context_ = context_for(default_switches(device_));
  upload({}, b);
  const VkhHierarchyRequirements needed = hierarchy_requirements();
  ResidentMesh resident{Buffer(device_, needed.hierarchySize, kWorking, Placement::kDevice),
                        mesh_b_.vertexCount, mesh_b_.faceCount};
  grow(workspace_, device_, needed.scratchSize, kWorking, Placement::kDevice);
  VkhHierarchy hierarchy{{resident.hierarchy.handle(), 0, resident.hierarchy.size()}, 0, 0};
  const VkhMemory scratch{workspace_.handle(), 0, workspace_.size()};
  const VkCommandBuffer commands = begin();
  record_upload(commands);
  vkhCmdBuildHierarchy(context_, commands, &mesh_b_, &hierarchy, &scratch, nullptr);
  submitter_.submit_and_wait({});
  return resident;
}

void Runner::record_start(VkCommandBuffer commands, const RunInput& in) {
  record_upload(commands);
  stamp(commands, nullptr);
  if (in.resident == nullptr) {
    vkhCmdBuildHierarchy(context_, commands, &mesh_b_, &problem_.b, &scratch_, profile());
    stamp(commands, "hierarchy");
  }
  vkhCmdBegin(context_, commands, &problem_, profile());
}

void Runner::submit(RunOutput& out) {
  submitter_.submit_and_wait({});
  std::memcpy(&out.report, readback_.mapped(), sizeof(out.report));
  if (!out.areas.empty()) {
    std::memcpy(out.areas.data(), areas_readback_.mapped(), out.areas.size() * sizeof(uint64_t));
  }
  const std::vector<double> ms = submitter_.read_timestamps(profile_.count);
  for (uint32_t i = 1; i < profile_.count; ++i) {
    if (names_[i] != nullptr) out.stages.push_back({names_[i], ms[i] - ms[i - 1]});
  }
}

RunOutput Runner::run(const RunInput& in) {
  RunOutput out;
  context_ = context_for(in.switches);
  stage_times_ = in.stage_times;
  const double start = now_ms();
  upload(in.a, in.resident != nullptr ? MeshData{} : in.b);
  place(in, out);
  out.upload_ms = now_ms() - start;
  bool wanted = true;
  uint32_t waves = device_.description().type == "cpu" ? kFirstWavesOnCpu : kFirstWaves;
  uint32_t submissions = 0;
  const uint32_t limit = std::max(in.wave_limit, 1u);
  do {
    const bool first = submissions == 0;
    if (!in.multiwave) waves = 1;
    // Exactly the budget: how they are grouped depends on the clock, the result must not.
    waves = std::min(waves, limit - out.report.waves);
    const double submitted = now_ms();
    const VkCommandBuffer commands = begin();
    if (first) {
      record_start(commands, in);
    } else {
      stamp(commands, nullptr);
    }
    vkhCmdAdvance(context_, commands, &problem_, first ? waves - 1 : waves, profile());
    vkhCmdWriteReport(context_, commands, &problem_, report_.handle(), 0, profile());
    stamp(commands, "solve");
    full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_TRANSFER_BIT);
    const VkBufferCopy copy{0, 0, sizeof(VkhReport)};
    device_.vk().CmdCopyBuffer(commands, report_.handle(), readback_.handle(), 1, &copy);
    if (in.coverage) {
      const VkBufferCopy areas{0, 0, out.areas.size() * sizeof(uint64_t)};
      device_.vk().CmdCopyBuffer(commands, areas_.handle(), areas_readback_.handle(), 1, &areas);
    }
    full_barrier(device_.vk(), commands, VK_PIPELINE_STAGE_HOST_BIT);
    submit(out);
    waves = next_waves(++submissions, waves, now_ms() - submitted);
    wanted = in.advanced(out.report);
  } while (wanted && out.report.waves < limit && out.report.status == VKH_STATUS_RUNNING);
  return out;
}

}  // namespace vkh
