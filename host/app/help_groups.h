// Chooses what --help and --help-all show of a command.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace vkh {

/// The exit codes of a command and their meanings: "Exit codes: 0 PASS; 1 FAIL; ...". Throws
/// std::out_of_range for a name that is no command's.
std::string exit_codes_text(const std::string& command);

/// Sorts the command's options into groups, for --help-all, unless they are few, and puts its exit
/// codes below. Throws std::out_of_range as above.
void group_options(CLI::App& command);

/// Hides the options that a newcomer does not need, and tells how to see them. Help alone may
/// follow.
void show_few(CLI::App& command);

}  // namespace vkh
