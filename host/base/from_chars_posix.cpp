#include <locale.h>  // newlocale
#include <stdlib.h>  // strtod_l

#include "host/base/from_chars.h"
#ifdef __APPLE__
#include <xlocale.h>
#endif

#include <cmath>
#include <string>
#include <string_view>

namespace vkh {
namespace {

struct DigitSet {
  std::string_view all;
  const char* end_in(const char* at, const char* last) const {
    while (at != last && all.find(*at) != std::string_view::npos) ++at;
    return at;
  }
};

constexpr DigitSet kDecimal{"0123456789"}, kHexadecimal{"0123456789abcdefABCDEF"};

// The end of digits, a point among them, from `first`; `first` itself if there is no digit.
const char* end_of_digits(const char* first, const char* last, const DigitSet& digits) {
  const char* const whole = digits.end_in(first, last);
  if (whole == last || *whole != '.') return whole;
  const char* const end = digits.end_in(whole + 1, last);
  return end - first == 1 ? first : end;
}

// The end of the exponent that begins at `at`; `at` itself if there is none.
const char* end_of_exponent(const char* at, const char* last, char letter) {
  if (at == last || (*at | 0x20) != letter) return at;
  const char* digits = at + 1;
  if (digits != last && (*digits == '+' || *digits == '-')) ++digits;
  const char* const end = kDecimal.end_in(digits, last);
  return end == digits ? at : end;
}

bool has_other_than_zero(std::string_view digits) {
  return digits.find_first_not_of("0.") != std::string_view::npos;
}

}  // namespace

std::from_chars_result from_chars_by_strtod(const char* first, const char* last, double& value,
                                            std::chars_format format) {
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", static_cast<locale_t>(nullptr));
  const bool is_hex = format == std::chars_format::hex;
  const bool is_negative = first != last && *first == '-';
  const char* const begin = first + (is_negative ? 1 : 0);
  const char* const digits = end_of_digits(begin, last, is_hex ? kHexadecimal : kDecimal);
  if (digits == begin) return {first, std::errc::invalid_argument};
  const char* const end = end_of_exponent(digits, last, is_hex ? 'p' : 'e');
  const std::string text = (is_hex ? "0x" : "") + std::string(begin, end);
  const double size = strtod_l(text.c_str(), nullptr, plain);
  if (std::isinf(size) || (size == 0 && has_other_than_zero({begin, digits})))
    return {end, std::errc::result_out_of_range};
  value = is_negative ? -size : size;
  return {end, std::errc()};
}

}  // namespace vkh
