#include "examples/renderer/target.h"

#include <array>

namespace example {
namespace {

constexpr VkFormat kColour = VK_FORMAT_R8G8B8A8_SRGB;
constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;
constexpr VkSampleCountFlagBits kSamples = VK_SAMPLE_COUNT_4_BIT;

VkAttachmentDescription attachment(VkFormat format, VkSampleCountFlagBits samples,
                                   VkImageLayout layout, bool kept) {
  VkAttachmentDescription a{};
  a.format = format;
  a.samples = samples;
  a.loadOp = kept ? VK_ATTACHMENT_LOAD_OP_DONT_CARE : VK_ATTACHMENT_LOAD_OP_CLEAR;
  a.storeOp = kept ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
  a.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  a.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  a.finalLayout = layout;
  return a;
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits stage, VkShaderModule shader) {
  VkPipelineShaderStageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = stage;
  info.module = shader;
  info.pName = "main";
  return info;
}

}  // namespace

Target::Target(Gpu& gpu, uint32_t width, uint32_t height) : gpu_(gpu), extent_{width, height} {
  create_pass();
  const VkImage colour = image(kColour, kSamples, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  const VkImage depth = image(kDepth, kSamples, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  resolved_ = image(kColour, VK_SAMPLE_COUNT_1_BIT,
                    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  const std::array<VkImageView, 3> views = {
      image_view(colour, kColour, VK_IMAGE_ASPECT_COLOR_BIT),
      image_view(depth, kDepth, VK_IMAGE_ASPECT_DEPTH_BIT),
      image_view(resolved_, kColour, VK_IMAGE_ASPECT_COLOR_BIT)};
  VkFramebufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  info.renderPass = pass_;
  info.attachmentCount = static_cast<uint32_t>(views.size());
  info.pAttachments = views.data();
  info.width = width;
  info.height = height;
  info.layers = 1;
  check(vkCreateFramebuffer(gpu.device(), &info, nullptr, &framebuffer_), "a framebuffer");
  gpu.keep([this] { vkDestroyFramebuffer(gpu_.device(), framebuffer_, nullptr); });
  pixels_ = gpu.buffer(4ull * width * height, Memory::kHost);
}

VkImage Target::image(VkFormat format, VkSampleCountFlagBits samples,
                      VkImageUsageFlags usage) const {
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {extent_.width, extent_.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = samples;
  info.usage = usage;
  VkImage made = VK_NULL_HANDLE;
  check(vkCreateImage(gpu_.device(), &info, nullptr, &made), "an image");
  gpu_.keep([device = gpu_.device(), made] { vkDestroyImage(device, made, nullptr); });
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(gpu_.device(), made, &needs);
  check(vkBindImageMemory(gpu_.device(), made, gpu_.allocate(needs, Memory::kDevice), 0),
        "binding an image");
  return made;
}

VkImageView Target::image_view(VkImage image, VkFormat format, VkImageAspectFlags aspect) const {
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = image;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = format;
  info.subresourceRange = {aspect, 0, 1, 0, 1};
  VkImageView made = VK_NULL_HANDLE;
  check(vkCreateImageView(gpu_.device(), &info, nullptr, &made), "an image view");
  gpu_.keep([device = gpu_.device(), made] { vkDestroyImageView(device, made, nullptr); });
  return made;
}

void Target::create_pass() {
  const std::array<VkAttachmentDescription, 3> attachments = {
      attachment(kColour, kSamples, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, false),
      attachment(kDepth, kSamples, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, false),
      attachment(kColour, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, true)};
  const VkAttachmentReference colour{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference resolved{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &colour;
  subpass.pDepthStencilAttachment = &depth;
  subpass.pResolveAttachments = &resolved;
  constexpr VkPipelineStageFlags draws = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                         VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                         VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  constexpr VkAccessFlags writes =
      VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  const std::array<VkSubpassDependency, 2> dependencies = {
      {{VK_SUBPASS_EXTERNAL, 0, draws | VK_PIPELINE_STAGE_TRANSFER_BIT, draws, writes, writes, 0},
       {0, VK_SUBPASS_EXTERNAL, draws, VK_PIPELINE_STAGE_TRANSFER_BIT, writes,
        VK_ACCESS_TRANSFER_READ_BIT, 0}}};
  VkRenderPassCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = static_cast<uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = static_cast<uint32_t>(dependencies.size());
  info.pDependencies = dependencies.data();
  check(vkCreateRenderPass(gpu_.device(), &info, nullptr, &pass_), "a render pass");
  gpu_.keep([this] { vkDestroyRenderPass(gpu_.device(), pass_, nullptr); });
}

VkPipeline Target::pipeline(VkShaderModule vertex, VkShaderModule fragment, bool depth) const {
  const std::array<VkPipelineShaderStageCreateInfo, 2> stages = {
      stage(VK_SHADER_STAGE_VERTEX_BIT, vertex), stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment)};
  VkPipelineVertexInputStateCreateInfo input{};
  input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{};
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{};
  raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{};
  samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  samples.rasterizationSamples = kSamples;
  VkPipelineDepthStencilStateCreateInfo tests{};
  tests.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  tests.depthTestEnable = tests.depthWriteEnable = depth ? VK_TRUE : VK_FALSE;
  tests.depthCompareOp = VK_COMPARE_OP_LESS;
  VkPipelineColorBlendAttachmentState opaque{};
  opaque.colorWriteMask = 0xf;
  VkPipelineColorBlendStateCreateInfo blend{};
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = 1;
  blend.pAttachments = &opaque;
  const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{};
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = 2;
  dynamic.pDynamicStates = states;
  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.stageCount = static_cast<uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &tests;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = gpu_.layout();
  info.renderPass = pass_;
  VkPipeline made = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(gpu_.device(), VK_NULL_HANDLE, 1, &info, nullptr, &made),
        "a pipeline");
  gpu_.keep([device = gpu_.device(), made] { vkDestroyPipeline(device, made, nullptr); });
  return made;
}

void Target::begin(VkCommandBuffer commands) const {
  std::array<VkClearValue, 2> clear{};
  clear[0].color = {{0.016f, 0.019f, 0.026f, 1}};
  clear[1].depthStencil = {1, 0};
  VkRenderPassBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  info.renderPass = pass_;
  info.framebuffer = framebuffer_;
  info.renderArea.extent = extent_;
  info.clearValueCount = static_cast<uint32_t>(clear.size());
  info.pClearValues = clear.data();
  vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

void Target::end(VkCommandBuffer commands) const {
  vkCmdEndRenderPass(commands);
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {extent_.width, extent_.height, 1};
  vkCmdCopyImageToBuffer(commands, resolved_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels_.handle,
                         1, &copy);
}

void Target::view(VkCommandBuffer commands, VkRect2D part) const {
  const VkViewport viewport{static_cast<float>(part.offset.x),
                            static_cast<float>(part.offset.y),
                            static_cast<float>(part.extent.width),
                            static_cast<float>(part.extent.height),
                            0,
                            1};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &part);
}

}  // namespace example
