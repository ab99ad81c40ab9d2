// Runs the program under test, $VKH_PROGRAM, and keeps files for it in a folder of this process.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace vkh::test {

using Words = std::vector<std::string>;

/// A folder of this process, gone at its end.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};
const TempFolder& folder();

std::string read_file(const std::string& path);
/// Returns the path of what was written into the folder.
std::string write_file(const std::string& name, const std::string& text);

struct Outcome {
  int exit_code = -1;
  int signal = 0;  ///< that killed it
  std::string out, err;
};

/// A running program, its stdout and stderr going to files.
struct Running {
  pid_t process = 0;
  std::string out, err;
};
/// `out`: where stdout goes; empty: into a file of the folder, to be read by finish().
Running start(const Words& words, const std::string& out = "");
Outcome finish(const Running& running);

/// start and finish; a death by signal fails the test.
Outcome run(const Words& words, const std::string& out = "");

}  // namespace vkh::test
