#include "host/base/reject.h"

#include "vkhausdorff/error.h"

namespace vkh {

void reject(std::string_view name, const std::string& place, const std::string& what,
            const std::string& expected) {
  throw InputError(
      {.file = std::string(name), .place = place, .problem = what, .expected = expected});
}

std::string quoted(std::string_view word) {
  constexpr size_t kLongest = 32;
  constexpr const char* kHex = "0123456789abcdef";
  std::string out = "'";
  for (const char c : word.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      out += c;
    } else {
      out += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return out + (word.size() > kLongest ? "...'" : "'");
}

}  // namespace vkh
