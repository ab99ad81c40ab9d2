// How far a misspelt word is from a known one.
#pragma once

#include <cstddef>
#include <string_view>

namespace vkh {

/// Levenshtein's distance: letters to insert, to leave out or to replace.
size_t edits(std::string_view x, std::string_view y);

}  // namespace vkh
