// Guesses the length or unit that a user meant by an invalid text: "0,1mm", "4mil", "inch".
#pragma once

#include <string>

namespace vkh {

/// Returns how to write the length that `text` may be, such as "0.1mm", or "1.000mm or 1000mm" if
/// it may be two. Returns `text` itself if it is valid, and nothing if it has no known unit or
/// length.
std::string length_meant(const std::string& text);

/// The unit that `text` may be, such as "in"; else nothing.
std::string unit_meant(const std::string& text);

}  // namespace vkh
