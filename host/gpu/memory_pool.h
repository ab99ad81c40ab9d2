// Memory of the device that many buffers share.
#pragma once

#include <cstdint>
#include <list>
#include <mutex>
#include <optional>
#include <vector>

#include "vkhausdorff/device.h"

namespace vkh {

/// Blocks of memory, given out in ranges. A driver allocates for one thread at a time, and takes
/// 0.2 ms and more for each allocation (H100, driver 580): the buffers of 48 pairs are 240 of them,
/// and more as they grow. Threads may share it.
class MemoryPool {
 public:
  explicit MemoryPool(const Device& device) : device_(device) {}
  /// Every range has been given back.
  ~MemoryPool() = default;
  MemoryPool(const MemoryPool&) = delete;
  MemoryPool& operator=(const MemoryPool&) = delete;

 private:
  struct Block;

 public:
  struct Range {
    Block* block = nullptr;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;  ///< bytes
  };

  /// Returns nothing if a buffer of this size should have its own allocation, or if there is no
  /// memory for a whole block. `type`: the index of the memory's type.
  std::optional<Range> take(const VkMemoryRequirements& needs, uint32_t type);
  /// Frees the block if no other range of it is in use.
  void give_back(const Range& range) noexcept;
  /// Maps the range's block, once. Throws DeviceError.
  std::byte* map(const Range& range);

 private:
  struct Span {
    VkDeviceSize offset, size;
    bool is_free;
  };
  // A block of one type, and all of its spans in order. Neighbours are not both free.
  struct Block {
    Block(const Device& d, VkDeviceSize bytes, uint32_t type_index);
    ~Block();
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;
    std::optional<VkDeviceSize> take(VkDeviceSize bytes);
    void give_back(VkDeviceSize offset) noexcept;
    bool is_free() const { return spans.size() == 1 && spans[0].is_free; }

    const Device& device;
    uint32_t type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr;
    std::vector<Span> spans;
  };

  const Device& device_;
  std::mutex mutex_;
  std::list<Block> blocks_;
};

}  // namespace vkh
