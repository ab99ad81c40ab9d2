#include "host/app/program.h"

#include <algorithm>

#include "vkhausdorff/answer.h"

namespace vkh {
namespace {

constexpr const char* kLengths =
    "0.1mm (um, cm, m, in, ft, mil and thou, too), 0.1abs in the files' own unit, 0.1% of A's "
    "bounding-box diagonal, 1e-6diag";

/// CLI11 puts two blank lines behind a group.
std::string without_double_blanks(std::string text) {
  for (size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;) text.erase(at, 1);
  return text;
}

std::string help_of(const Use& use) {
  constexpr std::string_view kPlace = "{lengths}";
  std::string text = use.help;
  const size_t at = text.find(kPlace);
  if (at != std::string::npos) text.replace(at, kPlace.size(), kLengths);
  return text;
}

bool has_commas(const Option& option) {
  return option.kind == Kind::kLengths || option.kind == Kind::kNames;
}

/// Refuses an empty value: with --max "$LIMIT", a script whose variable is not set would ask less
/// than it says.
std::string check_value(const std::string& text) { return text.empty() ? "'' is no value" : ""; }

CLI::Option* added(const Option& option, const Use& use, CLI::App& app, TypedOption& typed) {
  const std::string name = std::string("--") + option.name;
  const std::string help = help_of(use);
  const bool has_text = *option.shape != '\0';
  if (option.kind == Kind::kFlag && has_text) return app.add_flag(name, typed.text, help);
  if (option.kind == Kind::kFlag) return app.add_flag(name, typed.flag, help);
  CLI::Option* made = app.add_option(name, typed.text, help)->check(check_value);
  return has_commas(option) ? made->join(',') : made;
}

/// A command with few options shows all of them at once.
bool is_short(Commands command) {
  return std::none_of(options().begin(), options().end(),
                      [&](const Option& option) { return (option.few & command) != 0; });
}

void add_option(const Option& option, const Use& use, const TypedCommand& of, TypedOption& typed) {
  typed.option = added(option, use, *of.app, typed);
  const std::string shape = shape_of(option);
  if (!shape.empty()) typed.option->type_name(shape);
  typed.option->required(use.required);
  if (*use.otherwise != '\0') typed.option->default_str(use.otherwise);
  if (!is_short(of.command->bit))
    typed.option->group(use.required ? "What must be given" : heading_of(option.group));
}

/// Hides what --help does not show, and says how much that is.
void show_few(const TypedCommand& typed) {
  const Commands bit = typed.command->bit;
  if (is_short(bit)) return;
  size_t hidden = 0;
  for (const auto& [option, one] : typed.options) {
    const bool is_shown = (option->few & bit) != 0 || one.option->get_required();
    one.option->group(is_shown ? "Options" : "");
    hidden += is_shown ? 0 : 1;
  }
  typed.app->footer("--help-all shows " + std::to_string(hidden) + " more options.\n\n" +
                    typed.app->get_footer());
}

/// Puts what was typed, or what the command has otherwise.
void put_typed(const Option& option, const TypedOption& typed, Commands command, Request& asked) {
  constexpr const char* kLone = "true";  // CLI11's value for a lone --json
  const std::string said = std::string("--") + option.name;
  const Use& use = *use_of(option, command);
  if (typed.option->count() == 0) {
    if (*use.otherwise == '\0') return;
    put(option, {said, std::vector<std::string>{use.otherwise}}, asked);
    asked.given.erase(option.name);
    return;
  }
  std::vector<std::string> texts{typed.text};
  if (option.kind == Kind::kFlag && *option.shape == '\0') {
    texts = {typed.flag ? "true" : "false"};  // --stats=false
  } else if (option.kind == Kind::kFlag && typed.text == kLone) {
    texts.clear();
  } else if (has_commas(option)) {
    texts = CLI::detail::split(typed.text, ',');
  }
  put(option, {said, texts}, asked);
}

}  // namespace

Program::Program()
    : app_(
          "Encloses the directed Hausdorff distance h(A,B) of two triangle meshes in a certified "
          "interval, or proves that it is within a limit or beyond.",
          "vkhausdorff") {
  app_.set_version_flag("-V,--version", std::string("vkhausdorff ") + program_version());
  app_.set_help_flag("-h,--help", "Show the options that are needed most, and end");
  app_.set_help_all_flag("--help-all", "Show all options, and end");
  app_.require_subcommand(1);
  app_.allow_windows_style_options(false);  // one command line everywhere; and /folder is a name
  commands_.reserve(commands().size());     // the parser keeps places in it
  for (const Command& command : commands()) add(command);
  // Last, since a command begins with its parent's.
  app_.footer(
      "'vkhausdorff gate --help' shows a command's options. Exit codes: 0 closed, or PASS; 1 "
      "FAIL; 2 usage; 3 not closed within the budget, or UNDECIDED (the interval is true); 4 bad "
      "input; 5 device or driver; 6 the answer was given and an output could not be written.");
}

void Program::add(const Command& command) {
  TypedCommand& typed = commands_.emplace_back();
  typed.command = &command;
  typed.app = app_.add_subcommand(command.name, command.does);
  const bool is_fixed = command.positionals.empty() || !command.positionals[0].is_several;
  if (is_fixed) typed.files.resize(command.positionals.size());
  for (size_t i = 0; i < command.positionals.size(); ++i) {
    const Positional& one = command.positionals[i];
    CLI::Option* made = one.is_several ? typed.app->add_option(one.name, typed.files, one.help)
                                       : typed.app->add_option(one.name, typed.files[i], one.help);
    made->required()->check(check_value);
  }
  for (const bool is_required : {true, false}) {
    for (const Option& option : options()) {
      const Use* use = use_of(option, command.bit);
      if (use != nullptr && use->required == is_required)
        add_option(option, *use, typed, typed.options[&option]);
    }
  }
  typed.app->footer(command.footer + (command.footer.empty() ? "" : "\n\n") +
                    "Exit codes: " + command.codes);
}

std::string Program::help(bool shows_all) {
  const std::vector<CLI::App*> named = app_.get_subcommands();
  for (const TypedCommand& typed : commands_) {
    if (!shows_all && typed.app->parsed()) show_few(typed);
  }
  std::string text = without_double_blanks(app_.help());
  if (!named.empty() || !shows_all) return text;
  for (const TypedCommand& typed : commands_)
    text += "\n" + without_double_blanks(typed.app->help("vkhausdorff"));
  return text;
}

Request Program::asked() const {
  const auto typed = std::find_if(commands_.begin(), commands_.end(),
                                  [](const TypedCommand& one) { return one.app->parsed(); });
  Request asked;
  asked.command = typed->command->bit;
  asked.question.command = typed->command->name;
  for (const Option& option : options()) {
    const auto one = typed->options.find(&option);
    if (one != typed->options.end()) put_typed(option, one->second, asked.command, asked);
  }
  const std::vector<Positional>& named = typed->command->positionals;
  const bool is_of_meshes = !named.empty() && !named[0].is_several;
  if (is_of_meshes) asked.question.file_a = typed->files[0];
  if (is_of_meshes && named.size() > 1) asked.question.file_b = typed->files[1];
  asked.many.files = typed->files;
  return asked;
}

}  // namespace vkh
