#include "host/show/raster.h"

#include <array>
#include <cstddef>

#include "host/base/parallel.h"
#include "host/gpu/vulkan_api.h"
#include "kernels/draw/mesh_frag.h"
#include "kernels/draw/mesh_vert.h"
#include "vkhausdorff/error.h"

namespace vkh::drawing {
namespace {

constexpr VkFormat kColour = VK_FORMAT_R8G8B8A8_UNORM;  // sRGB's own numbers: a map's, untouched
constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;
constexpr AttachmentKind kColourKind{
    kColour, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
    VK_IMAGE_ASPECT_COLOR_BIT};
constexpr AttachmentKind kDepthKind{kDepth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                    VK_IMAGE_ASPECT_DEPTH_BIT};

// 30 MiB of corners: bindings of 128 MiB are no limit, nor is a device's visible memory.
constexpr size_t kFacesAtOnce = size_t{1} << 19;
constexpr uint32_t kMostSamples = 4;                 // per side: 16 a pixel
constexpr uint64_t kMostInAll = uint64_t{40} << 20;  // 320 MiB of colour and depth

// As mesh.frag has them; every device takes so many bytes.
struct Constants {
  float hatch_period, from, to;
  std::array<uint32_t, 2 * Palette::kOutside + Palette::kWithin> colours{};

  void add(const Palette& palette) {
    from = static_cast<float>(palette.from);
    to = static_cast<float>(palette.to);
    size_t at = 0;
    const auto put = [&](const Rgb& c) {
      colours[at++] = c.red | uint32_t{c.green} << 8 | uint32_t{c.blue} << 16;
    };
    for (const Rgb& c : palette.below) put(c);
    for (const Rgb& c : palette.within) put(c);
    for (const Rgb& c : palette.above) put(c);
    colours[0] |= palette.bands << 24;
  }
};
static_assert(sizeof(Constants) == 124);

uint32_t most_side(const Device& device) {
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  device.vk().GetPhysicalDeviceProperties2(device.physical(), &properties);
  const VkPhysicalDeviceLimits& limits = properties.properties.limits;
  return std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth,
                   limits.maxFramebufferHeight, limits.maxViewportDimensions[0],
                   limits.maxViewportDimensions[1]});
}

uint32_t samples_for(const Device& device, uint32_t width, uint32_t height) {
  if (!device.has_graphics()) {
    throw DeviceError(device.description().name +
                      " cannot draw a picture: its queue has no graphics; ask for another device");
  }
  const uint32_t most = most_side(device);
  for (uint32_t n = kMostSamples; n > 0; --n) {
    const bool fits = n * width <= most && n * height <= most;
    if (fits && (n == 1 || uint64_t{n} * n * width * height <= kMostInAll)) return n;
  }
  throw UsageError("a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                   " is too large for " + device.description().name);
}

VkAttachmentDescription description_of(VkFormat format, VkImageLayout layout, bool clears) {
  VkAttachmentDescription a{};
  a.format = format;
  a.samples = VK_SAMPLE_COUNT_1_BIT;
  a.loadOp = clears ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  a.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  a.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  a.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  a.initialLayout = clears ? VK_IMAGE_LAYOUT_UNDEFINED : layout;
  a.finalLayout = layout;
  return a;
}

// Waits before a pass for another's drawing, or the copy of the last layer. After it: either.
std::array<VkSubpassDependency, 2> dependencies() {
  constexpr VkPipelineStageFlags kDraws = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                          VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                          VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  constexpr VkPipelineStageFlags kCopies = VK_PIPELINE_STAGE_TRANSFER_BIT;
  constexpr VkAccessFlags kWrites =
      VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  constexpr VkAccessFlags kReads =
      VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
  return {{{VK_SUBPASS_EXTERNAL, 0, kDraws | kCopies, kDraws, kWrites | VK_ACCESS_TRANSFER_READ_BIT,
            kWrites | kReads, 0},
           {0, VK_SUBPASS_EXTERNAL, kDraws, kDraws | kCopies, kWrites,
            kWrites | kReads | VK_ACCESS_TRANSFER_READ_BIT, 0}}};
}

/// A shader; destroyed once a pipeline has it.
class Shader {
 public:
  template <size_t n>
  Shader(const Device& device, const uint32_t (&words)[n]) : device_(device) {
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = sizeof(words);
    info.pCode = words;
    check_made(device.vk().CreateShaderModule(device.handle(), &info, nullptr, &module_), module_,
               "creating a shader");
  }
  ~Shader() { device_.vk().DestroyShaderModule(device_.handle(), module_, nullptr); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;

  VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits of) const {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = of;
    info.module = module_;
    info.pName = "main";
    return info;
  }

 private:
  const Device& device_;
  VkShaderModule module_ = VK_NULL_HANDLE;
};

constexpr VkVertexInputBindingDescription kBinding{0, sizeof(Corner), VK_VERTEX_INPUT_RATE_VERTEX};
constexpr std::array<VkVertexInputAttributeDescription, 4> kInputs{
    {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Corner, x)},
     {1, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(Corner, colour)},
     {2, 0, VK_FORMAT_R8G8B8A8_UINT, offsetof(Corner, hatched)},
     {3, 0, VK_FORMAT_R32_SFLOAT, offsetof(Corner, share)}}};

