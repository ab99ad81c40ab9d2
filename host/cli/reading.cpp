#include "host/cli/reading.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include "host/cli/progress_line.h"
#include "host/cli/session.h"
#include "host/read/mesh_io.h"
#include "host/system/system.h"

namespace vkh {
namespace {

/// What both readers ask and tell, each on threads of its own.
class Reading {
 public:
  Reading(const std::string& file_a, const std::string& file_b) {
    for (const std::string& file : {file_a, file_b}) {
      std::error_code none;
      const uintmax_t size = std::filesystem::file_size(path_of(file), none);
      if (!none) bytes_ += size;
    }
  }

  std::atomic<uint64_t> bytes_read = 0;

  /// False after Ctrl-C.
  bool show() {
    constexpr uint64_t kWorthwhile = 100'000'000;  // about a second on one core
    if (const std::unique_lock lock(mutex_, std::try_to_lock);
        lock && line_ && bytes_ >= kWorthwhile)
      line_->show_reading(bytes_read, bytes_);
    return !is_interrupted();
  }

  /// Takes the line away; a reader that goes on, after the other one's error, has none.
  void end() {
    const std::lock_guard lock(mutex_);
    line_.reset();
  }

 private:
  std::mutex mutex_;
  uint64_t bytes_ = 0;
  std::optional<ProgressLine> line_{std::in_place};
};

}  // namespace

// After a bad A nobody waits for B, whose threads still ask.
MeshPair read_pair(const std::string& file_a, const std::string& file_b, ReadLimits limits) {
  const auto reading = std::make_shared<Reading>(file_a, file_b);
  limits.bytes_read = &reading->bytes_read;
  limits.keep_going = [reading] { return reading->show(); };
  auto b = begin_now([file_b, limits] { return read_mesh(path_of(file_b), limits); });
  try {
    MeshPair pair{read_mesh(path_of(file_a), limits), {}};
    pair.b = b.get();
    reading->end();
    return pair;
  } catch (...) {
    reading->end();
    throw;
  }
}

}  // namespace vkh
