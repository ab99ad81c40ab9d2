// Fills a page's template (tools/page/src/*.html) with data.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace vkh {

/// Renders a Mustache template: {{name}} is escaped as text of HTML (html_text), {{{name}}} stays
/// as it is, {{#name}} repeats for the elements of an array and stands once for an object, true or
/// a text that is not empty. An object's members come before those around it. Throws
/// std::logic_error for a template that cannot be parsed.
std::string rendered(std::string_view text, const nlohmann::ordered_json& data);

}  // namespace vkh
