// JSON that is parsed, its members in the order of the text.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace vkh {

using Json = nlohmann::ordered_json;

/// Returns a discarded value for text that is no JSON. It is in this room because that is
/// optimised: reading a result line is mostly parsing.
Json parse_json(std::string_view text);

}  // namespace vkh
