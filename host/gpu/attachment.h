// An image that is drawn into.
#pragma once

#include "host/gpu/memory.h"

namespace vkh {

/// The kind of an attachment.
struct AttachmentKind {
  VkFormat format;
  VkImageUsageFlags usage;
  VkImageAspectFlags aspect;
};

/// An image of one sample per pixel with its view, bound to its own allocation; it cannot be moved.
class Attachment {
 public:
  /// Throws MemoryError if there is not enough memory.
  Attachment(const Device& device, VkExtent2D extent, const AttachmentKind& kind);
  ~Attachment();
  Attachment(const Attachment&) = delete;
  Attachment& operator=(const Attachment&) = delete;

  VkImage image() const { return image_; }
  VkImageView view() const { return view_; }

 private:
  struct Empty {};
  Attachment(const Device& device, Empty) : device_(device) {}
  void create_image(VkExtent2D extent, const AttachmentKind& kind);
  void create_view(const AttachmentKind& kind);

  const Device& device_;
  VkImage image_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
};

}  // namespace vkh
