#include "engine/support.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>
#include <vector>

#include "engine/command.h"
#include "engine/kernels.h"

namespace vkh {
namespace {

// The extensions that are used if the device has them. Without the first the device needs Vulkan
// 1.3; without the second the engine uses descriptor sets.
constexpr const char* kExtensions[] = {VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME,
                                       VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};

// The kernels' largest needs, as the build has reflected them.
constexpr uint32_t kDescriptors = std::max({
#define VKH_BINDINGS(K) static_cast<uint32_t>(std::size(k::K::kBindings)),
    VKH_KERNELS(VKH_BINDINGS)
#undef VKH_BINDINGS
});
constexpr uint32_t kSharedBytes = std::max({
#define VKH_SHARED(K) k::K::kSharedBytes,
    VKH_KERNELS(VKH_SHARED)
#undef VKH_SHARED
});
static_assert(kDescriptors <= kMaxBindings);

struct DeviceFacts {
  VkPhysicalDeviceProperties2 properties{};
  VkPhysicalDeviceSubgroupProperties subgroup{};
  VkPhysicalDevicePushDescriptorPropertiesKHR push{};
  VkPhysicalDeviceFeatures2 features{};
  VkPhysicalDeviceScalarBlockLayoutFeatures scalar{};
  VkPhysicalDeviceSynchronization2Features synchronization{};
  VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
  VkPhysicalDeviceMaintenance3Properties allocations{};
  std::vector<VkExtensionProperties> extensions;
};

template <class F>
F load(const VkhDeviceInfo& info, const char* name) {
  return reinterpret_cast<F>(info.getInstanceProcAddr(info.instance, name));
}

// Whether getInstanceProcAddr gives a function of `device` that Vulkan 1.1 or 1.2 brought. A driver
// has none of a version that the instance was not created for.
bool has_device_function(const VkhDeviceInfo& info, const char* name) {
  const auto get = load<PFN_vkGetDeviceProcAddr>(info, "vkGetDeviceProcAddr");
  return get(info.device, name) != nullptr;
}

std::string version_text(uint32_t version) {
  return "Vulkan " + std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
         std::to_string(VK_API_VERSION_MINOR(version));
}

// The version that the instance was created for, if it is known to be less than Vulkan 1.2, or 0.
uint32_t old_instance(const VkhDeviceInfo& info) {
  if (info.apiVersion != 0) return info.apiVersion < VK_API_VERSION_1_2 ? info.apiVersion : 0;
  if (load<PFN_vkVoidFunction>(info, "vkGetPhysicalDeviceProperties2") == nullptr)
    return VK_API_VERSION_1_0;
  if (info.device == VK_NULL_HANDLE || has_device_function(info, "vkResetQueryPool")) return 0;
  return has_device_function(info, "vkTrimCommandPool") ? VK_API_VERSION_1_1 : VK_API_VERSION_1_0;
}

// Says what is older than Vulkan 1.2, device or instance. Uses only functions of Vulkan 1.0: no
// others may be called there.
std::string too_old(const VkhDeviceInfo& info) {
  VkPhysicalDeviceProperties properties;
  load<PFN_vkGetPhysicalDeviceProperties>(info, "vkGetPhysicalDeviceProperties")(
      info.physicalDevice, &properties);
  if (properties.apiVersion < VK_API_VERSION_1_2)
    return "Vulkan 1.2 is missing: the device has " + version_text(properties.apiVersion);
  const uint32_t old = old_instance(info);
  if (old == 0) return "";
  return "the instance was created for " + version_text(old) + ", not 1.2 or later";
}

void query_extensions(const VkhDeviceInfo& info, DeviceFacts& facts) {
  const auto enumerate =
      load<PFN_vkEnumerateDeviceExtensionProperties>(info, "vkEnumerateDeviceExtensionProperties");
  uint32_t count = 0;
  enumerate(info.physicalDevice, nullptr, &count, nullptr);
  facts.extensions.resize(count);
  enumerate(info.physicalDevice, nullptr, &count, facts.extensions.data());
}

bool has_extension(const DeviceFacts& facts, const char* name) {
  for (const VkExtensionProperties& e : facts.extensions) {
    if (std::strcmp(e.extensionName, name) == 0) return true;
  }
  return false;
}

void query_properties(const VkhDeviceInfo& info, DeviceFacts& facts) {
  facts.properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  facts.subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
  facts.push.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PUSH_DESCRIPTOR_PROPERTIES_KHR;
  facts.allocations.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  facts.properties.pNext = &facts.allocations;
  facts.allocations.pNext = &facts.subgroup;
  // Some drivers warn on stderr about structs of extensions that they do not have.
  if (has_extension(facts, kExtensions[1])) facts.subgroup.pNext = &facts.push;
  load<PFN_vkGetPhysicalDeviceProperties2>(info, "vkGetPhysicalDeviceProperties2")(
      info.physicalDevice, &facts.properties);
}

void query_facts(const VkhDeviceInfo& info, DeviceFacts& facts) {
  query_extensions(info, facts);
  query_properties(info, facts);
}

void query_features(const VkhDeviceInfo& info, DeviceFacts& facts) {
  facts.features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  facts.scalar.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES;
  facts.synchronization.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES;
  facts.features.pNext = &facts.scalar;
  facts.scalar.pNext = &facts.synchronization;
  facts.addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
  facts.synchronization.pNext = &facts.addresses;
  load<PFN_vkGetPhysicalDeviceFeatures2>(info, "vkGetPhysicalDeviceFeatures2")(info.physicalDevice,
                                                                               &facts.features);
}

bool has_synchronization2(const DeviceFacts& facts) {
  return has_extension(facts, kExtensions[0]) ||
         facts.properties.properties.apiVersion >= VK_API_VERSION_1_3;
}

bool pushes_descriptors(const DeviceFacts& facts) {
  return has_extension(facts, kExtensions[1]) && facts.push.maxPushDescriptors >= kDescriptors;
}

class Reasons {
 public:
  void unless(bool met, const std::string& reason) {
    if (met) return;
    if (!text_.empty()) text_ += "; ";
    text_ += reason;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void check_limits(const DeviceFacts& facts, Reasons& reasons) {
  const VkPhysicalDeviceLimits& limits = facts.properties.properties.limits;
  reasons.unless(limits.maxComputeWorkGroupInvocations >= gpu::kSortGroup &&
                     limits.maxComputeWorkGroupSize[0] >= gpu::kSortGroup,
                 "workgroups of 256 are not possible");
  reasons.unless(limits.maxComputeSharedMemorySize >= kSharedBytes,
                 std::to_string(kSharedBytes) + " bytes of shared memory are missing");
  reasons.unless(limits.minStorageBufferOffsetAlignment <= 256,
                 "storage buffer offsets need more than 256 bytes");
  reasons.unless(limits.maxPerStageDescriptorStorageBuffers >= kDescriptors,
                 std::to_string(kDescriptors) + " storage buffers a kernel are not possible");
}

void check_subgroups(const DeviceFacts& facts, Reasons& reasons) {
  constexpr VkSubgroupFeatureFlags needed =
      VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT |
      VK_SUBGROUP_FEATURE_ARITHMETIC_BIT | VK_SUBGROUP_FEATURE_SHUFFLE_BIT;
  const VkPhysicalDeviceSubgroupProperties& s = facts.subgroup;
  reasons.unless((s.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0 &&
                     (s.supportedOperations & needed) == needed,
                 "subgroup ballot, arithmetic and shuffle in compute shaders are missing");
  reasons.unless(
      s.subgroupSize >= gpu::kNarrowestSubgroup && s.subgroupSize <= gpu::kWidestSubgroup,
      "subgroups are " + std::to_string(s.subgroupSize) + " wide, not 4 to 128");
}

}  // namespace

Limits device_limits(const VkhDeviceInfo& info) {
  DeviceFacts facts;
  query_facts(info, facts);
  const VkPhysicalDeviceProperties& properties = facts.properties.properties;
  return {.storage_range = properties.limits.maxStorageBufferRange,
          .wide = properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU,
          .cpu = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU,
          .pushes = pushes_descriptors(facts),
          .allocation = facts.allocations.maxMemoryAllocationSize};
}

bool has_addresses(const VkhDeviceInfo& info) {
  DeviceFacts facts;
  query_features(info, facts);
  return facts.addresses.bufferDeviceAddress == VK_TRUE;
}

}  // namespace vkh

uint32_t vkhGetVersion(void) { return VKH_VERSION; }

const char* vkhResultString(VkhResult result) {
  switch (result) {
    case VKH_SUCCESS:
      return "VKH_SUCCESS";
    case VKH_ERROR_UNSUPPORTED:
      return "VKH_ERROR_UNSUPPORTED";
    case VKH_ERROR_PIPELINE:
      return "VKH_ERROR_PIPELINE";
    case VKH_ERROR_TOO_LARGE:
      return "VKH_ERROR_TOO_LARGE";
    case VKH_ERROR_MEMORY:
      return "VKH_ERROR_MEMORY";
    case VKH_ERROR_NOT_ENABLED:
      return "VKH_ERROR_NOT_ENABLED";
    case VKH_ERROR_MISUSE:
      return "VKH_ERROR_MISUSE";
  }
  return "no VkhResult of this version";
}

const char* const* vkhGetRequiredExtensions(const VkhDeviceInfo* info, uint32_t* count) try {
  *count = 0;
  if (!vkh::too_old(*info).empty()) return vkh::kExtensions;
  vkh::DeviceFacts facts;
  vkh::query_facts(*info, facts);
  const bool first = vkh::has_extension(facts, vkh::kExtensions[0]);
  const bool second = vkh::pushes_descriptors(facts);
  *count = (first ? 1u : 0u) + (second ? 1u : 0u);
  return vkh::kExtensions + (first ? 0 : 1);
} catch (...) {  // out of host memory: no exception may cross a C interface
  *count = 0;
  return vkh::kExtensions;
}

namespace vkh {
namespace {

std::string reasons_against(const VkhDeviceInfo& info) {
  std::string old = too_old(info);
  if (!old.empty()) return old;
  DeviceFacts facts;
  query_facts(info, facts);
  // Every device answers this since Vulkan 1.1, and lavapipe only where the instance is as new. It
  // is the only sign of an old instance if VkhDeviceInfo has neither a version nor a device.
  if (facts.subgroup.subgroupSize == 0)
    return "the instance was created for Vulkan 1.0, not 1.2 or later";
  query_features(info, facts);
  Reasons why;
  check_limits(facts, why);
  check_subgroups(facts, why);
  why.unless(facts.scalar.scalarBlockLayout == VK_TRUE, "scalarBlockLayout is missing");
  why.unless(facts.synchronization.synchronization2 == VK_TRUE && has_synchronization2(facts),
             "synchronization2 is missing");
  return why.text();
}

}  // namespace
}  // namespace vkh

VkhResult vkhQuerySupport(const VkhDeviceInfo* info, char* reasons, size_t capacity) try {
  const std::string why = vkh::reasons_against(*info);
  if (capacity > 0) {
    std::strncpy(reasons, why.c_str(), capacity);
    reasons[capacity - 1] = '\0';
  }
  return why.empty() ? VKH_SUCCESS : VKH_ERROR_UNSUPPORTED;
} catch (...) {  // out of host memory: no exception may cross a C interface
  if (capacity > 0) {
    std::strncpy(reasons, "this machine has not enough memory", capacity);
    reasons[capacity - 1] = '\0';
  }
  return VKH_ERROR_UNSUPPORTED;
}
