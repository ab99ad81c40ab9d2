// The known names that a misspelt one may mean.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vkh {

/// The names that are nearest to `word`, all as near, by no more than `most` letters to insert, to
/// leave out or to replace. Nearer are fewer of them, then the same first letter, then the same
/// length. Empty: none is near.
std::vector<std::string> closest_names(std::string_view word, const std::vector<std::string>& names,
                                       size_t most);

}  // namespace vkh
