#include "vkhausdorff/device.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstring>

#include "host/base/float_environment.h"
#include "host/gpu/queue_family.h"
#include "host/gpu/vulkan_api.h"
#include "host/gpu/vulkan_loader.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// The version of our instances: below 1.3 a device may lack synchronization2.
constexpr uint32_t kApiVersion = VK_API_VERSION_1_3;
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

// The engine names its objects and stages where VK_EXT_debug_utils is enabled.
#ifdef VKH_DEBUGGING
constexpr bool kNamesObjects = true;
#else
constexpr bool kNamesObjects = false;
#endif

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* count) {
  ++*static_cast<std::atomic<uint32_t>*>(count);
  std::fprintf(stderr, "validation: %s\n", data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::atomic<uint32_t>* count) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                     VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = count;
  return info;
}

bool has_layer(const VulkanApi& vk, const char* name) {
  const auto layers = list_of<VkLayerProperties>(vk.EnumerateInstanceLayerProperties);
  return std::any_of(layers.begin(), layers.end(), [&](const VkLayerProperties& l) {
    return std::strcmp(l.layerName, name) == 0;
  });
}

bool has_extension(const std::vector<VkExtensionProperties>& list, const char* name) {
  return std::any_of(list.begin(), list.end(), [&](const VkExtensionProperties& e) {
    return std::strcmp(e.extensionName, name) == 0;
  });
}

bool offers_portability(const VulkanApi& vk) {
  if (!kAsksForPortability) return false;
  const auto list =
      list_of<VkExtensionProperties>([&](uint32_t* count, VkExtensionProperties* all) {
        return vk.EnumerateInstanceExtensionProperties(nullptr, count, all);
      });
  return has_extension(list, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
}

/// Names the extensions that the engine needs, and one that a device which has it must be created
/// with.
std::vector<const char*> device_extensions(const VulkanApi& vk, const VkhDeviceInfo& chosen) {
  constexpr const char* kSubset = "VK_KHR_portability_subset";  // its macro is in a beta header
  uint32_t count = 0;
  const char* const* wanted = vkhGetRequiredExtensions(&chosen, &count);
  std::vector<const char*> names(wanted, wanted + count);
  const auto list =
      list_of<VkExtensionProperties>([&](uint32_t* length, VkExtensionProperties* all) {
        return vk.EnumerateDeviceExtensionProperties(chosen.physicalDevice, nullptr, length, all);
      });
  if (has_extension(list, kSubset)) names.push_back(kSubset);
  return names;
}

VkInstance make_instance(const VulkanApi& vk, const void* next, bool validation) {
  VkApplicationInfo app{};
  app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  app.pApplicationName = "vkhausdorff";
  app.apiVersion = kApiVersion;
  std::vector<const char*> extensions;
  if (validation || kNamesObjects) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  VkInstanceCreateInfo info{};
  if (offers_portability(vk)) {
    extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    info.flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
  }
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = next;
  info.pApplicationInfo = &app;
  info.enabledLayerCount = validation ? 1 : 0;
  info.ppEnabledLayerNames = &kValidationLayer;
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkInstance instance = VK_NULL_HANDLE;
  check_made(vk.CreateInstance(&info, nullptr, &instance), instance, "creating a Vulkan instance");
  return instance;
}

const char* type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

// A discrete GPU first, and of CPU devices lavapipe: SwiftShader takes ten times as long.
int rank_of(const DeviceDescription& d) {
  constexpr std::array order{"discrete", "integrated", "virtual", "other", "cpu"};
  const auto at = std::find(order.begin(), order.end(), d.type);
  const bool is_other_cpu = d.type == "cpu" && !d.name.starts_with("llvmpipe");
  return static_cast<int>(at - order.begin()) + (is_other_cpu ? 1 : 0);
}

uint64_t largest_local_heap(const VulkanApi& vk, VkPhysicalDevice physical) {
  VkPhysicalDeviceMemoryProperties memory;
  vk.GetPhysicalDeviceMemoryProperties(physical, &memory);
  uint64_t largest = 0;
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0) {
      largest = std::max<uint64_t>(largest, memory.memoryHeaps[i].size);
    }
  }
  return largest;
}

// Returns why the engine cannot use a device, or nothing.
std::string reasons_against(const VkhDeviceInfo& info) {
  std::array<char, 512> reasons{};
  vkhQuerySupport(&info, reasons.data(), reasons.size());
  return reasons.data();
}

