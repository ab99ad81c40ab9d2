#include "host/base/decimal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "host/base/from_chars.h"

namespace vkh {
namespace {

/// |value| = 0.d1d2d3... * 10^(exponent + 1), with all its digits.
struct Digits {
  std::string digits;
  int exponent = 0;  ///< the first digit's
};

// The longest exact expansion of a double has 767 significant digits (the largest denormal), so
// that asking to_chars for that many leaves nothing to round.
Digits exact_digits(double magnitude) {
  constexpr int kMostDigits = 767;
  std::array<char, kMostDigits + 16> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), magnitude,
                                    std::chars_format::scientific, kMostDigits - 1);
  const std::string text(buffer.data(), result.ptr);
  const size_t e = text.find('e');
  return {text.substr(0, 1) + text.substr(2, e - 2), std::atoi(text.c_str() + e + 1)};
}

/// Adds one unit to the last digit; 999 becomes 1000 with one digit less than that: 100 and a
/// larger exponent.
void increment(Digits& number) {
  size_t i = number.digits.size();
  while (i > 0 && number.digits[i - 1] == '9') number.digits[--i] = '0';
  if (i > 0) {
    ++number.digits[i - 1];
    return;
  }
  number.digits.front() = '1';
  ++number.exponent;
}

double number_of(const std::string& text) {
  double number = 0;
  number_from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

void round_to(Digits& number, size_t digits, bool away_from_zero) {
  if (digits >= number.digits.size()) return;
  const bool inexact = number.digits.find_first_not_of('0', digits) != std::string::npos;
  number.digits.resize(digits);
  if (inexact && away_from_zero) increment(number);
}

std::string scientific(const Digits& number) {
  std::string text = number.digits.substr(0, 1);
  if (number.digits.size() > 1) text.append(1, '.').append(number.digits, 1);
  return text.append(1, 'e').append(std::to_string(number.exponent));
}

/// Compares |x| with |y|: negative if it is smaller.
int compare(const Digits& x, const Digits& y) {
  if (x.exponent != y.exponent) return x.exponent < y.exponent ? -1 : 1;
  const size_t digits = std::max(x.digits.size(), y.digits.size());
  const auto padded = [&](const Digits& number) {
    return number.digits + std::string(digits - number.digits.size(), '0');
  };
  return padded(x).compare(padded(y));
}

/// Two ends of 0 or more, upper > 0.
struct Ends {
  std::optional<Digits> lower = {};  ///< none: 0
  Digits upper = {};

  bool contain(const Digits& number) const {
    return (!lower || compare(*lower, number) <= 0) && compare(number, upper) <= 0;
  }
};

Ends ends_of(double lower, double upper) {
  Ends ends;
  ends.upper = exact_digits(std::min(upper, std::numeric_limits<double>::max()));
  if (lower > 0) ends.lower = exact_digits(lower);
  return ends;
}

/// The same, rounded outward as JSON has them.
Ends printed_ends_of(double lower, double upper) {
  Ends ends = ends_of(lower, upper);
  if (ends.lower) round_to(*ends.lower, kJsonDigits, false);
  round_to(ends.upper, kJsonDigits, true);
  return ends;
}

/// Both decimals next to a number, the nearer one first.
std::array<Digits, 2> next_to(const Digits& exact, size_t digits) {
  Digits down = exact, up = exact;
  round_to(down, digits, false);
  round_to(up, digits, true);
  const bool is_up = exact.digits.size() > digits && exact.digits[digits] >= '5';
  return is_up ? std::array{up, down} : std::array{down, up};
}

std::string positional(const Digits& number) {
  const std::string& d = number.digits;
  if (number.exponent < 0) {
    return "0." + std::string(static_cast<size_t>(-number.exponent - 1), '0') + d;
  }
  const size_t whole = static_cast<size_t>(number.exponent) + 1;
  if (d.size() <= whole) return d + std::string(whole - d.size(), '0');
  return d.substr(0, whole) + "." + d.substr(whole);
}

std::string text_of(Digits number) {
  number.digits.erase(number.digits.find_last_not_of('0') + 1);
  const bool readable = number.exponent >= -5 && number.exponent < kJsonDigits;
  return readable ? positional(number) : scientific(number);
}

}  // namespace

std::string decimal(double value, int digits, Rounding rounding) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  if (value == 0) return "0";
  const bool negative = value < 0;
  Digits number = exact_digits(std::abs(value));
  round_to(number, static_cast<size_t>(std::max(digits, 1)),
           negative == (rounding == Rounding::kDown));
  const std::string magnitude = text_of(std::move(number));
  return negative ? std::string("-").append(magnitude) : magnitude;
}

std::string decimal_inside(double value, double lower, double upper, int digits) {
  if (!std::isfinite(value) || value == 0) return decimal(value, 1, Rounding::kDown);
  if (value < 0) return "-" + decimal_inside(-value, -upper, -lower, digits);
  constexpr int kEnough =
      20;  // neighbouring doubles always have a decimal of 20 digits between them
  const Digits exact = exact_digits(value);
  const Ends ends = ends_of(lower, upper);
  const int most = lower < upper ? kEnough : kJsonDigits - 1;
  for (int n = std::max(digits, 1); n <= most; ++n) {
    for (Digits& number : next_to(exact, static_cast<size_t>(n))) {
      if (ends.contain(number)) return text_of(std::move(number));
    }
  }
  return shortest_decimal(value);
}

std::string decimal_between(double value, double lower, double upper) {
  if (!std::isfinite(value) || value == 0) return decimal(value, 1, Rounding::kDown);
  if (value < 0) return "-" + decimal_between(-value, -upper, -lower);
  const Digits exact = exact_digits(value);
  const Ends ends = printed_ends_of(lower, upper);
  for (size_t n = 1; n < kJsonDigits; ++n) {
    for (Digits& number : next_to(exact, n)) {
      std::string text = ends.contain(number) ? text_of(std::move(number)) : std::string();
      if (!text.empty() && number_of(text) == value) return text;
    }
  }
  return decimal(value, kJsonDigits, Rounding::kDown);
}

std::string grouped(uint64_t count) {
  std::string text = std::to_string(count);
  for (size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

std::string hex_float(double value) {
  if (!std::isfinite(value)) return decimal(value, 1, Rounding::kDown);
  std::array<char, 40> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(value),
                                    std::chars_format::hex);
  return (std::signbit(value) ? "-0x" : "0x") + std::string(buffer.data(), result.ptr);
}

int digits_that_matter(double value, double gap) {
  if (!std::isfinite(value) || value == 0 || !std::isfinite(gap)) return 3;
  if (gap <= 0) return kJsonDigits;
  const double past_gap = std::floor(std::log10(std::abs(value))) - std::floor(std::log10(gap));
  return static_cast<int>(std::clamp(past_gap + 3, 3.0, static_cast<double>(kJsonDigits)));
}

std::string number_text(double value, std::chars_format format, int digits) {
  std::array<char, 400> text;  // 309 digits before the point, at most
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, digits).ptr;
  return {text.data(), end};
}

std::string coordinates_text(double x, double y, double z) {
  const auto nine = [](double value) { return number_text(value, std::chars_format::general, 9); };
  return nine(x) + ", " + nine(y) + ", " + nine(z);
}

std::string shortest_decimal(double value) {
  std::string text;
  for (int digits = 6; digits <= 17; ++digits) {
    text = number_text(value, std::chars_format::general, digits);
    if (number_of(text) == value) break;
  }
  return text;
}

}  // namespace vkh
