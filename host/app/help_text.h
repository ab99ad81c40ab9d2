// Help as it fits a terminal, and names that were nearly right.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vkh {

/// Breaks lines of more than `columns` at spaces; what follows is indented as the text was.
std::string wrapped(const std::string& text, size_t columns);

/// What $COLUMNS says, from 60 to 100; 100 where it says nothing.
size_t terminal_columns();

/// The name that `word` begins, or that begins it, or is two letters from; empty: none is close.
std::string closest_name(const std::string& word, const std::vector<std::string>& names);

}  // namespace vkh
