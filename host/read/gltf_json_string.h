// Decodes strings of JSON, escapes included, from the bytes of the document.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "host/base/percent.h"

namespace vkh::gltf {

/// A string's bytes in UTF-8, one by one, its escapes resolved (RFC 8259, section 7).
class JsonString {
 public:
  static constexpr int kEnd = -1, kNoEscape = -2;

  explicit JsonString(std::string_view text) : text_(text) {}

  /// Returns 0 to 255, or kEnd, or kNoEscape where a backslash begins none.
  int next() {
    if (pending_ < pending_count_) return static_cast<unsigned char>(bytes_[pending_++]);
    if (at_ >= text_.size()) return kEnd;
    const char c = text_[at_++];
    return c == '\\' ? escape() : static_cast<unsigned char>(c);
  }

 private:
  int escape() {
    constexpr std::string_view kEscapes = "\"\\/bfnrt", kBytes = "\"\\/\b\f\n\r\t";
    if (at_ >= text_.size()) return kNoEscape;
    const char name = text_[at_++];
    if (name == 'u') return code_point();
    const size_t number = kEscapes.find(name);
    return number == std::string_view::npos ? kNoEscape
                                            : static_cast<unsigned char>(kBytes[number]);
  }

  // Reads four hexadecimal digits; false if there are none.
  bool unit(uint32_t& value) {
    value = 0;
    for (int i = 0; i < 4; ++i) {
      if (at_ >= text_.size()) return false;
      const char c = text_[at_++];
      const int digit = hex_digit(c);
      if (digit < 0) return false;
      value = value << 4 | static_cast<uint32_t>(digit);
    }
    return true;
  }

  // Reads a code point. One beyond 0xffff is a pair of surrogates; half a pair is none.
  int code_point() {
    uint32_t code = 0, low = 0;
    if (!unit(code) || (code & 0xfc00) == 0xdc00) return kNoEscape;
    if ((code & 0xfc00) == 0xd800) {
      if (text_.substr(at_, 2) != "\\u") return kNoEscape;
      at_ += 2;
      if (!unit(low) || (low & 0xfc00) != 0xdc00) return kNoEscape;
      code = 0x10000 + ((code & 0x3ff) << 10 | (low & 0x3ff));
    }
    return encode(code);
  }

  int encode(uint32_t code) {
    if (code < 0x80) return static_cast<int>(code);
    const uint32_t more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    constexpr uint32_t kFirst[] = {0, 0xc0, 0xe0, 0xf0};
    for (uint32_t i = 0; i < more; ++i)
      bytes_[i] = static_cast<char>(0x80 | (code >> (6 * (more - 1 - i)) & 0x3f));
    pending_ = 0;
    pending_count_ = more;
    return static_cast<int>(kFirst[more] | code >> (6 * more));
  }

  std::string_view text_;
  size_t at_ = 0;
  std::array<char, 3> bytes_{};  // the bytes of a code point, after its first
  uint32_t pending_ = 0, pending_count_ = 0;
};

}  // namespace vkh::gltf
