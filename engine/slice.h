// The parts of a generated kernel header (tools/kernels/embed_shaders.py).
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <type_traits>

#include "shaders/gpu_types.h"

namespace vkh {

// A range of a buffer that holds elements of type T.
template <class T>
struct Slice {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;  // bytes
  VkDeviceSize size = 0;    // bytes
};

// The same range as elements of another type: kernels that only read a struct may read it in words
// of 16 bytes.
template <class U, class T>
Slice<U> as(const Slice<T>& slice) {
  return {slice.buffer, slice.offset, slice.size};
}

// A kernel's argument. It has no default: a designated initialiser without it does not compile, at
// any warning level (clang 14's -Wmissing-field-initializers passes over designated
// initialisers). Converting from a slice is implicit, so that a slice can be passed directly.
template <class T>
struct Argument : Slice<T> {
  Argument() = delete;
  Argument(const Slice<T>& slice) : Slice<T>(slice) {}
  // The type that traversals read in whole loads.
  template <class U>
  requires std::is_same_v<T, gpu::uvec4> || std::is_same_v<T, gpu::vec2> Argument(
      const Slice<U>& slice)
      : Slice<T>(as<T>(slice)) {}
};

template <class T>
VkDescriptorBufferInfo info(const Slice<T>& slice) {
  return {slice.buffer, slice.offset, slice.size};
}

// The push type of a kernel without push constants.
struct NoPush {};

// The place of the addresses of large buffers among a kernel's push constants, in the order of the
// bindings, 8 bytes each (engine/by_address.h).
constexpr uint32_t kAddressOffset = 64;
constexpr uint32_t kMaxAddresses = 8;  // 128 bytes of push constants are on every device

struct Binding {
  uint32_t binding;
  const char* name;
  bool read_only;  // the kernel never writes it
};

}  // namespace vkh
