// The known names that a misspelt one may mean.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vkh {

/// The names that are nearest to `word`: equally near, and at most `most` letters to insert, delete
/// or replace away. Fewer letters are nearer, then the same first letter, then the same length.
/// Empty: no name is near.
std::vector<std::string> closest_names(std::string_view word, const std::vector<std::string>& names,
                                       size_t most);

}  // namespace vkh
