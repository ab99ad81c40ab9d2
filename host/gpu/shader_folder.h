// Builds with VKH_DEBUGGING take a kernel's SPIR-V from the folder that the environment variable
// VKH_SHADER_DIR names, so that a changed kernel needs no link (docs/debugging.md).
#pragma once

#include <vulkan/vulkan.h>

namespace vkh {

/// Returns the loader's function, or one whose devices use NAME.spv for the kernel NAME if that
/// file exists. A kernel by address is the build's own: its words are edited on the way.
PFN_vkGetInstanceProcAddr with_shader_folder(PFN_vkGetInstanceProcAddr loader);

}  // namespace vkh
