// The layer's state while it runs: the next functions of every instance and device, objects
// that live, calls that were counted.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "tests/verification/layer/functions.h"

namespace vkh::layer {

/// The functions below this layer, of one instance or one device.
struct Table {
  VkInstance instance = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
  PFN_vkGetDeviceProcAddr GetDeviceProcAddr = nullptr;
  PFN_vkDestroyInstance DestroyInstance = nullptr;
  PFN_vkDestroyDevice DestroyDevice = nullptr;
  std::atomic<bool> is_lost = false;
#define VKH_NEXT(name, ...) PFN_vk##name name = nullptr;
  VKH_LAYER_INSTANCE_FALLIBLE(VKH_NEXT)
  VKH_LAYER_INSTANCE_VOID(VKH_NEXT)
  VKH_LAYER_DEVICE_FALLIBLE(VKH_NEXT)
  VKH_LAYER_DEVICE_SAFE(VKH_NEXT)
  VKH_LAYER_DEVICE_VOID(VKH_NEXT)
#undef VKH_NEXT
};

/// A dispatchable handle begins with the loader's table, which all handles of a device share.
template <class Handle>
void* key_of(Handle handle) {
  return *reinterpret_cast<void**>(handle);
}
Table& table_of(void* key);
Table& add_table(void* key);
void remove_table(void* key);

template <class Handle>
uint64_t number_of(Handle handle) {
  return (uint64_t)handle;  // a pointer, or an integer on 32 bits
}

/// Handed out in place of an object if its creation was failed: no code may use it.
constexpr uint64_t kPoison = 0x5ead5ead5ead5ea0u;

/// A limit or rule that was broken: a line on stderr, counted; aborts unless it is to keep going.
void violation(const std::string& what);
uint32_t violations();

/// Counts a call and returns its result if it is not to be made.
std::optional<VkResult> fault_of(const char* function, unsigned errors, Table& table);
/// Counts a call that cannot fail. Returns how many there were.
uint64_t count_call(const std::string& function);
uint64_t count_of(const std::string& function);
void write_counts();

bool arm(const char* faults);
uint32_t injected();
std::string log_text();

/// Objects by type, handle and owner (its device's, pool's or instance's number).
void add_object(const char* type, uint64_t handle, uint64_t owner);
/// Returns false, and reports a violation, if there is none; null is fine.
bool remove_object(const char* type, uint64_t handle);
void remove_objects_of(uint64_t owner);
/// The living objects of `owner`, as "2 VkBuffer, 1 VkFence"; empty if none.
std::string objects_of(uint64_t owner);
uint32_t live_objects();

}  // namespace vkh::layer
