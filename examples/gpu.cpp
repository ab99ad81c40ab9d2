#include "examples/gpu.h"

#include <array>
#include <cstdio>
#include <stdexcept>

namespace example {
namespace {

constexpr uint32_t kApiVersion = VK_API_VERSION_1_3;
constexpr uint32_t kBuffers = 8;
constexpr uint32_t kPushBytes = 128;
constexpr VkShaderStageFlags kStages =
    VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* count) {
  ++*static_cast<uint32_t*>(count);
  std::fprintf(stderr, "validation: %s\n", data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger(uint32_t* count, const void* next) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.pNext = next;
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = count;
  return info;
}

bool supported(VkInstance instance, VkPhysicalDevice physical) {
  const VkhDeviceInfo info{vkGetInstanceProcAddr, instance, physical, VK_NULL_HANDLE, kApiVersion};
  return vkhQuerySupport(&info, nullptr, 0) == VKH_SUCCESS;
}

}  // namespace

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS)
    throw std::runtime_error(std::string(what) + " failed: " + std::to_string(result));
}

void barrier(VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written,
             VkPipelineStageFlags to, VkAccessFlags used) {
  VkMemoryBarrier memory{};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  memory.srcAccessMask = written;
  memory.dstAccessMask = used;
  vkCmdPipelineBarrier(commands, from, to, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

Gpu::Gpu(const GpuRequest& request) {
  create_instance(request.validation);
  choose();
  create_device(request.graphics);
  create_queue_objects();
  create_layout();
  VkhContextCreateInfo info{};
  info.size = sizeof(info);
  info.device = {vkGetInstanceProcAddr, instance_, physical_, device_, kApiVersion};
  info.flags = request.flags;
  if (vkhCreateContext(&info, &context_) != VKH_SUCCESS) throw std::runtime_error("no context");
  keep([this] { vkhDestroyContext(context_); });
}

Gpu::~Gpu() {
  if (device_ != VK_NULL_HANDLE) vkDeviceWaitIdle(device_);
  // This does not use views::reverse: clang 14 cannot compile libstdc++ 12's.
  for (auto destroy = kept_.rbegin(); destroy != kept_.rend(); ++destroy) (*destroy)();
}

void Gpu::create_instance(bool validation) {
  const VkValidationFeatureEnableEXT synchronization =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  const VkDebugUtilsMessengerCreateInfoEXT listen = messenger(&messages_, &features);
  const char* layer = "VK_LAYER_KHRONOS_validation";
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  VkApplicationInfo app{};
  app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  app.apiVersion = kApiVersion;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = validation ? &listen : nullptr;
  info.pApplicationInfo = &app;
  info.enabledLayerCount = info.enabledExtensionCount = validation ? 1 : 0;
  info.ppEnabledLayerNames = &layer;
  info.ppEnabledExtensionNames = &extension;
  check(vkCreateInstance(&info, nullptr, &instance_), "creating an instance");
  keep([this] { vkDestroyInstance(instance_, nullptr); });
  if (!validation) return;
  const auto proc = [this](const char* name) { return vkGetInstanceProcAddr(instance_, name); };
  const auto create =
      reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(proc("vkCreateDebugUtilsMessengerEXT"));
  const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      proc("vkDestroyDebugUtilsMessengerEXT"));
  const VkDebugUtilsMessengerCreateInfoEXT listen_on = messenger(&messages_, nullptr);
  VkDebugUtilsMessengerEXT made = VK_NULL_HANDLE;
  check(create(instance_, &listen_on, nullptr, &made), "listening to the validation layer");
  keep([this, destroy, made] { destroy(instance_, made, nullptr); });
}

// The first device that the engine supports, discrete ones first.
void Gpu::choose() {
  uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "listing devices");
  std::vector<VkPhysicalDevice> all(count);
  check(vkEnumeratePhysicalDevices(instance_, &count, all.data()), "listing devices");
  for (const bool discrete : {true, false}) {
    for (VkPhysicalDevice physical : all) {
      VkPhysicalDeviceProperties properties;
      vkGetPhysicalDeviceProperties(physical, &properties);
      const bool fits = !discrete || properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
      if (physical_ != VK_NULL_HANDLE || !fits || !supported(instance_, physical)) continue;
      physical_ = physical;
      name_ = properties.deviceName;
      tick_ms_ = static_cast<double>(properties.limits.timestampPeriod) * 1e-6;
    }
  }
  if (physical_ == VK_NULL_HANDLE) throw std::runtime_error("no device that the engine supports");
}

