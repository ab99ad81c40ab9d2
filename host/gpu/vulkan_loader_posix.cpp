#include <dlfcn.h>

#include "host/gpu/vulkan_loader.h"

namespace vkh {
namespace {

#ifdef __APPLE__
constexpr const char* kLoaders[] = {"libvulkan.1.dylib", "/usr/local/lib/libvulkan.1.dylib",
                                    "/opt/homebrew/lib/libvulkan.1.dylib", "libMoltenVK.dylib"};
#else
constexpr const char* kLoaders[] = {"libvulkan.so.1", "libvulkan.so"};
#endif

void* vulkan_loader() {
  for (const char* name : kLoaders) {
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
  }
  return nullptr;
}

}  // namespace

#ifdef __APPLE__
const char* const kVulkanLoader =
    "libvulkan.1.dylib or libMoltenVK.dylib: install the Vulkan SDK, or molten-vk and "
    "vulkan-loader from Homebrew";
const bool kAsksForPortability = true;
#else
const bool kAsksForPortability = false;
const char* const kVulkanLoader = "libvulkan.so.1: install your driver's or the package libvulkan1";
#endif

AnyFunction vulkan_loader_function(const char* name) {
  void* library = vulkan_loader();
  return library == nullptr ? nullptr : reinterpret_cast<AnyFunction>(dlsym(library, name));
}

}  // namespace vkh
