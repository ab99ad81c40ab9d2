#include "host/gpu/memory_pool.h"

#include <algorithm>

#include "host/gpu/vulkan_api.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// Ranges begin at multiples of this, which no buffer's alignment exceeds on known devices.
constexpr VkDeviceSize kAlignment = VkDeviceSize{1} << 16;

// The device's own memory comes in blocks of 256 MiB, a few workspaces each, and the host's, which
// an H200 takes 0.3 ms a MiB to give out, in blocks of 4. In a small heap most memory stays free
// for buffers outside of the pool.
VkDeviceSize block_bytes(const Device& device, uint32_t type) {
  VkPhysicalDeviceMemoryProperties memory;
  device.vk().GetPhysicalDeviceMemoryProperties(device.physical(), &memory);
  const VkMemoryType& of = memory.memoryTypes[type];
  const bool is_local = (of.propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0;
  const VkDeviceSize wanted = VkDeviceSize{is_local ? 256u : 4u} << 20;
  return std::min(wanted, memory.memoryHeaps[of.heapIndex].size / 64 / kAlignment * kAlignment);
}

}  // namespace

MemoryPool::Block::Block(const Device& d, VkDeviceSize bytes, uint32_t type_index)
    : device(d), type(type_index), spans{{0, bytes, true}} {
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  if (device.has_addresses()) allocate.pNext = &flags;
  allocate.allocationSize = bytes;
  allocate.memoryTypeIndex = type;
  check_made(device.vk().AllocateMemory(device.handle(), &allocate, nullptr, &memory), memory,
             "allocating a block of memory");
}

MemoryPool::Block::~Block() { device.vk().FreeMemory(device.handle(), memory, nullptr); }

// Takes the smallest span that is large enough. What is left of it is the free span behind.
std::optional<VkDeviceSize> MemoryPool::Block::take(VkDeviceSize bytes) {
  auto best = spans.end();
  for (auto span = spans.begin(); span != spans.end(); ++span) {
    const bool fits = span->is_free && span->size >= bytes;
    if (fits && (best == spans.end() || span->size < best->size)) best = span;
  }
  if (best == spans.end()) return std::nullopt;
  const Span found = *best;
  if (found.size > bytes)
    best = spans.insert(best + 1, {found.offset + bytes, found.size - bytes, true}) - 1;
  *best = {found.offset, bytes, false};
  return found.offset;
}

void MemoryPool::Block::give_back(VkDeviceSize offset) noexcept {
  auto span = std::lower_bound(spans.begin(), spans.end(), offset,
                               [](const Span& s, VkDeviceSize at) { return s.offset < at; });
  span->is_free = true;
  if (span + 1 != spans.end() && (span + 1)->is_free) {
    span->size += (span + 1)->size;
    span = spans.erase(span + 1) - 1;
  }
  if (span == spans.begin() || !(span - 1)->is_free) return;
  (span - 1)->size += span->size;
  spans.erase(span);
}

std::optional<MemoryPool::Range> MemoryPool::take(const VkMemoryRequirements& needs,
                                                  uint32_t type) {
  const VkDeviceSize whole = block_bytes(device_, type);
  const VkDeviceSize bytes = (needs.size + kAlignment - 1) / kAlignment * kAlignment;
  if (bytes > whole / 2 || needs.alignment > kAlignment) return std::nullopt;
  const std::lock_guard lock(mutex_);
  for (Block& block : blocks_) {
    if (block.type != type) continue;
    if (const auto offset = block.take(bytes)) return Range{&block, block.memory, *offset};
  }
  try {
    Block& block = blocks_.emplace_back(device_, whole, type);
    return Range{&block, block.memory, *block.take(bytes)};
  } catch (const MemoryError&) {
    return std::nullopt;
  }
}

void MemoryPool::give_back(const Range& range) noexcept {
  const std::lock_guard lock(mutex_);
  range.block->give_back(range.offset);
  if (!range.block->is_free()) return;
  blocks_.erase(std::find_if(blocks_.begin(), blocks_.end(),
                             [&](const Block& block) { return &block == range.block; }));
}

std::byte* MemoryPool::map(const Range& range) {
  const std::lock_guard lock(mutex_);
  if (range.block->mapped == nullptr) {
    void* mapped = nullptr;
    check(device_.vk().MapMemory(device_.handle(), range.memory, 0, VK_WHOLE_SIZE, 0, &mapped),
          "mapping memory");
    range.block->mapped = static_cast<std::byte*>(mapped);
  }
  return range.block->mapped + range.offset;
}

}  // namespace vkh
