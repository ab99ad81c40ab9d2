// Conversions between the UTF-16 of Windows and the UTF-8 used everywhere else.
#pragma once

#include <string>
#include <string_view>

namespace vkh {

/// Replaces invalid UTF-16 by U+FFFD.
std::string utf8_of(std::wstring_view text);

}  // namespace vkh
