#include "host/show/template.h"

#include <kainjow/mustache.hpp>
#include <stdexcept>
#include <utility>

#include "host/show/escape.h"

namespace vkh {
namespace {

using MustacheData = kainjow::mustache::data;

MustacheData mustache_of(const nlohmann::ordered_json& value) {
  if (value == "") return {false};  // so that a section of an empty text is left out
  if (value.is_string()) return {value.get<std::string>()};
  if (value.is_boolean()) return {value.get<bool>()};
  if (value.is_array()) {
    MustacheData list{MustacheData::type::list};
    for (const auto& element : value) list << mustache_of(element);
    return list;
  }
  if (!value.is_object()) return {value.is_null() ? std::string() : value.dump()};
  MustacheData object{MustacheData::type::object};
  for (const auto& [name, member] : value.items()) object.set(name, mustache_of(member));
  return object;
}

}  // namespace

std::string rendered(std::string_view text, const nlohmann::ordered_json& data) {
  kainjow::mustache::mustache frame{std::string(text)};
  if (!frame.is_valid()) throw std::logic_error("template: " + frame.error_message());
  frame.set_custom_escape([](const std::string& s) { return html_text(s); });
  return frame.render(mustache_of(data));
}

}  // namespace vkh
