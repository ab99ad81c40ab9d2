// SHA-256 (FIPS 180-4), by which an answer names its files.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

/// A file by its name and its bytes.
struct FileHash {
  std::string path;
  std::string sha256;  ///< 64 hexadecimal digits; empty: not known
  bool operator==(const FileHash&) const = default;
};

/// The hash of a file in 64 hexadecimal digits. Empty: the file cannot be read, `keep_going`
/// returned false, or this build has no library for it (libcrypto; on Windows the system's own).
std::string sha256_of(const std::filesystem::path& path, const std::function<bool()>& keep_going);

/// The hash of bytes that `next` hands out in pieces, an empty one last. Empty: no library.
std::string sha256_of_pieces(const std::function<std::string_view()>& next);

}  // namespace vkh
