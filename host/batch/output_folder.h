// A folder with files about pairs, named by the pairs' ids. Each file names its inputs and options,
// so that it cannot be taken for a file of other ones.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace vkh {

/// The name of an id's files without an ending, a function of the id alone. An id of up to 64 small
/// letters, digits, - and _ is its own name. Any other id has its cleaned name and its hash: so
/// names of two ids differ, also if a file system makes no difference between letters. No name is
/// "index", a device's name on Windows, or another id's name with "-b".
std::string file_stem(const std::string& id);

class PairFolder {
 public:
  static constexpr const char* kIndex = "index.html";

  /// `ending`: ".png" or ".html".
  PairFolder(std::string option, std::string folder, std::string ending)
      : option_(std::move(option)), folder_(std::move(folder)), ending_(std::move(ending)) {}

  /// Makes the folder if it does not exist. Throws UsageError if it cannot be written, or if a file
  /// of one of `ids`, or the index, would replace one that is `taken`.
  void open(const std::vector<std::string>& ids, const std::vector<std::string>& taken) const;

  const std::string& option() const { return option_; }
  /// The name in the folder; `back`: of the reverse direction.
  std::string name_of(const std::string& id, bool back) const;
  std::string path_in(const std::string& name) const;

  /// Whether the file is there, and was written with this key.
  bool has(const std::string& id, bool back, const std::string& key) const;
  /// Throws OutputError.
  void write(const std::string& id, bool back, std::string text, const std::string& key) const;
  void write_index(const std::string& page) const;

 private:
  void check_taken(const std::set<std::string>& names, const std::vector<std::string>& taken) const;
  void replace(const std::string& name, const std::string& text) const;
  [[noreturn]] void refuse(const std::string& why) const;

  std::string option_, folder_, ending_;
};

}  // namespace vkh
