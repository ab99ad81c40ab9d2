// What operating systems do differently; files that are written are beside it (output_file.h). Each
// has a page of its own: system_posix.cpp, system_windows.cpp.
//
// A file's name in a string is UTF-8 on Windows, and the bytes that it has elsewhere.
#pragma once

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

/// Where a file is, or would be: absolute, links followed. A relative name of a file that is not
/// there yet stays relative without absolute().
inline std::filesystem::path place_of(const std::string& name) {
  std::error_code none;
  const std::filesystem::path whole = std::filesystem::absolute(path_of(name), none);
  const std::filesystem::path place = std::filesystem::weakly_canonical(whole, none);
  return none ? whole.lexically_normal() : place;
}

/// What follows the program's name on the command line.
std::vector<std::string> command_line(int argc, const char* const* argv);

/// While it lives, standard output and error take UTF-8, and lines that end in LF alone. A console
/// is then left as it was found. Standard error may be buffered.
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
/// where none is known.
std::filesystem::path user_cache_folder();

unsigned long process_id();

/// What this machine is called; empty where it has no name.
std::string host_name();

/// Ends the program now, without exit handlers, and without the libraries' own: threads of ours may
/// be within a driver.
[[noreturn]] void end_process(int code);

using AnyFunction = void (*)();

/// A function of the Vulkan loader, which is never closed again: drivers keep threads and exit
/// handlers of their own. Null where there is no loader.
AnyFunction vulkan_loader_function(const char* name);
/// What the loader is called, and where it comes from.
extern const char* const kVulkanLoader;
/// Whether the system's drivers stand on another interface (macOS: Metal). The loader lists such
/// drivers, which may leave out parts of Vulkan, to those alone who ask.
extern const bool kAsksForPortability;

}  // namespace vkh
