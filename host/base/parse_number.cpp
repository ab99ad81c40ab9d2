#include "host/base/parse_number.h"

#include <algorithm>
#include <cstdint>

namespace vkh {

// Decides by the decade of the first digit: a number that is no double is far from 1 on one side.
bool is_tiny_decimal(std::string_view word) {
  constexpr int64_t kFar = int64_t{1} << 62;  // beyond the digits of any file
  const size_t e = std::min(word.find_first_of("eE"), word.size());
  const size_t point = std::min(word.find('.'), e);
  const size_t first = std::min(word.find_first_of("123456789"), e);
  std::string_view power = word.substr(std::min(e + 1, word.size()));
  if (power.starts_with('+')) power.remove_prefix(1);
  int64_t exponent = 0;
  if (std::from_chars(power.data(), power.data() + power.size(), exponent).ec ==
      std::errc::result_out_of_range) {
    exponent = power.starts_with('-') ? -kFar : kFar;
  }
  const auto decade = static_cast<int64_t>(point) - static_cast<int64_t>(first);
  return std::clamp(exponent, -kFar, kFar) + decade < 0;
}

}  // namespace vkh
