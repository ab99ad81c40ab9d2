#include "host/answer/json_text.h"

#include <algorithm>
#include <cmath>

#include "host/answer/json_object.h"

namespace vkh {

bool is_utf8(const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

std::string in_utf8(const std::string& text) {
  return parse_json(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace))
      .get<std::string>();
}

std::string& JsonText::value() {
  if (!is_first_) text_ += ',';
  is_first_ = false;
  return text_;
}

void JsonText::key(const char* name) {
  text(name);
  text_ += ':';
  is_first_ = true;
}

void JsonText::count(uint64_t count) { value() += std::to_string(count); }

void JsonText::number(double number) {
  value() += std::isfinite(number) ? Json(number).dump() : "null";
}

void JsonText::bound(const char* name, double bound, Rounding rounding) {
  key(name);
  value() += std::isfinite(bound) ? decimal(bound, kJsonDigits, rounding) : "null";
  key((std::string(name) + "_hex").c_str());
  text(hex_float(bound));
}

void JsonText::text(std::string_view text) {
  const bool is_plain = std::all_of(text.begin(), text.end(), [](char c) {
    return c >= ' ' && c < '\x7f' && c != '"' && c != '\\';
  });
  if (is_plain)
    value().append("\"").append(text).append("\"");
  else
    value() += Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void JsonText::open(char opening, char closing) {
  value() += opening;
  closing_ += closing;
  is_first_ = true;
}

void JsonText::close() {
  text_ += closing_.back();
  closing_.pop_back();
  is_first_ = false;
}

}  // namespace vkh
