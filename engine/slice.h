// What a generated kernel header (tools/embed_shaders.py) is made of.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace vkh {

// A range of a buffer that holds elements of type T.
template <class T>
struct Slice {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;  // bytes
  VkDeviceSize size = 0;    // bytes
};

// A member without a default: leaving it out of a designated initialiser does not compile, at any
// warning level (clang 14's -Wmissing-field-initializers passes over designated initialisers).
// Converting from T is implicit, so that a plain slice is an argument.
template <class T>
struct Required : T {
  Required() = delete;
  Required(const T& value) : T(value) {}
};

// The same range as elements of another type: kernels that only read a struct may take it in words
// of 16 bytes.
template <class U, class T>
Slice<U> as(const Slice<T>& slice) {
  return {slice.buffer, slice.offset, slice.size};
}

template <class T>
VkDescriptorBufferInfo info(const Slice<T>& slice) {
  return {slice.buffer, slice.offset, slice.size};
}

// The push type of a kernel without push constants.
struct NoPush {};

struct Binding {
  uint32_t binding;
  const char* name;
  bool read_only;  // the kernel never writes it
};

}  // namespace vkh
