#include "host/answer/option_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <type_traits>

#include "host/answer/json_text.h"
#include "host/answer/quantities.h"
#include "host/base/blanks.h"
#include "host/base/decimal.h"
#include "host/base/from_chars.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

[[noreturn]] void refuse(const Given& given, const std::string& text, const std::string& expected) {
  throw UsageError(given.said + " '" + text + "': expected " + expected);
}

void check_choice(const Option& option, const Given& given, const std::string& text) {
  const std::vector<std::string>& known = option.choices;
  if (known.empty() || option.has_others) return;
  if (std::find(known.begin(), known.end(), text) != known.end()) return;
  const bool is_of_many = option.kind == Kind::kNames;
  refuse(given, text, (is_of_many ? "one of " : "") + joined(known, is_of_many ? ", " : " or "));
}

// Accepts TRUE too, as spreadsheets write it.
bool truth_of(const Given& given) {
  if (given.texts.empty()) return true;
  std::string word = given.text();
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (word == "true" || word == "1" || word == "yes") return true;
  if (word == "false" || word == "0" || word == "no") return false;
  throw InputError("'" + given.text() + "': expected true or false for " + given.said);
}

std::string text_of(const Option& option, const Given& given) {
  const std::string& text = given.text();
  if (option.kind == Kind::kUnit) check_unit(given.said.c_str(), text);
  if (option.kind == Kind::kText && !is_utf8(text)) refuse(given, text, "a text in UTF-8");
  return text;
}

/// Reads a whole text as a number; nothing if it is not one. Unlike parse_number(), it takes
/// inf, which a time may be.
std::optional<double> number_in(const std::string& text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto result = number_from_chars(text.data(), end, number);
  const bool is_one = result.ec == std::errc() && result.ptr == end;
  return is_one ? std::optional(number) : std::nullopt;
}

PlainNumber plain_number(Kind kind, Outlet outlet) {
  if (kind != Kind::kTolerance) return PlainNumber::kRefused;
  return outlet == Outlet::kTyped ? PlainNumber::kSmallFraction : PlainNumber::kFraction;
}

std::vector<Length> lengths_of(const Option& option, const Given& given) {
  std::vector<Length> lengths;
  lengths.reserve(given.texts.size());
  for (const std::string& text : given.texts)
    lengths.push_back(length_of(option.kind, given, text));
  return lengths;
}

std::vector<std::string> names_of(const Option& option, const Given& given) {
  for (const std::string& name : given.texts) check_choice(option, given, name);
  return {given.texts.begin(), given.texts.end()};
}

uint64_t whole_of(const Option& option, const Given& given) {
  const std::string& text = given.text();
  if (option.kind == Kind::kSize) return parse_size(given.said.c_str(), text);
  uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  const bool is_one = result.ec == std::errc() && result.ptr == end;
  if (is_one && is_within(option, static_cast<double>(number))) return number;
  refuse(given, text, whole_number(option));
}

/// A number of seconds may be 0, which ends at once, or infinite.
double seconds_of(const Given& given) {
  const std::optional<double> seconds = number_in(given.text());
  if (seconds && *seconds >= 0) return *seconds;
  refuse(given, given.text(), "a number of seconds, 0 or more");
}

double number_of(const Option& option, const Given& given) {
  const char* said = given.said.c_str();
  const std::string& text = given.text();
  switch (option.kind) {
    case Kind::kTime:
      return given.outlet == Outlet::kPythonNumber ? seconds_of(given) : parse_time(said, text);
    case Kind::kPercentile:
      return parse_percentile(said, text);
    case Kind::kAngle:
      return parse_angle(said, text);
    default:
      break;
  }
  const std::optional<double> number = number_in(text);
  if (number && is_within(option, *number)) return *number;
  refuse(
      given, text,
      "a number from " + shortest_decimal(option.least) + " to " + shortest_decimal(option.most));
}

