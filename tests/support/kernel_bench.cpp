#include "tests/support/kernel_bench.h"

#include <cstdlib>
#include <stdexcept>

namespace vkh::test {

Device& test_device() {
  static Device device(
      {.selector = std::getenv("VKH_TEST_DEVICE") ? std::getenv("VKH_TEST_DEVICE") : "",
       .validation = std::getenv("VKH_VALIDATION") != nullptr});
  return device;
}

KernelBench::KernelBench(uint32_t switches) : submitter_(test_device()) {
  const VkhContextCreateInfo info{test_device().engine_info(), VK_NULL_HANDLE, switches};
  if (vkhCreateContext(&info, &context_) != VKH_SUCCESS) throw std::runtime_error("no context");
}

KernelBench::~KernelBench() { vkhDestroyContext(context_); }

VkBuffer KernelBench::reserve(const void* content, size_t bytes) {
  constexpr VkBufferUsageFlags usage =
      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
      VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  buffers_.emplace_back(test_device(), bytes, usage, Placement::kReadback);
  std::memcpy(buffers_.back().mapped(), content, bytes);
  return buffers_.back().handle();
}

const std::byte* KernelBench::read(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize) {
  for (const Buffer& b : buffers_) {
    if (b.handle() == buffer) return b.mapped() + offset;
  }
  throw std::runtime_error("not a buffer of this bench");
}

void KernelBench::run(const std::function<void(Recorder&)>& record) {
  const VkCommandBuffer commands = submitter_.begin();
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
}

}  // namespace vkh::test
