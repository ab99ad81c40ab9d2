// A Vulkan layer for tests: lowers limits, hides features, leaves barriers out, fails calls, and
// counts objects that were not destroyed (docs/test_layer.md).
#include <vulkan/vk_layer.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <string_view>

#include "tests/verification/layer/limits.h"
#include "tests/verification/layer/rules.h"
#include "tests/verification/layer/settings.h"

namespace vkh::layer {
namespace {

template <class First, class... Rest>
void* key_of_first(First first, Rest...) {
  return key_of(first);
}

template <class Tag, class Pfn = typename Tag::Pfn>
struct Hook;

template <class Tag, class R, class... Args>
struct Hook<Tag, R(VKAPI_PTR*)(Args...)> {
  static VKAPI_ATTR R VKAPI_CALL call(Args... args) {
    Table& table = table_of(key_of_first(args...));
    if constexpr (std::is_void_v<R>) {
      count_call(Tag::kName);
      if (!allowed(Tag{}, table, args...)) return;
      Tag::next(table)(args...);
      made(Tag{}, table, args...);
    } else {
      std::optional<VkResult> instead = fault_of(Tag::kName, Tag::kErrors, table);
      if (instead) spoil(Tag{}, args...);
      if (!instead) instead = refusal(Tag{}, table, args...);
      if (instead) return *instead;
      const R result = Tag::next(table)(args...);
      if (result == VK_SUCCESS) made(Tag{}, table, args...);
      return result;
    }
  }
};

using Functions = std::map<std::string_view, PFN_vkVoidFunction>;

const Functions& hooks() {
#define VKH_HOOK(name, ...) \
  {"vk" #name, reinterpret_cast<PFN_vkVoidFunction>(&Hook<fn::name>::call)},
  static const Functions all{VKH_LAYER_INSTANCE_FALLIBLE(VKH_HOOK) VKH_LAYER_INSTANCE_VOID(VKH_HOOK)
                                 VKH_LAYER_DEVICE_FALLIBLE(VKH_HOOK) VKH_LAYER_DEVICE_SAFE(VKH_HOOK)
                                     VKH_LAYER_DEVICE_VOID(VKH_HOOK)};
#undef VKH_HOOK
  return all;
}

// The loader's list of the layers below, from which the next one takes its own place.
template <class Link>
Link* link_of(const void* next, VkStructureType type) {
  for (auto* s = const_cast<Link*>(static_cast<const Link*>(next)); s != nullptr;
       s = const_cast<Link*>(static_cast<const Link*>(s->pNext))) {
    if (s->sType == type && s->function == VK_LAYER_LINK_INFO) return s;
  }
  return nullptr;
}

void load(Table& table) {
#define VKH_LOAD(name, ...) \
  table.name =              \
      reinterpret_cast<PFN_vk##name>(table.GetInstanceProcAddr(table.instance, "vk" #name));
  VKH_LAYER_INSTANCE_FALLIBLE(VKH_LOAD)
  VKH_LAYER_INSTANCE_VOID(VKH_LOAD)
  VKH_LOAD(DestroyInstance)
#undef VKH_LOAD
}

void load_device(Table& table) {
#define VKH_LOAD(name, ...) \
  table.name = reinterpret_cast<PFN_vk##name>(table.GetDeviceProcAddr(table.device, "vk" #name));
  VKH_LAYER_DEVICE_FALLIBLE(VKH_LOAD)
  VKH_LAYER_DEVICE_SAFE(VKH_LOAD)
  VKH_LAYER_DEVICE_VOID(VKH_LOAD)
  VKH_LOAD(DestroyDevice)
#undef VKH_LOAD
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               Allocator allocator, VkInstance* instance) {
  auto* link = link_of<VkLayerInstanceCreateInfo>(info->pNext,
                                                  VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  Table none;
  if (const auto fault = fault_of("vkCreateInstance", kCreateInstanceErrors, none)) return *fault;
  const auto get = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create =
      reinterpret_cast<PFN_vkCreateInstance>(get(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  Table& table = add_table(key_of(*instance));
  table.instance = *instance;
  table.GetInstanceProcAddr = get;
  load(table);
  add_object("VkInstance", number_of(*instance), 0);
  return VK_SUCCESS;
}

void check_left(const char* where, uint64_t owner) {
  const std::string left = objects_of(owner);
  remove_objects_of(owner);
  if (!left.empty()) violation(std::string(where) + " leaks " + left);
}

VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance, Allocator allocator) {
  if (instance == VK_NULL_HANDLE) return;
  void* key = key_of(instance);
  check_left("vkDestroyInstance", number_of(instance));
  remove_object("VkInstance", number_of(instance));
  table_of(key).DestroyInstance(instance, allocator);
  remove_table(key);
  write_counts();
}

std::optional<VkResult> hidden_wish(const VkDeviceCreateInfo& info) {
  for (uint32_t i = 0; i < info.enabledExtensionCount; ++i) {
    if (!settings().hidden.contains(info.ppEnabledExtensionNames[i])) continue;
    violation(std::string("vkCreateDevice: ") + info.ppEnabledExtensionNames[i] + " is hidden");
    return VK_ERROR_EXTENSION_NOT_PRESENT;
  }
  const std::string feature = hidden_feature_of(info);
  if (feature.empty()) return std::nullopt;
  violation("vkCreateDevice: " + feature + " is hidden");
  return VK_ERROR_FEATURE_NOT_PRESENT;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                             const VkDeviceCreateInfo* info, Allocator allocator,
                                             VkDevice* device) {
  auto* link =
      link_of<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  Table& above = table_of(key_of(physical));
  if (const auto fault = fault_of("vkCreateDevice", kCreateDeviceErrors, above)) return *fault;
  if (const auto refused = hidden_wish(*info)) return *refused;
  if (info->pEnabledFeatures != nullptr && info->pEnabledFeatures->robustBufferAccess != VK_FALSE)
    count_call("robust_devices");
  const auto get = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  const auto get_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(get(above.instance, "vkCreateDevice"));
  const VkResult result = create(physical, info, allocator, device);
  if (result != VK_SUCCESS) return result;
  Table& table = add_table(key_of(*device));
  table.instance = above.instance;
  table.physical = physical;
  table.device = *device;
  table.GetDeviceProcAddr = get_device;
  load_device(table);
  add_object("VkDevice", number_of(*device), number_of(above.instance));
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, Allocator allocator) {
  if (device == VK_NULL_HANDLE) return;
  void* key = key_of(device);
  check_left("vkDestroyDevice", number_of(device));
  remove_object("VkDevice", number_of(device));
  table_of(key).DestroyDevice(device, allocator);
  remove_table(key);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_proc_addr(VkDevice device, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance,
                                                                const char* name);

// The functions that differ from the others.
const Functions& own_functions() {
#define VKH_OWN(name, function) \
  { name, reinterpret_cast<PFN_vkVoidFunction>(&(function)) }
  static const Functions own{VKH_OWN("vkGetInstanceProcAddr", get_instance_proc_addr),
                             VKH_OWN("vkGetDeviceProcAddr", get_device_proc_addr),
                             VKH_OWN("vkCreateInstance", create_instance),
                             VKH_OWN("vkDestroyInstance", destroy_instance),
                             VKH_OWN("vkCreateDevice", create_device),
                             VKH_OWN("vkDestroyDevice", destroy_device)};
#undef VKH_OWN
  return own;
}

PFN_vkVoidFunction find(const Functions& functions, const char* name) {
  const auto found = functions.find(name);
  return found == functions.end() ? nullptr : found->second;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance,
                                                                const char* name) {
  if (const auto own = find(own_functions(), name)) return own;
  if (instance == VK_NULL_HANDLE || is_hidden_function(name)) return nullptr;
  const auto next = table_of(key_of(instance)).GetInstanceProcAddr(instance, name);
  const auto hook = find(hooks(), name);
  return next != nullptr && hook != nullptr ? hook : next;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_proc_addr(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0 || std::strcmp(name, "vkDestroyDevice") == 0)
    return find(own_functions(), name);
  if (is_hidden_function(name)) return nullptr;
  const auto next = table_of(key_of(device)).GetDeviceProcAddr(device, name);
  const auto hook = find(hooks(), name);
  return next != nullptr && hook != nullptr ? hook : next;
}

}  // namespace
}  // namespace vkh::layer

extern "C" {

VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
  version->loaderLayerInterfaceVersion =
      std::min(version->loaderLayerInterfaceVersion, uint32_t{2});
  version->pfnGetInstanceProcAddr = vkh::layer::get_instance_proc_addr;
  version->pfnGetDeviceProcAddr = vkh::layer::get_device_proc_addr;
  version->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}

VK_LAYER_EXPORT bool vkhLayerArm(const char* faults) { return vkh::layer::arm(faults); }

VK_LAYER_EXPORT size_t vkhLayerLog(char* text, size_t capacity) {
  const std::string log = vkh::layer::log_text();
  if (capacity > 0) {
    const size_t length = std::min(log.size(), capacity - 1);
    std::copy_n(log.begin(), length, text);
    text[length] = '\0';
  }
  return log.size();
}

VK_LAYER_EXPORT uint64_t vkhLayerCount(const char* name) { return vkh::layer::count_of(name); }
VK_LAYER_EXPORT uint32_t vkhLayerInjected() { return vkh::layer::injected(); }
VK_LAYER_EXPORT uint32_t vkhLayerViolations() { return vkh::layer::violations(); }
VK_LAYER_EXPORT uint32_t vkhLayerLive() { return vkh::layer::live_objects(); }

VK_LAYER_EXPORT uint32_t vkhLayerErrorsOf(const char* function, const char** errors,
                                          uint32_t capacity) {
  const unsigned bits = vkh::layer::errors_of(function);
  uint32_t count = 0;
#define VKH_LIST(bit, result) \
  if ((bits & vkh::layer::bit) != 0 && count++ < capacity) errors[count - 1] = #result;
  VKH_LAYER_ERRORS(VKH_LIST)
#undef VKH_LIST
  return count;
}
}
