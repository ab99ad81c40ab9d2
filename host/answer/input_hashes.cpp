#include "host/answer/input_hashes.h"

#include <filesystem>
#include <functional>

#include "host/base/system.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh {
namespace {

std::string sha256_within(const std::filesystem::path& path, const ReadLimits& limits) {
  const auto goes_on = [&] { return !limits.keep_going || limits.keep_going(); };
  std::string digest = sha256_of(path, goes_on);
  if (digest.empty() && !goes_on())
    throw Interrupted(name_of(path) + ": called off while it was hashed");
  return digest;
}

/// Adds the files' sizes to `bytes`.
std::vector<FileHash> hash_beneath(const std::filesystem::path& path, const ReadLimits& limits,
                                   uint64_t& bytes) {
  std::vector<FileHash> hashes;
  for (const FileBeneath& file : files_beneath(path, limits)) {
    const bool is_there = !file.path.empty();
    hashes.push_back({file.name, is_there ? sha256_within(file.path, limits) : ""});
    if (is_there) bytes += file_bytes(file.path);
  }
  return hashes;
}

}  // namespace

std::vector<FileHash> hashes_beneath(const std::string& file, const ReadLimits& limits) {
  uint64_t bytes = 0;
  return hash_beneath(path_of(file), limits, bytes);
}

InputHashes hashes_of_input(const std::string& file, const ReadLimits& limits) {
  const std::filesystem::path path = path_of(file);
  InputHashes hashes{.sha256 = sha256_within(path, limits), .files = {}};
  hashes.bytes = file_bytes(path);
  if (!hashes.sha256.empty()) hashes.files = hash_beneath(path, limits, hashes.bytes);
  return hashes;
}

}  // namespace vkh
