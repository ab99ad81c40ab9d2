#include "vkhausdorff/length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>

#include "host/base/decimal.h"
#include "host/base/float128.h"
#include "host/base/from_chars.h"
#include "host/base/meant.h"
#include "host/base/rounding.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

struct Unit {
  std::string_view name;
  double tenths_of_micrometres;  ///< an integer for each
};
constexpr std::array<Unit, 8> kUnits = {{{"um", 1e1},
                                         {"mm", 1e4},
                                         {"cm", 1e5},
                                         {"m", 1e7},
                                         {"in", 254000},
                                         {"ft", 3048000},
                                         {"mil", 254},  // 127/5000 mm
                                         {"thou", 254}}};
constexpr size_t kFileUnits = 6;  ///< files are in one of the first ones

const Unit* find_unit(const std::string& name) {
  const auto* const found =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& u) { return u.name == name; });
  return found == kUnits.end() ? nullptr : &*found;
}

bool is_of_files(const std::string& name) {
  const Unit* unit = find_unit(name);
  return unit != nullptr && unit < kUnits.data() + kFileUnits;
}

constexpr const char* kUnitNames = "um, mm, cm, m, in or ft";

/// How far A's diagonal moves at most, for each unit of delta. A and its exact surface are within
/// delta of each other, so that each of the six planes of the bounding box moves by delta at most,
/// and each extent by 2 delta. The diagonal is the norm of three extents: by the triangle
/// inequality it moves by the norm of (2, 2, 2) delta, which is 2 sqrt(3) = 3.46410... delta.
/// Six corners that each move along their own axis reach it.
constexpr double kDiagonalPerDelta = 3.4642;

/// Encloses what lies between `least` and `most`, each the result of a product and a quotient or
/// two in Float128 (113 bits) from a number of 53 bits. The number was rounded to nearest, twice if
/// it was a percentage. A diagonal is off by six times 2^-53 of itself at most: its extents are
/// rounded, by 2^-53 of themselves, and hypot3 adds 5 of these (host/base/hypot3.h). Of the least
/// diagonal, which is no less than half of it where it decides, that is twelve times 2^-53. With
/// the number's two and the last rounding's one that is under 16 ulps, which are 2^-53 each at
/// least.
Limit around(Float128 least, Float128 most) {
  constexpr int kUlps = 16;
  Limit limit{static_cast<double>(least), static_cast<double>(most)};
  for (int ulp = 0; ulp < kUlps; ++ulp) {
    limit.within = std::nextafter(limit.within, 0.0);
    limit.beyond = std::nextafter(limit.beyond, std::numeric_limits<double>::infinity());
  }
  return limit;
}

Limit around(Float128 x) { return around(x, x); }

/// Returns "did you mean 0.1mm? " if the meaning is known and differs from the typed text.
std::string proposal(const std::string& meant, const std::string& typed) {
  return meant.empty() || meant == typed ? std::string() : "did you mean " + meant + "? ";
}

std::string expected_of(PlainNumber plain) {
  std::string text = "a positive length: ";
  if (plain != PlainNumber::kRefused) text += "a fraction of diag(A) such as 1e-6, ";
  return text +
         "0.1mm (um, cm, m, in, ft, mil and thou, too), 0.1abs in the files' own unit, 0.1% of "
         "diag(A) or "
         "1e-6diag";
}

/// Says why a share of the diagonal would decide nothing; empty: it does.
std::string why_unknown(const Diagonal& of_a) {
  using Doubles = std::numeric_limits<double>;
  const double least = of_a.least(), most = of_a.most();
  if (of_a.held() == 0) return "0";
  if (least < of_a.held() / 2)
    return "only known to lie between " + decimal(least, 3, Rounding::kDown) + " and " +
           decimal(most, 3, Rounding::kUp);
  const bool is_normal = least >= Doubles::min() && most < Doubles::max();
  return is_normal ? "" : "beyond what a double holds to all its bits";
}

}  // namespace

Length parse_length(const char* option, const std::string& text, PlainNumber plain) {
  constexpr double kLeast = 1e-290;  // a hundredth, or a part in another unit, has all its bits
  Length length{.requested = text};
  const char* end = text.data() + text.size();
  // from_chars, because a locale must not decide whether 0.5 is a number.
  const auto [rest, error] = number_from_chars(text.data(), end, length.number);
  std::string unit(rest, end);
  unit.erase(0, unit.find_first_not_of(' '));
  const bool is_number =
      error == std::errc() && std::isfinite(length.number) && length.number >= kLeast;
  const bool is_fraction = unit == "diag" || (unit.empty() && plain != PlainNumber::kRefused);
  constexpr double kSmall = 1e-3;
  if (is_number && unit.empty() && plain == PlainNumber::kSmallFraction && length.number > kSmall)
    throw UsageError(std::string(option) + " '" + text + "': write " + text + "diag for " + text +
                     " of A's diagonal, or " + text + "mm or " + text +
                     "abs, in the files' own unit, for a length");
  if (unit == "%") {
    length.number /= 100;
  } else if (unit == "abs") {
    length.of = Length::Of::kFiles;
  } else if (find_unit(unit) != nullptr) {
    length.of = Length::Of::kUnit;
    length.unit = unit;
  } else if (!is_fraction) {
    length.number = 0;
  }
  if (!is_number || !(length.number > 0))
    throw UsageError(std::string(option) + " '" + text +
                     "': " + proposal(length_meant(text), text) + "expected " + expected_of(plain));
  return length;
}

