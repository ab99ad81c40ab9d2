#include <windows.h>

#include "host/gpu/vulkan_loader.h"

namespace vkh {

const char* const kVulkanLoader = "vulkan-1.dll: install your graphics card's driver";
const bool kAsksForPortability = false;

AnyFunction vulkan_loader_function(const char* name) {
  // Searches the program's folder and Windows' own, not the current one.
  const HMODULE library =
      LoadLibraryExW(L"vulkan-1.dll", nullptr, LOAD_LIBRARY_SEARCH_DEFAULT_DIRS);
  return library == nullptr ? nullptr
                            : reinterpret_cast<AnyFunction>(GetProcAddress(library, name));
}

}  // namespace vkh
