#include "host/base/meant.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <system_error>

#include "host/base/decimal.h"

namespace vkh {
namespace {

/// A unit as people type it, in lower case, and its factor to a unit of lengths.
struct TypedUnit {
  std::string_view typed;
  double of;
  std::string_view unit;
};
constexpr std::array<TypedUnit, 52> kTypedUnits = {{
    {"um", 1, "um"},
    {"mm", 1, "mm"},
    {"cm", 1, "cm"},
    {"m", 1, "m"},
    {"in", 1, "in"},
    {"ft", 1, "ft"},
    {"%", 1, "%"},
    {"abs", 1, "abs"},
    {"diag", 1, "diag"},
    {"inch", 1, "in"},
    {"inches", 1, "in"},
    {"\"", 1, "in"},
    {"''", 1, "in"},
    {"mil", 0.0254, "mm"},
    {"mils", 0.0254, "mm"},
    {"thou", 0.0254, "mm"},
    {"foot", 1, "ft"},
    {"feet", 1, "ft"},
    {"'", 1, "ft"},
    {"yd", 3, "ft"},
    {"yard", 3, "ft"},
    {"yards", 3, "ft"},
    {"millimeter", 1, "mm"},
    {"millimeters", 1, "mm"},
    {"millimetre", 1, "mm"},
    {"millimetres", 1, "mm"},
    {"centimeter", 1, "cm"},
    {"centimeters", 1, "cm"},
    {"centimetre", 1, "cm"},
    {"centimetres", 1, "cm"},
    {"dm", 10, "cm"},
    {"meter", 1, "m"},
    {"meters", 1, "m"},
    {"metre", 1, "m"},
    {"metres", 1, "m"},
    {"km", 1000, "m"},
    {"micron", 1, "um"},
    {"microns", 1, "um"},
    {"micrometer", 1, "um"},
    {"micrometers", 1, "um"},
    {"micrometre", 1, "um"},
    {"micrometres", 1, "um"},
    {"\xc2\xb5m", 1, "um"},  // the micro sign, and the Greek letter
    {"\xce\xbcm", 1, "um"},
    {"nm", 0.001, "um"},
    {"nanometer", 0.001, "um"},
    {"nanometers", 0.001, "um"},
    {"nanometre", 0.001, "um"},
    {"nanometres", 0.001, "um"},
    {"percent", 1, "%"},
    {"pct", 1, "%"},
    {"diagonal", 1, "diag"},
}};

std::string stripped(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

const TypedUnit* typed_unit(const std::string& text) {
  std::string lower = stripped(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto* const found =
      std::find_if(kTypedUnits.begin(), kTypedUnits.end(),
                   [&](const TypedUnit& unit) { return unit.typed == lower; });
  return found == kTypedUnits.end() ? nullptr : found;
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

/// Writes a number and a unit in the form of parse_length; nothing if the number is none.
std::string as_parsed(const std::string& number, const TypedUnit& unit) {
  double value = 0;
  const char* const end = number.data() + number.size();
  const auto [rest, error] = std::from_chars(number.data(), end, value);
  if (error != std::errc() || rest != end || !(value > 0)) return "";
  if (unit.of == 1) return number + std::string(unit.unit);
  return number_text(value * unit.of, std::chars_format::general, 12) + std::string(unit.unit);
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
  // A number such as 0,100 has no thousands.
  const bool is_either = number.size() == comma + 4 && comma > 0 && number[0] != '0';
  return is_either && !decimal.empty() ? decimal + " or " + thousands : decimal;
}

std::string unit_meant(const std::string& text) {
  const TypedUnit* const unit = typed_unit(text);
  const bool is_unit = unit != nullptr && unit->of == 1 && unit->unit != "%" &&
                       unit->unit != "abs" && unit->unit != "diag";
  return is_unit ? std::string(unit->unit) : std::string();
}

}  // namespace vkh
