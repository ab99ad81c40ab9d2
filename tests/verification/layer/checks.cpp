// Limits that were lowered are held: a fallback that takes more is noticed.
#include <span>
#include <vector>

#include "tests/verification/layer/hazards.h"
#include "tests/verification/layer/limits.h"
#include "tests/verification/layer/regroup.h"
#include "tests/verification/layer/rules.h"
#include "tests/verification/layer/settings.h"
#include "tests/verification/layer/spirv.h"

// Parameters are as many as Vulkan has.
// NOLINTBEGIN(readability-function-size)
namespace vkh::layer {
namespace {

struct Known {
  std::mutex mutex;
  std::map<uint64_t, VkDeviceSize> buffers;                           // sizes
  std::map<uint64_t, std::vector<uint32_t>> modules;                  // words
  std::map<uint64_t, uint32_t> layouts;                               // storage buffers of a set
  std::map<uint64_t, std::pair<uint32_t, VkDeviceSize>> allocations;  // heap, bytes
};

Known& known() {
  static Known* one = new Known;  // never destroyed: threads may still be at work at the end
  return *one;
}

// Whether the limit is kept; the driver checks a limit that was not given.
bool at_most(uint64_t value, const char* name, const char* where) {
  const auto limit = settings().limit(name);
  if (!limit || value <= *limit) return true;
  violation(std::string(where) + ": " + std::to_string(value) + " is above " + name + " = " +
            std::to_string(*limit));
  return false;
}

bool is_storage(VkDescriptorType type) {
  return type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ||
         type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC;
}

VkDeviceSize size_of(VkBuffer buffer) {
  const std::lock_guard lock(known().mutex);
  return known().buffers[number_of(buffer)];
}

void check_writes(const char* where, uint32_t count, const VkWriteDescriptorSet* writes) {
  const uint64_t alignment = settings().limit("minStorageBufferOffsetAlignment").value_or(1);
  for (const VkWriteDescriptorSet& write : std::span(writes, count)) {
    if (!is_storage(write.descriptorType)) continue;
    for (const VkDescriptorBufferInfo& b : std::span(write.pBufferInfo, write.descriptorCount)) {
      const bool whole = b.range == VK_WHOLE_SIZE && b.buffer != VK_NULL_HANDLE;
      at_most(whole ? size_of(b.buffer) - b.offset : b.range, "maxStorageBufferRange", where);
      if (b.offset % alignment != 0)
        violation(std::string(where) + ": offset " + std::to_string(b.offset) +
                  " is not aligned to " + std::to_string(alignment));
    }
  }
}

uint32_t storage_buffers(const VkDescriptorSetLayoutCreateInfo& info) {
  uint32_t count = 0;
  for (const VkDescriptorSetLayoutBinding& b : std::span(info.pBindings, info.bindingCount))
    count += is_storage(b.descriptorType) ? b.descriptorCount : 0;
  return count;
}

bool check_shader(const VkPipelineShaderStageCreateInfo& stage) {
  std::vector<uint32_t> words;
  {
    const std::lock_guard lock(known().mutex);
    words = known().modules[number_of(stage.module)];
  }
  const auto needs = needs_of(words, stage.pSpecializationInfo);
  if (!needs) {
    violation("vkCreateComputePipelines: this layer cannot read the shader");
    return false;
  }
  const auto& [x, y, z] = needs->local_size;
  const char* where = "vkCreateComputePipelines";
  const bool fits = at_most(uint64_t{x} * y * z, "maxComputeWorkGroupInvocations", where);
  return at_most(x, "maxComputeWorkGroupSize0", where) &&
         at_most(y, "maxComputeWorkGroupSize1", where) &&
         at_most(z, "maxComputeWorkGroupSize2", where) &&
         at_most(needs->shared_bytes, "maxComputeSharedMemorySize", where) && fits;
}

bool looks_at_shaders() {
  for (const char* name :
       {"maxComputeWorkGroupInvocations", "maxComputeWorkGroupSize0", "maxComputeWorkGroupSize1",
        "maxComputeWorkGroupSize2", "maxComputeSharedMemorySize"}) {
    if (settings().limit(name)) return true;
  }
  return false;
}

std::optional<VkResult> unless(bool fits) {
  return fits ? std::nullopt : std::optional(VK_ERROR_OUT_OF_DEVICE_MEMORY);
}

VkPhysicalDeviceMemoryProperties memory_of(const Table& table) {
  VkPhysicalDeviceMemoryProperties memory;
  table_of(key_of(table.physical)).GetPhysicalDeviceMemoryProperties(table.physical, &memory);
  return memory;
}

uint32_t heap_of(const Table& table, uint32_t type) {
  const VkPhysicalDeviceMemoryProperties memory = memory_of(table);
  return is_split(memory) ? type : memory.memoryTypes[type].heapIndex;
}

bool fits_heap(uint32_t heap, VkDeviceSize bytes) {
  const bool is_local = heap == 0;
  const auto local = is_local ? settings().limit("localMemory") : std::nullopt;
  return bytes <=
         std::min(local.value_or(UINT64_MAX), settings().limit("heapSize").value_or(UINT64_MAX));
}

bool keeps_barrier(VkCommandBuffer commands, const VkDependencyInfo& info) {
  const uint64_t n = count_call("barriers");
  if (n == settings().dropped_barrier) return false;
  for (const VkMemoryBarrier2& b : std::span(info.pMemoryBarriers, info.memoryBarrierCount))
    follow_barrier(commands,
                   {{b.srcStageMask, b.srcAccessMask}, {b.dstStageMask, b.dstAccessMask}});
  return true;
}

}  // namespace

void learn(const VkBufferCreateInfo& info, VkBuffer buffer) {
  follow_buffer(buffer, info.size);
  const std::lock_guard lock(known().mutex);
  known().buffers[number_of(buffer)] = info.size;
}

void learn(const VkShaderModuleCreateInfo& info, VkShaderModule module) {
  follow_module(module, {info.pCode, info.codeSize / 4});
  if (!looks_at_shaders()) return;
  const std::lock_guard lock(known().mutex);
  known().modules[number_of(module)].assign(info.pCode, info.pCode + info.codeSize / 4);
}

void learn(const VkDescriptorSetLayoutCreateInfo& info, VkDescriptorSetLayout layout) {
  const std::lock_guard lock(known().mutex);
  known().layouts[number_of(layout)] = storage_buffers(info);
}

void keep_allocation(VkDevice device, const VkMemoryAllocateInfo& info, uint64_t memory) {
  const uint32_t heap = heap_of(table_of(key_of(device)), info.memoryTypeIndex);
  const std::lock_guard lock(known().mutex);
  known().allocations[memory] = {heap, info.allocationSize};
}

void forget_allocation(uint64_t memory) {
  const std::lock_guard lock(known().mutex);
  known().allocations.erase(memory);
}

void made(fn::GetBufferMemoryRequirements, Table& table, VkDevice, VkBuffer,
          VkMemoryRequirements* requirements) {
  if (is_split(memory_of(table))) requirements->memoryTypeBits |= requirements->memoryTypeBits << 1;
}

// An allocation larger than a heap is no violation: a driver reports that it lacks the memory. The
// two types that the program sees are one to the driver.
std::optional<VkResult> refusal(fn::AllocateMemory tag, Table& table, VkDevice device,
                                const VkMemoryAllocateInfo* info, Allocator allocator,
                                VkDeviceMemory* out) {
  const char* where = "vkAllocateMemory";
  if (!at_most(info->allocationSize, "maxMemoryAllocationSize", where)) return unless(false);
  const uint32_t heap = heap_of(table, info->memoryTypeIndex);
  {
    const std::lock_guard lock(known().mutex);
    VkDeviceSize bytes = info->allocationSize;
    for (const auto& [memory, taken] : known().allocations)
      bytes += taken.first == heap ? taken.second : 0;
    const bool counted = at_most(known().allocations.size() + 1, "maxMemoryAllocationCount", where);
    if (!counted || !fits_heap(heap, bytes)) return unless(false);
  }
  if (!is_split(memory_of(table))) return std::nullopt;
  VkMemoryAllocateInfo of_driver = *info;
  of_driver.memoryTypeIndex = 0;
  const VkResult result = table.AllocateMemory(device, &of_driver, allocator, out);
  if (result == VK_SUCCESS) made(tag, table, device, info, allocator, out);
  return result;
}

std::optional<VkResult> refusal(fn::MapMemory, Table& table, VkDevice, VkDeviceMemory memory,
                                VkDeviceSize, VkDeviceSize, VkMemoryMapFlags, void**) {
  if (!is_split(memory_of(table))) return std::nullopt;
  const std::lock_guard lock(known().mutex);
  if (known().allocations[number_of(memory)].first != 0) return std::nullopt;
  violation("vkMapMemory: the host does not see the device's own memory");
  return VK_ERROR_MEMORY_MAP_FAILED;
}

std::optional<VkResult> refusal(fn::CreateBuffer, Table&, VkDevice, const VkBufferCreateInfo* info,
                                Allocator, VkBuffer*) {
  return unless(at_most(info->size, "maxBufferSize", "vkCreateBuffer"));
}

std::optional<VkResult> refusal(fn::CreateDescriptorSetLayout, Table&, VkDevice,
                                const VkDescriptorSetLayoutCreateInfo* info, Allocator,
                                VkDescriptorSetLayout*) {
  const char* where = "vkCreateDescriptorSetLayout";
  const uint32_t count = storage_buffers(*info);
  const bool pushed = (info->flags & VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR) != 0;
  if (pushed && settings().hidden.contains("VK_KHR_push_descriptor"))
    violation(std::string(where) + ": push descriptors, which are hidden");
  return unless(at_most(count, "maxPerStageDescriptorStorageBuffers", where) &&
                at_most(count, "maxDescriptorSetStorageBuffers", where) &&
                (!pushed || at_most(count, "maxPushDescriptors", where)));
}

std::optional<VkResult> refusal(fn::CreatePipelineLayout, Table&, VkDevice,
                                const VkPipelineLayoutCreateInfo* info, Allocator,
                                VkPipelineLayout*) {
  const char* where = "vkCreatePipelineLayout";
  uint64_t count = 0;
  bool fits = at_most(info->setLayoutCount, "maxBoundDescriptorSets", where);
  for (const VkPushConstantRange& r :
       std::span(info->pPushConstantRanges, info->pushConstantRangeCount))
    fits = at_most(r.offset + r.size, "maxPushConstantsSize", where) && fits;
  {
    const std::lock_guard lock(known().mutex);
    for (const VkDescriptorSetLayout layout : std::span(info->pSetLayouts, info->setLayoutCount))
      count += known().layouts[number_of(layout)];
  }
  return unless(at_most(count, "maxPerStageDescriptorStorageBuffers", where) && fits);
}

// The driver gets another module, which rounds otherwise.
std::optional<VkResult> refusal(fn::CreateShaderModule tag, Table& table, VkDevice device,
                                const VkShaderModuleCreateInfo* info, Allocator allocator,
                                VkShaderModule* out) {
  if (!settings().regroups) return std::nullopt;
  const Regrouped module = regrouped({info->pCode, info->codeSize / 4});
  for (uint32_t i = 0; i < module.sums; ++i) count_call("regrouped_sums");
  VkShaderModuleCreateInfo other = *info;
  other.codeSize = 4 * module.words.size();
  other.pCode = module.words.data();
  const VkShaderModuleCreateInfo* const of_driver = &other;
  const VkResult result = table.CreateShaderModule(device, of_driver, allocator, out);
  if (result == VK_SUCCESS) made(tag, table, device, of_driver, allocator, out);
  return result;
}

std::optional<VkResult> refusal(fn::CreateComputePipelines, Table&, VkDevice, VkPipelineCache,
                                uint32_t count, const VkComputePipelineCreateInfo* infos, Allocator,
                                VkPipeline*) {
  if (!looks_at_shaders()) return std::nullopt;
  bool fits = true;
  for (uint32_t i = 0; i < count; ++i) fits = check_shader(infos[i].stage) && fits;
  return unless(fits);
}

bool allowed(fn::UpdateDescriptorSets, Table&, VkDevice, uint32_t count,
             const VkWriteDescriptorSet* writes, uint32_t, const VkCopyDescriptorSet*) {
  check_writes("vkUpdateDescriptorSets", count, writes);
  follow_sets({writes, count});
  return true;
}

bool allowed(fn::CmdPushDescriptorSetKHR, Table&, VkCommandBuffer commands, VkPipelineBindPoint,
             VkPipelineLayout, uint32_t, uint32_t count, const VkWriteDescriptorSet* writes) {
  at_most(count, "maxPushDescriptors", "vkCmdPushDescriptorSetKHR");
  follow_push(commands, {writes, count});
  check_writes("vkCmdPushDescriptorSetKHR", count, writes);
  return true;
}

bool allowed(fn::CmdDispatch, Table&, VkCommandBuffer commands, uint32_t x, uint32_t y,
             uint32_t z) {
  at_most(x, "maxComputeWorkGroupCount0", "vkCmdDispatch");
  at_most(y, "maxComputeWorkGroupCount1", "vkCmdDispatch");
  at_most(z, "maxComputeWorkGroupCount2", "vkCmdDispatch");
  follow_dispatch(commands);
  return true;
}

bool allowed(fn::CmdPipelineBarrier, Table&, VkCommandBuffer commands, VkPipelineStageFlags from,
             VkPipelineStageFlags to, VkDependencyFlags, uint32_t count,
             const VkMemoryBarrier* barriers, uint32_t, const VkBufferMemoryBarrier*, uint32_t,
             const VkImageMemoryBarrier*) {
  if (count_call("plain_barriers") == settings().dropped_plain_barrier) return false;
  for (const VkMemoryBarrier& b : std::span(barriers, count))
    follow_barrier(commands, {{from, b.srcAccessMask}, {to, b.dstAccessMask}});
  return true;
}

bool allowed(fn::CmdPipelineBarrier2, Table&, VkCommandBuffer commands,
             const VkDependencyInfo* info) {
  return keeps_barrier(commands, *info);
}

bool allowed(fn::CmdPipelineBarrier2KHR, Table&, VkCommandBuffer commands,
             const VkDependencyInfo* info) {
  return keeps_barrier(commands, *info);
}

}  // namespace vkh::layer
// NOLINTEND(readability-function-size)
