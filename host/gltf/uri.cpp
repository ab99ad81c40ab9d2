#include <algorithm>
#include <array>
#include <filesystem>

#include "host/gltf/data.h"
#include "host/system/system.h"

namespace vkh::gltf {
namespace {

constexpr int kNoDigit = -1;

constexpr std::array<int, 256> base64_digits() {
  std::array<int, 256> digits{};
  digits.fill(kNoDigit);
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t i = 0; i < kDigits.size(); ++i)
    digits[static_cast<unsigned char>(kDigits[i])] = static_cast<int>(i);
  return digits;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return kNoDigit;
}

// JSON may write a slash as \/; names that need other escapes are refused below.
std::string without_escaped_slashes(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '/') continue;
    out += text[i];
  }
  return out;
}

}  // namespace

bool decode_base64(std::string_view uri, std::vector<char>& out) {
  static constexpr std::array<int, 256> kDigits = base64_digits();
  constexpr std::string_view kMark = ";base64,";
  const size_t mark = uri.substr(0, 256).find(kMark);
  if (mark == std::string_view::npos) return false;
  std::string_view text = uri.substr(mark + kMark.size());
  while (text.ends_with('=')) text.remove_suffix(1);
  out.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0, count = 0;
  for (const char c : text) {
    if (c == '\\') continue;
    const int digit = kDigits[static_cast<unsigned char>(c)];
    if (digit == kNoDigit) return false;
    bits = bits << 6 | static_cast<uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out.push_back(static_cast<char>(bits >> count & 0xff));
  }
  return count != 6;
}

bool file_beneath(std::string_view uri, std::string& name) {
  const std::string text = without_escaped_slashes(uri);
  name.clear();
  for (size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 2 >= text.size()) return false;
      const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
      if (high == kNoDigit || low == kNoDigit) return false;
      c = static_cast<char>(16 * high + low);
      i += 2;
    }
    if (static_cast<unsigned char>(c) < 0x20 || c == '\\' || c == ':') return false;
    name += c;
  }
  const std::filesystem::path path = path_of(name);
  return !name.empty() && path.is_relative() && !path.has_root_path() &&
         std::find(path.begin(), path.end(), path_of("..")) == path.end();
}

}  // namespace vkh::gltf
