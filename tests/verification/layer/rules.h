// The layer's actions at each function, beside counting: it keeps objects, holds limits, spoils the
// outputs of a failed call. Each action is an overload for the function's tag; the default does
// nothing.
#pragma once

#include <optional>

#include "tests/verification/layer/state.h"

// Parameters are as many as Vulkan has.
// NOLINTBEGIN(readability-function-size)
namespace vkh::layer {

// A tag for every function: its name, its errors, and the next one below.
namespace fn {
#define VKH_TAG(name, errors)                                  \
  struct name {                                                \
    using Pfn = PFN_vk##name;                                  \
    static constexpr const char* kName = "vk" #name;           \
    static constexpr unsigned kErrors = errors;                \
    static Pfn next(const Table& table) { return table.name; } \
  };
#define VKH_PLAIN_TAG(name) VKH_TAG(name, 0)
VKH_LAYER_INSTANCE_FALLIBLE(VKH_TAG)
VKH_LAYER_DEVICE_FALLIBLE(VKH_TAG)
VKH_LAYER_INSTANCE_VOID(VKH_PLAIN_TAG)
VKH_LAYER_DEVICE_VOID(VKH_PLAIN_TAG)
VKH_LAYER_DEVICE_SAFE(VKH_PLAIN_TAG)
#undef VKH_TAG
#undef VKH_PLAIN_TAG
}  // namespace fn

using Allocator = const VkAllocationCallbacks*;

/// The result that the call returns instead of being made.
template <class Tag, class... Args>
std::optional<VkResult> refusal(Tag, Table&, Args...) {
  return std::nullopt;
}
/// Whether to make a call that returns nothing.
template <class Tag, class... Args>
bool allowed(Tag, Table&, Args...) {
  return true;
}
/// Called after the call, if it succeeded.
template <class Tag, class... Args>
void made(Tag, Table&, Args...) {}
/// Sets the output parameters of a failed call: undefined, except where the specification demands
/// null.
template <class Tag, class... Args>
void spoil(Tag, Args...) {}
/// Called after an object was made, to record data for the checks.
template <class Info, class Object>
void learn(const Info&, Object) {}

void learn(const VkBufferCreateInfo& info, VkBuffer buffer);
void learn(const VkShaderModuleCreateInfo& info, VkShaderModule module);
void learn(const VkDescriptorSetLayoutCreateInfo& info, VkDescriptorSetLayout layout);

template <class Object>
void poison(Object* out) {
  *out = (Object)kPoison;  // NOLINT(performance-no-int-to-ptr): no pointer that anybody may use
}

#define VKH_OBJECT(X)                                                                           \
  inline void made(fn::Create##X, Table& table, VkDevice, const Vk##X##CreateInfo* info,        \
                   Allocator, Vk##X* out) {                                                     \
    add_object("Vk" #X, number_of(*out), number_of(table.device));                              \
    learn(*info, *out);                                                                         \
  }                                                                                             \
  inline void spoil(fn::Create##X, VkDevice, const Vk##X##CreateInfo*, Allocator, Vk##X* out) { \
    poison(out);                                                                                \
  }                                                                                             \
  inline bool allowed(fn::Destroy##X, Table&, VkDevice, Vk##X object, Allocator) {              \
    remove_objects_of(number_of(object));                                                       \
    return remove_object("Vk" #X, number_of(object));                                           \
  }
VKH_LAYER_OBJECTS(VKH_OBJECT)
#undef VKH_OBJECT

// objects.cpp: the objects that are made otherwise.
void made(fn::CreateDebugUtilsMessengerEXT, Table& table, VkInstance,
          const VkDebugUtilsMessengerCreateInfoEXT*, Allocator, VkDebugUtilsMessengerEXT* out);
bool allowed(fn::DestroyDebugUtilsMessengerEXT, Table& table, VkInstance,
             VkDebugUtilsMessengerEXT object, Allocator);
void made(fn::AllocateMemory, Table& table, VkDevice, const VkMemoryAllocateInfo* info, Allocator,
          VkDeviceMemory* out);
void spoil(fn::AllocateMemory, VkDevice, const VkMemoryAllocateInfo*, Allocator,
           VkDeviceMemory* out);
bool allowed(fn::FreeMemory, Table& table, VkDevice, VkDeviceMemory memory, Allocator);
void spoil(fn::MapMemory, VkDevice, VkDeviceMemory, VkDeviceSize, VkDeviceSize, VkMemoryMapFlags,
           void** out);
void made(fn::AllocateCommandBuffers, Table&, VkDevice, const VkCommandBufferAllocateInfo* info,
          VkCommandBuffer* out);
void spoil(fn::AllocateCommandBuffers, VkDevice, const VkCommandBufferAllocateInfo* info,
           VkCommandBuffer* out);
bool allowed(fn::FreeCommandBuffers, Table&, VkDevice, VkCommandPool, uint32_t count,
             const VkCommandBuffer* buffers);
void made(fn::AllocateDescriptorSets, Table&, VkDevice, const VkDescriptorSetAllocateInfo* info,
          VkDescriptorSet* out);
void spoil(fn::AllocateDescriptorSets, VkDevice, const VkDescriptorSetAllocateInfo* info,
           VkDescriptorSet* out);
void made(fn::FreeDescriptorSets, Table&, VkDevice, VkDescriptorPool, uint32_t count,
          const VkDescriptorSet* sets);
void made(fn::ResetDescriptorPool, Table&, VkDevice, VkDescriptorPool pool,
          VkDescriptorPoolResetFlags);
void made(fn::CreateComputePipelines, Table& table, VkDevice, VkPipelineCache, uint32_t count,
          const VkComputePipelineCreateInfo*, Allocator, VkPipeline* out);
void spoil(fn::CreateComputePipelines, VkDevice, VkPipelineCache, uint32_t count,
           const VkComputePipelineCreateInfo*, Allocator, VkPipeline* out);
void made(fn::CreateGraphicsPipelines, Table& table, VkDevice, VkPipelineCache, uint32_t count,
          const VkGraphicsPipelineCreateInfo*, Allocator, VkPipeline* out);
void spoil(fn::CreateGraphicsPipelines, VkDevice, VkPipelineCache, uint32_t count,
           const VkGraphicsPipelineCreateInfo*, Allocator, VkPipeline* out);
bool allowed(fn::DestroyPipeline, Table&, VkDevice, VkPipeline pipeline, Allocator);

// checks.cpp: limits and barriers.
std::optional<VkResult> refusal(fn::AllocateMemory, Table& table, VkDevice device,
                                const VkMemoryAllocateInfo* info, Allocator allocator,
                                VkDeviceMemory* out);
std::optional<VkResult> refusal(fn::MapMemory, Table& table, VkDevice, VkDeviceMemory memory,
                                VkDeviceSize, VkDeviceSize, VkMemoryMapFlags, void**);
std::optional<VkResult> refusal(fn::CreateBuffer, Table&, VkDevice, const VkBufferCreateInfo* info,
                                Allocator, VkBuffer*);
std::optional<VkResult> refusal(fn::CreateDescriptorSetLayout, Table&, VkDevice,
                                const VkDescriptorSetLayoutCreateInfo* info, Allocator,
                                VkDescriptorSetLayout*);
std::optional<VkResult> refusal(fn::CreatePipelineLayout, Table&, VkDevice,
                                const VkPipelineLayoutCreateInfo* info, Allocator,
                                VkPipelineLayout*);
std::optional<VkResult> refusal(fn::CreateComputePipelines, Table&, VkDevice, VkPipelineCache,
                                uint32_t count, const VkComputePipelineCreateInfo* infos, Allocator,
                                VkPipeline*);
std::optional<VkResult> refusal(fn::CreateShaderModule, Table& table, VkDevice device,
                                const VkShaderModuleCreateInfo* info, Allocator allocator,
                                VkShaderModule* out);
void made(fn::GetBufferMemoryRequirements, Table& table, VkDevice, VkBuffer,
          VkMemoryRequirements* requirements);
bool allowed(fn::UpdateDescriptorSets, Table&, VkDevice, uint32_t count,
             const VkWriteDescriptorSet* writes, uint32_t, const VkCopyDescriptorSet*);
bool allowed(fn::CmdPushDescriptorSetKHR, Table&, VkCommandBuffer, VkPipelineBindPoint,
             VkPipelineLayout, uint32_t, uint32_t count, const VkWriteDescriptorSet* writes);
bool allowed(fn::CmdDispatch, Table&, VkCommandBuffer, uint32_t x, uint32_t y, uint32_t z);
bool allowed(fn::CmdPipelineBarrier, Table&, VkCommandBuffer, VkPipelineStageFlags,
             VkPipelineStageFlags, VkDependencyFlags, uint32_t, const VkMemoryBarrier*, uint32_t,
             const VkBufferMemoryBarrier*, uint32_t, const VkImageMemoryBarrier*);
bool allowed(fn::CmdPipelineBarrier2, Table&, VkCommandBuffer, const VkDependencyInfo*);
bool allowed(fn::CmdPipelineBarrier2KHR, Table&, VkCommandBuffer, const VkDependencyInfo*);
// hazards.cpp: what the commands of a command buffer read and write.
void made(fn::BeginCommandBuffer, Table&, VkCommandBuffer commands,
          const VkCommandBufferBeginInfo*);
void made(fn::EndCommandBuffer, Table&, VkCommandBuffer commands);
bool allowed(fn::CmdBindPipeline, Table&, VkCommandBuffer commands, VkPipelineBindPoint,
             VkPipeline pipeline);
bool allowed(fn::CmdBindDescriptorSets, Table&, VkCommandBuffer commands, VkPipelineBindPoint,
             VkPipelineLayout, uint32_t, uint32_t count, const VkDescriptorSet* sets, uint32_t,
             const uint32_t*);
bool allowed(fn::CmdDispatchIndirect, Table&, VkCommandBuffer commands, VkBuffer sizes,
             VkDeviceSize offset);
bool allowed(fn::CmdFillBuffer, Table&, VkCommandBuffer commands, VkBuffer buffer,
             VkDeviceSize offset, VkDeviceSize size, uint32_t);
bool allowed(fn::CmdCopyBuffer, Table&, VkCommandBuffer commands, VkBuffer from, VkBuffer to,
             uint32_t count, const VkBufferCopy* regions);
/// The bytes in use by allocations; for the budget of `heapSize`.
void forget_allocation(uint64_t memory);
void keep_allocation(VkDevice device, const VkMemoryAllocateInfo& info, uint64_t memory);

// properties.cpp: the reported properties.
void made(fn::GetPhysicalDeviceProperties, Table&, VkPhysicalDevice, VkPhysicalDeviceProperties* p);
void made(fn::GetPhysicalDeviceProperties2, Table&, VkPhysicalDevice,
          VkPhysicalDeviceProperties2* p);
void made(fn::GetPhysicalDeviceProperties2KHR, Table&, VkPhysicalDevice,
          VkPhysicalDeviceProperties2* p);
void made(fn::GetPhysicalDeviceFeatures, Table&, VkPhysicalDevice, VkPhysicalDeviceFeatures* f);
void made(fn::GetPhysicalDeviceFeatures2, Table&, VkPhysicalDevice, VkPhysicalDeviceFeatures2* f);
void made(fn::GetPhysicalDeviceFeatures2KHR, Table&, VkPhysicalDevice,
          VkPhysicalDeviceFeatures2* f);
void made(fn::GetPhysicalDeviceMemoryProperties, Table&, VkPhysicalDevice,
          VkPhysicalDeviceMemoryProperties* m);
void made(fn::GetPhysicalDeviceMemoryProperties2, Table&, VkPhysicalDevice,
          VkPhysicalDeviceMemoryProperties2* m);
void made(fn::GetPhysicalDeviceQueueFamilyProperties, Table&, VkPhysicalDevice, uint32_t* count,
          VkQueueFamilyProperties* families);
void made(fn::GetPhysicalDeviceQueueFamilyProperties2, Table&, VkPhysicalDevice, uint32_t* count,
          VkQueueFamilyProperties2* families);
std::optional<VkResult> refusal(fn::EnumerateDeviceExtensionProperties, Table& table,
                                VkPhysicalDevice physical, const char* layer, uint32_t* count,
                                VkExtensionProperties* extensions);

}  // namespace vkh::layer
// NOLINTEND(readability-function-size)
