// Guesses the column or keyword that an unknown name may mean, such as max for Max, maxx and limit.
#pragma once

#include <string>
#include <vector>

namespace vkh {

/// A name, and other names that people use for it, in lower case without blanks.
struct KnownName {
  std::string name;
  std::vector<std::string> also = {};
  bool has_unit = false;  ///< "max (mm)" means it, too
};

/// Returns the name that is meant, or several with "or" between them; nothing if none is near.
std::string name_meant(const std::string& name, const std::vector<KnownName>& known);

}  // namespace vkh
