// A file as its reader gets it: in memory, or to be read piece by piece.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/input_file.h"
#include "host/base/thread_pool.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/read_limits.h"

namespace vkh {

struct MeshSource {
  std::string name;        ///< starts every error line; its extension decides where content cannot
  std::string_view bytes;  ///< the whole file, unless `file` is there
  ReadLimits limits = {};
  const InputFile* file = nullptr;  ///< read instead of `bytes`
  /// The folder beneath which a file may name others that hold its data; empty: nowhere.
  std::string folder = {};
  uint64_t begin = 0;         ///< the byte where the mesh begins in `file`: after a byte-order mark
  bool* by_blocks = nullptr;  ///< for tests: becomes true if it was read by blocks

  uint64_t size() const { return file != nullptr ? file->size() - begin : bytes.size(); }
};

/// Throws Interrupted if the caller that waits for the file has called it off.
void check_going(const std::string& name, const ReadLimits& limits);

/// The threads that read the source, at its limits.
ThreadPool pool_of(const MeshSource& source);

/// Reports progress to a caller that watches.
inline void count_read(const MeshSource& source, uint64_t bytes) {
  if (source.limits.bytes_read != nullptr) *source.limits.bytes_read += bytes;
}

/// Reads all of it into memory. Throws InputError if the file has become shorter than it was.
std::string read_all(const MeshSource& source);

/// Pieces of a source, for several threads at once. Pieces of a file are read into memory that is
/// used again.
class Windows {
 public:
  explicit Windows(const MeshSource& source) : source_(source) {}

  class Window {
   public:
    explicit Window(Windows& windows) : windows_(windows), buffer_(windows.take()) {}
    ~Window() { windows_.give_back(std::move(buffer_)); }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// The bytes from `begin` to `end`, valid until the next call; throws InputError if the file
    /// has become shorter.
    std::string_view read(uint64_t begin, uint64_t end);

   private:
    Windows& windows_;
    std::vector<char> buffer_;
  };

  const MeshSource& source() const { return source_; }

 private:
  std::vector<char> take();
  void give_back(std::vector<char>&& buffer) noexcept;

  const MeshSource& source_;
  std::mutex mutex_;
  std::vector<std::vector<char>> free_;
  size_t made_ = 0;
};

/// The first `most` bytes, or all.
std::string head_of(const MeshSource& source, size_t most);

/// The bytes that one thread reads at a time: the limit if there is one, or a fitting part of the
/// file.
size_t block_bytes_of(const MeshSource& source);

/// The result of `read` for the source with all its bytes in memory.
template <class Read>
auto in_memory(const MeshSource& source, const Read& read) {
  if (source.file == nullptr) return read(source);
  const std::string bytes = read_all(source);
  MeshSource whole = source;
  whole.bytes = bytes;
  whole.file = nullptr;
  return read(whole);
}

/// Reads by blocks if there are several and `by_blocks` can. That need not report errors well:
/// after an InputError, `whole` reads everything in one block, and finds the first mistake and its
/// line.
template <class ByBlocks, class Whole>
auto by_blocks_or_whole(const MeshSource& source, const ByBlocks& by_blocks, const Whole& whole) {
  if (source.size() > block_bytes_of(source)) {
    try {
      auto mesh = by_blocks(source);
      if (source.by_blocks != nullptr) *source.by_blocks = true;
      return mesh;
    } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): `whole` reports it
    }
  }
  return in_memory(source, whole);
}

}  // namespace vkh
