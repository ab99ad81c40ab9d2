#include "tools/kernels/pipeline_statistics.h"

#include <cstring>
#include <vector>

#include "host/gpu/queue_family.h"
#include "host/gpu/vulkan_api.h"
#include "vkhausdorff/error.h"

namespace {

using vkh::VulkanApi;

// The functions below stand before these. One device is made in a process.
PFN_vkGetInstanceProcAddr real_instance_function = nullptr;
PFN_vkGetDeviceProcAddr real_device_function = nullptr;
PFN_vkCreateComputePipelines real_create = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL create_with_statistics(VkDevice device, VkPipelineCache cache,
                                                      uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* allocator,
                                                      VkPipeline* pipelines) {
  std::vector<VkComputePipelineCreateInfo> all(infos, infos + count);
  for (VkComputePipelineCreateInfo& info : all)
    info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
  return real_create(device, cache, count, all.data(), allocator, pipelines);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkCreateComputePipelines") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(create_with_statistics);
  return real_device_function(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(device_function);
  return real_instance_function(instance, name);
}

constexpr uint32_t kApiVersion = VK_API_VERSION_1_3;

VkInstance make_instance(const VulkanApi& vk) {
  VkApplicationInfo app{};
  app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  app.pApplicationName = "vkh_compile";
  app.apiVersion = kApiVersion;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &app;
  VkInstance instance = VK_NULL_HANDLE;
  vkh::check_made(vk.CreateInstance(&info, nullptr, &instance), instance, "creating an instance");
  return instance;
}

// The features that the engine needs, and optional ones that it uses.
struct Features {
  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR executables{};
  VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
  VkPhysicalDeviceSynchronization2Features synchronization{};
  VkPhysicalDeviceScalarBlockLayoutFeatures scalar{};
  VkPhysicalDeviceFeatures2 all{};

  // The device's own, to be enabled as they are.
  Features(const VulkanApi& vk, VkPhysicalDevice physical) {
    executables.sType =
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
    addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
    synchronization.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES;
    scalar.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES;
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    all.pNext = &scalar;
    scalar.pNext = &synchronization;
    synchronization.pNext = &addresses;
    addresses.pNext = &executables;
    vk.GetPhysicalDeviceFeatures2(physical, &all);
  }
  Features(const Features&) = delete;
  Features& operator=(const Features&) = delete;
};

VkDevice make_device(const VulkanApi& vk, const VkhDeviceInfo& chosen, const Features& features,
                     uint32_t family) {
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  uint32_t count = 0;
  const char* const* wanted = vkhGetRequiredExtensions(&chosen, &count);
  std::vector<const char*> extensions(wanted, wanted + count);
  extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features.all;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkDevice device = VK_NULL_HANDLE;
  vkh::check_made(vk.CreateDevice(chosen.physicalDevice, &info, nullptr, &device), device,
                  "creating a device with VK_KHR_pipeline_executable_properties");
  return device;
}

}  // namespace

StatisticsDevice::StatisticsDevice() {
  VulkanApi vk = vkh::load_vulkan();
  real_instance_function = vk.GetInstanceProcAddr;
  made_.instance = make_instance(vk);
  vkh::load_instance(vk, made_.instance);
  uint32_t count = 1;
  vk.EnumeratePhysicalDevices(made_.instance, &count, &made_.physical);
  if (count == 0) throw vkh::DeviceError("no Vulkan device");
  made_.get_instance_proc_addr = vk.GetInstanceProcAddr;
  made_.queue_family = vkh::compute_family(vkh::queue_families(vk, made_.physical));
  const Features features(vk, made_.physical);
  if (features.executables.pipelineExecutableInfo != VK_TRUE)
    throw vkh::DeviceError("the driver has no statistics of pipelines");
  made_.has_addresses = features.addresses.bufferDeviceAddress == VK_TRUE;
  const VkhDeviceInfo info{vk.GetInstanceProcAddr, made_.instance, made_.physical, VK_NULL_HANDLE,
                           kApiVersion};
  made_.device = make_device(vk, info, features, made_.queue_family);
  vkh::load_device(vk, made_.device);
  vk.GetDeviceQueue(made_.device, made_.queue_family, 0, &made_.queue);
  real_device_function = vk.GetDeviceProcAddr;
  real_create = vk.CreateComputePipelines;
  get_ = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
      vk.GetDeviceProcAddr(made_.device, "vkGetPipelineExecutableStatisticsKHR"));
  device_ = new vkh::Device(made_);
}

VkhDeviceInfo StatisticsDevice::engine_info() const {
  VkhDeviceInfo info = device_->engine_info();
  info.getInstanceProcAddr = instance_function;
  return info;
}

// A compute pipeline has one executable. Whole numbers alone are taken.
PipelineStatistics StatisticsDevice::of(VkPipeline pipeline) const {
  VkPipelineExecutableInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
  info.pipeline = pipeline;
  uint32_t count = 0;
  vkh::check(get_(made_.device, &info, &count, nullptr), "the number of statistics");
  VkPipelineExecutableStatisticKHR none{};
  none.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
  std::vector<VkPipelineExecutableStatisticKHR> list(count, none);
  vkh::check(get_(made_.device, &info, &count, list.data()), "the statistics");
  PipelineStatistics statistics;
  for (const VkPipelineExecutableStatisticKHR& s : list) {
    if (s.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR)
      statistics[s.name] = s.value.u64;
  }
  return statistics;
}
