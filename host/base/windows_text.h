// Windows speaks UTF-16; everything else here speaks UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace vkh {

/// What is no UTF-16 becomes U+FFFD.
std::string utf8_of(std::wstring_view text);

}  // namespace vkh