void check_unit(const char* option, const std::string& unit) {
  if (!is_of_files(unit))
    throw UsageError(std::string(option) + " '" + unit + "': " + proposal(unit_meant(unit), unit) +
                     "expected " + kUnitNames);
}

UnitRatio unit_ratio(const std::string& from, const std::string& to) {
  const auto a = static_cast<uint64_t>(find_unit(from)->tenths_of_micrometres);
  const auto b = static_cast<uint64_t>(find_unit(to)->tenths_of_micrometres);
  const uint64_t common = std::gcd(a, b), numerator = a / common, denominator = b / common;
  return {static_cast<double>(numerator), static_cast<double>(denominator)};
}

double in_millimetres(double length, const std::string& unit) {
  const Unit* known = find_unit(unit);
  constexpr double kMillimetre = 1e4;
  return known == nullptr ? length : length * (known->tenths_of_micrometres / kMillimetre);
}

double Diagonal::least() const {
  return std::max(0.0, add_down(held_, -multiply_up(kDiagonalPerDelta, delta_)));
}

double Diagonal::most() const { return add_up(held_, multiply_up(kDiagonalPerDelta, delta_)); }

Limit in_files(const Length& length, const char* option, const std::string& file_unit,
               const Diagonal& of_a) {
  const Float128 number = float128(length.number);
  Limit limit;
  if (length.of == Length::Of::kDiagonal) {
    limit = around(number * float128(of_a.least()), number * float128(of_a.most()));
  } else if (length.of == Length::Of::kFiles) {
    limit = length.is_double ? Limit{length.number, length.number} : around(number);
  } else {
    const Unit* file = find_unit(file_unit);
    if (file == nullptr) {
      throw UsageError(
          std::string(option) + " '" + length.requested +
          "': the files do not say what they are in; say so with " +
          (std::string_view(option).starts_with("--") ? "--unit" : "unit_a and unit_b") +
          ", or give the length in their own unit, as " +
          length.requested.substr(0, length.requested.find_first_not_of("0123456789.eE+- ")) +
          "abs");
    }
    limit = around(number * float128(find_unit(length.unit)->tenths_of_micrometres) /
                   float128(file->tenths_of_micrometres));
  }
  if (!std::isfinite(limit.beyond))
    throw UsageError(std::string(option) + " '" + length.requested + "': longer than any double");
  return limit;
}

Limit limit_in_files(const Length& length, const char* option, const std::string& file_unit,
                     const Diagonal& of_a) {
  const std::string unknown = length.of == Length::Of::kDiagonal ? why_unknown(of_a) : "";
  if (!unknown.empty())
    throw UsageError(std::string(option) + " '" + length.requested + "': A's diagonal is " +
                     unknown + "; give the length itself, as 0.1abs or 0.1mm");
  return in_files(length, option, file_unit, of_a);
}

double typed_length(const Limit& limit) {
  const double middle = limit.within / 2 + limit.beyond / 2;
  char text[32] = "";
  std::snprintf(text, sizeof text, "%.15g", middle);
  const double decimal = std::strtod(text, nullptr);
  return decimal >= limit.within && decimal <= limit.beyond ? decimal : middle;
}

std::string length_in_words(const Limit& limit) {
  const double length = typed_length(limit);
  for (const Rounding rounding : {Rounding::kDown, Rounding::kUp}) {  // a decimal is either's
    std::string all = decimal(length, 12, rounding);
    if (std::strtod(all.c_str(), nullptr) == length) return all;
  }
  return "about " + decimal(length, 4, Rounding::kDown);
}

std::string typed_in_words(const Length& length, const std::string& file_unit) {
  const std::string& text = length.requested;
  const std::string digits = text.substr(0, text.find_first_not_of("0123456789.eE+-"));
  if (length.of == Length::Of::kUnit) return with_unit(digits, length.unit);
  if (length.of == Length::Of::kFiles) return with_unit(digits, file_unit);
  return text.ends_with('%') ? digits + " % of A's diagonal" : digits + " of A's diagonal";
}

std::string with_unit(std::string number, const std::string& unit) {
  if (!unit.empty()) number.append(" ").append(unit);
  return number;
}

}  // namespace vkh
