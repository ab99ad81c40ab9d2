#include "host/app/device_properties.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "host/gpu/queue_family.h"
#include "host/gpu/vulkan_api.h"

namespace vkh {
namespace {

/// The chain that Vulkan fills, each structure once.
struct Properties {
  VkPhysicalDeviceProperties2 base{};
  VkPhysicalDeviceVulkan11Properties v11{};
  VkPhysicalDeviceVulkan12Properties v12{};
  VkPhysicalDevicePushDescriptorPropertiesKHR push{};
  VkPhysicalDeviceSubgroupSizeControlProperties sizes{};

  Properties(const Device& device, bool has_push, bool has_sizes) {
    base.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
    push.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PUSH_DESCRIPTOR_PROPERTIES_KHR;
    sizes.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES;
    base.pNext = &v11;
    v11.pNext = &v12;
    if (has_push) v12.pNext = &push;
    if (has_sizes) (has_push ? push.pNext : v12.pNext) = &sizes;
    device.vk().GetPhysicalDeviceProperties2(device.physical(), &base);
  }
  Properties(const Properties&) = delete;
  Properties& operator=(const Properties&) = delete;
};

struct Features {
  VkPhysicalDeviceFeatures2 base{};
  VkPhysicalDeviceVulkan11Features v11{};
  VkPhysicalDeviceVulkan12Features v12{};
  VkPhysicalDeviceSynchronization2Features synchronization{};

