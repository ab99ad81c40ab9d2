// Files of a test, in a folder of its process.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "host/base/system.h"

namespace vkh::test {

/// A folder that is removed at the process's end.
class TempFolder {
 public:
  TempFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("vkh_cli_" + std::to_string(process_id()))) {
    std::filesystem::create_directories(path_);
  }
  ~TempFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  std::string operator/(const std::string& name) const { return name_of(path_ / path_of(name)); }

 private:
  std::filesystem::path path_;
};

inline const TempFolder& folder() {
  static const TempFolder instance;
  return instance;
}

inline std::string read_file(const std::string& path) {
  std::ifstream file(path_of(path), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Returns the path of the written file in the folder.
inline std::string write_file(const std::string& name, const std::string& text) {
  std::ofstream(path_of(folder() / name), std::ios::binary) << text;
  return folder() / name;
}

}  // namespace vkh::test
