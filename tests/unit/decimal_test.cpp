// Printed decimals against exact rationals: outward, and by less than one unit of the last digit.
#include "host/base/decimal.h"

#include <doctest/doctest.h>

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "tests/support/sanitized.h"

namespace {

using boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;
using vkh::decimal;
using vkh::Rounding;
using vkh::test::kIsSanitized;

Rational power(unsigned base, int exponent) {
  const cpp_int p =
      boost::multiprecision::pow(cpp_int(base), static_cast<unsigned>(std::abs(exponent)));
  return exponent < 0 ? Rational(1, p) : Rational(p);
}

Rational exact(double value) {
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(value, &exponent), 53);
  return Rational(static_cast<int64_t>(mantissa)) * power(2, exponent - 53);
}

/// A decimal, read without any rounding.
struct Printed {
  Rational value;
  bool is_json = false;
};

Printed read_decimal(const std::string& text) {
  cpp_int digits = 0;
  int scale = 0;
  Printed printed;
  bool after_point = false;
  size_t i = text[0] == '-' ? 1 : 0;
  for (; i < text.size() && text[i] != 'e'; ++i) {
    if (text[i] == '.') {
      after_point = true;
      continue;
    }
    REQUIRE(text[i] >= '0');
    REQUIRE(text[i] <= '9');
    digits = digits * 10 + (text[i] - '0');
    if (after_point) --scale;
  }
  if (i < text.size()) scale += std::atoi(text.c_str() + i + 1);
  printed.value = Rational(digits) * power(10, scale) * (text[0] == '-' ? -1 : 1);
  printed.is_json = nlohmann::json::accept(text);
  return printed;
}

/// Exponent of the first significant digit of |value|.
int decade(const Rational& value) {
  const Rational magnitude = abs(value);
  int e = static_cast<int>(std::floor(std::log10(magnitude.convert_to<double>())));
  while (power(10, e) > magnitude) --e;
  while (power(10, e + 1) <= magnitude) ++e;
  return e;
}

void check_outward(double value, int digits) {
  CAPTURE(value);
  CAPTURE(digits);
  const Rational truth = exact(value);
  const Printed down = read_decimal(decimal(value, digits, Rounding::kDown));
  const Printed up = read_decimal(decimal(value, digits, Rounding::kUp));
  const Rational unit = power(10, decade(truth) - digits + 1);
  CHECK(down.value <= truth);
  CHECK(truth <= up.value);
  CHECK(truth - down.value < unit);
  CHECK(up.value - truth < unit);
  // Two different answers must both be inexact, otherwise one of them was widened for nothing.
  if (down.value != up.value) {
    CHECK(down.value < truth);
    CHECK(truth < up.value);
    CHECK(up.value - down.value == unit);
  }
  CHECK(down.is_json);
  // A few digits may round up past the largest double, which JSON's grammar allows and its readers
  // do not; kJsonDigits never do.
  const bool past_all_doubles = up.value > exact(std::numeric_limits<double>::max());
  CHECK((up.is_json || (past_all_doubles && digits < vkh::kJsonDigits)));
}

double random_bits_double(std::mt19937_64& random) {
  for (;;) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value) && value != 0) return value;
  }
}

TEST_CASE("random bit patterns are printed outward within one unit") {
  std::mt19937_64 random(1);
  for (int i = 0; i < (kIsSanitized ? 150 : 3000); ++i) {
    const double value = random_bits_double(random);
    check_outward(value, 1 + static_cast<int>(random() % 20));
    check_outward(value, vkh::kJsonDigits);
  }
}

TEST_CASE("sizes that people meet are printed outward within one unit") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-9, 9);
  for (int i = 0; i < (kIsSanitized ? 500 : 10000); ++i) {
    check_outward(std::pow(10.0, exponent(random)), 1 + static_cast<int>(random() % 20));
  }
}

