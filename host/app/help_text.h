// Help that fits a terminal, and the closest names to a misspelt one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vkh {

/// Breaks lines of more than `columns` at spaces; the continuation is indented as the text was.
std::string wrapped(const std::string& text, size_t columns);

/// The value of $COLUMNS, from 60 to 100; 100 if it is not set.
size_t terminal_columns();

/// The name that `word` begins, or that begins it, or is two letters from; empty: none is close.
std::string closest_name(const std::string& word, const std::vector<std::string>& names);

}  // namespace vkh
