#include "host/answer/name_meant.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "host/base/closest_name.h"
#include "host/base/meant.h"

namespace vkh {
namespace {

/// Leaves the letters and digits of a name, in lower case.
std::string letters_of(const std::string& name) {
  std::string letters;
  for (const char c : name)
    letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::erase_if(letters, [](char c) {
    return std::string_view(" \t_-.()[]:").find(c) != std::string_view::npos;
  });
  return letters;
}

bool is_with_unit(const std::string& letters, const KnownName& known) {
  const std::string name = letters_of(known.name);
  if (!known.has_unit || !letters.starts_with(name)) return false;
  const std::string unit = letters.substr(name.size());
  return !unit.empty() && unit_meant(unit) == unit;
}

/// One extra letter at the end counts as a typing error, and for short names nothing else does: mat
/// and map do not mean max, nor does tool mean tol.
bool is_slip(const std::string& letters, const std::string& name) {
  return name.size() >= 3 && letters.starts_with(name) && letters.size() == name.size() + 1;
}

}  // namespace

std::string name_meant(const std::string& name, const std::vector<KnownName>& known) {
  const std::string letters = letters_of(name);
  std::string called;
  std::vector<std::string> longer;
  for (const KnownName& one : known) {
    const std::string own = letters_of(one.name);
    if (letters == own || is_with_unit(letters, one)) return one.name;
    if (std::find(one.also.begin(), one.also.end(), letters) != one.also.end())
      called += (called.empty() ? "" : " or ") + one.name;
    if (own.size() > 3) longer.push_back(own);
  }
  if (!called.empty()) return called;
  const std::vector<std::string> near = closest_names(letters, longer, 1);
  for (const KnownName& one : known) {
    const std::string own = letters_of(one.name);
    if (is_slip(letters, own) || (!near.empty() && own == near.front())) return one.name;
  }
  return "";
}

}  // namespace vkh
