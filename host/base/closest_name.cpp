#include "host/base/closest_name.h"

#include <algorithm>
#include <numeric>

namespace vkh {
namespace {

// Levenshtein's distance. Keeps one row of the table.
size_t edits(std::string_view x, std::string_view y) {
  std::vector<size_t> row(y.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= x.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= y.size(); ++j) {
      const size_t change = diagonal + (x[i - 1] == y[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string> closest_names(std::string_view word, const std::vector<std::string>& names,
                                       size_t most) {
  size_t least = 4 * most + 4;
  std::vector<std::string> nearest;
  for (const std::string& name : names) {
    const size_t count = edits(word, name);
    const size_t here = 4 * count + (word.substr(0, 1) == name.substr(0, 1) ? 0 : 2) +
                        (word.size() == name.size() ? 0 : 1);
    if (count > most || here > least) continue;
    if (here < least) nearest.clear();
    least = here;
    nearest.push_back(name);
  }
  return nearest;
}

}  // namespace vkh
