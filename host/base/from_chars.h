// std::from_chars of a double, which libc++ has from LLVM 20 on.
#pragma once

#include <charconv>
#include <concepts>
#include <version>

namespace vkh {

#ifndef _WIN32
/// The same by strtod_l in the locale C, for decimals and for `format` hex (without 0x); refuses
/// inf and nan. Returns the double nearest to the number, in any locale of the program.
std::from_chars_result from_chars_by_strtod(const char* first, const char* last, double& value,
                                            std::chars_format format = std::chars_format::general);
#endif

/// Reads the longest number at `first`, correctly rounded, and returns where it ends; `value` stays
/// as it was if there is none (invalid_argument) or if it is no double (result_out_of_range).
inline std::from_chars_result number_from_chars(
    const char* first, const char* last, double& value,
    std::chars_format format = std::chars_format::general) {
#if defined(__cpp_lib_to_chars)
  return std::from_chars(first, last, value, format);
#else
  return from_chars_by_strtod(first, last, value, format);
#endif
}

/// The same of an integer.
template <std::integral T>
std::from_chars_result number_from_chars(const char* first, const char* last, T& value) {
  return std::from_chars(first, last, value);
}

}  // namespace vkh
