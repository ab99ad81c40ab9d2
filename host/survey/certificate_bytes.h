// Numbers as a certificate file has them: docs/certificate-file.md.
#pragma once

#include <cstdint>
#include <string>

namespace vkh {

/// Appends a number, little-endian.
inline void append_unsigned(std::string& out, uint64_t x, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>((x >> (8 * i)) & 255);
}

/// Appends a number in groups of seven bits, the lowest first.
inline void append_count(std::string& out, uint64_t x) {
  for (; x >= 128; x >>= 7) append_unsigned(out, 128 | (x & 127), 1);
  append_unsigned(out, x, 1);
}

}  // namespace vkh
