#include "host/answer/quantities.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "host/base/blanks.h"
#include "host/base/decimal.h"
#include "host/base/from_chars.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

struct NamedFactor {
  const char* name;
  double factor;
};

struct Quantity {
  double number = 0;
  std::string unit;
};

[[noreturn]] void refuse(const char* option, const std::string& text, const char* expected) {
  throw UsageError(std::string(option) + " '" + text + "': expected " + expected);
}

/// Splits a positive, finite number from the text after it. from_chars, because a locale must not
/// decide whether 0.5 is a number.
bool split(const std::string& text, Quantity& out) {
  const char* end = text.data() + text.size();
  const auto result = number_from_chars(text.data(), end, out.number);
  if (result.ec != std::errc() || !std::isfinite(out.number) || out.number <= 0) return false;
  out.unit.assign(result.ptr, end);
  out.unit.erase(0, out.unit.find_first_not_of(' '));
  return true;
}

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

template <size_t kCount>
const NamedFactor* find_unit(const std::array<NamedFactor, kCount>& units,
                             const std::string& name) {
  for (const NamedFactor& unit : units) {
    if (name == unit.name) return &unit;
  }
  return nullptr;
}

constexpr std::array<NamedFactor, 14> kMemoryUnits = {{{"", 1},
                                                       {"b", 1},
                                                       {"k", 0x1p10},
                                                       {"m", 0x1p20},
                                                       {"g", 0x1p30},
                                                       {"t", 0x1p40},
                                                       {"kib", 0x1p10},
                                                       {"mib", 0x1p20},
                                                       {"gib", 0x1p30},
                                                       {"tib", 0x1p40},
                                                       {"kb", 1e3},
                                                       {"mb", 1e6},
                                                       {"gb", 1e9},
                                                       {"tb", 1e12}}};

constexpr std::array<NamedFactor, 5> kTimeUnits = {
    {{"", 1}, {"s", 1}, {"ms", 1e-3}, {"min", 60}, {"h", 3600}}};

}  // namespace

uint64_t parse_size(const char* option, const std::string& text) {
  constexpr const char* kExpected =
      "a size of at least one byte such as 2GiB, 512MiB, 1.5GB or a number of bytes";
  Quantity quantity;
  if (!split(text, quantity)) refuse(option, text, kExpected);
  const NamedFactor* unit = find_unit(kMemoryUnits, lower_case(quantity.unit));
  if (unit == nullptr) refuse(option, text, kExpected);
  const double bytes = std::floor(quantity.number * unit->factor);
  if (bytes < 1 || bytes >= 0x1p63) refuse(option, text, kExpected);
  return static_cast<uint64_t>(bytes);
}

double parse_time(const char* option, const std::string& text) {
  constexpr const char* kExpected =
      "a time above zero such as 10s, 250ms, 2min, 1h or a number of seconds";
  Quantity quantity;
  if (!split(text, quantity)) refuse(option, text, kExpected);
  const NamedFactor* unit = find_unit(kTimeUnits, quantity.unit);
  if (unit == nullptr) refuse(option, text, kExpected);
  const double seconds = quantity.number * unit->factor;
  if (!std::isfinite(seconds) || seconds <= 0) refuse(option, text, kExpected);
  return seconds;
}

std::optional<SidedMax> parse_sided(const char* option, const std::string& text) {
  const size_t comma = std::min(text.find(','), text.size());
  const std::string first(trimmed(text.substr(0, comma)));
  const std::string second(trimmed(text.substr(std::min(comma + 1, text.size()))));
  const bool is_sided = first.starts_with('+') || first.starts_with('-');
  if (!is_sided) return {};
  const bool is_both =
      (first[0] == '+' && second.starts_with('-')) || (first[0] == '-' && second.starts_with('+'));
  if (!is_both)
    refuse(option, text,
           "a limit for both sides, such as 0.1mm, or one over B and one under it, such as "
           "+0.1mm,-0.05mm");
  const std::string& over = first[0] == '+' ? first : second;
  const std::string& under = first[0] == '+' ? second : first;
  return SidedMax{
      parse_length(option, std::string(trimmed(over.substr(1))), PlainNumber::kRefused),
      parse_length(option, std::string(trimmed(under.substr(1))), PlainNumber::kRefused)};
}

std::string sided_text(const Length& over, const Length& under) {
  return "+" + over.requested + ",-" + under.requested;
}

double parse_share(const char* option, const std::string& text) {
  const bool is_percent = text.ends_with('%');
  const std::string number = text.substr(0, text.size() - (is_percent ? 1 : 0));
  double share = 0;
  const auto [end, error] = number_from_chars(number.data(), number.data() + number.size(), share);
  if (is_percent) share /= 100;
  if (error != std::errc() || end != number.data() + number.size() || !(share > 0 && share <= 1))
    throw UsageError(std::string(option) + " '" + text +
                     "': expected a share of the area, such as 99.5% or 0.995");
  return share;
}

namespace {

// Takes a number up to `most`, with its unit or without one.
double parse_up_to(double most, const char* unit, const char* option, const std::string& text,
                   const char* expected) {
  Quantity quantity;
  const bool is_one = split(text, quantity) && quantity.number <= most &&
                      (quantity.unit.empty() || quantity.unit == unit);
  if (!is_one) refuse(option, text, expected);
  return quantity.number;
}

}  // namespace

void check_percentile(const char* option, double percentile) {
  if (percentile >= 1) return;
  const std::string text = shortest_decimal(percentile);
  throw UsageError(std::string(option) + " " + text + ": could be " +
                   number_text(100 * percentile, std::chars_format::general, 15) + " or " + text +
                   "%: write one of them");
}

double parse_percentile(const char* option, const std::string& text) {
  const double percentile =
      parse_up_to(100, "%", option, text, "a percentile above 0 and at most 100, such as 95");
  if (!text.ends_with('%')) check_percentile(option, percentile);
  return percentile;
}

double parse_angle(const char* option, const std::string& text) {
  return parse_up_to(90, "deg", option, text,
                     "an angle above 0 and at most 90 degrees, such as 20deg");
}

Length default_tolerance(bool has_limit) {
  return parse_length("tol", has_limit ? "1e-7" : "1e-6", PlainNumber::kFraction);
}

PartOf parse_part(const char* option, const std::string& text) {
  PartOf part;
  const char* end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, part.index);
  if (index.ec == std::errc() && index.ptr != end && *index.ptr == '/') {
    const auto count = std::from_chars(index.ptr + 1, end, part.count);
    if (count.ec == std::errc() && count.ptr == end && part.index < part.count) return part;
  }
  refuse(option, text, "a part, from 0, and how many there are, such as 0/8 to 7/8");
}

}  // namespace vkh