/// All of a pipeline's state but shaders, layout and pass. Both sides of a face are drawn.
struct FixedState {
  VkPipelineVertexInputStateCreateInfo input{};
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  VkPipelineViewportStateCreateInfo viewport{};
  VkPipelineRasterizationStateCreateInfo raster{};
  VkPipelineMultisampleStateCreateInfo samples{};
  VkPipelineDepthStencilStateCreateInfo depth{};
  VkPipelineColorBlendAttachmentState opaque{};
  VkPipelineColorBlendStateCreateInfo blend{};
  std::array<VkDynamicState, 2> states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{};

  FixedState() {
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &kBinding;
    input.vertexAttributeDescriptionCount = static_cast<uint32_t>(kInputs.size());
    input.pVertexAttributeDescriptions = kInputs.data();
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = viewport.scissorCount = 1;
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.lineWidth = 1;
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_LESS;
    opaque.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                            VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = 1;
    blend.pAttachments = &opaque;
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<uint32_t>(states.size());
    dynamic.pDynamicStates = states.data();
  }
  FixedState(const FixedState&) = delete;
  FixedState& operator=(const FixedState&) = delete;

  VkGraphicsPipelineCreateInfo info() const {
    VkGraphicsPipelineCreateInfo i{};
    i.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    i.pVertexInputState = &input;
    i.pInputAssemblyState = &assembly;
    i.pViewportState = &viewport;
    i.pRasterizationState = &raster;
    i.pMultisampleState = &samples;
    i.pDepthStencilState = &depth;
    i.pColorBlendState = &blend;
    i.pDynamicState = &dynamic;
    return i;
  }
};

}  // namespace

Raster::Raster(const Device& device, Empty, uint32_t width, uint32_t height)
    : device_(device),
      samples_(samples_for(device, width, height)),
      extent_{samples_ * width, samples_ * height},
      colour_(device, extent_, kColourKind),
      depth_(device, extent_, kDepthKind),
      submitter_(device),
      corners_(device, 3 * kFacesAtOnce * sizeof(Corner), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
               Placement::kUpload),
      read_(device, VkDeviceSize{4} * extent_.width * extent_.height,
            VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kReadback),
      pipeline_(device) {}

// Delegates, here and below: what was created is destroyed if a later step throws.
Raster::Raster(const Device& device, uint32_t width, uint32_t height)
    : Raster(device, Empty{}, width, height) {
  make_framebuffer();
}

Raster::~Raster() { device_.vk().DestroyFramebuffer(device_.handle(), framebuffer_, nullptr); }

RasterPipeline::RasterPipeline(const Device& device) : RasterPipeline(device, Empty{}) {
  clearing_ = make_pass(true);
  keeping_ = make_pass(false);
  make_layout();
  make_pipeline();
}

RasterPipeline::~RasterPipeline() {
  const VulkanApi& vk = device_.vk();
  vk.DestroyPipeline(device_.handle(), pipeline_, nullptr);
  vk.DestroyPipelineLayout(device_.handle(), layout_, nullptr);
  vk.DestroyRenderPass(device_.handle(), keeping_, nullptr);
  vk.DestroyRenderPass(device_.handle(), clearing_, nullptr);
}

