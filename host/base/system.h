// The differences of operating systems; output files are beside it (output_file.h). Each system has
// a file of its own: system_posix.cpp, system_windows.cpp.
//
// A file's name in a string is UTF-8 on Windows, and the system's own bytes elsewhere.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vkh {

inline std::filesystem::path path_of(const std::string& name) {
  return std::u8string(name.begin(), name.end());
}
inline std::string name_of(const std::filesystem::path& path) {
  const std::u8string name = path.u8string();
  return {name.begin(), name.end()};
}

/// The size of a file; 0: not known.
inline uint64_t file_bytes(const std::filesystem::path& path) {
  std::error_code none;
  const uintmax_t size = std::filesystem::file_size(path, none);
  return none ? 0 : size;
}

/// The last part of a path, or all of it if that is empty.
inline std::string file_name_of(const std::string& path) {
  return path_of(path).filename().empty() ? path : path.substr(path.find_last_of("/\\") + 1);
}

/// The place of a file, existing or not: absolute, links followed. Without absolute(), a relative
/// name of a file that does not exist yet stays relative.
inline std::filesystem::path place_of(const std::string& name) {
  std::error_code none;
  const std::filesystem::path whole = std::filesystem::absolute(path_of(name), none);
  const std::filesystem::path place = std::filesystem::weakly_canonical(whole, none);
  return none ? whole.lexically_normal() : place;
}

/// The words after the program's name on the command line.
std::vector<std::string> command_line(int argc, const char* const* argv);

/// While this object lives, standard output and error accept UTF-8, and LF as the end of a line.
/// The destructor restores the console. Standard error may be buffered.
class Console {
 public:
  Console();
  // NOLINTNEXTLINE(performance-trivially-destructible): not on Windows
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
};

/// Whether standard error is a terminal.
bool is_error_terminal();

/// From now on the first Ctrl-C or SIGTERM is noted, and the second one ends the program.
void note_interrupts();
bool is_interrupted();

/// %LOCALAPPDATA%\vkhausdorff; elsewhere $XDG_CACHE_HOME/vkhausdorff or ~/.cache/vkhausdorff. Empty
/// if none is known.
std::filesystem::path user_cache_folder();

unsigned long process_id();

/// This machine's name; empty if it has none.
std::string host_name();

/// The processor's name, such as "AMD EPYC 7763 64-Core Processor"; "unknown processor" if the
/// system does not name it.
std::string processor_name();

/// Has `renew` called in each child that this process forks, where a system forks.
void call_in_forks(void (*renew)());

/// Ends the program now, without exit handlers, and without the libraries' own: our threads may be
/// within a driver.
[[noreturn]] void end_process(int code);

}  // namespace vkh
