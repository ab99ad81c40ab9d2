#include "host/job/reading.h"

#include <atomic>
#include <filesystem>
#include <memory>

#include "host/job/session.h"
#include "host/read/mesh_io.h"
#include "host/system/system.h"

namespace vkh {

MeshPair read_pair(const std::string& file_a, const std::string& file_b, ReadLimits limits,
                   const std::shared_ptr<const Reading>& reading) {
  constexpr uint64_t kWorthwhile = 100'000'000;  // about a second on one core
  uint64_t bytes = 0;
  for (const std::string& file : {file_a, file_b}) {
    std::error_code none;
    const uintmax_t size = std::filesystem::file_size(path_of(file), none);
    if (!none) bytes += size;
  }
  const auto bytes_read = std::make_shared<std::atomic<uint64_t>>(0);
  limits.bytes_read = bytes_read.get();
  limits.keep_going = [bytes_read, bytes, reading] {
    if (bytes >= kWorthwhile) reading->line.show_reading(*bytes_read, bytes);
    return !reading->stop.is_asked();
  };
  auto b = begin_now([file_b, limits] { return read_mesh(path_of(file_b), limits); });
  MeshPair pair{read_mesh(path_of(file_a), limits), {}};
  pair.b = b.get();
  return pair;
}

}  // namespace vkh