void Gpu::create_device(bool graphics) {
  VkQueueFlags wanted = VK_QUEUE_COMPUTE_BIT;
  if (graphics) wanted |= VK_QUEUE_GRAPHICS_BIT;
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  while (family_ < count && ((families[family_].queueFlags & wanted) != wanted ||
                             families[family_].timestampValidBits == 0))
    ++family_;
  if (family_ == count) throw std::runtime_error(name_ + " has no such queue");

  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceSynchronization2Features synchronization{};
  synchronization.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES;
  synchronization.synchronization2 = VK_TRUE;
  VkPhysicalDeviceScalarBlockLayoutFeatures scalar{};
  scalar.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES;
  scalar.pNext = &synchronization;
  scalar.scalarBlockLayout = VK_TRUE;
  VkPhysicalDeviceFeatures features{};
  features.geometryShader = graphics ? VK_TRUE : VK_FALSE;  // gl_PrimitiveID belongs to it
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &scalar;
  info.pEnabledFeatures = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  const VkhDeviceInfo engine{vkGetInstanceProcAddr, instance_, physical_, VK_NULL_HANDLE,
                             kApiVersion};
  info.ppEnabledExtensionNames = vkhGetRequiredExtensions(&engine, &info.enabledExtensionCount);
  check(vkCreateDevice(physical_, &info, nullptr, &device_), "creating a device");
  keep([this] { vkDestroyDevice(device_, nullptr); });
  vkGetDeviceQueue(device_, family_, 0, &queue_);
  push_descriptors_ = reinterpret_cast<PFN_vkCmdPushDescriptorSetKHR>(
      vkGetDeviceProcAddr(device_, "vkCmdPushDescriptorSetKHR"));
}

void Gpu::create_queue_objects() {
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.queueFamilyIndex = family_;
  check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "creating a command pool");
  keep([this] { vkDestroyCommandPool(device_, pool_, nullptr); });
  VkCommandBufferAllocateInfo commands{};
  commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  commands.commandPool = pool_;
  commands.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device_, &commands, &commands_), "allocating commands");
  VkFenceCreateInfo fence{};
  fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  check(vkCreateFence(device_, &fence, nullptr, &fence_), "creating a fence");
  keep([this] { vkDestroyFence(device_, fence_, nullptr); });
  VkQueryPoolCreateInfo queries{};
  queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queries.queryCount = 2;
  check(vkCreateQueryPool(device_, &queries, nullptr, &timestamps_), "creating a query pool");
  keep([this] { vkDestroyQueryPool(device_, timestamps_, nullptr); });
}

void Gpu::create_layout() {
  if (push_descriptors_ == nullptr) return;
  std::array<VkDescriptorSetLayoutBinding, kBuffers> bindings{};
  for (uint32_t i = 0; i < kBuffers; ++i)
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, kStages, nullptr};
  VkDescriptorSetLayoutCreateInfo set{};
  set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  set.bindingCount = kBuffers;
  set.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(device_, &set, nullptr, &set_layout_), "a set layout");
  keep([this] { vkDestroyDescriptorSetLayout(device_, set_layout_, nullptr); });
  const VkPushConstantRange push{kStages, 0, kPushBytes};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout_;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &push;
  check(vkCreatePipelineLayout(device_, &info, nullptr, &layout_), "a pipeline layout");
  keep([this] { vkDestroyPipelineLayout(device_, layout_, nullptr); });
}

