// An instance, a device and a queue of the examples' own, in place of your renderer's: all of this
// is plain Vulkan, and unknown to the engine.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "engine/vkhausdorff.h"

namespace example {

/// Throws std::runtime_error that names `what`.
void check(VkResult result, const char* what);

struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceSize size = 0;
  std::byte* mapped = nullptr;  ///< null for memory of the device
};

enum class Memory { kDevice, kHost };

struct GpuRequest {
  bool validation = false;    ///< with synchronization validation; messages go to stderr
  bool graphics = false;      ///< the queue can draw, and fragment shaders know their primitive
  VkhContextFlags flags = 0;  ///< of the engine's context
};

/// The device owns all that it creates. Only the extensions and features that the engine requires
/// are enabled.
class Gpu {
 public:
  explicit Gpu(const GpuRequest& request);
  ~Gpu();
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  VkDevice device() const { return device_; }
  VkPhysicalDevice physical() const { return physical_; }
  const std::string& name() const { return name_; }
  uint32_t validation_messages() const { return messages_; }
  VkhContext context() const { return context_; }  ///< the engine's

  /// Usage: storage, indirect, copies.
  Buffer buffer(VkDeviceSize size, Memory memory);
  VkDeviceMemory allocate(const VkMemoryRequirements& needs, Memory memory);
  /// Destroyed with the device, the last one first.
  void keep(std::function<void()> destroy) { kept_.push_back(std::move(destroy)); }

  /// Eight storage buffers as push descriptors and 128 bytes of push constants, for all stages.
  VkPipelineLayout layout() const { return layout_; }
  VkShaderModule shader(std::span<const uint32_t> words);
  VkPipeline compute_pipeline(std::span<const uint32_t> words);
  /// Binds buffers 0, 1, 2, .. and push constants.
  void bind(VkCommandBuffer commands, VkPipelineBindPoint point,
            std::initializer_list<VkBuffer> buffers, std::span<const std::byte> push) const;

  /// Records, submits and waits; returns the milliseconds that the device took.
  double run(const std::function<void(VkCommandBuffer)>& record);

 private:
  void create_instance(bool validation);
  void choose();
  void create_device(bool graphics);
  void create_queue_objects();
  void create_layout();

  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  std::string name_;
  double tick_ms_ = 0;
  uint32_t messages_ = 0;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  VkQueryPool timestamps_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkhContext context_ = nullptr;
  PFN_vkCmdPushDescriptorSetKHR push_descriptors_ = nullptr;
  std::vector<std::function<void()>> kept_;
};

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

/// Makes everything that `from` has written so far visible to `to`.
void barrier(VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written,
             VkPipelineStageFlags to, VkAccessFlags used);

}  // namespace example
