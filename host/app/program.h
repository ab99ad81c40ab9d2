// The program as its parser knows it: the commands and options of the tables, and their help.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "host/answer/options_table.h"
#include "host/app/commands.h"

namespace vkh {

/// An option of a command, and the text that was typed for it.
struct TypedOption {
  CLI::Option* option = nullptr;
  bool flag = false;
  std::string text;  ///< several between commas
};

/// A command with what was typed for it.
struct TypedCommand {
  const Command* command = nullptr;
  CLI::App* app = nullptr;
  std::vector<std::string> files;
  std::map<const Option*, TypedOption> options = {};
};

class Program {
 public:
  Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  CLI::App& app() { return app_; }
  /// The help on the command that was named, or on the program.
  std::string help(bool shows_all);
  /// The command that was typed, with its options in their places.
  Request asked() const;

 private:
  void add(const Command& command);

  CLI::App app_;
  std::vector<TypedCommand> commands_;
};

}  // namespace vkh
