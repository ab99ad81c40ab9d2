#include "host/gpu/memory.h"

#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "host/gpu/vulkan_api.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

VkMemoryPropertyFlags wanted(Placement placement) {
  constexpr VkMemoryPropertyFlags visible =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (placement) {
    case Placement::kDevice:
      return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    case Placement::kMapped:
      return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | visible;
    case Placement::kUpload:
      return visible;
    case Placement::kReadback:
      return visible | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  }
  return 0;
}

// Rounded up: nothing that is allocated has a size of 0.
std::string size_text(VkDeviceSize bytes) {
  const bool is_small = bytes < (VkDeviceSize{1} << 20);
  const int shift = is_small ? 10 : 20;
  const VkDeviceSize most = (VkDeviceSize{1} << shift) - 1;
  return std::to_string((bytes + most) >> shift) + (is_small ? " KiB" : " MiB");
}

VkPhysicalDeviceMemoryProperties memory_of(const Device& device) {
  VkPhysicalDeviceMemoryProperties memory;
  device.vk().GetPhysicalDeviceMemoryProperties(device.physical(), &memory);
  return memory;
}

std::optional<uint32_t> find_type(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                                  VkMemoryPropertyFlags flags) {
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    if ((allowed & (1u << i)) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags)
      return i;
  }
  return std::nullopt;
}

// Requires the other properties, and prefers cached memory.
uint32_t memory_type(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                     Placement placement) {
  const VkMemoryPropertyFlags flags = wanted(placement);
  for (const VkMemoryPropertyFlags asked :
       {flags, flags & ~VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_HOST_CACHED_BIT}}) {
    if (const auto type = find_type(memory, allowed, asked)) return *type;
  }
  throw DeviceError("the device has no fitting memory type");
}

}  // namespace

uint32_t memory_type(const Device& device, uint32_t allowed, Placement placement) {
  return memory_type(memory_of(device), allowed, placement);
}

// Delegates, here and below: the objects made so far are destroyed if a later step throws.
Buffer::Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage,
               Placement placement, MemoryPool* pool)
    : Buffer() {
  device_ = &device;
  pool_ = pool;
  size_ = size;
  const VulkanApi& vk = device.vk();
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  const bool has_address =
      device.has_addresses() && (usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) != 0;
  info.usage = usage | (has_address ? VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT : 0);
  check_made(vk.CreateBuffer(device.handle(), &info, nullptr, &buffer_), buffer_,
             "creating a buffer");
  VkMemoryRequirements requirements;
  vk.GetBufferMemoryRequirements(device.handle(), buffer_, &requirements);
  const VkPhysicalDeviceMemoryProperties memory = memory_of(device);
  const uint32_t type = memory_type(memory, requirements.memoryTypeBits, placement);
  in_host_ = (memory.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) == 0;
  allocate(requirements, type, has_address);
  check(vk.BindBufferMemory(device.handle(), buffer_, range_ ? range_->memory : memory_,
                            range_ ? range_->offset : 0),
        "binding a buffer");
  if (placement == Placement::kDevice) return;
  if (range_) {
    mapped_ = pool_->map(*range_);
  } else {
    check(vk.MapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped_), "mapping memory");
  }
}

void Buffer::allocate(const VkMemoryRequirements& needs, uint32_t type, bool has_address) {
  if (pool_ != nullptr) range_ = pool_->take(needs, type);
  if (range_) return;
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  if (has_address) allocate.pNext = &flags;
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex = type;
  const VkResult result =
      device_->vk().AllocateMemory(device_->handle(), &allocate, nullptr, &memory_);
  check_made(result, memory_,
             ("allocating " + size_text(size_) + " " +
              (in_host_ ? "of the host's memory for the device" : "on the device"))
                 .c_str());
}

Buffer::~Buffer() {
  if (device_ == nullptr) return;
  device_->vk().DestroyBuffer(device_->handle(), buffer_, nullptr);
  if (range_) {
    pool_->give_back(*range_);
  } else {
    device_->vk().FreeMemory(device_->handle(), memory_, nullptr);
  }
}

void Buffer::swap(Buffer& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(pool_, other.pool_);
  std::swap(range_, other.range_);
  std::swap(size_, other.size_);
  std::swap(in_host_, other.in_host_);
  std::swap(mapped_, other.mapped_);
}

bool is_mappable(const Device& device, VkDeviceSize size) {
  constexpr uint32_t kAnyType = ~0u;
  const VkPhysicalDeviceMemoryProperties memory = memory_of(device);
  const auto type = find_type(memory, kAnyType, wanted(Placement::kMapped));
  return type && device.maps_memory() &&
         size <= memory.memoryHeaps[memory.memoryTypes[*type].heapIndex].size / 4;
}

