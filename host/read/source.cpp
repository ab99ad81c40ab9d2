#include "host/read/source.h"

#include <algorithm>

#include "host/base/reject.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

std::string called_off(const std::string& name) { return name + ": called off while it was read"; }

[[noreturn]] void reject_shorter(const MeshSource& source, uint64_t end) {
  reject(source.name, "byte " + std::to_string(end),
         "the file ends or cannot be read, and had " + std::to_string(source.size()) + " bytes",
         "a file that nobody writes to while it is read");
}

}  // namespace

void check_going(const std::string& name, const ReadLimits& limits) {
  if (limits.keep_going && !limits.keep_going()) throw Interrupted(called_off(name));
}

ThreadPool pool_of(const MeshSource& source) {
  return {source.limits.threads, source.limits.keep_going, called_off(source.name)};
}

std::string read_all(const MeshSource& source) {
  if (source.file == nullptr) return std::string(source.bytes);
  constexpr size_t kPiece = size_t{1} << 24;
  const auto size = static_cast<size_t>(source.size());
  std::string bytes;
  bytes.reserve(size);
  while (bytes.size() < size) {
    check_going(source.name, source.limits);
    const size_t at = bytes.size(), piece = std::min(kPiece, size - at);
    bytes.resize(at + piece);
    const size_t got = source.file->read(source.begin + at, bytes.data() + at, piece);
    if (got < piece) reject_shorter(source, at + got);
  }
  return bytes;
}

std::vector<char> Windows::take() {
  const std::lock_guard lock(mutex_);
  if (free_.empty()) {
    free_.reserve(++made_);  // so that giving back cannot fail
    return {};
  }
  std::vector<char> buffer = std::move(free_.back());
  free_.pop_back();
  return buffer;
}

void Windows::give_back(std::vector<char>&& buffer) noexcept {
  const std::lock_guard lock(mutex_);
  free_.push_back(std::move(buffer));
}

std::string_view Windows::Window::read(uint64_t begin, uint64_t end) {
  const MeshSource& source = windows_.source_;
  const auto size = static_cast<size_t>(end - begin);
  if (source.file == nullptr) return source.bytes.substr(static_cast<size_t>(begin), size);
  if (buffer_.size() < size) buffer_ = std::vector<char>(size);
  const size_t got = source.file->read(source.begin + begin, buffer_.data(), size);
  if (got < size) reject_shorter(source, begin + got);
  return {buffer_.data(), size};
}

std::string head_of(const MeshSource& source, size_t most) {
  Windows windows(source);
  return std::string(Windows::Window(windows).read(0, std::min<uint64_t>(most, source.size())));
}

// A small file gives several blocks per thread, so that none waits long for the last one.
size_t block_bytes_of(const MeshSource& source) {
  constexpr uint64_t kLeast = uint64_t{1} << 16, kMost = uint64_t{1} << 19;
  if (source.limits.block_bytes != 0) return source.limits.block_bytes;
  const uint64_t threads = source.limits.threads == 0 ? thread_count() : source.limits.threads;
  return static_cast<size_t>(std::clamp(source.size() / (4 * threads), kLeast, kMost));
}

}  // namespace vkh