TEST_CASE("doubles beside short decimals, where carries run through all digits") {
  for (int e = -30; e <= 30; e += kIsSanitized ? 10 : 1) {
    for (double factor : {1.0, 0.999, 9.99, 0.5, 0.1, 123456789.0}) {
      const double value = factor * std::pow(10.0, e);
      for (double v : {std::nextafter(value, 0.0), value, std::nextafter(value, 1e300)}) {
        for (int digits : {1, 2, 3, 9, 15, 16, 17, 18, 30}) {
          check_outward(v, digits);
          check_outward(-v, digits);
        }
      }
    }
  }
}

TEST_CASE("the ends of the range") {
  using Limits = std::numeric_limits<double>;
  for (double value : {Limits::max(), Limits::min(), Limits::denorm_min(),
                       std::nextafter(Limits::min(), 0.0), 0x1p-1074 * 3}) {
    for (int digits : {1, 5, 17, 400, 767, 800}) check_outward(value, digits);
  }
}

TEST_CASE("spellings") {
  CHECK(decimal(0, 17, Rounding::kDown) == "0");
  CHECK(decimal(-0.0, 17, Rounding::kUp) == "0");
  CHECK(decimal(0.25, 17, Rounding::kDown) == "0.25");
  CHECK(decimal(0.25, 1, Rounding::kDown) == "0.2");
  CHECK(decimal(0.25, 1, Rounding::kUp) == "0.3");
  CHECK(decimal(-0.25, 1, Rounding::kDown) == "-0.3");
  CHECK(decimal(-0.25, 1, Rounding::kUp) == "-0.2");
  CHECK(decimal(999.5, 3, Rounding::kUp) == "1000");
  CHECK(decimal(999.5, 3, Rounding::kDown) == "999");
  CHECK(decimal(123456, 2, Rounding::kUp) == "130000");
  CHECK(decimal(0x1p-40, 3, Rounding::kDown) == "9.09e-13");
  CHECK(decimal(1e300, 1, Rounding::kUp) == "2e300");
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(decimal(infinity, 17, Rounding::kUp) == "inf");
  CHECK(decimal(-infinity, 17, Rounding::kUp) == "-inf");
  CHECK(decimal(std::nan(""), 17, Rounding::kUp) == "nan");
}

TEST_CASE("what JSON gives, rounded outward, reads back as the double") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::abs(random_bits_double(random));
    const double down =
        std::strtod(decimal(value, vkh::kJsonDigits, Rounding::kDown).c_str(), nullptr);
    const double up = std::strtod(decimal(value, vkh::kJsonDigits, Rounding::kUp).c_str(), nullptr);
    CHECK(down == value);
    CHECK(up == value);
  }
}

TEST_CASE("hex floats read back as the same bits") {
  std::mt19937_64 random(4);
  for (int i = 0; i < 20000; ++i) {
    const double value = random_bits_double(random);
    const std::string text = vkh::hex_float(value);
    CHECK(text.find("0x") <= 1);
    CHECK(std::bit_cast<uint64_t>(std::strtod(text.c_str(), nullptr)) ==
          std::bit_cast<uint64_t>(value));
  }
  CHECK(vkh::hex_float(0) == "0x0p+0");
  CHECK(vkh::hex_float(0.1875) == "0x1.8p-3");
  CHECK(vkh::hex_float(std::numeric_limits<double>::infinity()) == "inf");
}

TEST_CASE("digits that matter go two past the gap") {
  CHECK(vkh::digits_that_matter(0.5, 1e-6) == 8);  // 0.50000000
  CHECK(vkh::digits_that_matter(123.4, 0.01) == 7);
  CHECK(vkh::digits_that_matter(1e-9, 1) == 3);
  CHECK(vkh::digits_that_matter(1, 0) == vkh::kJsonDigits);
  CHECK(vkh::digits_that_matter(0, 1e-9) == 3);
  CHECK(vkh::digits_that_matter(1, std::numeric_limits<double>::infinity()) == 3);
}

}  // namespace
