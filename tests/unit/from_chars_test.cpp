// number_from_chars without the library's own: the same numbers, ends and errors.
#include "host/base/from_chars.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>

#ifndef _WIN32
namespace {

struct Read {
  double value = 17;  // which stays where there is no number
  std::ptrdiff_t length = 0;
  std::errc error{};
};

Read read(std::string_view text, std::chars_format format = std::chars_format::general) {
  Read got;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = vkh::from_chars_by_strtod(text.data(), end, got.value, format);
  got.length = rest - text.data();
  got.error = error;
  return got;
}

constexpr auto kNone = std::errc::invalid_argument;
constexpr auto kBeyond = std::errc::result_out_of_range;
constexpr auto kHex = std::chars_format::hex;

}  // namespace

TEST_CASE("a number ends where it is none any more") {
  struct Case {
    std::string_view text;
    double value;
    std::ptrdiff_t length;
    std::errc error;
  };
  const std::array cases = {
      Case{"1.5mm", 1.5, 3, {}},      Case{"-2.", -2, 3, {}},        Case{".5.5", 0.5, 2, {}},
      Case{"1e", 1, 1, {}},           Case{"1e+", 1, 1, {}},         Case{"1e+2e", 100, 4, {}},
      Case{"0x10", 0, 1, {}},         Case{"1,5", 1, 1, {}},         Case{"0e999", 0, 5, {}},
      Case{"", 17, 0, kNone},         Case{".", 17, 0, kNone},       Case{"-", 17, 0, kNone},
      Case{"+1", 17, 0, kNone},       Case{" 1", 17, 0, kNone},      Case{"e5", 17, 0, kNone},
      Case{"nan", 17, 0, kNone},      Case{"-inf", 17, 0, kNone},    Case{"--1", 17, 0, kNone},
      Case{"1e309 ", 17, 5, kBeyond}, Case{"1e-400", 17, 6, kBeyond}};
  for (const Case& c : cases) {
    CAPTURE(c.text);
    const Read got = read(c.text);
    CHECK(got.value == c.value);
    CHECK(got.length == c.length);
    CHECK(got.error == c.error);
  }
  CHECK(std::signbit(read("-0").value));
  CHECK(read("1.8p-3x", kHex).value == 0x1.8p-3);
  CHECK(read("1.8p-3x", kHex).length == 6);
  CHECK(read("fFp", kHex).value == 255);
  CHECK(read("1p1024", kHex).error == kBeyond);
  CHECK(read("p5", kHex).error == kNone);
}

#if defined(__cpp_lib_to_chars)
namespace {

// Digits of any number, at any power; many lie next to the middle of two doubles.
std::string random_decimal(std::mt19937_64& random) {
  std::string text = random() % 2 == 0 ? "-" : "";
  const double x = std::bit_cast<double>(random() >> 1);
  std::array<char, 800> digits{};
  const int count = static_cast<int>(random() % 40);
  const double shown = std::isfinite(x) ? x : 0.1;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), shown,
                                 std::chars_format::scientific, count)
                       .ptr;
  return text.append(digits.data(), end);
}

}  // namespace

TEST_CASE("numbers are the library's, bit for bit") {
  std::mt19937_64 random(46);
  for (int round = 0; round < 100'000; ++round) {
    const std::string text = random_decimal(random);
    double theirs = 17;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), theirs);
    const Read got = read(text);
    const bool agree = got.error == error && got.length == rest - text.data() &&
                       std::bit_cast<uint64_t>(got.value) == std::bit_cast<uint64_t>(theirs);
    if (!agree) FAIL(text);
  }
}

TEST_CASE("hexadecimal numbers are those that were written") {
  std::mt19937_64 random(47);
  for (int round = 0; round < 100'000; ++round) {
    const auto x = std::bit_cast<double>(random() >> 1);
    if (!std::isfinite(x)) continue;
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x, kHex).ptr;
    if (read({digits.data(), end}, kHex).value != x) FAIL("round " << round);
  }
}
#endif
#endif
