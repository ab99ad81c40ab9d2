#include "host/gpu/vulkan_api.h"

#include <dlfcn.h>

#include <string>

#include "host/base/error.h"

namespace vkh {

VulkanApi load_vulkan() {
  // Never closed: drivers keep threads and exit handlers of their own.
  void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) library = dlopen("libvulkan.so", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw DeviceError(
        "no Vulkan loader (libvulkan.so.1): install your driver's or the package libvulkan1");
  }
  VulkanApi vk;
  vk.GetInstanceProcAddr =
      reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
  if (vk.GetInstanceProcAddr == nullptr)
    throw DeviceError("the Vulkan loader has no vkGetInstanceProcAddr");
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

void check(VkResult result, const char* what) {
  if (result == VK_SUCCESS) return;
  std::string reason = "error " + std::to_string(static_cast<int>(result));
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      reason = "out of host memory";
      break;
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      reason = "out of device memory";
      break;
    case VK_ERROR_DEVICE_LOST:
      reason = "the device was lost";
      break;
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      reason = "no compatible driver";
      break;
    case VK_ERROR_INITIALIZATION_FAILED:
      reason = "initialization failed";
      break;
    default:
      break;
  }
  throw DeviceError(std::string(what) + " failed: " + reason);
}

}  // namespace vkh
