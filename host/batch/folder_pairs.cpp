// Makes a list of pairs from two folders: files with the same stem are a pair.
#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "host/answer/json_text.h"
#include "host/base/system.h"
#include "host/batch/list.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh {
namespace {

/// A folder's meshes by their stems, and the names of its other files.
struct FolderOfMeshes {
  std::string folder;
  std::map<std::string, std::string> files;  ///< the paths that open from here
  std::vector<std::string> others;
};

void add_mesh(FolderOfMeshes& meshes, const std::filesystem::path& path) {
  const std::string file = name_of(path), stem = name_of(path.stem());
  if (!is_utf8(stem))
    throw InputError(file + ": the name is no UTF-8, as an id must be: name it in a list");
  const auto [known, is_new] = meshes.files.emplace(stem, file);
  if (is_new) return;
  const auto [first, second] = std::minmax(known->second, file);
  throw InputError(second + ": has the stem of " + first +
                   "; expected one mesh of each stem in a folder");
}

FolderOfMeshes meshes_in(const FolderOfFiles& given) {
  const std::string& folder = given.path;
  const auto is_read = given.points ? has_points_extension : has_mesh_extension;
  FolderOfMeshes meshes{.folder = folder, .files = {}, .others = {}};
  std::error_code error;
  for (std::filesystem::directory_iterator at(path_of(folder), error), end; !error && at != end;
       at.increment(error)) {
    std::error_code none;
    const std::string name = name_of(at->path().filename());
    const bool is_mesh = is_read(at->path()) && !at->is_directory(none);
    if (name.starts_with('.')) continue;  // files of systems and editors
    if (is_mesh) add_mesh(meshes, at->path());
    if (!is_mesh) meshes.others.push_back(at->is_directory(none) ? name + "/" : name);
  }
  if (error) throw InputError(folder + ": cannot be read: " + error.message());
  std::sort(meshes.others.begin(), meshes.others.end());
  return meshes;
}

void check_folders(const std::string& a, const std::string& b) {
  std::error_code none;
  for (const std::string& folder : {a, b}) {
    if (std::filesystem::is_directory(path_of(folder), none)) continue;
    throw UsageError("batch: '" + folder +
                     "' is no folder; expected one LIST, two folders, or --against B with meshes");
  }
  if (std::filesystem::equivalent(path_of(a), path_of(b), none))
    throw UsageError("batch: '" + a + "' and '" + b +
                     "' are one folder; expected one of A's and one of B's");
}

/// The note on files that are no meshes by their names; empty: there are none.
std::string note_on_others(const FolderOfMeshes& meshes) {
  constexpr size_t kMost = 5;
  const size_t count = meshes.others.size();
  std::string text;
  for (size_t i = 0; i < std::min(count, kMost); ++i)
    text += (i == 0 ? "" : ", ") + meshes.others[i];
  if (count > kMost) text += " and " + std::to_string(count - kMost) + " more";
  return text.empty() ? text : meshes.folder + ": left out, since no name of a mesh: " + text;
}

Entry pair_of(const std::string& stem, const std::string& a, const std::string& b) {
  Entry entry;
  entry.id = stem;
  entry.a = entry.file_a = a;
  entry.b = entry.file_b = b;
  return entry;
}

/// The error of a file that has no partner in `other`.
std::string missing_in(const FolderOfMeshes& other, const std::string& stem) {
  return "no partner in " + other.folder + "; expected a mesh named " + stem + " there";
}

}  // namespace

PairList list_folders(const FolderOfFiles& of_a, const FolderOfFiles& of_b) {
  const std::string &a = of_a.path, &b = of_b.path;
  check_folders(a, b);
  const FolderOfMeshes meshes_a = meshes_in(of_a), meshes_b = meshes_in(of_b);
  PairList list;
  for (const auto& [stem, file] : meshes_a.files) {
    const auto partner = meshes_b.files.find(stem);
    if (partner != meshes_b.files.end()) {
      list.entries.push_back(pair_of(stem, file, partner->second));
      continue;
    }
    list.unpaired.push_back(pair_of(stem, file, ""));
    list.unpaired.back().missing = missing_in(meshes_b, stem);
  }
  for (const auto& [stem, file] : meshes_b.files) {
    if (meshes_a.files.count(stem) > 0) continue;
    list.unpaired.push_back(pair_of(stem, "", file));
    list.unpaired.back().missing = missing_in(meshes_a, stem);
  }
  for (const FolderOfMeshes* meshes : {&meshes_a, &meshes_b}) {
    if (std::string note = note_on_others(*meshes); !note.empty())
      list.notes.push_back(std::move(note));
  }
  if (list.entries.empty())
    throw InputError(a + " and " + b + ": no pair; expected meshes with the same names in both");
  return list;
}

}  // namespace vkh
