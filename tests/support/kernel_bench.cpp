#include "tests/support/kernel_bench.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "host/gpu/vulkan_api.h"
#include "host/mesh/round_to_float.h"

namespace vkh::test {
namespace {

const char* environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

// Pipelines take longer than most tests, so each set of switches is compiled once per program.
struct TestDevice {
  Device device{{.selector = environment("VKH_TEST_DEVICE"),
                 .validation = *environment("VKH_VALIDATION") != '\0'}};
  std::map<std::pair<uint32_t, bool>, VkhContext> contexts;  // by switches and kind

  ~TestDevice() {
    for (const auto& [ways, context] : contexts) vkhDestroyContext(context);
  }
};

TestDevice*& made() {
  static TestDevice* device = nullptr;
  return device;
}

// Whether contexts are to be byAddress; ends a program that is to be skipped.
VkBool32 by_address(const Device& device) {
  if (*environment("VKH_TEST_BY_ADDRESS") == '\0') return VK_FALSE;
  if (device.has_addresses()) return VK_TRUE;
  std::puts("SKIP: the device has no bufferDeviceAddress");
  std::fflush(nullptr);
  std::_Exit(77);
}

VkhContext context_for(uint32_t switches, bool wide) {
  Device& device = test_device();
  VkhContext& context = made()->contexts[{switches, wide}];
  const VkhContextCreateInfo info =
      create_info(switches | VKH_SWITCH_NONE, wide ? VKH_DEVICE_KIND_WIDE : VKH_DEVICE_KIND_NARROW,
                  by_address(device));
  if (context == nullptr && vkhCreateContext(&info, &context) != VKH_SUCCESS)
    throw std::runtime_error("no context");
  return context;
}

}  // namespace

Device& test_device() {
  if (made() == nullptr) {
    made() = &kept<TestDevice>();
    validation_messages() = [] { return made()->device.validation_messages(); };
  }
  return made()->device;
}

VkhContextCreateInfo create_info(uint32_t switches, VkhDeviceKind kind, VkBool32 by_address,
                                 VkBool32 checks) {
  VkhContextCreateInfo info{};
  constexpr uint32_t flags = VKH_CONTEXT_COVERAGE | VKH_CONTEXT_CELLS | VKH_CONTEXT_FINE |
                             VKH_CONTEXT_CHECK_INPUT | VKH_CONTEXT_CLOSEST |
                             VKH_CONTEXT_BY_ADDRESS | VKH_CONTEXT_CHECK_CALLS;
  info.size = sizeof(info);
  info.device = test_device().engine_info();
  info.flags = switches & flags;
  if (by_address == VK_TRUE) info.flags |= VKH_CONTEXT_BY_ADDRESS;
  if (checks == VK_TRUE) info.flags |= VKH_CONTEXT_CHECK_INPUT;
  info.deviceKind = kind;
  info.switches = switches & ~flags;
  return info;
}

AdoptedDevice handles_of(const Device& device) {
  const VkhDeviceInfo info = device.engine_info();
  return {.get_instance_proc_addr = info.getInstanceProcAddr,
          .instance = info.instance,
          .physical = info.physicalDevice,
          .device = info.device,
          .queue = device.queue(),
          .queue_family = device.queue_family(),
          .queue_mutex = nullptr};
}

KernelBench::KernelBench(uint32_t switches, bool wide)
    : guard_bytes_(*environment("VKH_TEST_GUARDED") == '\0' ? 4096 : 0),
      submitter_(test_device()),
      context_(context_for(switches, wide)) {}

VkBuffer KernelBench::reserve_bytes(const void* content, size_t bytes) {
  constexpr VkBufferUsageFlags usage =
      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
      VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  buffers_.emplace_back(test_device(), bytes + guard_bytes_, usage, Placement::kReadback);
  std::memset(buffers_.back().mapped(), kGarbage, bytes + guard_bytes_);
  if (content != nullptr) std::memcpy(buffers_.back().mapped(), content, bytes);
  return buffers_.back().handle();
}

const std::byte* KernelBench::mapped(VkBuffer buffer) const {
  for (const Buffer& b : buffers_) {
    if (b.handle() == buffer) return b.mapped();
  }
  throw std::runtime_error("not a buffer of this bench");
}

void KernelBench::check_guards() const {
  for (const Buffer& b : buffers_) {
    const std::byte* end = b.mapped() + b.size();
    if (std::any_of(end - static_cast<std::ptrdiff_t>(guard_bytes_), end,
                    [](std::byte x) { return x != std::byte{kGarbage}; }))
      throw std::runtime_error("a kernel wrote beyond the end of a buffer of " +
                               std::to_string(b.size() - guard_bytes_) + " bytes");
  }
}

void KernelBench::run(const std::function<void(Recorder&)>& record) {
  const VkCommandBuffer commands = submitter_.begin();
  vkhReleaseCommandBuffer(context_, commands);
  Recorder rec(*context_, commands, nullptr);
  record(rec);
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  test_device().vk().CmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                        VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0,
                                        nullptr);
  submitter_.submit_and_wait({});
  check_guards();
}

VkhMesh put_mesh(KernelBench& bench, const Mesh& mesh) {
  std::vector<float> high, low;
  bool has_low = false;
  for (const glm::dvec3& v : mesh.vertices) {
    for (int i = 0; i < 3; ++i) {
      const double rounded = round_to_float(v[i]);
      high.push_back(static_cast<float>(rounded));
      low.push_back(static_cast<float>(v[i] - rounded));
      has_low = has_low || low.back() != 0;
    }
  }
  std::vector<uint32_t> corners;
  for (const glm::uvec3& f : mesh.faces) corners.insert(corners.end(), {f.x, f.y, f.z});
  return {.vertexBuffer = bench.put(high).buffer,
          .vertexOffset = 0,
          .vertexStride = 12,
          .vertexCount = static_cast<uint32_t>(mesh.vertices.size()),
          .indexBuffer = bench.put(corners).buffer,
          .indexOffset = 0,
          .indexType = VK_INDEX_TYPE_UINT32,
          .faceCount = static_cast<uint32_t>(mesh.faces.size()),
          .vertexLowBuffer = has_low ? bench.put(low).buffer : VK_NULL_HANDLE,
          .vertexLowOffset = 0};
}

BuiltHierarchy build_hierarchy(KernelBench& bench, const Mesh& mesh) {
  return build_hierarchy(bench, mesh, bench.context()->limits);
}

BuiltHierarchy build_hierarchy(KernelBench& bench, const Mesh& mesh, const Limits& limits) {
  const VkhMesh b = put_mesh(bench, mesh);
  const uint32_t faces = b.faceCount;
  const Slice<uint32_t> kept =
      bench.garbage<uint32_t>(hierarchy_size(limits, b.vertexCount, faces).all / 4);
  const Slice<uint32_t> spare = bench.garbage<uint32_t>(scratch_size(faces).all / 4);
  const BuiltHierarchy built{
      view_hierarchy({{kept.buffer, 0, kept.size}, faces, b.vertexCount, {}}, limits),
      view_scratch({spare.buffer, 0, spare.size}, faces)};
  bench.run([&](Recorder& rec) { record_build(rec, b, built.scratch, built.hierarchy); });
  return built;
}

}  // namespace vkh::test
