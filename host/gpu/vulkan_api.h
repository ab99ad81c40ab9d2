// The Vulkan functions that host/ calls, loaded at run time: a machine without a loader gets a
// sentence, not a linker error.
#pragma once

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

namespace vkh {

#define VKH_GLOBAL_API(X)                 \
  X(CreateInstance)                       \
  X(EnumerateInstanceExtensionProperties) \
  X(EnumerateInstanceLayerProperties)

#define VKH_INSTANCE_API(X)                 \
  X(DestroyInstance)                        \
  X(EnumeratePhysicalDevices)               \
  X(EnumerateDeviceExtensionProperties)     \
  X(GetPhysicalDeviceFeatures2)             \
  X(GetPhysicalDeviceProperties2)           \
  X(GetPhysicalDeviceMemoryProperties)      \
  X(GetPhysicalDeviceQueueFamilyProperties) \
  X(CreateDevice)

#define VKH_DEVICE_API(X)        \
  X(DestroyDevice)               \
  X(GetDeviceQueue)              \
  X(DeviceWaitIdle)              \
  X(CreateBuffer)                \
  X(DestroyBuffer)               \
  X(GetBufferMemoryRequirements) \
  X(AllocateMemory)              \
  X(FreeMemory)                  \
  X(BindBufferMemory)            \
  X(MapMemory)                   \
  X(CreateCommandPool)           \
  X(DestroyCommandPool)          \
  X(AllocateCommandBuffers)      \
  X(ResetCommandPool)            \
  X(BeginCommandBuffer)          \
  X(EndCommandBuffer)            \
  X(CmdCopyBuffer)               \
  X(CmdPipelineBarrier)          \
  X(CmdResetQueryPool)           \
  X(CmdWriteTimestamp)           \
  X(CmdBindPipeline)             \
  X(CmdBindDescriptorSets)       \
  X(CmdDispatch)                 \
  X(CreateShaderModule)          \
  X(DestroyShaderModule)         \
  X(CreateDescriptorSetLayout)   \
  X(DestroyDescriptorSetLayout)  \
  X(CreateDescriptorPool)        \
  X(DestroyDescriptorPool)       \
  X(AllocateDescriptorSets)      \
  X(UpdateDescriptorSets)        \
  X(CreatePipelineLayout)        \
  X(DestroyPipelineLayout)       \
  X(CreateComputePipelines)      \
  X(CreatePipelineCache)         \
  X(DestroyPipelineCache)        \
  X(GetPipelineCacheData)        \
  X(DestroyPipeline)             \
  X(QueueSubmit)                 \
  X(CreateFence)                 \
  X(DestroyFence)                \
  X(ResetFences)                 \
  X(WaitForFences)               \
  X(CreateQueryPool)             \
  X(DestroyQueryPool)            \
  X(GetQueryPoolResults)         \
  X(CreateImage)                 \
  X(DestroyImage)                \
  X(GetImageMemoryRequirements)  \
  X(BindImageMemory)             \
  X(CreateImageView)             \
  X(DestroyImageView)            \
  X(CreateRenderPass)            \
  X(DestroyRenderPass)           \
  X(CreateFramebuffer)           \
  X(DestroyFramebuffer)          \
  X(CreateGraphicsPipelines)     \
  X(CmdBeginRenderPass)          \
  X(CmdEndRenderPass)            \
  X(CmdBindVertexBuffers)        \
  X(CmdPushConstants)            \
  X(CmdSetViewport)              \
  X(CmdSetScissor)               \
  X(CmdDraw)                     \
  X(CmdCopyImageToBuffer)

struct VulkanApi {
  PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
  PFN_vkGetDeviceProcAddr GetDeviceProcAddr = nullptr;
#define VKH_MEMBER(name) PFN_vk##name name = nullptr;
  VKH_GLOBAL_API(VKH_MEMBER)
  VKH_INSTANCE_API(VKH_MEMBER)
  VKH_DEVICE_API(VKH_MEMBER)
#undef VKH_MEMBER
};

/// Lists what Vulkan reports in two calls: first the number, then the items. `call` takes the count
/// and the array.
template <class T, class Call>
std::vector<T> list_of(const Call& call) {
  uint32_t count = 0;
  call(&count, nullptr);
  std::vector<T> list(count);
  call(&count, list.data());
  return list;
}

/// A version of Vulkan for people: "1.3.230".
std::string version_text(uint32_t version);

/// Opens the loader. Throws DeviceError if there is none.
VulkanApi load_vulkan();
void load_instance(VulkanApi& vk, VkInstance instance);
void load_device(VulkanApi& vk, VkDevice device);

/// Throws DeviceError: "`what` failed: out of host memory", or another reason.
void check(VkResult result, const char* what);
/// Throws the same way, and sets a handle that could not be made to null, which Vulkan does not
/// promise.
template <class Handle>
void check_made(VkResult result, Handle& handle, const char* what) {
  if (result != VK_SUCCESS) handle = VK_NULL_HANDLE;
  check(result, what);
}

}  // namespace vkh
