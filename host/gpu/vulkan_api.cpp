#include "host/gpu/vulkan_api.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#ifdef VKH_DEBUGGING
#include "host/gpu/shader_folder.h"
#endif
#include "host/gpu/vulkan_loader.h"
#include "vkhausdorff/error.h"

namespace vkh {

VulkanApi load_vulkan() {
  VulkanApi vk;
  vk.GetInstanceProcAddr =
      reinterpret_cast<PFN_vkGetInstanceProcAddr>(vulkan_loader_function("vkGetInstanceProcAddr"));
  if (vk.GetInstanceProcAddr == nullptr)
    throw DeviceError(std::string("no Vulkan loader (") + kVulkanLoader +
                      "); device native gives distances, limits and figures without Vulkan");
#ifdef VKH_DEBUGGING
  vk.GetInstanceProcAddr = with_shader_folder(vk.GetInstanceProcAddr);
#endif
#define VKH_LOAD(name) \
  vk.name = reinterpret_cast<PFN_vk##name>(vk.GetInstanceProcAddr(nullptr, "vk" #name));
  VKH_GLOBAL_API(VKH_LOAD)
#undef VKH_LOAD
  return vk;
}

void load_instance(VulkanApi& vk, VkInstance instance) {
#define VKH_LOAD(name) \
  vk.name = reinterpret_cast<PFN_vk##name>(vk.GetInstanceProcAddr(instance, "vk" #name));
  VKH_LOAD(GetDeviceProcAddr)
  VKH_INSTANCE_API(VKH_LOAD)
#undef VKH_LOAD
}

void load_device(VulkanApi& vk, VkDevice device) {
#define VKH_LOAD(name) \
  vk.name = reinterpret_cast<PFN_vk##name>(vk.GetDeviceProcAddr(device, "vk" #name));
  VKH_DEVICE_API(VKH_LOAD)
#undef VKH_LOAD
}

std::string version_text(uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
         std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

void check(VkResult result, const char* what) {
  if (result == VK_SUCCESS) return;
  static constexpr std::array<std::pair<VkResult, const char*>, 10> kReasons{
      {{VK_ERROR_OUT_OF_HOST_MEMORY, "out of host memory"},
       {VK_ERROR_OUT_OF_DEVICE_MEMORY, "out of device memory"},
       {VK_ERROR_DEVICE_LOST, "the device was lost"},
       {VK_ERROR_INCOMPATIBLE_DRIVER,
        "no compatible driver; install the graphics card's, or a CPU one (mesa-vulkan-drivers)"},
       {VK_ERROR_INITIALIZATION_FAILED, "initialization failed"},
       {VK_ERROR_MEMORY_MAP_FAILED, "the memory cannot be mapped"},
       {VK_ERROR_LAYER_NOT_PRESENT, "a layer is missing"},
       {VK_ERROR_EXTENSION_NOT_PRESENT, "an extension is missing"},
       {VK_ERROR_FEATURE_NOT_PRESENT, "a feature is missing"},
       {VK_ERROR_TOO_MANY_OBJECTS, "the driver has too many objects"}}};
  const auto* known = std::find_if(kReasons.begin(), kReasons.end(),
                                   [&](const auto& reason) { return reason.first == result; });
  const std::string reason =
      known != kReasons.end() ? known->second : "error " + std::to_string(static_cast<int>(result));
  const std::string said = std::string(what) + " failed: " + reason;
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
    throw MemoryError(said);
  if (result == VK_ERROR_DEVICE_LOST) throw DeviceLost(said);
  throw DeviceError(said);
}

}  // namespace vkh
