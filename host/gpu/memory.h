// Buffers with their memory, and one command buffer that is submitted and waited for.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "host/gpu/memory_pool.h"
#include "vkhausdorff/device.h"

namespace vkh {

/// kMapped is the device's own memory that the host writes into.
enum class Placement { kDevice, kMapped, kUpload, kReadback };

/// The memory type for this placement, among the types that a buffer or an image allows. Throws
/// DeviceError.
uint32_t memory_type(const Device& device, uint32_t allowed, Placement placement);

/// A buffer bound to its own allocation, or to a range of a pool; move-only. Host-visible ones stay
/// mapped.
class Buffer {
 public:
  Buffer() = default;
  /// Throws MemoryError if there is not enough memory. The pool, if there is one, outlives it.
  Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, Placement placement,
         MemoryPool* pool = nullptr);
  ~Buffer();
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }

  VkBuffer handle() const { return buffer_; }
  VkDeviceSize size() const { return size_; }
  bool is_in_host() const { return in_host_; }  ///< true: not in the device's own memory
  std::byte* mapped() const { return static_cast<std::byte*>(mapped_); }

 private:
  void swap(Buffer& other) noexcept;
  void allocate(const VkMemoryRequirements& needs, uint32_t type, bool has_address);
  const Device* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;  // its own
  MemoryPool* pool_ = nullptr;
  std::optional<MemoryPool::Range> range_;  // of the pool
  VkDeviceSize size_ = 0;
  bool in_host_ = false;
  void* mapped_ = nullptr;
};

/// Whether Placement::kMapped is possible for this many bytes: the host sees all of the device's
/// memory, or the size is small beside the part that it sees.
bool is_mappable(const Device& device, VkDeviceSize size);

/// The use of a buffer, and the pool that it takes memory from, if any.
struct BufferUse {
  VkBufferUsageFlags flags;
  Placement placement;
  MemoryPool* pool = nullptr;
};

/// Makes `buffer` at least `size` bytes; its content is lost if it grows.
void grow(Buffer& buffer, const Device& device, VkDeviceSize size, const BufferUse& use);

/// One command buffer, one fence, one pool of timestamps.
class Submitter {
 public:
  explicit Submitter(const Device& device);
  ~Submitter();
  Submitter(const Submitter&) = delete;
  Submitter& operator=(const Submitter&) = delete;

  VkCommandBuffer begin();
  /// Submits and waits, in slices short enough that `waiting` is called every 50 ms. Throws
  /// DeviceError if the device is lost.
  void submit_and_wait(const std::function<void()>& waiting);

  VkQueryPool timestamps() const { return timestamps_; }  ///< null if the queue has none
  static constexpr uint32_t kTimestamps = 1024;
  /// The first `count` timestamps of the last submission, in milliseconds.
  std::vector<double> read_timestamps(uint32_t count) const;

 private:
  struct Empty {};
  Submitter(const Device& device, Empty) : device_(device) {}
  void finish();  // waits for what was submitted

  const Device& device_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  bool pending_ = false;
  VkQueryPool timestamps_ = VK_NULL_HANDLE;
};

}  // namespace vkh