DeviceDescription describe(const VulkanApi& vk, const VkhDeviceInfo& info) {
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vk.GetPhysicalDeviceProperties2(info.physicalDevice, &properties);
  DeviceDescription d;
  d.name = properties.properties.deviceName;
  d.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  d.type = type_name(properties.properties.deviceType);
  d.api_version = version_text(properties.properties.apiVersion);
  d.memory_bytes = largest_local_heap(vk, info.physicalDevice);
  d.reason = reasons_against(info);
  d.usable = d.reason.empty();
  return d;
}

struct Choice {
  VkPhysicalDevice physical;
  DeviceDescription description;
};

// Lists devices, usable or not, in the order of preference; `index` is the place in that order.
std::vector<Choice> enumerate(const VulkanApi& vk, VkInstance instance) {
  const auto physicals = list_of<VkPhysicalDevice>([&](uint32_t* count, VkPhysicalDevice* all) {
    check(vk.EnumeratePhysicalDevices(instance, count, all), "listing Vulkan devices");
  });
  std::vector<Choice> choices;
  choices.reserve(physicals.size());
  for (VkPhysicalDevice p : physicals) {
    const VkhDeviceInfo info{vk.GetInstanceProcAddr, instance, p, VK_NULL_HANDLE, kApiVersion};
    choices.push_back({p, describe(vk, info)});
  }
  std::stable_sort(choices.begin(), choices.end(), [](const Choice& x, const Choice& y) {
    return rank_of(x.description) < rank_of(y.description);
  });
  for (uint32_t i = 0; i < choices.size(); ++i) choices[i].description.index = i;
  return choices;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool matches(const DeviceDescription& d, const std::string& selector) {
  if (selector.empty()) return true;
  if (selector == "cpu") return d.type == "cpu";
  if (selector == "gpu") return d.type != "cpu";
  if (selector.find_first_not_of("0123456789") == std::string::npos)
    return std::to_string(d.index) == selector;
  return lower_case(d.name).find(lower_case(selector)) != std::string::npos;
}

std::string nothing_usable(const std::vector<Choice>& choices, const std::string& selector) {
  std::string text = selector.empty() ? "no usable Vulkan device"
                                      : "no usable Vulkan device matches '" + selector + "'";
  if (choices.empty())
    text += ": the loader found none; install a driver (mesa-vulkan-drivers has a CPU one)";
  for (const Choice& c : choices) {
    text += "; " + std::to_string(c.description.index) + " " + c.description.name + " (" +
            c.description.type + "): ";
    text += c.description.usable ? "usable, not asked for" : c.description.reason;
  }
  return text;
}

// The features that are used if the device has them.
struct Wishes {
  VkPhysicalDeviceFeatures2 features{};
  VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};

  Wishes(const VulkanApi& vk, VkPhysicalDevice physical) {
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
    features.pNext = &addresses;
    vk.GetPhysicalDeviceFeatures2(physical, &features);
  }
  Wishes(const Wishes&) = delete;
  Wishes& operator=(const Wishes&) = delete;
};

}  // namespace

// A driver's threads inherit the environment; one linked with -ffast-math changes it on loading.
Device::Device(const DeviceRequest& request) : Device(Empty{}) {
  const FloatEnvironment ours;
  create_instance(request.validation);
  choose(request.selector);
  create_device(request.robust);
  maps_memory_ = request.maps_memory;
}

Device::Device(const AdoptedDevice& adopted) : vk_(std::make_unique<VulkanApi>()), owned_(false) {
  adopt(adopted);
}

Device::Device(Empty) : vk_(std::make_unique<VulkanApi>(load_vulkan())) {}

