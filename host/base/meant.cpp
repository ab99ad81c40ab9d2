#include "host/base/meant.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <system_error>
#include <vector>

#include "host/base/closest_name.h"
#include "host/base/decimal.h"
#include "host/base/from_chars.h"

namespace vkh {
namespace {

/// A unit as people type it, in lower case: times / over of a known unit of lengths.
struct TypedUnit {
  std::string_view typed, unit;
  double times = 1, over = 1;  ///< whole numbers
};
constexpr std::array<TypedUnit, 54> kTypedUnits = {{
    {"um", "um"},
    {"mm", "mm"},
    {"cm", "cm"},
    {"m", "m"},
    {"mil", "mil"},
    {"thou", "thou"},
    {"in", "in"},
    {"ft", "ft"},
    {"%", "%"},
    {"abs", "abs"},
    {"diag", "diag"},
    {"inch", "in"},
    {"inches", "in"},
    {"\"", "in"},
    {"''", "in"},
    {"mils", "mil"},
    {"foot", "ft"},
    {"feet", "ft"},
    {"'", "ft"},
    {"yd", "ft", 3},
    {"yard", "ft", 3},
    {"yards", "ft", 3},
    {"mile", "m", 1609344, 1000},
    {"miles", "m", 1609344, 1000},
    {"millimeter", "mm"},
    {"millimeters", "mm"},
    {"millimetre", "mm"},
    {"millimetres", "mm"},
    {"centimeter", "cm"},
    {"centimeters", "cm"},
    {"centimetre", "cm"},
    {"centimetres", "cm"},
    {"dm", "cm", 10},
    {"meter", "m"},
    {"meters", "m"},
    {"metre", "m"},
    {"metres", "m"},
    {"km", "m", 1000},
    {"micron", "um"},
    {"microns", "um"},
    {"micrometer", "um"},
    {"micrometers", "um"},
    {"micrometre", "um"},
    {"micrometres", "um"},
    {"\xc2\xb5m", "um"},  // the micro sign, and the Greek letter
    {"\xce\xbcm", "um"},
    {"nm", "um", 1, 1000},
    {"nanometer", "um", 1, 1000},
    {"nanometers", "um", 1, 1000},
    {"nanometre", "um", 1, 1000},
    {"nanometres", "um", 1, 1000},
    {"percent", "%"},
    {"pct", "%"},
    {"diagonal", "diag"},
}};

std::string stripped(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

const TypedUnit* unit_typed(std::string_view word) {
  const auto* const found = std::find_if(kTypedUnits.begin(), kTypedUnits.end(),
                                         [&](const TypedUnit& unit) { return unit.typed == word; });
  return found == kTypedUnits.end() ? nullptr : found;
}

/// Finds the unit that a misspelt word is closest to. Returns null if there is none, or if two
/// different units are as close.
const TypedUnit* nearest_unit(const std::string& word) {
  constexpr size_t kLong = 6;
  const bool is_word = word.size() > 1 && std::all_of(word.begin(), word.end(),
                                                      [](char c) { return c >= 'a' && c <= 'z'; });
  if (!is_word) return nullptr;
  std::vector<std::string> names;
  names.reserve(std::size(kTypedUnits));
  for (const TypedUnit& unit : kTypedUnits) names.emplace_back(unit.typed);
  const TypedUnit* nearest = nullptr;
  for (const std::string& name : closest_names(word, names, word.size() < kLong ? 1 : 2)) {
    const TypedUnit* const unit = unit_typed(name);
    if (nearest != nullptr && nearest->unit != unit->unit) return nullptr;
    nearest = unit;
  }
  return nearest;
}

const TypedUnit* typed_unit(const std::string& text) {
  std::string lower = stripped(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const TypedUnit* const found = unit_typed(lower);
  return found == nullptr ? nearest_unit(lower) : found;
}

/// The end of the number that `text` begins with, including its exponent, if it has one.
size_t number_end(const std::string& text) {
  const size_t digits = std::min(text.find_first_not_of("0123456789.,"), text.size());
  if (digits == text.size() || (text[digits] != 'e' && text[digits] != 'E')) return digits;
  const size_t sign = digits + 1;
  const bool is_signed = sign < text.size() && (text[sign] == '-' || text[sign] == '+');
  const size_t power = sign + (is_signed ? 1 : 0);
  const size_t end = std::min(text.find_first_not_of("0123456789", power), text.size());
  return end == power ? digits : end;
}

bool is_itself(const TypedUnit& unit) { return unit.times == unit.over; }

/// Writes a number and a unit in the form of parse_length; nothing if the number is none.
std::string as_parsed(const std::string& number, const TypedUnit& unit) {
  double value = 0;
  const char* const end = number.data() + number.size();
  const auto [rest, error] = number_from_chars(number.data(), end, value);
  if (error != std::errc() || rest != end || !(value > 0)) return "";
  if (is_itself(unit)) return number + std::string(unit.unit);
  return number_text(value * unit.times / unit.over, std::chars_format::general, 12) +
         std::string(unit.unit);
}

std::string without_commas(std::string number) {
  number.erase(std::remove(number.begin(), number.end(), ','), number.end());
  return number;
}

}  // namespace

std::string length_meant(const std::string& text) {
  std::string rest = stripped(text);
  if (rest.starts_with('+')) rest.erase(0, 1);
  const size_t end = number_end(rest);
  std::string number = rest.substr(0, end);
  const TypedUnit* const unit = typed_unit(rest.substr(end));
  if (unit == nullptr) return "";
  const size_t comma = number.find(',');
  if (comma == std::string::npos) return as_parsed(number, *unit);
  if (number.find('.') != std::string::npos || number.find(',', comma + 1) != std::string::npos)
    return as_parsed(without_commas(number), *unit);
  const std::string thousands = as_parsed(without_commas(number), *unit);
  number[comma] = '.';
  const std::string decimal = as_parsed(number, *unit);
  // A number such as 0,100 has no thousands separator.
  const bool is_either = number.size() == comma + 4 && comma > 0 && number[0] != '0';
  return is_either && !decimal.empty() ? decimal + " or " + thousands : decimal;
}

std::string unit_meant(const std::string& text) {
  const TypedUnit* const unit = typed_unit(text);
  constexpr std::array<std::string_view, 5> kOfLengthsAlone = {"%", "abs", "diag", "mil", "thou"};
  const bool is_unit = unit != nullptr && is_itself(*unit) &&
                       std::find(kOfLengthsAlone.begin(), kOfLengthsAlone.end(), unit->unit) ==
                           kOfLengthsAlone.end();
  return is_unit ? std::string(unit->unit) : std::string();
}

}  // namespace vkh
