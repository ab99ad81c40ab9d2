#include "tests/verification/fuzz/pair_bench.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "host/gpu/vulkan_api.h"

namespace vkh::test {
namespace {

constexpr VkBufferUsageFlags kWorking =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr VkDeviceSize kWorkingBytes = VkDeviceSize{24} << 20, kMeshBytes = VkDeviceSize{16} << 10;
constexpr VkDeviceSize kMostWorkspace = VkDeviceSize{8} << 20, kGuardBytes = 256;
constexpr int kGuard = 0x5a;
constexpr uint32_t kReports = 3;

const char* environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

void check_engine(VkhResult result) {
  if (result != VKH_SUCCESS) throw std::runtime_error("the engine refused");
}

VkDeviceSize aligned(VkDeviceSize at) { return (at + 255) / 256 * 256; }

}  // namespace

// Every family of kernels: those of the CPU profile and of the GPU profile, which have surveys, of
// the paper, and all at once with coverage.
FuzzDevice::FuzzDevice(size_t context_count)
    : device_({.selector = environment("VKH_TEST_DEVICE"),
               .validation = *environment("VKH_VALIDATION") != '\0'}),
      submitter_(device_) {
  constexpr uint32_t kPaper = VKH_SWITCH_DEFAULT_NARROW | VKH_SWITCH_U4 | VKH_SWITCH_SORT |
                              VKH_SWITCH_PACKET | VKH_SWITCH_LARGEST_FIRST | VKH_SWITCH_U3_PAPER;
  struct Ways {
    uint32_t switches, flags;
    VkhDeviceKind kind;
  };
  constexpr std::array<Ways, kMostContexts> kWays = {
      {{VKH_SWITCH_DEFAULT_NARROW, VKH_CONTEXT_CELLS, VKH_DEVICE_KIND_NARROW},
       {VKH_SWITCH_DEFAULT_WIDE, VKH_CONTEXT_CELLS, VKH_DEVICE_KIND_WIDE},
       {kPaper, 0, VKH_DEVICE_KIND_WIDE},
       {VKH_SWITCH_NONE, 0, VKH_DEVICE_KIND_NARROW},
       {VKH_SWITCH_DEFAULT_WIDE, VKH_CONTEXT_COVERAGE, VKH_DEVICE_KIND_WIDE}}};
  for (size_t i = 0; i < std::min(context_count, kWays.size()); ++i) {
    const Ways& ways = kWays[i];
    VkhContextCreateInfo info{};
    info.size = sizeof(info);
    info.device = device_.engine_info();
    info.flags = ways.flags;
    info.switches = ways.switches;
    info.deviceKind = ways.kind;
    check_engine(vkhCreateContext(&info, &contexts_.emplace_back()));
  }
}

FuzzDevice::~FuzzDevice() {
  for (VkhContext context : contexts_) vkhDestroyContext(context);
}

void FuzzDevice::run(const std::function<void(VkCommandBuffer)>& record) {
  const VkCommandBuffer commands = submitter_.begin();
  record(commands);
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  device_.vk().CmdPipelineBarrier(
      commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
      VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
  submitter_.submit_and_wait({});
}

PairBench::PairBench(const FuzzDevice& device)
    : meshes_(device.device(), kMeshBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
              Placement::kReadback),
      working_(device.device(), kWorkingBytes, kWorking, Placement::kReadback) {
  std::memset(meshes_.mapped(), kGuard, kMeshBytes);
  std::memset(working_.mapped(), kGuard, kWorkingBytes);
}

VkDeviceSize PairBench::report_stride() { return aligned(sizeof(VkhReport)) + kGuardBytes; }

void PairBench::guard(VkDeviceSize begin, VkDeviceSize end) {
  std::memset(working_.mapped() + begin, kGuard, end - begin);
  guards_.emplace_back(begin, end);
}

VkhMemory PairBench::reserve(VkDeviceSize size) {
  const VkhMemory memory{working_.handle(), used_, size};
  const VkDeviceSize next = aligned(used_ + size) + kGuardBytes;
  if (next > working_.size()) throw std::runtime_error("more than a fuzzed pair may take");
  guard(used_ + size, next);
  used_ = next;
  return memory;
}

VkhMesh PairBench::put(const FuzzMesh& mesh, VkDeviceSize vertices_at, VkDeviceSize indices_at) {
  const VkDeviceSize low_at = vertices_at + kMeshBytes / 8 + mesh.low_offset;
  vertices_at += mesh.vertex_offset;
  indices_at += mesh.index_offset;
  std::byte* const to = meshes_.mapped();
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const VkDeviceSize at = VkDeviceSize{v} * mesh.stride;
    std::memcpy(to + vertices_at + at, &mesh.high[3 * size_t{v}], 12);
    std::memcpy(to + low_at + at, &mesh.low[3 * size_t{v}], 12);
  }
  const size_t width = mesh.is_16bit ? 2 : 4;
  for (size_t i = 0; i < mesh.corners.size(); ++i)
    std::memcpy(to + indices_at + i * width, &mesh.corners[i], width);
  return {.vertexBuffer = meshes_.handle(),
          .vertexOffset = vertices_at,
          .vertexStride = mesh.stride,
          .vertexCount = mesh.vertex_count(),
          .indexBuffer = meshes_.handle(),
          .indexOffset = indices_at,
          .indexType = mesh.is_16bit ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32,
          .faceCount = mesh.face_count(),
          .vertexLowBuffer = mesh.has_low ? meshes_.handle() : VK_NULL_HANDLE,
          .vertexLowOffset = mesh.has_low ? low_at : 0};
}

void PairBench::take(const FuzzPair& pair, VkhContext context, bool covers) {
  pair_ = &pair;
  guards_.clear();
  used_ = 0;
  problem = {};
  problem.a = put(pair.a, 0, kMeshBytes / 4);
  b = put(pair.b, kMeshBytes / 2, kMeshBytes * 3 / 4);
  VkhHierarchyRequirements hierarchy{};
  check_engine(vkhGetHierarchyRequirements(context, b.vertexCount, b.faceCount, &hierarchy));
  VkhWorkspaceRequirements workspace{};
  check_engine(
      vkhGetWorkspaceRequirements(context, problem.a.vertexCount, problem.a.faceCount, &workspace));
  const VkDeviceSize more = std::min(workspace.recommended, kMostWorkspace) - workspace.minimum;
  problem.b.memory = reserve(hierarchy.hierarchySize);
  problem.workspace = reserve(workspace.minimum + more * pair.workspace_percent / 100);
  scratch = reserve(hierarchy.scratchSize);
  reports_at_ = used_;
  for (uint32_t slot = 0; slot < kReports; ++slot) reserve(sizeof(VkhReport));
  problem.options.size = sizeof(problem.options);
  problem.options.cullTolerance = pair.tolerance;
  problem.options.knownLower = pair.known_lower;
  problem.options.twoFloat = pair.two_float ? VK_TRUE : VK_FALSE;
  problem.options.sortFrom = pair.sort_from;
  if (!covers) return;
  const VkhMemory coverage = reserve(VkDeviceSize{16} * problem.a.faceCount);
  coverage_at_ = coverage.offset;
  problem.options.coverageBuffer = coverage.buffer;
  problem.options.coverageOffset = coverage.offset;
}

void PairBench::move() {
  problem.a = put(pair_->later_a, 0, kMeshBytes / 4);
  b = put(pair_->later_b, kMeshBytes / 2, kMeshBytes * 3 / 4);
  problem.options.warm = pair_->warm ? VK_TRUE : VK_FALSE;
}

void PairBench::reserve_survey(VkhContext context, uint32_t cells_a_face, float face_width) {
  const uint32_t faces = problem.a.faceCount, cells = cells_a_face * faces;
  survey = {.size = sizeof(VkhSurvey),
            .memory = reserve(vkhGetSurveySize(context, faces, cells)),
            .capacity = cells,
            .faceWidth = face_width,
            .faceLimit = 0};
  for (VkDeviceSize& at : surveys_at_)
    at = reserve(sizeof(VkhSurveyReport) + 2 * faces * sizeof(float)).offset;
}

VkhSurveyReport PairBench::survey_report(uint32_t slot) const {
  VkhSurveyReport report;
  std::memcpy(&report, working_.mapped() + survey_offset(slot), sizeof(report));
  return report;
}

std::vector<float> PairBench::face_errors(uint32_t slot) const {
  std::vector<float> errors(2 * size_t{problem.a.faceCount});
  std::memcpy(errors.data(), working_.mapped() + survey_offset(slot) + sizeof(VkhSurveyReport),
              errors.size() * sizeof(float));
  return errors;
}

VkhReport PairBench::report(uint32_t slot) const {
  VkhReport report;
  std::memcpy(&report, working_.mapped() + report_offset(slot), sizeof(report));
  return report;
}

std::vector<uint64_t> PairBench::coverage() const {
  std::vector<uint64_t> words(2 * size_t{problem.a.faceCount});
  std::memcpy(words.data(), working_.mapped() + coverage_at_, words.size() * sizeof(uint64_t));
  return words;
}

bool PairBench::is_untouched_around() const {
  return std::all_of(guards_.begin(), guards_.end(), [&](const auto& range) {
    const std::byte* const at = working_.mapped();
    return std::all_of(at + range.first, at + range.second,
                       [](std::byte x) { return x == std::byte{kGuard}; });
  });
}

}  // namespace vkh::test
