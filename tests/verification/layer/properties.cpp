// The reported properties of a device, lowered.
#include <algorithm>
#include <vector>

#include "tests/verification/layer/limits.h"
#include "tests/verification/layer/rules.h"
#include "tests/verification/layer/settings.h"

namespace vkh::layer {
namespace {

void lower_family(VkQueueFamilyProperties& family) {
  if (const auto bits = settings().limit("timestampValidBits"))
    family.timestampValidBits = static_cast<uint32_t>(*bits);
}

void lower_all(VkPhysicalDeviceProperties2* p) {
  lower(p->properties);
  lower_chain(p->pNext);
}

void hide_all(VkPhysicalDeviceFeatures2* f) {
  hide(f->features);
  hide_chain(f->pNext);
}

}  // namespace

void made(fn::GetPhysicalDeviceProperties, Table&, VkPhysicalDevice,
          VkPhysicalDeviceProperties* p) {
  lower(*p);
}

void made(fn::GetPhysicalDeviceProperties2, Table&, VkPhysicalDevice,
          VkPhysicalDeviceProperties2* p) {
  lower_all(p);
}

void made(fn::GetPhysicalDeviceProperties2KHR, Table&, VkPhysicalDevice,
          VkPhysicalDeviceProperties2* p) {
  lower_all(p);
}

void made(fn::GetPhysicalDeviceFeatures, Table&, VkPhysicalDevice, VkPhysicalDeviceFeatures* f) {
  hide(*f);
}

void made(fn::GetPhysicalDeviceFeatures2, Table&, VkPhysicalDevice, VkPhysicalDeviceFeatures2* f) {
  hide_all(f);
}

void made(fn::GetPhysicalDeviceFeatures2KHR, Table&, VkPhysicalDevice,
          VkPhysicalDeviceFeatures2* f) {
  hide_all(f);
}

void made(fn::GetPhysicalDeviceMemoryProperties, Table&, VkPhysicalDevice,
          VkPhysicalDeviceMemoryProperties* m) {
  lower(*m);
}

void made(fn::GetPhysicalDeviceMemoryProperties2, Table&, VkPhysicalDevice,
          VkPhysicalDeviceMemoryProperties2* m) {
  lower(m->memoryProperties);
}

void made(fn::GetPhysicalDeviceQueueFamilyProperties, Table&, VkPhysicalDevice, uint32_t* count,
          VkQueueFamilyProperties* families) {
  for (uint32_t i = 0; families != nullptr && i < *count; ++i) lower_family(families[i]);
}

void made(fn::GetPhysicalDeviceQueueFamilyProperties2, Table&, VkPhysicalDevice, uint32_t* count,
          VkQueueFamilyProperties2* families) {
  for (uint32_t i = 0; families != nullptr && i < *count; ++i)
    lower_family(families[i].queueFamilyProperties);
}

// This is not passed on: the list is the one below without the hidden entries.
std::optional<VkResult> refusal(fn::EnumerateDeviceExtensionProperties, Table& table,
                                VkPhysicalDevice physical, const char* layer, uint32_t* count,
                                VkExtensionProperties* extensions) {
  if (layer != nullptr || settings().hidden.empty()) return std::nullopt;
  const auto next = table.EnumerateDeviceExtensionProperties;
  uint32_t all = 0;
  if (const VkResult r = next(physical, nullptr, &all, nullptr); r != VK_SUCCESS) return r;
  std::vector<VkExtensionProperties> shown(all);
  if (const VkResult r = next(physical, nullptr, &all, shown.data()); r != VK_SUCCESS) return r;
  shown.resize(all);
  std::erase_if(shown, [](const VkExtensionProperties& e) {
    return settings().hidden.contains(e.extensionName);
  });
  const auto have = static_cast<uint32_t>(shown.size());
  if (extensions != nullptr) std::copy_n(shown.begin(), std::min(*count, have), extensions);
  const bool cut = extensions != nullptr && *count < have;
  *count = extensions != nullptr ? std::min(*count, have) : have;
  return cut ? VK_INCOMPLETE : VK_SUCCESS;
}

}  // namespace vkh::layer
