// The commands of the program, a row each.
#pragma once

#include <string_view>
#include <vector>

#include "host/answer/request.h"

namespace vkh {

/// Words that a command takes without an option before them; all of them are required.
struct Positional {
  const char* name;
  const char* help;
  bool is_several = false;
};

struct Command {
  const char* name;
  Commands bit;
  const char* does;
  std::vector<Positional> positionals = {};
  std::string footer = {};  ///< of its help, before its exit codes
  std::string codes;        ///< the exit codes and what each means
};

/// All commands, in the order of their help.
const std::vector<Command>& commands();

/// The command of this name, or null.
const Command* command_of(std::string_view name);

}  // namespace vkh
