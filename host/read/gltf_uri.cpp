#include <algorithm>
#include <array>
#include <filesystem>

#include "host/base/percent.h"
#include "host/base/system.h"
#include "host/read/gltf_data.h"
#include "host/read/gltf_json_string.h"

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

bool is_beneath(const std::string& name) {
  for (const char c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == '\\' || c == ':') return false;
  }
  const std::filesystem::path path = path_of(name);
  return !name.empty() && path.is_relative() && !path.has_root_path() &&
         std::find(path.begin(), path.end(), path_of("..")) == path.end();
}

}  // namespace

bool is_data(std::string_view uri) {
  JsonString text(uri);
  for (const char c : std::string_view("data:")) {
    if (text.next() != c) return false;
  }
  return true;
}

bool decode_base64(std::string_view uri, std::vector<char>& out) {
  static constexpr std::array<int, 256> kDigits = base64_digits();
  constexpr std::string_view kMark = ";base64,";
  constexpr size_t kLongestHead = 256;
  JsonString text(uri);
  std::string head;
  while (!head.ends_with(kMark)) {
    const int c = text.next();
    if (c < 0 || head.size() == kLongestHead) return false;
    head += static_cast<char>(c);
  }
  out.reserve(uri.size() / 4 * 3 + 3);
  uint32_t bits = 0, count = 0;
  bool is_over = false;  // nothing but '=' comes behind one
  for (int c = text.next(); c != JsonString::kEnd; c = text.next()) {
    is_over = is_over || c == '=';
    const int digit = c < 0 ? kNoDigit : kDigits[static_cast<size_t>(c)];
    if (is_over ? c != '=' : digit == kNoDigit) return false;
    if (is_over) continue;
    bits = bits << 6 | static_cast<uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out.push_back(static_cast<char>(bits >> count & 0xff));
  }
  return count != 6;
}

std::vector<std::string> files_beneath(std::string_view uri) {
  std::string written;
  JsonString text(uri);
  for (int c = text.next(); c != JsonString::kEnd; c = text.next()) {
    if (c < 0) return {};
    written += static_cast<char>(c);
  }
  std::vector<std::string> names;
  const std::string resolved = without_percents(written);
  if (is_beneath(resolved)) names.push_back(resolved);
  if (resolved != written && is_beneath(written)) names.push_back(written);
  return names;
}

}  // namespace vkh::gltf
