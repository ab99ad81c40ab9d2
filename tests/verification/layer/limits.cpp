#include "tests/verification/layer/limits.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "tests/verification/layer/settings.h"

namespace vkh::layer {
namespace {

// Members of VkPhysicalDeviceLimits: first those where less is lower, then those where more is.
#define VKH_MOST(X)                      \
  X(maxStorageBufferRange)               \
  X(maxUniformBufferRange)               \
  X(maxPushConstantsSize)                \
  X(maxMemoryAllocationCount)            \
  X(maxBoundDescriptorSets)              \
  X(maxPerStageDescriptorStorageBuffers) \
  X(maxPerStageResources)                \
  X(maxDescriptorSetStorageBuffers)      \
  X(maxComputeSharedMemorySize)          \
  X(maxComputeWorkGroupInvocations)      \
  X(maxDrawIndirectCount)                \
  X(timestampComputeAndGraphics)
#define VKH_LEAST(X)                  \
  X(minStorageBufferOffsetAlignment)  \
  X(minMemoryMapAlignment)            \
  X(optimalBufferCopyOffsetAlignment) \
  X(nonCoherentAtomSize)              \
  X(bufferImageGranularity)

// Members of the structures in the chain of VkPhysicalDeviceProperties2: limit, sType, structure,
// member.
#define VKH_MOST_CHAINED(X)                                                                      \
  X(maxPushDescriptors, PUSH_DESCRIPTOR_PROPERTIES_KHR, PushDescriptorPropertiesKHR,             \
    maxPushDescriptors)                                                                          \
  X(maxMemoryAllocationSize, MAINTENANCE_3_PROPERTIES, Maintenance3Properties,                   \
    maxMemoryAllocationSize)                                                                     \
  X(maxMemoryAllocationSize, VULKAN_1_1_PROPERTIES, Vulkan11Properties, maxMemoryAllocationSize) \
  X(maxBufferSize, MAINTENANCE_4_PROPERTIES, Maintenance4Properties, maxBufferSize)              \
  X(maxBufferSize, VULKAN_1_3_PROPERTIES, Vulkan13Properties, maxBufferSize)
#define VKH_SET_CHAINED(X)                                                                     \
  X(subgroupSize, SUBGROUP_PROPERTIES, SubgroupProperties, subgroupSize)                       \
  X(subgroupSize, VULKAN_1_1_PROPERTIES, Vulkan11Properties, subgroupSize)                     \
  X(minSubgroupSize, SUBGROUP_SIZE_CONTROL_PROPERTIES, SubgroupSizeControlProperties,          \
    minSubgroupSize)                                                                           \
  X(maxSubgroupSize, SUBGROUP_SIZE_CONTROL_PROPERTIES, SubgroupSizeControlProperties,          \
    maxSubgroupSize)                                                                           \
  X(minSubgroupSize, VULKAN_1_3_PROPERTIES, Vulkan13Properties, minSubgroupSize)               \
  X(maxSubgroupSize, VULKAN_1_3_PROPERTIES, Vulkan13Properties, maxSubgroupSize)               \
  X(subgroupSupportedOperations, SUBGROUP_PROPERTIES, SubgroupProperties, supportedOperations) \
  X(subgroupSupportedOperations, VULKAN_1_1_PROPERTIES, Vulkan11Properties,                    \
    subgroupSupportedOperations)

#define VKH_FEATURES(X)             \
  X(robustBufferAccess)             \
  X(shaderFloat64)                  \
  X(shaderInt64)                    \
  X(shaderInt16)                    \
  X(multiDrawIndirect)              \
  X(vertexPipelineStoresAndAtomics) \
  X(fragmentStoresAndAtomics)
#define VKH_FEATURES_CHAINED(X)                                                        \
  X(scalarBlockLayout, SCALAR_BLOCK_LAYOUT_FEATURES, ScalarBlockLayoutFeatures)        \
  X(scalarBlockLayout, VULKAN_1_2_FEATURES, Vulkan12Features)                          \
  X(bufferDeviceAddress, BUFFER_DEVICE_ADDRESS_FEATURES, BufferDeviceAddressFeatures)  \
  X(bufferDeviceAddress, VULKAN_1_2_FEATURES, Vulkan12Features)                        \
  X(timelineSemaphore, TIMELINE_SEMAPHORE_FEATURES, TimelineSemaphoreFeatures)         \
  X(timelineSemaphore, VULKAN_1_2_FEATURES, Vulkan12Features)                          \
  X(shaderFloat16, SHADER_FLOAT16_INT8_FEATURES, ShaderFloat16Int8Features)            \
  X(shaderFloat16, VULKAN_1_2_FEATURES, Vulkan12Features)                              \
  X(synchronization2, SYNCHRONIZATION_2_FEATURES, Synchronization2Features)            \
  X(synchronization2, VULKAN_1_3_FEATURES, Vulkan13Features)                           \
  X(subgroupSizeControl, SUBGROUP_SIZE_CONTROL_FEATURES, SubgroupSizeControlFeatures)  \
  X(subgroupSizeControl, VULKAN_1_3_FEATURES, Vulkan13Features)                        \
  X(computeFullSubgroups, SUBGROUP_SIZE_CONTROL_FEATURES, SubgroupSizeControlFeatures) \
  X(computeFullSubgroups, VULKAN_1_3_FEATURES, Vulkan13Features)                       \
  X(maintenance4, MAINTENANCE_4_FEATURES, Maintenance4Features)                        \
  X(maintenance4, VULKAN_1_3_FEATURES, Vulkan13Features)                               \
  X(robustBufferAccess2, ROBUSTNESS_2_FEATURES_EXT, Robustness2FeaturesEXT)            \
  X(nullDescriptor, ROBUSTNESS_2_FEATURES_EXT, Robustness2FeaturesEXT)

template <class T>
void to_most(T& value, const char* name) {
  if (const auto limit = settings().limit(name)) value = std::min(value, static_cast<T>(*limit));
}
template <class T>
void to_least(T& value, const char* name) {
  if (const auto limit = settings().limit(name)) value = std::max(value, static_cast<T>(*limit));
}
template <class T>
void set(T& value, const char* name) {
  if (const auto limit = settings().limit(name)) value = static_cast<T>(*limit);
}

bool is_hidden(const char* name) { return settings().hidden.contains(name); }

const std::map<std::string, std::vector<std::string>>& functions_of_extensions() {
  static const std::map<std::string, std::vector<std::string>> known{
      {"VK_KHR_push_descriptor",
       {"vkCmdPushDescriptorSetKHR", "vkCmdPushDescriptorSetWithTemplateKHR"}},
      {"VK_KHR_synchronization2",
       {"vkCmdPipelineBarrier2KHR", "vkCmdWriteTimestamp2KHR", "vkQueueSubmit2KHR",
        "vkCmdSetEvent2KHR", "vkCmdResetEvent2KHR", "vkCmdWaitEvents2KHR"}},
  };
  return known;
}

// Features of 1.3, as far as this project could want them.
const std::set<std::string>& functions_of_1_3() {
  static const std::set<std::string> known{
      "vkCmdPipelineBarrier2", "vkCmdWriteTimestamp2", "vkQueueSubmit2",  "vkCmdSetEvent2",
      "vkCmdResetEvent2",      "vkCmdWaitEvents2",     "vkCmdCopyBuffer2"};
  return known;
}

}  // namespace

bool is_limit(const std::string& name) {
  static const std::set<std::string> others{"maxComputeWorkGroupCount0",
                                            "maxComputeWorkGroupCount1",
                                            "maxComputeWorkGroupCount2",
                                            "maxComputeWorkGroupSize0",
                                            "maxComputeWorkGroupSize1",
                                            "maxComputeWorkGroupSize2",
                                            "apiVersion",
                                            "deviceType",
                                            "heapSize",
                                            "hostCached",
                                            "localMemory",
                                            "timestampValidBits"};
#define VKH_IS(limit, ...) \
  if (name == #limit) return true;
  VKH_MOST(VKH_IS)
  VKH_LEAST(VKH_IS)
  VKH_MOST_CHAINED(VKH_IS)
  VKH_SET_CHAINED(VKH_IS)
  return others.contains(name);
}

bool is_feature(const std::string& name) {
  VKH_FEATURES(VKH_IS)
  VKH_FEATURES_CHAINED(VKH_IS)
#undef VKH_IS
  return false;
}

void lower(VkPhysicalDeviceProperties& properties) {
  VkPhysicalDeviceLimits& limits = properties.limits;
#define VKH_LOWER(name) to_most(limits.name, #name);
  VKH_MOST(VKH_LOWER)
#undef VKH_LOWER
#define VKH_RAISE(name) to_least(limits.name, #name);
  VKH_LEAST(VKH_RAISE)
#undef VKH_RAISE
  for (uint32_t i = 0; i < 3; ++i) {
    const std::string axis = std::to_string(i);
    to_most(limits.maxComputeWorkGroupCount[i], ("maxComputeWorkGroupCount" + axis).c_str());
    to_most(limits.maxComputeWorkGroupSize[i], ("maxComputeWorkGroupSize" + axis).c_str());
  }
  to_most(properties.apiVersion, "apiVersion");
  if (const auto type = settings().limit("deviceType"))
    properties.deviceType = static_cast<VkPhysicalDeviceType>(*type);
}

bool is_split(const VkPhysicalDeviceMemoryProperties& of_driver) {
  return settings().limit("localMemory") && of_driver.memoryTypeCount == 1;
}

namespace {

void split(VkPhysicalDeviceMemoryProperties& memory) {
  constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  memory.memoryTypeCount = memory.memoryHeapCount = 2;
  memory.memoryTypes[1] = {memory.memoryTypes[0].propertyFlags & ~local, 1};
  memory.memoryTypes[0].propertyFlags = local;
  memory.memoryHeaps[1] = {memory.memoryHeaps[0].size, 0};
  to_most(memory.memoryHeaps[0].size, "localMemory");
}

}  // namespace

void lower(VkPhysicalDeviceMemoryProperties& memory) {
  if (is_split(memory)) split(memory);
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    to_most(memory.memoryHeaps[i].size, "heapSize");
  if (settings().limit("hostCached") != std::optional<uint64_t>(0)) return;
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    memory.memoryTypes[i].propertyFlags &=
        ~VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
}

void lower_chain(void* next) {
  for (auto* s = static_cast<VkBaseOutStructure*>(next); s != nullptr; s = s->pNext) {
#define VKH_LOWER(name, type, structure, member)            \
  if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_##type) \
    to_most(reinterpret_cast<VkPhysicalDevice##structure*>(s)->member, #name);
    VKH_MOST_CHAINED(VKH_LOWER)
#undef VKH_LOWER
#define VKH_SET(name, type, structure, member)              \
  if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_##type) \
    set(reinterpret_cast<VkPhysicalDevice##structure*>(s)->member, #name);
    VKH_SET_CHAINED(VKH_SET)
#undef VKH_SET
  }
}

void hide(VkPhysicalDeviceFeatures& features) {
#define VKH_HIDE(name) \
  if (is_hidden(#name)) features.name = VK_FALSE;
  VKH_FEATURES(VKH_HIDE)
#undef VKH_HIDE
}

void hide_chain(void* next) {
  for (auto* s = static_cast<VkBaseOutStructure*>(next); s != nullptr; s = s->pNext) {
    if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2)
      hide(reinterpret_cast<VkPhysicalDeviceFeatures2*>(s)->features);
#define VKH_HIDE(name, type, structure)                                         \
  if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_##type && is_hidden(#name)) \
    reinterpret_cast<VkPhysicalDevice##structure*>(s)->name = VK_FALSE;
    VKH_FEATURES_CHAINED(VKH_HIDE)
#undef VKH_HIDE
  }
}

std::string hidden_feature_of(const VkDeviceCreateInfo& info) {
  const auto in = [](const VkPhysicalDeviceFeatures& features) -> std::string {
#define VKH_WANTED(name) \
  if (features.name != VK_FALSE && is_hidden(#name)) return #name;
    VKH_FEATURES(VKH_WANTED)
#undef VKH_WANTED
    return "";
  };
  if (info.pEnabledFeatures != nullptr && !in(*info.pEnabledFeatures).empty())
    return in(*info.pEnabledFeatures);
  for (auto* s = static_cast<const VkBaseInStructure*>(info.pNext); s != nullptr; s = s->pNext) {
    if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2) {
      std::string name = in(reinterpret_cast<const VkPhysicalDeviceFeatures2*>(s)->features);
      if (!name.empty()) return name;
    }
#define VKH_WANTED(name, type, structure)                                         \
  if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_##type && is_hidden(#name) && \
      reinterpret_cast<const VkPhysicalDevice##structure*>(s)->name != VK_FALSE)  \
    return #name;
    VKH_FEATURES_CHAINED(VKH_WANTED)
#undef VKH_WANTED
  }
  return "";
}

bool is_hidden_function(const std::string& function) {
  for (const std::string& hidden : settings().hidden) {
    const auto found = functions_of_extensions().find(hidden);
    if (found == functions_of_extensions().end()) continue;
    if (std::find(found->second.begin(), found->second.end(), function) != found->second.end())
      return true;
  }
  const auto version = settings().limit("apiVersion");
  return version && *version < VK_API_VERSION_1_3 && functions_of_1_3().contains(function);
}

}  // namespace vkh::layer
