// The Vulkan functions that the test layer stands before, each named once. The possible results of
// a function are the specification's (vk.xml; tools/lint/layer_functions_test.py compares).
#pragma once

#include <vulkan/vulkan.h>

namespace vkh::layer {

enum Error : unsigned {
  kHostMemory = 1u << 0,
  kDeviceMemory = 1u << 1,
  kLost = 1u << 2,
  kInitialization = 1u << 3,
  kMapFailed = 1u << 4,
  kLayerMissing = 1u << 5,
  kExtensionMissing = 1u << 6,
  kFeatureMissing = 1u << 7,
  kTooManyObjects = 1u << 8,
  kIncompatible = 1u << 9,
  kFragmentedPool = 1u << 10,
  kPoolMemory = 1u << 11,
  kFragmentation = 1u << 12,
  kMemory = kHostMemory | kDeviceMemory,
  kMemoryOrLost = kMemory | kLost,
};

#define VKH_LAYER_ERRORS(X)                            \
  X(kHostMemory, VK_ERROR_OUT_OF_HOST_MEMORY)          \
  X(kDeviceMemory, VK_ERROR_OUT_OF_DEVICE_MEMORY)      \
  X(kLost, VK_ERROR_DEVICE_LOST)                       \
  X(kInitialization, VK_ERROR_INITIALIZATION_FAILED)   \
  X(kMapFailed, VK_ERROR_MEMORY_MAP_FAILED)            \
  X(kLayerMissing, VK_ERROR_LAYER_NOT_PRESENT)         \
  X(kExtensionMissing, VK_ERROR_EXTENSION_NOT_PRESENT) \
  X(kFeatureMissing, VK_ERROR_FEATURE_NOT_PRESENT)     \
  X(kTooManyObjects, VK_ERROR_TOO_MANY_OBJECTS)        \
  X(kIncompatible, VK_ERROR_INCOMPATIBLE_DRIVER)       \
  X(kFragmentedPool, VK_ERROR_FRAGMENTED_POOL)         \
  X(kPoolMemory, VK_ERROR_OUT_OF_POOL_MEMORY)          \
  X(kFragmentation, VK_ERROR_FRAGMENTATION)

constexpr unsigned kCreateInstanceErrors =
    kMemory | kInitialization | kLayerMissing | kExtensionMissing | kIncompatible;
constexpr unsigned kCreateDeviceErrors =
    kMemoryOrLost | kInitialization | kExtensionMissing | kFeatureMissing | kTooManyObjects;

// The functions that return a VkResult: of an instance, and of a device. vkCreateInstance and
// vkCreateDevice are layer.cpp's.
#define VKH_LAYER_INSTANCE_FALLIBLE(X)                           \
  X(EnumeratePhysicalDevices, kMemory | kInitialization)         \
  X(EnumerateDeviceExtensionProperties, kMemory | kLayerMissing) \
  X(CreateDebugUtilsMessengerEXT, kHostMemory)

#define VKH_LAYER_DEVICE_FALLIBLE(X)                                 \
  X(QueueSubmit, kMemoryOrLost)                                      \
  X(QueueSubmit2, kMemoryOrLost)                                     \
  X(QueueSubmit2KHR, kMemoryOrLost)                                  \
  X(QueueWaitIdle, kMemoryOrLost)                                    \
  X(DeviceWaitIdle, kMemoryOrLost)                                   \
  X(AllocateMemory, kMemory)                                         \
  X(MapMemory, kMemory | kMapFailed)                                 \
  X(FlushMappedMemoryRanges, kMemory)                                \
  X(InvalidateMappedMemoryRanges, kMemory)                           \
  X(BindBufferMemory, kMemory)                                       \
  X(BindBufferMemory2, kMemory)                                      \
  X(BindImageMemory, kMemory)                                        \
  X(SetDebugUtilsObjectNameEXT, kMemory)                             \
  X(CreateFence, kMemory)                                            \
  X(ResetFences, kDeviceMemory)                                      \
  X(GetFenceStatus, kMemoryOrLost)                                   \
  X(WaitForFences, kMemoryOrLost)                                    \
  X(CreateSemaphore, kMemory)                                        \
  X(WaitSemaphores, kMemoryOrLost)                                   \
  X(SignalSemaphore, kMemory)                                        \
  X(GetSemaphoreCounterValue, kMemoryOrLost)                         \
  X(CreateEvent, kMemory)                                            \
  X(CreateQueryPool, kMemory)                                        \
  X(GetQueryPoolResults, kMemoryOrLost)                              \
  X(CreateBuffer, kMemory)                                           \
  X(CreateBufferView, kMemory)                                       \
  X(CreateImage, kMemory)                                            \
  X(CreateImageView, kMemory)                                        \
  X(CreateSampler, kMemory)                                          \
  X(CreateFramebuffer, kMemory)                                      \
  X(CreateRenderPass, kMemory)                                       \
  X(CreateShaderModule, kMemory)                                     \
  X(CreatePipelineCache, kMemory)                                    \
  X(GetPipelineCacheData, kMemory)                                   \
  X(MergePipelineCaches, kMemory)                                    \
  X(CreateComputePipelines, kMemory)                                 \
  X(CreateGraphicsPipelines, kMemory)                                \
  X(CreatePipelineLayout, kMemory)                                   \
  X(CreateDescriptorSetLayout, kMemory)                              \
  X(CreateDescriptorPool, kMemory | kFragmentation)                  \
  X(AllocateDescriptorSets, kMemory | kFragmentedPool | kPoolMemory) \
  X(CreateDescriptorUpdateTemplate, kMemory)                         \
  X(CreateCommandPool, kMemory)                                      \
  X(ResetCommandPool, kDeviceMemory)                                 \
  X(AllocateCommandBuffers, kMemory)                                 \
  X(BeginCommandBuffer, kMemory)                                     \
  X(EndCommandBuffer, kMemory)                                       \
  X(ResetCommandBuffer, kDeviceMemory)

// Made by vkCreateX(device, info, allocator, &object), ended by vkDestroyX(device, object,
// allocator). The others are objects.cpp's.
#define VKH_LAYER_OBJECTS(X)  \
  X(Fence)                    \
  X(Semaphore)                \
  X(Event)                    \
  X(QueryPool)                \
  X(Buffer)                   \
  X(BufferView)               \
  X(Image)                    \
  X(ImageView)                \
  X(Sampler)                  \
  X(Framebuffer)              \
  X(RenderPass)               \
  X(ShaderModule)             \
  X(PipelineCache)            \
  X(PipelineLayout)           \
  X(DescriptorSetLayout)      \
  X(DescriptorPool)           \
  X(DescriptorUpdateTemplate) \
  X(CommandPool)

// The functions that return nothing and are checked.
#define VKH_LAYER_INSTANCE_VOID(X)          \
  X(DestroyDebugUtilsMessengerEXT)          \
  X(GetPhysicalDeviceProperties)            \
  X(GetPhysicalDeviceProperties2)           \
  X(GetPhysicalDeviceProperties2KHR)        \
  X(GetPhysicalDeviceFeatures)              \
  X(GetPhysicalDeviceFeatures2)             \
  X(GetPhysicalDeviceFeatures2KHR)          \
  X(GetPhysicalDeviceMemoryProperties)      \
  X(GetPhysicalDeviceMemoryProperties2)     \
  X(GetPhysicalDeviceQueueFamilyProperties) \
  X(GetPhysicalDeviceQueueFamilyProperties2)

#define VKH_LAYER_DEVICE_VOID(X)     \
  X(DestroyFence)                    \
  X(DestroySemaphore)                \
  X(DestroyEvent)                    \
  X(DestroyQueryPool)                \
  X(DestroyBuffer)                   \
  X(DestroyBufferView)               \
  X(DestroyImage)                    \
  X(DestroyImageView)                \
  X(DestroySampler)                  \
  X(DestroyFramebuffer)              \
  X(DestroyRenderPass)               \
  X(DestroyShaderModule)             \
  X(DestroyPipelineCache)            \
  X(DestroyPipelineLayout)           \
  X(DestroyDescriptorSetLayout)      \
  X(DestroyDescriptorPool)           \
  X(DestroyDescriptorUpdateTemplate) \
  X(DestroyCommandPool)              \
  X(DestroyPipeline)                 \
  X(GetBufferMemoryRequirements)     \
  X(FreeMemory)                      \
  X(FreeCommandBuffers)              \
  X(UpdateDescriptorSets)            \
  X(CmdPushDescriptorSetKHR)         \
  X(CmdPushConstants)                \
  X(CmdBindPipeline)                 \
  X(CmdBindDescriptorSets)           \
  X(CmdDispatch)                     \
  X(CmdDispatchIndirect)             \
  X(CmdFillBuffer)                   \
  X(CmdCopyBuffer)                   \
  X(CmdDispatchBase)                 \
  X(CmdPipelineBarrier)              \
  X(CmdPipelineBarrier2)             \
  X(CmdPipelineBarrier2KHR)

// The functions that return a VkResult and no error.
#define VKH_LAYER_DEVICE_SAFE(X) \
  X(ResetDescriptorPool)         \
  X(FreeDescriptorSets)

}  // namespace vkh::layer
