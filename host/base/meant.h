// Guesses the length or unit that somebody meant who typed what is none: "0,1mm", "4mil", "inch".
#pragma once

#include <string>

namespace vkh {

/// How to write the length that `text` may be, such as "0.1mm", or "1.000mm or 1000mm" where it may
/// be two. `text` itself where it is written so, and nothing where it says no unit or length that
/// is known.
std::string length_meant(const std::string& text);

/// The unit that `text` may be, such as "in"; else nothing.
std::string unit_meant(const std::string& text);

}  // namespace vkh
