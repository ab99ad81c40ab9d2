// A context: the pipelines of every kernel on the caller's device, and the Vulkan functions that
// recording needs.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "engine/slice.h"
#include "engine/vkhausdorff.h"

namespace vkh {

#define VKH_DEVICE_FUNCTIONS(X) \
  X(CreateDescriptorSetLayout)  \
  X(DestroyDescriptorSetLayout) \
  X(CreatePipelineLayout)       \
  X(DestroyPipelineLayout)      \
  X(CreateShaderModule)         \
  X(DestroyShaderModule)        \
  X(CreateComputePipelines)     \
  X(DestroyPipeline)            \
  X(CmdBindPipeline)            \
  X(CmdDispatch)                \
  X(CmdDispatchIndirect)        \
  X(CmdFillBuffer)              \
  X(CmdCopyBuffer)              \
  X(CmdPushConstants)
// Functions of Vulkan 1.3; of VK_KHR_synchronization2 before.
#define VKH_PROMOTED_FUNCTIONS(X) \
  X(CmdPipelineBarrier2)          \
  X(CmdWriteTimestamp2)
#define VKH_PUSH_FUNCTIONS(X) X(CmdPushDescriptorSetKHR)
// Functions for devices where descriptors cannot be pushed.
#define VKH_SET_FUNCTIONS(X) \
  X(CreateDescriptorPool)    \
  X(DestroyDescriptorPool)   \
  X(AllocateDescriptorSets)  \
  X(UpdateDescriptorSets)    \
  X(CmdBindDescriptorSets)

// The function for large buffers that are given by address (engine/by_address.h).
#define VKH_ADDRESS_FUNCTIONS(X) X(GetBufferDeviceAddress)

// Labels and names for captures; null unless the caller has enabled VK_EXT_debug_utils.
#define VKH_OPTIONAL_FUNCTIONS(X) \
  X(CmdBeginDebugUtilsLabelEXT)   \
  X(CmdEndDebugUtilsLabelEXT)     \
  X(SetDebugUtilsObjectNameEXT)

// The engine links no prototypes: the loader belongs to the caller.
struct DeviceFunctions {
#define VKH_DECLARE(name) PFN_vk##name name = nullptr;
  VKH_DEVICE_FUNCTIONS(VKH_DECLARE)
  VKH_PROMOTED_FUNCTIONS(VKH_DECLARE)
  VKH_PUSH_FUNCTIONS(VKH_DECLARE)
  VKH_SET_FUNCTIONS(VKH_DECLARE)
  VKH_ADDRESS_FUNCTIONS(VKH_DECLARE)
  VKH_OPTIONAL_FUNCTIONS(VKH_DECLARE)
#undef VKH_DECLARE
};

struct KernelPipeline {
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
  uint32_t by_address = 0;  // bindings, as bits, that are addresses instead
};

constexpr uint32_t kMaxKernels = 64;

struct Limits {
  VkDeviceSize storage_range = 0;  // bytes of one binding
  uint32_t switches = 0;           // of the context: some switches add streams
  bool wide = true;                // many workgroups run at once (base/switches.glsl)
  bool cpu = false;                // the device is a CPU
  bool pushes = true;              // it has push descriptors
  bool by_address = false;         // of the context: how large buffers are given by address
  VkDeviceSize allocation = ~VkDeviceSize{0};  // bytes of one allocation
};

class SetStore;  // engine/descriptors.h
class Misuses;   // engine/checks.h

}  // namespace vkh

struct VkhContext_T {
  VkDevice device = VK_NULL_HANDLE;
  vkh::DeviceFunctions vk;
  vkh::Limits limits;
  std::array<vkh::KernelPipeline, vkh::kMaxKernels> kernels{};
  // Null if descriptors are pushed. A shared_ptr can destroy a type that is incomplete here:
  // members that are not inline would be exported with the C interface.
  std::shared_ptr<vkh::SetStore> sets;
  std::shared_ptr<vkh::Misuses> misuses;  // null if calls are not checked for the caller
};
