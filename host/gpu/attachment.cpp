#include "host/gpu/attachment.h"

#include "host/gpu/vulkan_api.h"

namespace vkh {

// Delegates: the objects made so far are destroyed if a later step throws.
Attachment::Attachment(const Device& device, VkExtent2D extent, const AttachmentKind& kind)
    : Attachment(device, Empty{}) {
  create_image(extent, kind);
  create_view(kind);
}

Attachment::~Attachment() {
  const VulkanApi& vk = device_.vk();
  vk.DestroyImageView(device_.handle(), view_, nullptr);
  vk.DestroyImage(device_.handle(), image_, nullptr);
  vk.FreeMemory(device_.handle(), memory_, nullptr);
}

void Attachment::create_image(VkExtent2D extent, const AttachmentKind& kind) {
  const VulkanApi& vk = device_.vk();
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = kind.format;
  info.extent = {extent.width, extent.height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = kind.usage;
  check_made(vk.CreateImage(device_.handle(), &info, nullptr, &image_), image_,
             "creating an image");
  VkMemoryRequirements needs;
  vk.GetImageMemoryRequirements(device_.handle(), image_, &needs);
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex = memory_type(device_, needs.memoryTypeBits, Placement::kDevice);
  check_made(vk.AllocateMemory(device_.handle(), &allocate, nullptr, &memory_), memory_,
             "allocating an image");
  check(vk.BindImageMemory(device_.handle(), image_, memory_, 0), "binding an image");
}

void Attachment::create_view(const AttachmentKind& kind) {
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = image_;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = kind.format;
  info.subresourceRange = {kind.aspect, 0, 1, 0, 1};
  check_made(device_.vk().CreateImageView(device_.handle(), &info, nullptr, &view_), view_,
             "creating an image view");
}

}  // namespace vkh
