// Help that fits a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace vkh {

/// Breaks lines of more than `columns` at spaces; the continuation is indented as the text was.
std::string wrapped(const std::string& text, size_t columns);

/// The value of $COLUMNS, from 60 to 100; 100 if it is not set.
size_t terminal_columns();

}  // namespace vkh
