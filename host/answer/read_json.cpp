// Numbers of an answer that a user may have changed since it was written.
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "host/answer/json_object.h"
#include "host/base/error.h"

namespace vkh {
namespace {

constexpr std::string_view kHexEnd = "_hex";

/// Reads the text of hex_float() with from_chars, which no locale changes.
double double_of_hex(const std::string& key, const std::string& text) {
  if (text == "inf") return std::numeric_limits<double>::infinity();
  const std::string digits = text.starts_with("0x") ? text.substr(2) : "";
  const char* end = digits.data() + digits.size();
  double value = 0;
  const auto result = std::from_chars(digits.data(), end, value, std::chars_format::hex);
  if (result.ec != std::errc() || result.ptr != end || !(value >= 0))
    throw InputError(key + " '" + text + "' is no bound");
  return value;
}

// Compares exactly: the decimal has so many digits that it is read back as the same double.
bool is_double(const Json& decimal, double bound) {
  if (decimal.is_null()) return std::isinf(bound);
  return decimal.is_number() && decimal.get<double>() == bound;
}

// Names an array or object by its kind alone: it may be deep.
std::string as_written(const Json& value) {
  if (value.is_structured()) return value.is_array() ? "array" : "object";
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

double bound_in(const Json& interval, const std::string& key) {
  const std::string hex_key = key + std::string(kHexEnd);
  const auto hex = interval.find(hex_key), decimal = interval.find(key);
  if (hex == interval.end() || decimal == interval.end() || !hex->is_string())
    throw InputError("no " + key + " with its " + hex_key);
  const auto& text = hex->get_ref<const std::string&>();
  const double value = double_of_hex(hex_key, text);
  if (!is_double(*decimal, value))
    throw InputError(hex_key + " '" + text + "' is another number than " + key + " " +
                     as_written(*decimal));
  return value;
}

void check_bounds(const Json& answer) {
  std::vector<const Json*> left{&answer};  // no recursion: a line may be nested deep
  while (!left.empty()) {
    const Json& at = *left.back();
    left.pop_back();
    for (const auto& [key, value] : at.items()) {
      if (value.is_structured()) left.push_back(&value);
      if (at.is_object() && key.ends_with(kHexEnd))
        (void)bound_in(at, key.substr(0, key.size() - kHexEnd.size()));
    }
  }
}

uint64_t count_in(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  if (found == object.end()) throw InputError("no " + key);
  const bool is_count =
      found->is_number_unsigned() || (found->is_number_integer() && found->get<int64_t>() >= 0);
  if (!is_count)
    throw InputError(key + " " + as_written(*found) + " is no whole number of 0 or more");
  return found->get<uint64_t>();
}

}  // namespace vkh
