// A decimal as it is printed, read without any rounding.
#pragma once

#include <gmpxx.h>

#include <cstdlib>
#include <string>

namespace vkh::test {

/// The exact value of a decimal such as "-12.5e-3". Throws std::invalid_argument for other texts.
inline mpq_class decimal_value(const std::string& text) {
  const size_t e = text.find('e');
  std::string number = text.substr(0, e);
  int exponent = e == std::string::npos ? 0 : std::stoi(text.substr(e + 1));
  if (const size_t point = number.find('.'); point != std::string::npos) {
    exponent -= static_cast<int>(number.size() - point - 1);
    number.erase(point, 1);
  }
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(exponent)));
  const mpz_class mantissa(number, 10);
  mpq_class value = exponent < 0 ? mpq_class(mantissa, power) : mpq_class(mantissa * power);
  value.canonicalize();
  return value;
}

}  // namespace vkh::test