VkRenderPass RasterPipeline::make_pass(bool clears) {
  const std::array<VkAttachmentDescription, 2> attachments = {
      description_of(kColour, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, clears),
      description_of(kDepth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, clears)};
  const VkAttachmentReference colour{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &colour;
  subpass.pDepthStencilAttachment = &depth;
  const auto waits = dependencies();
  VkRenderPassCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = static_cast<uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = static_cast<uint32_t>(waits.size());
  info.pDependencies = waits.data();
  VkRenderPass pass = VK_NULL_HANDLE;
  check_made(device_.vk().CreateRenderPass(device_.handle(), &info, nullptr, &pass), pass,
             "creating a render pass");
  return pass;
}

void Raster::make_framebuffer() {
  const std::array<VkImageView, 2> views = {colour_.view(), depth_.view()};
  VkFramebufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  info.renderPass = pipeline_.clearing();  // the other one is compatible
  info.attachmentCount = static_cast<uint32_t>(views.size());
  info.pAttachments = views.data();
  info.width = extent_.width;
  info.height = extent_.height;
  info.layers = 1;
  check_made(device_.vk().CreateFramebuffer(device_.handle(), &info, nullptr, &framebuffer_),
             framebuffer_, "creating a framebuffer");
}

void RasterPipeline::make_layout() {
  const VkPushConstantRange constants{VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(Constants)};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &constants;
  check_made(device_.vk().CreatePipelineLayout(device_.handle(), &info, nullptr, &layout_), layout_,
             "creating a pipeline layout");
}

void RasterPipeline::make_pipeline() {
  const Shader vertex(device_, k_mesh_vert), fragment(device_, k_mesh_frag);
  const std::array<VkPipelineShaderStageCreateInfo, 2> stages = {
      vertex.stage(VK_SHADER_STAGE_VERTEX_BIT), fragment.stage(VK_SHADER_STAGE_FRAGMENT_BIT)};
  const FixedState state;
  VkGraphicsPipelineCreateInfo info = state.info();
  info.stageCount = static_cast<uint32_t>(stages.size());
  info.pStages = stages.data();
  info.layout = layout_;
  info.renderPass = clearing_;
  check_made(device_.vk().CreateGraphicsPipelines(device_.handle(), VK_NULL_HANDLE, 1, &info,
                                                  nullptr, &pipeline_),
             pipeline_, "creating a graphics pipeline");
}

void Raster::draw_some(VkExtent2D samples, double line, size_t face_count, bool first) {
  constexpr double kHatchLines = 7;  // a period, in widths of lines
  const VulkanApi& vk = device_.vk();
  const VkCommandBuffer commands = submitter_.begin();
  std::array<VkClearValue, 2> clear{};
  clear[0].color = {{1, 1, 1, 0}};
  clear[1].depthStencil = {1, 0};
  VkRenderPassBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  info.renderPass = first ? pipeline_.clearing() : pipeline_.keeping();
  info.framebuffer = framebuffer_;
  info.renderArea.extent = samples;
  info.clearValueCount = static_cast<uint32_t>(clear.size());
  info.pClearValues = clear.data();
  vk.CmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.pipeline());
  const VkViewport viewport{
      0, 0, static_cast<float>(samples.width), static_cast<float>(samples.height), 0, 1};
  const VkRect2D scissor{{0, 0}, samples};
  vk.CmdSetViewport(commands, 0, 1, &viewport);
  vk.CmdSetScissor(commands, 0, 1, &scissor);
  Constants constants{
      .hatch_period = static_cast<float>(line * samples_ * kHatchLines), .from = 0, .to = 1};
  constants.add(palette_);
  vk.CmdPushConstants(commands, pipeline_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                      sizeof(constants), &constants);
  const VkBuffer corners = corners_.handle();
  const VkDeviceSize offset = 0;
  vk.CmdBindVertexBuffers(commands, 0, 1, &corners, &offset);
  vk.CmdDraw(commands, static_cast<uint32_t>(3 * face_count), 1, 0, 0);
  vk.CmdEndRenderPass(commands);
  submitter_.submit_and_wait({});
}

void Raster::read_back(VkExtent2D samples) {
  const VulkanApi& vk = device_.vk();
  const VkCommandBuffer commands = submitter_.begin();
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {samples.width, samples.height, 1};
  vk.CmdCopyImageToBuffer(commands, colour_.image(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                          read_.handle(), 1, &copy);
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vk.CmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                        &barrier, 0, nullptr, 0, nullptr);
  submitter_.submit_and_wait({});
}

Layer Raster::averaged(VkExtent2D pixels) const {
  Layer layer{pixels.width, pixels.height, {}};
  layer.rgba.resize(size_t{4} * pixels.width * pixels.height);
  const auto* from = reinterpret_cast<const uint8_t*>(read_.mapped());
  const size_t row = size_t{4} * pixels.width * samples_;
  const uint32_t in_all = samples_ * samples_;
  for_each_index(pixels.height, [&](size_t y) {
    std::vector<uint16_t> sums(row);  // of the rows' samples one below the other
    for (uint32_t j = 0; j < samples_; ++j) {
      const uint8_t* line = from + (y * samples_ + j) * row;
      for (size_t i = 0; i < row; ++i) sums[i] = static_cast<uint16_t>(sums[i] + line[i]);
    }
    uint8_t* to = &layer.rgba[y * 4 * pixels.width];
    for (size_t at = 0; at < size_t{4} * pixels.width; ++at) {
      const uint16_t* first = &sums[at / 4 * samples_ * 4 + at % 4];
      uint32_t sum = in_all / 2;
      for (uint32_t i = 0; i < samples_; ++i) sum += first[size_t{4} * i];
      to[at] = static_cast<uint8_t>(sum / in_all);
    }
  });
  return layer;
}

Layer Raster::draw(VkExtent2D pixels, double line, size_t face_count, const FillFaces& fill) {
  const VkExtent2D samples{samples_ * pixels.width, samples_ * pixels.height};
  auto* corners = reinterpret_cast<Corner*>(corners_.mapped());
  for (size_t first = 0; first < face_count; first += kFacesAtOnce) {
    const size_t count = std::min(kFacesAtOnce, face_count - first);
    fill(first, count, corners);
    draw_some(samples, line, count, first == 0);
  }
  read_back(samples);
  return averaged(pixels);
}

}  // namespace vkh::drawing
