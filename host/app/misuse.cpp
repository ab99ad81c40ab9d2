#include "host/app/misuse.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

#include "host/answer/option_values.h"
#include "host/base/closest_name.h"
#include "host/base/meant.h"

namespace vkh {
namespace {

/// Finds the command that `words` name, or returns the program itself.
const CLI::App& named(const CLI::App& program, const Words& words) {
  if (words.empty()) return program;
  const std::vector<const CLI::App*> commands = program.get_subcommands({});
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const CLI::App* one) { return one->get_name() == words[0]; });
  return found == commands.end() ? program : **found;
}

Words option_names(const CLI::App& command) {
  Words names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The commands that have an option of this name.
Words commands_with(const CLI::App& program, const std::string& option) {
  Words names;
  for (const CLI::App* command : program.get_subcommands({})) {
    const Words known = option_names(*command);
    if (std::find(known.begin(), known.end(), option) != known.end())
      names.push_back(command->get_name());
  }
  return names;
}

Words command_names(const CLI::App& program) {
  Words names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::string hint_without_blank(const std::string& option, const std::string& given,
                               const std::string& meant) {
  return option + " '" + given + "': write " + meant + ", without a blank";
}

/// Returns what to write for "--max 0.1 mm" and "--max=0.1 mm"; nothing if no blank separates a
/// number from its unit.
std::string blank_hint(const Words& words) {
  for (size_t i = 1; i < words.size(); ++i) {
    const std::string& before = words[i - 1];
    const size_t equals = before.starts_with("--") ? before.find('=') : std::string::npos;
    const bool is_one_word = equals != std::string::npos;
    if (!is_one_word && (i < 2 || !words[i - 2].starts_with("--"))) continue;
    const std::string option = is_one_word ? before.substr(0, equals) : words[i - 2];
    const std::string number = is_one_word ? before.substr(equals + 1) : before;
    if (option == "--time" || number.find_first_not_of("0123456789.,+-eE") != std::string::npos)
      continue;
    const std::string meant = length_meant(number + words[i]);
    if (!meant.empty()) return hint_without_blank(option, number + " " + words[i], meant);
  }
  return "";
}

/// Returns how to get the help for the command, or for the program.
std::string see_help(const CLI::App& command) {
  const bool is_program = command.get_parent() == nullptr;
  return " (see vkhausdorff " + (is_program ? "--help)" : command.get_name() + " --help-all)");
}

/// An option of an earlier version, and what to do instead.
struct GoneOption {
  std::string_view name, instead;
};
constexpr std::array<GoneOption, 2> kGoneOptions{
    {{"--device-report", "'doctor --json=FILE' writes the device's properties, checks and times"},
     {"--field-by",
      "leave it out: pictures show distances by cells, and --field OUT.ply has the "
      "bounds of faces"}}};

/// Returns the replacement for a removed option; nothing for any other.
std::string gone_hint(const std::string& name) {
  for (const GoneOption& gone : kGoneOptions) {
    if (gone.name == name) return name + " is gone: " + std::string(gone.instead);
  }
  return "";
}

/// Returns the option or command that a word may mean: one that it begins, or that begins it, or
/// that it is a slip of; else nothing.
std::string name_meant(const std::string& word, const Words& names) {
  constexpr size_t kBegun = 3;  // letters, besides dashes
  const size_t dashes = std::min(word.find_first_not_of('-'), word.size());
  const auto begins = [&](const std::string& longer, const std::string& shorter) {
    return shorter.size() >= kBegun + dashes && longer.starts_with(shorter);
  };
  const auto begun = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return begins(word, name) || begins(name, word);
  });
  if (begun != names.end()) return *begun;
  const Words near = closest_names(word, names, 2);
  return near.empty() ? std::string() : near.front();
}

}  // namespace

// CLI11 reports a missing command for a misspelt one, and an unexpected option for a misspelt one.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error,
                          const Words& words) {
  const CLI::App& command = named(program, words);
  if (&command == &program && !words.empty() && !words[0].starts_with('-')) {
    const Words names = command_names(program);
    const std::string meant = name_meant(words[0], names);
    return "unknown command '" + words[0] + "': expected " + joined(names, " or ") +
           (meant.empty() ? "" : "; did you mean " + meant + "?");
  }
  const Words options = option_names(command);
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    const bool is_known = std::find(options.begin(), options.end(), name) != options.end();
    if (!name.starts_with("--") || name == "--" || is_known) continue;
    if (std::string hint = gone_hint(name); !hint.empty()) return hint;
    if (const Words others = commands_with(program, name); !others.empty())
      return "unknown option '" + name + "': it is of " + joined(others, " and ");
    const std::string meant = name_meant(name, options);
    return "unknown option '" + name + "'" +
           (meant.empty() ? see_help(command) : ": did you mean " + meant + "?");
  }
  const bool stray = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (std::string hint = stray ? blank_hint(words) : ""; !hint.empty()) return hint;
  if (stray && std::find(words.begin(), words.end(), "--json") != words.end()) {
    return std::string(error.what()) + "; JSON goes into a file by --json=FILE, without a space";
  }
  const std::string said = error.what();
  const size_t missing = said.find(": 1 required ");
  if (missing != std::string::npos && said.ends_with(" missing"))
    return said.substr(0, missing) + ": expected a value" + see_help(command);
  return said + see_help(command);
}

}  // namespace vkh
