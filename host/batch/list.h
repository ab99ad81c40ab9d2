// The pairs of a batch, as a file lists them: an object a line (JSONL), or CSV with a heading; or
// as two folders have them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "host/answer/options_table.h"

namespace vkh {

/// A pair. For what it does not ask itself, the batch's options hold.
struct Entry {
  std::string id;
  std::string a, b;            ///< the names in the list, for people
  std::string file_a, file_b;  ///< the paths that open from here
  /// The options that its row has for itself, each with its text.
  std::vector<std::pair<const Option*, std::string>> options;
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
/// the name without its last extension, is the id. Leaves out subfolders, and names without the
/// extension of a mesh. Throws UsageError if a path is no folder or both are the same folder, and
/// InputError if two meshes of a folder have the same stem, or if no mesh has a partner.
PairList list_folders(const FolderOfFiles& a, const FolderOfFiles& b);

/// Whether a pair is in this part of a list. It depends on the id alone: its hash modulo the count.
bool is_in(const PartOf& shard, const std::string& id);

}  // namespace vkh
