// Limits and features that are reported lower than the device's own.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace vkh::layer {

bool is_limit(const std::string& name);
bool is_feature(const std::string& name);

/// Lowers a structure and its chain, as if the device had no more.
void lower(VkPhysicalDeviceProperties& properties);
void lower(VkPhysicalDeviceMemoryProperties& memory);
void lower_chain(void* next);
/// `localMemory`: the one type of memory that a CPU device has is reported as two, the device's own
/// and, by the number 1, the host's. Other devices have the first of their own.
bool is_split(const VkPhysicalDeviceMemoryProperties& of_driver);
void hide(VkPhysicalDeviceFeatures& features);
void hide_chain(void* next);
/// The feature that is enabled though it is hidden; empty if none.
std::string hidden_feature_of(const VkDeviceCreateInfo& info);
/// Whether `function` belongs to a hidden extension, or to a version above a lowered apiVersion.
bool is_hidden_function(const std::string& function);

}  // namespace vkh::layer