/// Reads what was given, by the member's type and the option's kind.
struct TextReader {
  const Option& option;
  const Given& given;

  template <class T>
  T value() const {
    if constexpr (std::is_same_v<T, bool>)
      return truth_of(given);
    else if constexpr (std::is_same_v<T, std::string>)
      return text_of(option, given);
    else if constexpr (std::is_same_v<T, Length>)
      return length_of(option.kind, given, given.text());
    else if constexpr (std::is_same_v<T, double>)
      return number_of(option, given);
    else if constexpr (std::is_same_v<T, PartOf>)
      return parse_part(given.said.c_str(), given.text());
    else if constexpr (std::is_same_v<T, std::vector<std::string>>)
      return names_of(option, given);
    else if constexpr (std::is_same_v<T, std::vector<Length>>)
      return lengths_of(option, given);
    else
      return static_cast<T>(whole_of(option, given));
  }
};

std::string key_of(bool value) { return value ? "yes" : ""; }
std::string key_of(const std::string& value) { return value; }
std::string key_of(const Length& value) { return value.requested; }
std::string key_of(double value) { return shortest_decimal(value); }
std::string key_of(uint64_t value) { return std::to_string(value); }
std::string key_of(uint32_t value) { return std::to_string(value); }
std::string key_of(const PartOf& value) {
  return std::to_string(value.index) + "/" + std::to_string(value.count);
}
template <class T>
std::string key_of(const std::optional<T>& value) {
  return value ? key_of(*value) : "";
}
template <class T>
std::string key_of(const std::vector<T>& values) {
  std::string text;
  for (const T& value : values) text += " " + key_of(value);
  return text;
}

std::string value_text(const Option& option, Request& asked) {
  if (const Own* own = std::get_if<Own>(&option.target))
    return own->text == nullptr ? "" : own->text(asked);
  return std::visit(
      [&](const auto& target) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(target)>, Own>)
          return "";
        else
          return key_of(target(asked));
      },
      option.target);
}

/// Whether the first length is the longer one, as far as that is known without the files.
bool is_reversed(const std::array<Length, 2>& range) {
  const auto& [first, second] = range;
  if (second.number == 0) return first.number > 0;
  return first.of == second.of &&
         in_millimetres(first.number, first.unit) > in_millimetres(second.number, second.unit);
}

}  // namespace

std::string joined(const std::vector<std::string>& names, const char* last) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? last : ", ") + names[i];
  return text;
}

std::string whole_number(const Option& option) {
  const std::string of = *option.noun == '\0' ? "" : std::string(" of ") + option.noun;
  return "a whole number" + of + " from " + shortest_decimal(option.least) + " to " +
         std::to_string(static_cast<uint64_t>(option.most));
}

Length length_of(Kind kind, const Given& given, const std::string& text) {
  if (given.outlet == Outlet::kPythonNumber) {
    const std::optional<double> number = number_in(text);
    const bool is_one = number && *number > 0 && std::isfinite(*number);
    if (!is_one) refuse(given, text, "a positive number");
    const bool is_fraction = kind == Kind::kTolerance;
    return {.requested = text,
            .number = *number,
            .of = is_fraction ? Length::Of::kDiagonal : Length::Of::kFiles,
            .is_double = true};
  }
  Length length = parse_length(given.said.c_str(), text, plain_number(kind, given.outlet));
  if (given.outlet == Outlet::kPythonText && length.of == Length::Of::kUnit)
    refuse(given, text, "a length without a unit, which arrays do not have");
  return length;
}

void check_truth(const std::string& said, const std::string& text) {
  (void)truth_of({said, std::span(&text, 1)});
}

void put(const Option& option, const Given& given, Request& asked) {
  if (option.kind == Kind::kChoice) check_choice(option, given, given.text());
  if (const Own* own = std::get_if<Own>(&option.target)) own->put(given, asked);
  fill(option, asked, TextReader{option, given});
  if (option.kind == Kind::kFlag && option.shape[0] == '\0' && !truth_of(given)) {
    asked.given.erase(option.name);
  } else {
    asked.given.insert(option.name);
  }
}