  explicit Features(const Device& device) {
    base.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    synchronization.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES;
    base.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &synchronization;
    device.vk().GetPhysicalDeviceFeatures2(device.physical(), &base);
  }
  Features(const Features&) = delete;
  Features& operator=(const Features&) = delete;
};

std::vector<VkExtensionProperties> extensions_of(const Device& device) {
  return list_of<VkExtensionProperties>([&](uint32_t* count, VkExtensionProperties* all) {
    check(device.vk().EnumerateDeviceExtensionProperties(device.physical(), nullptr, count, all),
          "the list of extensions");
  });
}

Json extensions_json(const std::vector<VkExtensionProperties>& list) {
  std::vector<std::pair<std::string, uint32_t>> rows;
  rows.reserve(list.size());
  for (const VkExtensionProperties& e : list) rows.emplace_back(e.extensionName, e.specVersion);
  std::sort(rows.begin(), rows.end());
  Json json = Json::object();
  for (const auto& [name, version] : rows) json[name] = version;
  return json;
}

// Vulkan's own names, and the values.
#define VKH_MEMBER(name) json[#name] = from.name;
#define VKH_TRUTH(name) json[#name] = from.name == VK_TRUE;

Json limits_json(const VkPhysicalDeviceLimits& from) {
  Json json = Json::object();
  VKH_MEMBER(maxComputeSharedMemorySize)
  VKH_MEMBER(maxComputeWorkGroupInvocations)
  VKH_MEMBER(maxComputeWorkGroupCount)
  VKH_MEMBER(maxComputeWorkGroupSize)
  VKH_MEMBER(maxStorageBufferRange)
  VKH_MEMBER(maxPushConstantsSize)
  VKH_MEMBER(maxMemoryAllocationCount)
  VKH_MEMBER(maxBoundDescriptorSets)
  VKH_MEMBER(maxPerStageDescriptorStorageBuffers)
  VKH_MEMBER(maxPerStageResources)
  VKH_MEMBER(maxDescriptorSetStorageBuffers)
  VKH_MEMBER(minMemoryMapAlignment)
  VKH_MEMBER(minStorageBufferOffsetAlignment)
  VKH_MEMBER(nonCoherentAtomSize)
  VKH_MEMBER(timestampPeriod)
  VKH_TRUTH(timestampComputeAndGraphics)
  return json;
}

Json subgroup_json(const VkPhysicalDeviceVulkan11Properties& from, const Properties& all,
                   bool has_sizes) {
  Json json = Json::object();
  VKH_MEMBER(subgroupSize)
  VKH_MEMBER(subgroupSupportedStages)
  VKH_MEMBER(subgroupSupportedOperations)
  VKH_TRUTH(subgroupQuadOperationsInAllStages)
  json["minSubgroupSize"] = has_sizes ? Json(all.sizes.minSubgroupSize) : Json();
  json["maxSubgroupSize"] = has_sizes ? Json(all.sizes.maxSubgroupSize) : Json();
  return json;
}

Json float_controls_json(const VkPhysicalDeviceVulkan12Properties& from) {
  Json json = Json::object();
  VKH_MEMBER(denormBehaviorIndependence)
  VKH_MEMBER(roundingModeIndependence)
  VKH_TRUTH(shaderSignedZeroInfNanPreserveFloat32)
  VKH_TRUTH(shaderDenormPreserveFloat32)
  VKH_TRUTH(shaderDenormFlushToZeroFloat32)
  VKH_TRUTH(shaderRoundingModeRTEFloat32)
  VKH_TRUTH(shaderRoundingModeRTZFloat32)
  return json;
}

void add_core_features(Json& json, const VkPhysicalDeviceFeatures& from) {
  VKH_TRUTH(robustBufferAccess)
  VKH_TRUTH(shaderInt64)
  VKH_TRUTH(shaderFloat64)
  VKH_TRUTH(shaderInt16)
  VKH_TRUTH(pipelineStatisticsQuery)
}

void add_features(Json& json, const VkPhysicalDeviceVulkan12Features& from){
    VKH_TRUTH(storageBuffer8BitAccess) VKH_TRUTH(shaderBufferInt64Atomics)
        VKH_TRUTH(shaderSharedInt64Atomics) VKH_TRUTH(shaderFloat16) VKH_TRUTH(shaderInt8)
            VKH_TRUTH(scalarBlockLayout) VKH_TRUTH(shaderSubgroupExtendedTypes)
                VKH_TRUTH(hostQueryReset) VKH_TRUTH(timelineSemaphore)
                    VKH_TRUTH(bufferDeviceAddress) VKH_TRUTH(vulkanMemoryModel)
                        VKH_TRUTH(vulkanMemoryModelDeviceScope)}
#undef VKH_MEMBER
#undef VKH_TRUTH

Json features_json(const Device& device) {
  const Features all(device);
  Json json = Json::object();
  add_core_features(json, all.base.features);
  json["storageBuffer16BitAccess"] = all.v11.storageBuffer16BitAccess == VK_TRUE;
  add_features(json, all.v12);
  json["synchronization2"] = all.synchronization.synchronization2 == VK_TRUE;
  return json;
}

Json queues_json(const Device& device) {
  Json rows = Json::array();
  for (const VkQueueFamilyProperties& f : queue_families(device.vk(), device.physical()))
    rows.push_back({{"queueFlags", f.queueFlags},
                    {"queueCount", f.queueCount},
                    {"timestampValidBits", f.timestampValidBits}});
  return rows;
}

Json memory_json(const Device& device) {
  VkPhysicalDeviceMemoryProperties memory;
  device.vk().GetPhysicalDeviceMemoryProperties(device.physical(), &memory);
  Json heaps = Json::array(), types = Json::array();
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    heaps.push_back({{"size", memory.memoryHeaps[i].size}, {"flags", memory.memoryHeaps[i].flags}});
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    types.push_back({{"heapIndex", memory.memoryTypes[i].heapIndex},
                     {"propertyFlags", memory.memoryTypes[i].propertyFlags}});
  return {{"memoryHeaps", heaps}, {"memoryTypes", types}};
}

Json driver_json(const Properties& all) {
  const VkConformanceVersion& c = all.v12.conformanceVersion;
  return {{"driverID", static_cast<uint32_t>(all.v12.driverID)},
          {"driverName", all.v12.driverName},
          {"driverInfo", all.v12.driverInfo},
          {"driverVersion", all.base.properties.driverVersion},
          {"conformanceVersion", std::to_string(c.major) + "." + std::to_string(c.minor) + "." +
                                     std::to_string(c.subminor) + "." + std::to_string(c.patch)}};
}

}  // namespace

Json properties_json(const Device& device) {
  const std::vector<VkExtensionProperties> extensions = extensions_of(device);
  const auto has = [&](std::string_view name) {
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const VkExtensionProperties& e) { return e.extensionName == name; });
  };
  const bool has_push = has(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
  const bool has_sizes = has(VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME);
  const Properties all(device, has_push, has_sizes);
  const VkPhysicalDeviceProperties& base = all.base.properties;
  Json json = {{"deviceName", base.deviceName},
               {"deviceType", device.description().type},
               {"vendorID", base.vendorID},
               {"deviceID", base.deviceID},
               {"apiVersion", device.description().api_version},
               {"driver", driver_json(all)},
               {"limits", limits_json(base.limits)}};
  json["limits"]["maxMemoryAllocationSize"] = all.v11.maxMemoryAllocationSize;
  json["limits"]["maxPushDescriptors"] = has_push ? Json(all.push.maxPushDescriptors) : Json();
  json["subgroup"] = subgroup_json(all.v11, all, has_sizes);
  json["float_controls"] = float_controls_json(all.v12);
  json["features"] = features_json(device);
  json["extensions"] = extensions_json(extensions);
  json["queue_families"] = queues_json(device);
  json["memory"] = memory_json(device);
  return json;
}

std::string loader_version() {
  const auto enumerate = reinterpret_cast<PFN_vkEnumerateInstanceVersion>(
      load_vulkan().GetInstanceProcAddr(VK_NULL_HANDLE, "vkEnumerateInstanceVersion"));
  uint32_t version = VK_API_VERSION_1_0;
  if (enumerate != nullptr) enumerate(&version);
  return version_text(version);
}

const char* system_name() {
#if defined(_WIN32)
#define VKH_SYSTEM "Windows"
#elif defined(__APPLE__)
#define VKH_SYSTEM "macOS"
#elif defined(__linux__)
#define VKH_SYSTEM "Linux"
#else
#define VKH_SYSTEM "another system"
#endif
#if defined(__x86_64__) || defined(_M_X64)
  return VKH_SYSTEM " x86-64";
#elif defined(__aarch64__) || defined(_M_ARM64)
  return VKH_SYSTEM " ARM64";
#else
  return VKH_SYSTEM ", another processor";
#endif
#undef VKH_SYSTEM
}

}  // namespace vkh
