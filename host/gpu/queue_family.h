// Chooses the queue family that the host submits to.
#pragma once

#include <algorithm>
#include <vector>

#include "host/gpu/vulkan_api.h"
#include "vkhausdorff/error.h"

namespace vkh {

inline std::vector<VkQueueFamilyProperties> queue_families(const VulkanApi& vk,
                                                           VkPhysicalDevice physical) {
  return list_of<VkQueueFamilyProperties>([&](uint32_t* count, VkQueueFamilyProperties* all) {
    vk.GetPhysicalDeviceQueueFamilyProperties(physical, count, all);
  });
}

/// The first of the best families: ones with timestamps, since then stages can be timed.
inline uint32_t compute_family(const std::vector<VkQueueFamilyProperties>& families) {
  const auto worth = [](const VkQueueFamilyProperties& f) {
    if ((f.queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) return 0;
    return f.timestampValidBits > 0 ? 2 : 1;
  };
  const auto best =
      std::max_element(families.begin(), families.end(),
                       [&](const auto& f, const auto& g) { return worth(f) < worth(g); });
  if (best == families.end() || worth(*best) == 0)
    throw DeviceError("the device has no compute queue");
  return static_cast<uint32_t>(best - families.begin());
}

}  // namespace vkh
