#include "host/gpu/shader_folder.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "host/gpu/vulkan_loader.h"
#include "kernels/all_kernels.h"

namespace vkh {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kSpirvMagic = 0x07230203;

PFN_vkGetInstanceProcAddr loaders = nullptr;
PFN_vkGetDeviceProcAddr loaders_of_device = nullptr;

fs::path shader_folder() {
  const char* folder = std::getenv("VKH_SHADER_DIR");
  return folder != nullptr ? folder : "";
}

// The name of the kernel whose words these are, by their address.
const char* kernel_of(const uint32_t* words) {
#define VKH_COMPARE(K) \
  if (words == k::K::words().data() || words == k::K::words_for_cpu().data()) return k::K::kName;
  VKH_KERNELS(VKH_COMPARE)
#undef VKH_COMPARE
  return nullptr;
}

// Returns nothing if there is no file, and no words if it is no SPIR-V.
std::optional<std::vector<uint32_t>> words_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  std::vector<uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), 4 * words.size());
  if (bytes.size() % 4 != 0 || words.empty() || words[0] != kSpirvMagic) words.clear();
  return words;
}

VKAPI_ATTR VkResult VKAPI_CALL create_module(VkDevice device, const VkShaderModuleCreateInfo* info,
                                             const VkAllocationCallbacks* callbacks,
                                             VkShaderModule* module) {
  static const auto create =
      reinterpret_cast<PFN_vkCreateShaderModule>(vulkan_loader_function("vkCreateShaderModule"));
  const char* name = kernel_of(info->pCode);
  if (name == nullptr) return create(device, info, callbacks, module);
  const fs::path file = shader_folder() / (std::string(name) + ".spv");
  const auto words = words_in(file);
  if (!words) return create(device, info, callbacks, module);
  if (words->empty()) {
    std::fprintf(stderr, "VKH_SHADER_DIR: %s is no SPIR-V\n", file.string().c_str());
    return VK_ERROR_INITIALIZATION_FAILED;
  }
  VkShaderModuleCreateInfo ours = *info;
  ours.codeSize = 4 * words->size();
  ours.pCode = words->data();
  return create(device, &ours, callbacks, module);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name) {
  return std::strcmp(name, "vkCreateShaderModule") == 0
             ? reinterpret_cast<PFN_vkVoidFunction>(create_module)
             : loaders_of_device(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name) {
  const PFN_vkVoidFunction found = loaders(instance, name);
  if (std::strcmp(name, "vkGetDeviceProcAddr") != 0) return found;
  return reinterpret_cast<PFN_vkVoidFunction>(device_function);
}

}  // namespace

PFN_vkGetInstanceProcAddr with_shader_folder(PFN_vkGetInstanceProcAddr loader) {
  const fs::path folder = shader_folder();
  if (loader == nullptr || folder.empty()) return loader;
  std::fprintf(stderr, "kernels come from %s (VKH_SHADER_DIR)\n", folder.string().c_str());
  loaders = loader;
  loaders_of_device =
      reinterpret_cast<PFN_vkGetDeviceProcAddr>(vulkan_loader_function("vkGetDeviceProcAddr"));
  return instance_function;
}

}  // namespace vkh