void grow(Buffer& buffer, const Device& device, VkDeviceSize size, const BufferUse& use) {
  if (buffer.size() >= size) return;
  buffer = Buffer();  // free first: the two need not fit at the same time
  buffer = Buffer(device, size, use.flags, use.placement, use.pool);
}

Submitter::Submitter(const Device& device) : Submitter(device, Empty{}) {
  const VulkanApi& vk = device.vk();
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.queueFamilyIndex = device.queue_family();
  check_made(vk.CreateCommandPool(device.handle(), &pool, nullptr, &pool_), pool_,
             "creating a command pool");
  VkCommandBufferAllocateInfo commands{};
  commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  commands.commandPool = pool_;
  commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands.commandBufferCount = 1;
  check(vk.AllocateCommandBuffers(device.handle(), &commands, &commands_),
        "allocating a command buffer");
  VkFenceCreateInfo fence{};
  fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  check_made(vk.CreateFence(device.handle(), &fence, nullptr, &fence_), fence_, "creating a fence");
  if (!device.has_timestamps()) return;
  VkQueryPoolCreateInfo queries{};
  queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queries.queryCount = kTimestamps;
  check_made(vk.CreateQueryPool(device.handle(), &queries, nullptr, &timestamps_), timestamps_,
             "creating a query pool");
}

Submitter::~Submitter() {
  const VulkanApi& vk = device_.vk();
  finish();
  vk.DestroyQueryPool(device_.handle(), timestamps_, nullptr);
  vk.DestroyFence(device_.handle(), fence_, nullptr);
  vk.DestroyCommandPool(device_.handle(), pool_, nullptr);
}

// Waits in a loop: a wait may fail for lack of memory while the device goes on, and nothing that it
// uses may be freed before it has ended. vkDeviceWaitIdle is no alternative: the device may be
// another owner's, with queues in use on other threads.
void Submitter::finish() {
  constexpr int kMostTries = 100;
  constexpr std::chrono::milliseconds kPause(10);
  for (int i = 0; pending_ && i < kMostTries; ++i) {
    const VkResult result =
        device_.vk().WaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX);
    pending_ = result != VK_SUCCESS && result != VK_ERROR_DEVICE_LOST;
    if (pending_) std::this_thread::sleep_for(kPause);
  }
}

VkCommandBuffer Submitter::begin() {
  const VulkanApi& vk = device_.vk();
  check(vk.ResetCommandPool(device_.handle(), pool_, 0), "resetting a command pool");
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vk.BeginCommandBuffer(commands_, &info), "beginning a command buffer");
  if (timestamps_ != VK_NULL_HANDLE) vk.CmdResetQueryPool(commands_, timestamps_, 0, kTimestamps);
  return commands_;
}

void Submitter::submit_and_wait(const std::function<void()>& waiting) {
  const VulkanApi& vk = device_.vk();
  check(vk.EndCommandBuffer(commands_), "recording");
  // Resets the fence here and not after the wait: after a failed wait the next one must not see an
  // old signal.
  check(vk.ResetFences(device_.handle(), 1, &fence_), "resetting a fence");
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  {
    const std::lock_guard lock(device_.queue_mutex());
    check(vk.QueueSubmit(device_.queue(), 1, &submit, fence_), "submitting");
  }
  pending_ = true;
  constexpr uint64_t slice_ns = 50'000'000;
  VkResult result = VK_TIMEOUT;
  while (result == VK_TIMEOUT) {
    result = vk.WaitForFences(device_.handle(), 1, &fence_, VK_TRUE, slice_ns);
    if (waiting) waiting();
  }
  if (result == VK_SUCCESS) {
    pending_ = false;
  } else {
    finish();
  }
  check(result, "waiting for the device");
}

std::vector<double> Submitter::read_timestamps(uint32_t count) const {
  std::vector<uint64_t> ticks(count);
  if (count > 0) {
    check(device_.vk().GetQueryPoolResults(device_.handle(), timestamps_, 0, count,
                                           count * sizeof(uint64_t), ticks.data(), sizeof(uint64_t),
                                           VK_QUERY_RESULT_64_BIT),
          "reading timestamps");
  }
  std::vector<double> ms;
  ms.reserve(count);
  for (uint64_t t : ticks)
    ms.push_back(static_cast<double>(t - ticks[0]) * device_.timestamp_period_ns() * 1e-6);
  return ms;
}

}  // namespace vkh
