// Binary files as they grow, little-endian.
#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <string_view>

namespace vkh {

class Bytes {
 public:
  template <class T>
  void add(T value) {
    static_assert(std::endian::native == std::endian::little);
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    text.append(raw, sizeof(T));
  }

  std::string text;
};

/// A GLB of glTF 2.0: the document, and one binary chunk whose size is a multiple of four. Throws
/// OutputError if it exceeds 4 GiB.
std::string glb_of(std::string json, std::string_view binary);

}  // namespace vkh
