// A 3MF file's package: a zip archive, out of which parts are read piece by piece, by libzip.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "host/read/readers.h"

namespace vkh::threemf {

/// Needs no more memory than the archive's own list of parts; a part is never in memory as a whole.
class Package {
 public:
  /// The source's bytes have to outlive it. Rejects a file that is no zip archive.
  explicit Package(const MeshSource& source);
  ~Package();
  Package(const Package&) = delete;
  Package& operator=(const Package&) = delete;

  bool has(const std::string& part) const { return find(part) >= 0; }
  /// Unpacks a part, named from the root on, with or without its first slash: use(piece) for each
  /// piece, in order. The unpacked bytes count against --max-input. Rejects a part that is not
  /// there, encrypted or damaged.
  /// Percents in the name, and "." and "..", mean what they do in a URI.
  void read(const std::string& part, const std::function<void(std::string_view)>& use);

 private:
  struct Archive;
  int64_t find(const std::string& part) const;

  const MeshSource& source_;
  uint64_t unpacked_bytes_ = 0;
  std::unique_ptr<Archive> archive_;
};

}  // namespace vkh::threemf
