// Objects that are made several at a time, or belong to a pool.
#include "tests/verification/layer/hazards.h"
#include "tests/verification/layer/rules.h"

// Parameters are as many as Vulkan has.
// NOLINTBEGIN(readability-function-size)
namespace vkh::layer {
namespace {

void keep_pipelines(const Table& table, uint32_t count, const VkPipeline* out) {
  for (uint32_t i = 0; i < count; ++i)
    add_object("VkPipeline", number_of(out[i]), number_of(table.device));
}

template <class Object>
void to_null(uint32_t count, Object* out) {
  for (uint32_t i = 0; i < count; ++i) out[i] = VK_NULL_HANDLE;
}

}  // namespace

void made(fn::CreateDebugUtilsMessengerEXT, Table& table, VkInstance,
          const VkDebugUtilsMessengerCreateInfoEXT*, Allocator, VkDebugUtilsMessengerEXT* out) {
  add_object("VkDebugUtilsMessengerEXT", number_of(*out), number_of(table.instance));
}

bool allowed(fn::DestroyDebugUtilsMessengerEXT, Table&, VkInstance, VkDebugUtilsMessengerEXT object,
             Allocator) {
  return remove_object("VkDebugUtilsMessengerEXT", number_of(object));
}

void made(fn::AllocateMemory, Table& table, VkDevice device, const VkMemoryAllocateInfo* info,
          Allocator, VkDeviceMemory* out) {
  add_object("VkDeviceMemory", number_of(*out), number_of(table.device));
  keep_allocation(device, *info, number_of(*out));
}

void spoil(fn::AllocateMemory, VkDevice, const VkMemoryAllocateInfo*, Allocator,
           VkDeviceMemory* out) {
  poison(out);
}

bool allowed(fn::FreeMemory, Table&, VkDevice, VkDeviceMemory memory, Allocator) {
  forget_allocation(number_of(memory));
  return remove_object("VkDeviceMemory", number_of(memory));
}

void spoil(fn::MapMemory, VkDevice, VkDeviceMemory, VkDeviceSize, VkDeviceSize, VkMemoryMapFlags,
           void** out) {
  poison(out);
}

void made(fn::AllocateCommandBuffers, Table&, VkDevice, const VkCommandBufferAllocateInfo* info,
          VkCommandBuffer* out) {
  for (uint32_t i = 0; i < info->commandBufferCount; ++i)
    add_object("VkCommandBuffer", number_of(out[i]), number_of(info->commandPool));
}

void spoil(fn::AllocateCommandBuffers, VkDevice, const VkCommandBufferAllocateInfo* info,
           VkCommandBuffer* out) {
  to_null(info->commandBufferCount, out);
}

bool allowed(fn::FreeCommandBuffers, Table&, VkDevice, VkCommandPool, uint32_t count,
             const VkCommandBuffer* buffers) {
  bool all = true;
  for (uint32_t i = 0; i < count; ++i)
    all = remove_object("VkCommandBuffer", number_of(buffers[i])) && all;
  return all;
}

void made(fn::AllocateDescriptorSets, Table&, VkDevice, const VkDescriptorSetAllocateInfo* info,
          VkDescriptorSet* out) {
  for (uint32_t i = 0; i < info->descriptorSetCount; ++i)
    add_object("VkDescriptorSet", number_of(out[i]), number_of(info->descriptorPool));
}

void spoil(fn::AllocateDescriptorSets, VkDevice, const VkDescriptorSetAllocateInfo* info,
           VkDescriptorSet* out) {
  to_null(info->descriptorSetCount, out);
}

void made(fn::FreeDescriptorSets, Table&, VkDevice, VkDescriptorPool, uint32_t count,
          const VkDescriptorSet* sets) {
  for (uint32_t i = 0; i < count; ++i) remove_object("VkDescriptorSet", number_of(sets[i]));
}

void made(fn::ResetDescriptorPool, Table&, VkDevice, VkDescriptorPool pool,
          VkDescriptorPoolResetFlags) {
  remove_objects_of(number_of(pool));
}

void made(fn::CreateComputePipelines, Table& table, VkDevice, VkPipelineCache, uint32_t count,
          const VkComputePipelineCreateInfo* infos, Allocator, VkPipeline* out) {
  keep_pipelines(table, count, out);
  follow_pipelines({infos, count}, out);
}

void spoil(fn::CreateComputePipelines, VkDevice, VkPipelineCache, uint32_t count,
           const VkComputePipelineCreateInfo*, Allocator, VkPipeline* out) {
  to_null(count, out);
}

void made(fn::CreateGraphicsPipelines, Table& table, VkDevice, VkPipelineCache, uint32_t count,
          const VkGraphicsPipelineCreateInfo*, Allocator, VkPipeline* out) {
  keep_pipelines(table, count, out);
}

void spoil(fn::CreateGraphicsPipelines, VkDevice, VkPipelineCache, uint32_t count,
           const VkGraphicsPipelineCreateInfo*, Allocator, VkPipeline* out) {
  to_null(count, out);
}

bool allowed(fn::DestroyPipeline, Table&, VkDevice, VkPipeline pipeline, Allocator) {
  return remove_object("VkPipeline", number_of(pipeline));
}

}  // namespace vkh::layer
// NOLINTEND(readability-function-size)