VkDeviceMemory Gpu::allocate(const VkMemoryRequirements& needs, Memory memory) {
  const VkMemoryPropertyFlags wanted =
      memory == Memory::kDevice
          ? VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT}
          : VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  VkPhysicalDeviceMemoryProperties types;
  vkGetPhysicalDeviceMemoryProperties(physical_, &types);
  uint32_t type = 0;
  while (type < types.memoryTypeCount &&
         ((needs.memoryTypeBits >> type & 1) == 0 ||
          (types.memoryTypes[type].propertyFlags & wanted) != wanted))
    ++type;
  if (type == types.memoryTypeCount) throw std::runtime_error("no such memory");
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = type;
  VkDeviceMemory made = VK_NULL_HANDLE;
  check(vkAllocateMemory(device_, &info, nullptr, &made), "allocating memory");
  keep([this, made] { vkFreeMemory(device_, made, nullptr); });
  return made;
}

Buffer Gpu::buffer(VkDeviceSize size, Memory memory) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  Buffer made{VK_NULL_HANDLE, size, nullptr};
  check(vkCreateBuffer(device_, &info, nullptr, &made.handle), "creating a buffer");
  keep([this, handle = made.handle] { vkDestroyBuffer(device_, handle, nullptr); });
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_, made.handle, &needs);
  const VkDeviceMemory bound = allocate(needs, memory);
  check(vkBindBufferMemory(device_, made.handle, bound, 0), "binding a buffer");
  if (memory == Memory::kHost) {
    void* mapped = nullptr;
    check(vkMapMemory(device_, bound, 0, VK_WHOLE_SIZE, 0, &mapped), "mapping a buffer");
    made.mapped = static_cast<std::byte*>(mapped);
  }
  return made;
}

VkShaderModule Gpu::shader(std::span<const uint32_t> words) {
  if (layout_ == VK_NULL_HANDLE)
    throw std::runtime_error("the example's own shaders need VK_KHR_push_descriptor");
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = words.size_bytes();
  info.pCode = words.data();
  VkShaderModule made = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device_, &info, nullptr, &made), "creating a shader");
  keep([this, made] { vkDestroyShaderModule(device_, made, nullptr); });
  return made;
}

VkPipeline Gpu::compute_pipeline(std::span<const uint32_t> words) {
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = shader(words);
  info.stage.pName = "main";
  info.layout = layout_;
  VkPipeline made = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &made), "a pipeline");
  keep([this, made] { vkDestroyPipeline(device_, made, nullptr); });
  return made;
}

void Gpu::bind(VkCommandBuffer commands, VkPipelineBindPoint point,
               std::initializer_list<VkBuffer> buffers, std::span<const std::byte> push) const {
  std::array<VkDescriptorBufferInfo, kBuffers> infos{};
  std::array<VkWriteDescriptorSet, kBuffers> writes{};
  uint32_t count = 0;
  for (VkBuffer buffer : buffers) {
    infos[count] = {buffer, 0, VK_WHOLE_SIZE};
    writes[count].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[count].dstBinding = count;
    writes[count].descriptorCount = 1;
    writes[count].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[count].pBufferInfo = &infos[count];
    ++count;
  }
  push_descriptors_(commands, point, layout_, 0, count, writes.data());
  vkCmdPushConstants(commands, layout_, kStages, 0, static_cast<uint32_t>(push.size()),
                     push.data());
}

double Gpu::run(const std::function<void(VkCommandBuffer)>& record) {
  check(vkResetCommandPool(device_, pool_, 0), "resetting a command pool");
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  check(vkBeginCommandBuffer(commands_, &begin), "beginning commands");
  vkhReleaseCommandBuffer(context_, commands_);
  vkCmdResetQueryPool(commands_, timestamps_, 0, 2);
  vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, timestamps_, 0);
  record(commands_);
  vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, timestamps_, 1);
  if (vkhGetRecordingResult(context_, commands_) != VKH_SUCCESS)
    throw std::runtime_error("no memory for the engine's descriptor sets");
  check(vkEndCommandBuffer(commands_), "recording");
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  check(vkQueueSubmit(queue_, 1, &submit, fence_), "submitting");
  check(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX), "waiting");
  check(vkResetFences(device_, 1, &fence_), "resetting a fence");
  uint64_t ticks[2];
  check(vkGetQueryPoolResults(device_, timestamps_, 0, 2, sizeof(ticks), ticks, sizeof(uint64_t),
                              VK_QUERY_RESULT_64_BIT),
        "reading timestamps");
  return static_cast<double>(ticks[1] - ticks[0]) * tick_ms_;
}

}  // namespace example
