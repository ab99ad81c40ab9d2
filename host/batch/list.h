// The pairs of a batch, as a file lists them: an object a line (JSONL), or CSV with a heading.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vkh {

/// A pair. What is empty is the batch's own.
struct Entry {
  std::string id;
  std::string a, b;            ///< as they are written, for people
  std::string file_a, file_b;  ///< as they open from here
  std::string tolerance, max, unit;
  std::optional<bool> symmetric;
};

struct PairList {
  std::vector<Entry> entries;
  std::vector<std::string> notes;  ///< members and columns that are none of a batch's
};

/// `id`, `a` and `b`, and perhaps `tol`, `max`, `unit` and `symmetric`. Relative names are of the
/// list's folder, or of the current one where the list is a pipe. CSV is what ends in .csv. Throws
/// InputError: file, line, what was expected; an id that is there twice.
PairList read_list(const std::string& path);

/// Each of `parts` against one B; its id is its name, as typed.
PairList list_against(const std::string& b, const std::vector<std::string>& parts);

/// i of n, from 0.
struct Shard {
  uint64_t index = 0, count = 1;
  /// A function of the id alone: its hash modulo n.
  bool has(const std::string& id) const;
};
/// "3/64". Throws UsageError.
Shard parse_shard(const std::string& text);

}  // namespace vkh
