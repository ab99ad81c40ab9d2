// JSON that is parsed, its members in the order of the text.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace vkh {

using Json = nlohmann::ordered_json;

/// Text that is no JSON gives a discarded value. It stands in a room that is optimized: parsing is
/// most of the time of reading a result line.
Json parse_json(std::string_view text);

}  // namespace vkh
