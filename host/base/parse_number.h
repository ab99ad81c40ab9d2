// Decimal numbers of files and options, read in full or refused.
#pragma once

#include <cstddef>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "host/base/from_chars.h"

namespace vkh {

/// Whether a decimal that is no double lies below the least one, not beyond the largest.
bool is_tiny_decimal(std::string_view word);

/// Reads all of `word` as a decimal number of type T, correctly rounded; false if any of it is left
/// over (1/3, 1,5, 0x1p3), if it is nan or inf, or if it is too large for T. A number below the
/// least double becomes a zero of its sign. The leading plus that from_chars refuses is accepted.
template <class T>
bool parse_number(std::string_view word, T& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const size_t sign = !word.empty() && word[0] == '-' ? 1 : 0;
  // Without this, some from_chars take the words nan and inf.
  if (word.size() == sign || word[sign] > '9') return false;
  const auto [end, error] = number_from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return false;
  if constexpr (std::is_same_v<T, double>) {
    if (error == std::errc::result_out_of_range && is_tiny_decimal(word)) {
      value = sign == 1 ? -0.0 : 0.0;
      return true;
    }
  }
  return error == std::errc();
}

}  // namespace vkh
