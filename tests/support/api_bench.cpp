#include "tests/support/api_bench.h"

#include <doctest/doctest.h>

#include <cstring>
#include <stdexcept>

#include "host/gpu/vulkan_api.h"
#include "host/mesh/round_to_float.h"
#include "tests/shapes/shapes.h"
#include "tests/support/kernel_bench.h"

namespace vkh::test {
namespace {

constexpr int kGarbage = 0xa5;
constexpr VkDeviceSize kStatistics = 132;  // behind a report, at a multiple of 4
constexpr VkDeviceSize kReportStride = (kStatistics + sizeof(VkhStatistics) + 255) / 256 * 256;
static_assert(sizeof(VkhReport) <= kStatistics);
constexpr VkDeviceSize kFirstReport = 512;  // not at the start, where an offset left out would pass
constexpr VkBufferUsageFlags kWorking =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

Buffer garbage(VkDeviceSize size, VkBufferUsageFlags usage) {
  Buffer buffer(test_device(), size, usage, Placement::kReadback);
  std::memset(buffer.mapped(), kGarbage, size);
  return buffer;
}

VkhContext shared_context() {
  static KernelBench& bench = kept<KernelBench>(VKH_SWITCH_DEFAULT_WIDE);
  return bench.context();
}

// The same as in_float32, also for data that is no mesh. GCC 12 makes nothing of glm::vec3(p) here.
Mesh rounded(Mesh mesh) {
  for (glm::dvec3& p : mesh.vertices) p = round_to_float(p);
  return mesh;
}

void check_engine(VkhResult result) {
  if (result != VKH_SUCCESS) throw std::runtime_error("the engine refused");
}

}  // namespace

ApiMesh::ApiMesh(const Mesh& mesh, MeshLayout layout) : mesh_(rounded(mesh)), layout_(layout) {
  const size_t width = layout.is_16bit ? 2 : 4;
  // The buffer has no byte more than the contract requires.
  const size_t index_bytes = (layout.index_offset + 3 * width * mesh.faces.size() + 3) / 4 * 4;
  const size_t vertex_bytes =
      layout.vertex_offset + (mesh.vertices.size() - 1) * layout.stride + 12;
  vertices_ = garbage(vertex_bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  indices_ = garbage(index_bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  std::byte* to = indices_.mapped() + layout.index_offset;
  for (const glm::uvec3& f : mesh.faces) {
    for (int corner = 0; corner < 3; ++corner, to += width) std::memcpy(to, &f[corner], width);
  }
  view_ = {.vertexBuffer = vertices_.handle(),
           .vertexOffset = layout.vertex_offset,
           .vertexStride = layout.stride,
           .vertexCount = static_cast<uint32_t>(mesh.vertices.size()),
           .indexBuffer = indices_.handle(),
           .indexOffset = layout.index_offset,
           .indexType = layout.is_16bit ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32,
           .faceCount = static_cast<uint32_t>(mesh.faces.size()),
           .vertexLowBuffer = VK_NULL_HANDLE,
           .vertexLowOffset = 0};
  move(mesh);
}

void ApiMesh::move(const Mesh& moved) {
  mesh_ = rounded(moved);
  std::byte* to = vertices_.mapped() + layout_.vertex_offset;
  for (const glm::dvec3& v : mesh_.vertices) {
    const float position[3] = {static_cast<float>(v.x), static_cast<float>(v.y),
                               static_cast<float>(v.z)};
    std::memcpy(to, position, sizeof(position));
    to += layout_.stride;
  }
}

ApiCommands::ApiCommands() {
  const Device& device = test_device();
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.queueFamilyIndex = device.queue_family();
  check(device.vk().CreateCommandPool(device.handle(), &pool, nullptr, &pool_), "a command pool");
  VkFenceCreateInfo fence{};
  fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  check(device.vk().CreateFence(device.handle(), &fence, nullptr, &fence_), "a fence");
}

ApiCommands::~ApiCommands() {
  const Device& device = test_device();
  device.vk().DestroyFence(device.handle(), fence_, nullptr);
  device.vk().DestroyCommandPool(device.handle(), pool_, nullptr);
}

VkCommandBuffer ApiCommands::record(const std::function<void(VkCommandBuffer)>& record) {
  const Device& device = test_device();
  VkCommandBufferAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocate.commandPool = pool_;
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(device.vk().AllocateCommandBuffers(device.handle(), &allocate, &commands), "commands");
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  check(device.vk().BeginCommandBuffer(commands, &begin), "beginning commands");
  record(commands);
  check(device.vk().EndCommandBuffer(commands), "recording");
  return commands;
}

void ApiCommands::submit_and_wait(VkCommandBuffer commands) {
  const Device& device = test_device();
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  check(device.vk().QueueSubmit(device.queue(), 1, &submit, fence_), "submitting");
  check(device.vk().WaitForFences(device.handle(), 1, &fence_, VK_TRUE, 120'000'000'000),
        "waiting");
  check(device.vk().ResetFences(device.handle(), 1, &fence_), "resetting a fence");
}

ApiPair::ApiPair(ApiMesh& a, ApiMesh& b, float cull_tolerance, VkhContext context)
    : context_(context != nullptr ? context : shared_context()), b_(b) {
  VkhHierarchyRequirements hierarchy{};
  check_engine(
      vkhGetHierarchyRequirements(context_, b.view().vertexCount, b.view().faceCount, &hierarchy));
  VkhWorkspaceRequirements workspace{};
  check_engine(
      vkhGetWorkspaceRequirements(context_, a.view().vertexCount, a.view().faceCount, &workspace));
  const VkDeviceSize bytes = std::min(workspace.recommended, workspace.minimum + (8u << 20));
  for (uint32_t i = 0; i < hierarchy.rangeCount; ++i) {
    const VkDeviceSize size = hierarchy.ranges[i];
    hierarchy_.push_back(garbage(size, kWorking));
    (i == 0 ? problem_.b.memory : problem_.b.more[i - 1]) = {hierarchy_[i].handle(), 0, size};
  }
  scratch_ = garbage(hierarchy.scratchSize, kWorking);
  workspace_ = garbage(bytes, kWorking);
  reports_ = garbage(kFirstReport + 4 * kReportStride,
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  problem_.a = a.view();
  problem_.workspace = {workspace_.handle(), 0, bytes};
  problem_.options.size = sizeof(problem_.options);
  problem_.options.cullTolerance = cull_tolerance;
  scratch_view_ = {scratch_.handle(), 0, scratch_.size()};
}

void ApiPair::build(VkCommandBuffer commands) {
  vkhCmdBuildHierarchy(context_, commands, &b_.view(), &problem_.b, &scratch_view_, nullptr);
}

void ApiPair::refit(VkCommandBuffer commands) {
  vkhCmdRefitHierarchy(context_, commands, &b_.view(), &problem_.b, nullptr);
}

void ApiPair::begin(VkCommandBuffer commands, bool warm) {
  problem_.options.warm = warm ? VK_TRUE : VK_FALSE;
  vkhCmdBegin(context_, commands, &problem_, nullptr);
}

void ApiPair::begin_at(VkCommandBuffer commands, VkBuffer vertices, VkDeviceSize offset) {
  problem_.a.vertexBuffer = vertices;
  problem_.a.vertexOffset = offset;
  begin(commands);
}

void ApiPair::advance(VkCommandBuffer commands, uint32_t waves) {
  vkhCmdAdvance(context_, commands, &problem_, waves, nullptr);
}

void ApiPair::report(VkCommandBuffer commands, uint32_t slot) {
  vkhCmdWriteReport(context_, commands, &problem_, reports_.handle(), report_offset(slot), nullptr);
  vkhCmdWriteStatistics(context_, commands, &problem_, reports_.handle(),
                        report_offset(slot) + kStatistics, nullptr);
  record_host_barrier(commands);
}

void ApiPair::spoil_report() {
  std::memset(reports_.mapped() + report_offset(0), kGarbage, sizeof(VkhReport));
}

void ApiPair::spoil_hierarchy() {
  for (const Buffer& range : hierarchy_) std::memset(range.mapped(), kGarbage, range.size());
  problem_.b.faceCount = problem_.b.vertexCount = 0;
}

VkhTask ApiPair::task(uint32_t waves) {
  return {.size = sizeof(VkhTask),
          .mesh = &b_.view(),
          .scratch = &scratch_view_,
          .problem = &problem_,
          .begin = VK_TRUE,
          .waves = waves,
          .reportBuffer = reports_.handle(),
          .reportOffset = report_offset(0),
          .statisticsBuffer = reports_.handle(),
          .statisticsOffset = report_offset(0) + kStatistics};
}

void ApiPairs::add(const Mesh& a, const Mesh& b, float cull_tolerance) {
  meshes.push_back(std::make_unique<ApiMesh>(a));
  meshes.push_back(std::make_unique<ApiMesh>(b));
  pairs.push_back(
      std::make_unique<ApiPair>(*meshes[meshes.size() - 2], *meshes.back(), cull_tolerance));
}

bool is_same(const VkhReport& a, const VkhReport& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void record_host_barrier(VkCommandBuffer commands) {
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  test_device().vk().CmdPipelineBarrier(
      commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
      VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

VkDeviceSize ApiPair::report_offset(uint32_t slot) { return kFirstReport + slot * kReportStride; }

VkhReport ApiPair::read(uint32_t slot) const {
  VkhReport report;
  std::memcpy(&report, reports_.mapped() + report_offset(slot), sizeof(report));
  return report;
}

VkhStatistics ApiPair::statistics(uint32_t slot) const {
  VkhStatistics statistics;
  std::memcpy(&statistics, reports_.mapped() + report_offset(slot) + kStatistics,
              sizeof(statistics));
  return statistics;
}

VkhReport ApiPair::run(const std::function<void(VkCommandBuffer)>& record) {
  commands_.submit_and_wait(commands_.record(record));
  return read();
}

Interval interval(const VkhReport& report) {
  return {static_cast<double>(report.lower), static_cast<double>(report.upper)};
}

void check_true(const VkhReport& report, const Interval& exact) {
  CAPTURE(report.lower);
  CAPTURE(report.upper);
  CAPTURE(exact.lower);
  CAPTURE(exact.upper);
  CHECK(report.lower <= report.upper);
  CHECK(interval(report).meets(exact));
}

void check_true(const VkhReport& report, const ApiMesh& a, const ApiMesh& b) {
  check_true(report, reference_hausdorff(a.mesh(), b.mesh(), 1e-8));
}

}  // namespace vkh::test
