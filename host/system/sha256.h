// A file's SHA-256 (FIPS 180-4), by which an answer names what it is about.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace vkh {

/// 64 hexadecimal digits. Empty: the file cannot be read, `keep_going` said no, or this build has
/// no library for it (libcrypto; on Windows the system's own).
std::string sha256_of(const std::filesystem::path& path, const std::function<bool()>& keep_going);

}  // namespace vkh
