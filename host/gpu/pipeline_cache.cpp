#include "host/gpu/pipeline_cache.h"

#include <array>
#include <atomic>
#include <cstring>
#include <fstream>
#include <vector>

#include "host/base/system.h"
#include "host/gpu/vulkan_api.h"
#include "kernels/all_kernels.h"

namespace vkh {
namespace {

namespace fs = std::filesystem;

// Drivers look at the header of their data and trust the rest, so the file has a checksum.
constexpr uint64_t kMagic = 0x31706970686b76u;  // "vkhpip1"
// A VkPipelineCacheHeaderVersionOne and nothing after it: the driver keeps no pipelines (lavapipe).
constexpr size_t kEmptyBytes = 32;
constexpr size_t kMostBytes = size_t{256} << 20;

struct FileHeader {
  uint64_t magic = kMagic, bytes = 0, checksum = 0;
};

// Mixes the same way in every process, for names and checksums of files. It protects against
// accidents, not against people.
uint64_t mix_bits(uint64_t hash, uint64_t word) {
  hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 29);
}

uint64_t checksum_of(const std::vector<char>& data) {
  uint64_t hash = data.size();
  for (size_t at = 0; at < data.size(); at += 8) {
    uint64_t word = 0;
    std::memcpy(&word, data.data() + at, std::min<size_t>(8, data.size() - at));
    hash = mix_bits(hash, word);
  }
  return hash;
}

uint64_t kernels_fingerprint() {
  uint64_t hash = 0;
#define VKH_MIX(K) hash = mix_bits(hash, k::K::fingerprint());
  VKH_KERNELS(VKH_MIX)
#undef VKH_MIX
  return hash;
}

std::string hexadecimal(uint64_t value) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

// Names one file per device, driver and set of kernels.
std::string file_name(const Device& device) {
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  device.vk().GetPhysicalDeviceProperties2(device.physical(), &properties);
  const VkPhysicalDeviceProperties& p = properties.properties;
  std::array<uint64_t, 2> uuid{};
  static_assert(sizeof(uuid) == VK_UUID_SIZE);
  std::memcpy(uuid.data(), p.pipelineCacheUUID, VK_UUID_SIZE);
  uint64_t hash = mix_bits(kernels_fingerprint(), uuid[0]);
  for (const uint64_t word : {uuid[1], uint64_t{p.vendorID}, uint64_t{p.deviceID},
                              uint64_t{p.driverVersion}, uint64_t{p.apiVersion}})
    hash = mix_bits(hash, word);
  return hexadecimal(hash) + ".pipelines";
}

}  // namespace

std::vector<char> read_checked(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  FileHeader header{};
  if (!in.read(reinterpret_cast<char*>(&header), sizeof(header))) return {};
  std::error_code none;
  if (header.magic != kMagic || header.bytes > kMostBytes ||
      fs::file_size(path, none) != sizeof(header) + header.bytes)
    return {};
  std::vector<char> data(header.bytes);
  in.read(data.data(), static_cast<std::streamsize>(data.size()));
  return in && checksum_of(data) == header.checksum ? data : std::vector<char>();
}

void write_checked(const fs::path& path, const std::vector<char>& data) {
  std::error_code none;
  fs::create_directories(path.parent_path(), none);
  fs::path mine = path;
  static std::atomic<unsigned> count = 0;  // two Solvers may save at once
  mine += "." + std::to_string(process_id()) + "-" + std::to_string(count++);
  std::ofstream out(mine, std::ios::binary);
  const FileHeader header{kMagic, data.size(), checksum_of(data)};
  out.write(reinterpret_cast<const char*>(&header), sizeof(header));
  out.write(data.data(), static_cast<std::streamsize>(data.size()));
  out.close();
  if (out) fs::rename(mine, path, none);
  if (!out || none) fs::remove(mine, none);
}

PipelineCache::PipelineCache(const Device& device, const fs::path& folder) : device_(device) {
  if (folder.empty()) return;
  file_ = folder / file_name(device);
  const std::vector<char> data = read_checked(file_);
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = data.size();
  info.pInitialData = data.data();
  if (device.vk().CreatePipelineCache(device.handle(), &info, nullptr, &cache_) != VK_SUCCESS)
    cache_ = VK_NULL_HANDLE;
  saved_bytes_ = data.size();
}

PipelineCache::~PipelineCache() {
  device_.vk().DestroyPipelineCache(device_.handle(), cache_, nullptr);
}

void PipelineCache::save() {
  if (cache_ == VK_NULL_HANDLE) return;
  const VulkanApi& vk = device_.vk();
  size_t bytes = 0;
  if (vk.GetPipelineCacheData(device_.handle(), cache_, &bytes, nullptr) != VK_SUCCESS) return;
  if (bytes <= kEmptyBytes || bytes <= saved_bytes_ || bytes > kMostBytes) return;
  std::vector<char> data(bytes);
  if (vk.GetPipelineCacheData(device_.handle(), cache_, &bytes, data.data()) != VK_SUCCESS) return;
  data.resize(bytes);
  write_checked(file_, data);
  saved_bytes_ = bytes;
}

}  // namespace vkh
