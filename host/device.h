// A Vulkan instance, device and queue of our own, for everything that is not embedded in somebody
// else's.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/vkhausdorff.h"
#include "host/report.h"
#include "host/vulkan_api.h"

namespace vkh {

struct DeviceRequest {
  std::string selector;  ///< "": best device; "gpu"; "cpu"; an index; or part of a name, any case
  bool validation = false;  ///< load the Khronos validation layer, synchronization validation too,
                            ///< and count messages
};

/// Owns instance, device and one compute queue. Throws DeviceError if nothing usable matches, with
/// each device's reason. Discrete before integrated before virtual before CPU.
class Device {
 public:
  explicit Device(const DeviceRequest& request = {});
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceDescription& description() const { return description_; }
  /// Warnings and errors of the validation layer so far; the text of each went to stderr.
  uint32_t validation_messages() const { return *messages_; }

  const VulkanApi& vk() const { return vk_; }
  VkDevice handle() const { return device_; }
  VkQueue queue() const { return queue_; }
  uint32_t queue_family() const { return queue_family_; }
  VkPhysicalDevice physical() const { return physical_; }
  double timestamp_period_ns() const { return timestamp_period_ns_; }
  /// For the engine's C API.
  VkhDeviceInfo engine_info() const;

 private:
  struct Empty {};
  /// Delegated to, so that what was created is destroyed if a later step throws.
  explicit Device(Empty);
  void create_instance(bool validation);
  void choose(const std::string& selector);
  void create_device();

  VulkanApi vk_;
  DeviceDescription description_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t queue_family_ = 0;
  double timestamp_period_ns_ = 1;
  std::unique_ptr<uint32_t> messages_ =
      std::make_unique<uint32_t>(0);  // the messenger keeps its address
};

/// Every Vulkan device of this machine, usable or not, in the order of preference.
std::vector<DeviceDescription> list_devices();

}  // namespace vkh
