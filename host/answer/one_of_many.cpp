#include "host/answer/one_of_many.h"

#include "host/base/system.h"

namespace vkh {

ReadMesh read_one_of_many(const std::string& file, ReadLimits limits) {
  constexpr uint64_t kLarge = uint64_t{1} << 25;
  const std::filesystem::path path = path_of(file);
  limits.threads = file_bytes(path) < kLarge ? 1 : 0;
  return read_mesh(path, limits);
}

}  // namespace vkh
