// A Vulkan instance, device and queue: our own, or another owner's that we may use.
#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "vkhausdorff.h"
#include "vkhausdorff/device_description.h"
#include "vkhausdorff/error.h"

namespace vkh {

struct VulkanApi;  ///< the table of functions, of this library alone (host/gpu/vulkan_api.h)

struct DeviceRequest {
  /// "": the best device, a GPU where there is one and lavapipe before other CPU devices; "gpu";
  /// "cpu"; an index; or part of a name, any case.
  std::string selector;
  bool validation = false;  ///< load the Khronos validation layer, synchronization validation too,
                            ///< and count messages
  bool robust = true;  ///< robustBufferAccess, where there is any: an index out of range, on the
                       ///< GPU, reads nothing outside of its buffer
  bool maps_memory = true;  ///< meshes are written straight into the device's memory, where the
                            ///< host sees it; else copied there from memory of the host
};

/// Handles of the caller, who keeps and destroys them, after the Device and all that was made with
/// it. The device: created with the extensions that vkhGetRequiredExtensions names and with
/// scalarBlockLayout and synchronization2 enabled. The queue: of a family with compute; no other
/// code may use it while a call of Solver runs, unless all submit under `queue_mutex`: that
/// includes another Device that adopted it.
struct AdoptedDevice {
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  VkInstance instance = VK_NULL_HANDLE;  ///< Vulkan 1.2 or later
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t queue_family = 0;
  bool has_addresses =
      false;  ///< bufferDeviceAddress is enabled: meshes may be larger than bindings
  std::mutex* queue_mutex = nullptr;  ///< held around every vkQueueSubmit; null: the Device's own
};

/// One compute queue with its device. Solvers of one Device may run on as many threads.
class Device {
 public:
  /// Owns instance, device and queue. Throws DeviceError if nothing usable matches, with each
  /// device's reason. Discrete before integrated before virtual before CPU.
  explicit Device(const DeviceRequest& request = {});
  /// Destroys nothing but its own objects. Throws DeviceError that names what is missing. Vulkan
  /// cannot report what was enabled at creation: the caller has to know it.
  explicit Device(const AdoptedDevice& adopted);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceDescription& description() const { return description_; }
  /// The number of warnings and errors of the validation layer so far; the text of each went to
  /// stderr.
  uint32_t validation_messages() const { return *messages_; }

  const VulkanApi& vk() const { return *vk_; }
  VkDevice handle() const { return device_; }
  VkQueue queue() const { return queue_; }
  uint32_t queue_family() const { return queue_family_; }
  VkPhysicalDevice physical() const { return physical_; }
  std::mutex& queue_mutex() const { return *queue_mutex_; }
  /// Whether the queue has timestamps: not every adopted family does, and GPU times are then not
  /// measured.
  bool has_timestamps() const { return has_timestamps_; }
  /// Whether buffers can be given by address: storage buffers are then made for it.
  bool has_addresses() const { return has_addresses_; }
  bool maps_memory() const { return maps_memory_; }
  double timestamp_period_ns() const { return timestamp_period_ns_; }
  /// Waits until the device has nothing to do, and returns whether it was lost. An adopted
  /// device does not allow this: other threads may use its queues.
  bool is_lost() const;
  /// The handles for the engine's C API.
  VkhDeviceInfo engine_info() const;

 private:
  friend std::vector<DeviceDescription> list_devices();
  struct Empty {};
  /// Delegated to, so that what was created is destroyed if a later step throws.
  explicit Device(Empty);
  void create_instance(bool validation);
  void choose(const std::string& selector);
  void create_device(bool robust);
  void adopt(const AdoptedDevice& adopted);
  void read_limits();

  std::unique_ptr<VulkanApi> vk_;
  DeviceDescription description_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t queue_family_ = 0;
  mutable std::mutex own_mutex_;
  std::mutex* queue_mutex_ = &own_mutex_;
  bool owned_ = true;
  bool has_timestamps_ = true;
  bool has_addresses_ = false;
  bool maps_memory_ = true;
  double timestamp_period_ns_ = 1;
  // The messenger keeps the counter's address, and calls from any thread.
  std::unique_ptr<std::atomic<uint32_t>> messages_ = std::make_unique<std::atomic<uint32_t>>(0);
};

/// Every Vulkan device of this machine, usable or not, in the order of preference.
std::vector<DeviceDescription> list_devices();

}  // namespace vkh
