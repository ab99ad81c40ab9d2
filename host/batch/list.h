// The pairs of a batch, as a file lists them: an object a line (JSONL), or CSV with a heading; or
// as two folders have them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vkh {

/// A pair. An empty member takes the batch's value.
struct Entry {
  std::string id;
  std::string a, b;            ///< the names in the list, for people
  std::string file_a, file_b;  ///< the paths that open from here
  std::string tolerance, max, unit, unit_a, unit_b;
  std::string transform;  ///< a matrix's path that opens from here
  std::string points;     ///< a, b or both
  std::optional<bool> symmetric, is_signed, align;
  /// The error of a file without a partner; empty: there is a pair.
  std::string missing = {};
  const std::string& one_file() const { return file_a.empty() ? file_b : file_a; }
};

struct PairList {
  std::vector<Entry> entries;
  std::vector<std::string> notes;  ///< members, columns and files that a batch does not use
  std::vector<Entry> unpaired;     ///< of two folders: files without a partner, with `missing`
};

/// Names the columns of a list for people: "id, a, b and perhaps tol, ...".
std::string list_columns();

/// Reads a list of these columns. Relative names, of matrices too, start at the
/// list's folder, or at the current one if the list is a pipe. A list is CSV if its name ends in
/// .csv; its separator is a comma or a semicolon, as its heading has. Throws InputError with file,
/// line and the expected form; also for an id that occurs twice.
PairList read_list(const std::string& path);

/// Pairs each of `parts` with one B; its id is its name as the user typed it.
PairList list_against(const std::string& b, const std::vector<std::string>& parts);

/// A folder, and whether its files are points.
struct FolderOfFiles {
  std::string path;
  bool points = false;
};

/// Pairs the meshes of two folders by their stems, letter by letter, in the stems' order: a stem,
/// the name without its last extension, is the id. Files beneath folders in them are left out, as
/// are names that are none of a mesh. Throws UsageError if one is no folder or both are one, and
/// InputError if two meshes of a folder have one stem, or no mesh has a partner.
PairList list_folders(const FolderOfFiles& a, const FolderOfFiles& b);

/// Whether a result line can hold the id.
bool is_utf8(const std::string& text);

/// Shard i of n, from 0.
struct Shard {
  uint64_t index = 0, count = 1;
  /// Depends on the id alone: its hash modulo n.
  bool has(const std::string& id) const;
};
/// Parses a shard such as "3/64". Throws UsageError.
Shard parse_shard(const std::string& text);

}  // namespace vkh