Device::~Device() {
  if (!owned_) return;
  if (device_ != VK_NULL_HANDLE) {
    vk_->DeviceWaitIdle(device_);
    vk_->DestroyDevice(device_, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE) {
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vk_->GetInstanceProcAddr(
        instance_, "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, nullptr);
  }
  if (instance_ != VK_NULL_HANDLE) vk_->DestroyInstance(instance_, nullptr);
}

void Device::create_instance(bool validation) {
  if (validation && !has_layer(*vk_, kValidationLayer)) {
    throw DeviceError(
        "the Khronos validation layer is not installed (package vulkan-validationlayers)");
  }
  const VkValidationFeatureEnableEXT synchronization =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(messages_.get());
  messenger.pNext = &features;
  instance_ = make_instance(*vk_, validation ? &messenger : nullptr, validation);
  load_instance(*vk_, instance_);
  if (!validation) return;
  messenger.pNext = nullptr;
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vk_->GetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  check_made(create(instance_, &messenger, nullptr, &messenger_), messenger_,
             "creating the validation messenger");
}

void Device::choose(const std::string& selector) {
  const std::vector<Choice> choices = enumerate(*vk_, instance_);
  for (const Choice& c : choices) {
    if (!c.description.usable || !matches(c.description, selector)) continue;
    physical_ = c.physical;
    description_ = c.description;
    return;
  }
  throw DeviceError(nothing_usable(choices, selector));
}

void Device::create_device(bool robust) {
  const std::vector<VkQueueFamilyProperties> families = queue_families(*vk_, physical_);
  queue_family_ = compute_family(families);
  has_timestamps_ = families[queue_family_].timestampValidBits > 0;
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = queue_family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  const Wishes has(*vk_, physical_);
  VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
  addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
  addresses.bufferDeviceAddress = has.addresses.bufferDeviceAddress;
  has_addresses_ = has.addresses.bufferDeviceAddress == VK_TRUE;
  VkPhysicalDeviceSynchronization2Features synchronization{};
  synchronization.pNext = &addresses;
  synchronization.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES;
  synchronization.synchronization2 = VK_TRUE;
  VkPhysicalDeviceScalarBlockLayoutFeatures scalar{};
  scalar.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES;
  scalar.pNext = &synchronization;
  scalar.scalarBlockLayout = VK_TRUE;
  VkPhysicalDeviceFeatures features{};
  features.robustBufferAccess = robust ? has.features.features.robustBufferAccess : VK_FALSE;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &scalar;
  info.pEnabledFeatures = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  const std::vector<const char*> extensions = device_extensions(*vk_, engine_info());
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  check_made(vk_->CreateDevice(physical_, &info, nullptr, &device_), device_,
             "creating the device");
  load_device(*vk_, device_);
  vk_->GetDeviceQueue(device_, queue_family_, 0, &queue_);
  read_limits();
}

void Device::adopt(const AdoptedDevice& adopted) {
  const auto refuse = [](const std::string& why) {
    throw DeviceError("the device that was handed over cannot be used: " + why);
  };
  if (adopted.get_instance_proc_addr == nullptr || adopted.instance == VK_NULL_HANDLE ||
      adopted.physical == VK_NULL_HANDLE || adopted.device == VK_NULL_HANDLE ||
      adopted.queue == VK_NULL_HANDLE)
    refuse("a handle is null");
  vk_->GetInstanceProcAddr = adopted.get_instance_proc_addr;
  load_instance(*vk_, adopted.instance);
  const VkhDeviceInfo info{adopted.get_instance_proc_addr, adopted.instance, adopted.physical,
                           adopted.device, 0};  // the device shows the instance's version
  if (const std::string why = reasons_against(info); !why.empty()) refuse(why);
  description_ = describe(*vk_, info);
  const std::vector<VkQueueFamilyProperties> families = queue_families(*vk_, adopted.physical);
  if (adopted.queue_family >= families.size() ||
      (families[adopted.queue_family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0)
    refuse("its queue family " + std::to_string(adopted.queue_family) + " has no compute");
  has_timestamps_ = families[adopted.queue_family].timestampValidBits > 0;
  instance_ = adopted.instance;
  physical_ = adopted.physical;
  device_ = adopted.device;
  queue_ = adopted.queue;
  queue_family_ = adopted.queue_family;
  has_addresses_ = adopted.has_addresses;
  if (adopted.queue_mutex != nullptr) queue_mutex_ = adopted.queue_mutex;
  load_device(*vk_, device_);
  read_limits();
}

void Device::read_limits() {
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  vk_->GetPhysicalDeviceProperties2(physical_, &properties);
  timestamp_period_ns_ = static_cast<double>(properties.properties.limits.timestampPeriod);
}

bool Device::is_lost() const {
  const std::lock_guard lock(queue_mutex());  // waiting for the device touches its queue
  return vk_->DeviceWaitIdle(device_) == VK_ERROR_DEVICE_LOST;
}

VkhDeviceInfo Device::engine_info() const {
  return {vk_->GetInstanceProcAddr, instance_, physical_, device_, owned_ ? kApiVersion : 0};
}

std::vector<DeviceDescription> list_devices() {
  const FloatEnvironment ours;
  Device none{Device::Empty{}};  // destroys its instance, also after an exception
  none.create_instance(false);
  std::vector<DeviceDescription> descriptions;
  for (const Choice& c : enumerate(*none.vk_, none.instance_))
    descriptions.push_back(c.description);
  return descriptions;
}

}  // namespace vkh
