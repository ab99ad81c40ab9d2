// The render target, and the pipelines that draw: plain Vulkan, nothing of the engine.
#pragma once

#include "examples/gpu.h"

namespace example {

/// A picture with depth, four samples a pixel, resolved and copied to the host.
class Target {
 public:
  Target(Gpu& gpu, uint32_t width, uint32_t height);

  void begin(VkCommandBuffer commands) const;
  /// Ends the pass and copies the picture into `pixels`.
  void end(VkCommandBuffer commands) const;
  /// A part of the picture, in pixels.
  void view(VkCommandBuffer commands, VkRect2D part) const;
  const Buffer& pixels() const { return pixels_; }  ///< RGBA, 8 bits each, rows from the top
  VkExtent2D extent() const { return extent_; }

  /// Triangles without vertex buffers, in the gpu's layout.
  VkPipeline pipeline(VkShaderModule vertex, VkShaderModule fragment, bool depth) const;

 private:
  VkImage image(VkFormat format, VkSampleCountFlagBits samples, VkImageUsageFlags usage) const;
  VkImageView image_view(VkImage image, VkFormat format, VkImageAspectFlags aspect) const;
  void create_pass();

  Gpu& gpu_;
  VkExtent2D extent_;
  VkImage resolved_ = VK_NULL_HANDLE;
  VkRenderPass pass_ = VK_NULL_HANDLE;
  VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
  Buffer pixels_;
};

}  // namespace example
