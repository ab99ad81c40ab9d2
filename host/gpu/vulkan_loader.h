// The Vulkan loader of this operating system, found at run time (vulkan_loader_posix.cpp,
// vulkan_loader_windows.cpp).
#pragma once

namespace vkh {

using AnyFunction = void (*)();

/// A function of the Vulkan loader, which is never closed again: drivers keep threads and exit
/// handlers of their own. Null if there is no loader.
AnyFunction vulkan_loader_function(const char* name);
/// The loader's name and source.
extern const char* const kVulkanLoader;
/// Whether the system's drivers stand on another interface (macOS: Metal). The loader lists such
/// drivers, which may leave out parts of Vulkan, only to programs that ask for them.
extern const bool kAsksForPortability;

}  // namespace vkh