std::string key_text(Request asked) {
  Request none;
  std::string text;
  for (const Option& option : options()) {
    const bool is_of_pairs = option.is_column || use_of(option, kBatch) != nullptr;
    if (!is_of_pairs || *option.unlike != '\0') continue;
    const std::string value = value_text(option, asked);
    if (value != value_text(option, none)) text += std::string("\n") + option.name + ' ' + value;
  }
  return text;
}

void put_max(const Given& given, Request& asked) {
  Question& question = asked.question;
  const std::string text(trimmed(given.text()));
  const bool is_number = given.outlet == Outlet::kPythonNumber;
  question.max_sides = is_number ? std::nullopt : parse_sided(given.said.c_str(), text);
  question.max =
      question.max_sides ? question.max_sides->over : length_of(Kind::kLength, given, text);
}

std::string typed_max(const Request& asked) {
  const Question& question = asked.question;
  if (question.max_sides) return sided_text(question.max_sides->over, question.max_sides->under);
  return question.max ? question.max->requested : "";
}

void put_area(const Given& given, Request& asked) {
  asked.question.area = parse_share(given.said.c_str(), given.text());
  asked.question.area_requested = given.text();
}

std::string area_text(const Request& asked) { return asked.question.area_requested; }

void put_polygons(const Given& given, Request& asked) {
  const std::string& text = given.text();
  asked.question.limits.odd_polygons = text == "fan" ? OddPolygons::kFanned : OddPolygons::kRefused;
  asked.question.limits.any_triangulation = text == "any";
}

std::string polygons_text(const Request& asked) {
  const ReadLimits& limits = asked.question.limits;
  if (limits.any_triangulation) return "any";
  return limits.odd_polygons == OddPolygons::kFanned ? "fan" : "";
}

void put_bodies(const Given& given, Request& asked) {
  asked.question.limits.bodies = given.text() == "all" ? Bodies::kAll : Bodies::kSolid;
}

std::string bodies_text(const Request& asked) {
  return asked.question.limits.bodies == Bodies::kAll ? "all" : "";
}

void put_points(const Given& given, Request& asked) {
  const std::string& text = given.text();
  asked.question.points_a = text != "b";
  asked.question.points_b = text != "a";
}

std::string points_text(const Request& asked) {
  return std::string(asked.question.points_a ? "a" : "") + (asked.question.points_b ? "b" : "");
}

void put_transform(const Given& given, Request& asked) {
  asked.question.transform_file = given.text();
}

std::string transform_text(const Request& asked) {
  if (!asked.question.transform) return asked.question.transform_file;
  std::string text;
  for (const auto& row : *asked.question.transform) {
    for (const double entry : row) text += ' ' + shortest_decimal(entry);
  }
  return text;
}

void put_json(const Given& given, Request& asked) {
  asked.outputs.json = given.texts.empty();
  if (!given.texts.empty()) asked.outputs.json_file = given.text();
}

void put_range(const Given& given, Request& asked) {
  if (given.texts.size() != 2)
    throw UsageError(given.said + ": expected two lengths, as in 0,0.5mm");
  std::array<Length, 2> range;
  for (size_t i = 0; i < 2; ++i) {
    const std::string& text = given.texts[i];
    range[i] = text == "0" ? Length{.requested = text, .of = Length::Of::kFiles}
                           : parse_length(given.said.c_str(), text, PlainNumber::kRefused);
  }
  if (is_reversed(range))
    refuse(given, given.texts[0] + "," + given.texts[1], "the shorter length first");
  asked.outputs.look.range = range;
}

void put_no_cache(const Given& given, Request& asked) { asked.question.caches = !truth_of(given); }

}  // namespace vkh
