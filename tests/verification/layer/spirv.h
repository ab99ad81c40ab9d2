// A compute shader's needs, read from its SPIR-V with its specialisation, and what it writes.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>

namespace vkh::layer {

struct ShaderNeeds {
  std::array<uint32_t, 3> local_size{1, 1, 1};
  uint64_t shared_bytes = 0;
};

/// Returns nothing if the module holds an operation on constants that this file does not know.
std::optional<ShaderNeeds> needs_of(std::span<const uint32_t> words,
                                    const VkSpecializationInfo* specialisation);

/// The storage buffers of a shader, by binding: whether it may write one. A member or variable that
/// is decorated NonWritable is not written. Returns nothing for a module that is broken.
std::optional<std::map<uint32_t, bool>> writes_of(std::span<const uint32_t> words);

}  // namespace vkh::layer
