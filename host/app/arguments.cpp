#include "host/app/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <limits>
#include <sstream>
#include <string_view>

#include "host/answer/options.h"
#include "host/app/help_groups.h"
#include "host/app/help_text.h"
#include "host/app/many_pairs_line.h"
#include "host/app/simplify_line.h"
#include "host/app/typed.h"
#include "host/base/closest_name.h"
#include "host/base/meant.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

/// CLI11 puts two blank lines behind a group.
std::string without_double_blanks(std::string text) {
  for (size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;) text.erase(at, 1);
  return text;
}

/// The commands, each with its own typed options: their defaults differ.
struct Program {
  CLI::App app{
      "Encloses the directed Hausdorff distance h(A,B) of two triangle meshes in a certified "
      "interval, or proves that it is within a limit or beyond.",
      "vkhausdorff"};
  Typed distance, gate, metrics, demo, doctor;
  TypedMany batch, merge;
  TypedSimplify simplify;

  Program() {
    app.set_version_flag("-V,--version", std::string("vkhausdorff ") + program_version());
    app.set_help_flag("-h,--help", "Show the options that are needed most, and end");
    app.set_help_all_flag("--help-all", "Show all options, and end");
    app.require_subcommand(1);
    app.allow_windows_style_options(false);  // one command line everywhere; and /folder is a name

    CLI::App* command = app.add_subcommand("distance", "Distance of two mesh files");
    add_pair(*command, distance);
    add_tolerance(*command, distance, "1e-6");
    add_symmetric(*command, distance);
    add_part(*command, distance);
    add_survey_options(*command, distance);
    add_picture_options(*command, distance.pictures);
    add_certificate_option(*command, distance.pictures);
    add_output_options(*command, distance);
    add_search_options(*command, distance);

    add_gate(*app.add_subcommand("gate", "Is the distance of two mesh files within a limit?"));
    add_metrics(*app.add_subcommand(
        "metrics", "Figures of two mesh files by the names that papers use, both directions"));
    add_batch(*app.add_subcommand("batch", "Distances or verdicts of many pairs"), batch);
    add_merge(*app.add_subcommand("merge", "Results of several batches as one, by id"), merge);

    add_simplify(*app.add_subcommand("simplify", "Fewer faces, within a proven limit"), simplify);

    command = app.add_subcommand("demo", "Distance of a built-in pair");
    add_tolerance(*command, demo, "1e-8");
    add_symmetric(*command, demo);
    add_survey_options(*command, demo);
    add_picture_options(*command, demo.pictures);
    add_output_options(*command, demo);
    add_search_options(*command, demo);

    command = app.add_subcommand("doctor", "Devices, drivers and a self-check");
    add_device_option(*command, doctor);
    add_json_option(*command, doctor, "words");
    refuse_empty_values();
    for (CLI::App* one : app.get_subcommands([](CLI::App*) { return true; })) group_options(*one);
    // Last, since a command begins with its parent's.
    app.footer(
        "'vkhausdorff gate --help' shows a command's options. Exit codes: 0 closed, or PASS; 1 "
        "FAIL; 2 usage; 3 not closed within the budget, or UNDECIDED (the interval is true); 4 bad "
        "input; 5 device or driver; 6 the answer was given and an output could not be written.");
  }

  /// Refuses an empty value: with --max "$LIMIT", a script whose variable is not set would ask less
  /// than it says.
  void refuse_empty_values() {
    for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
      for (CLI::Option* option : command->get_options()) {
        if (option->get_expected_max() == 0) continue;  // a flag
        option->check([](const std::string& text) {
          return std::string(text.empty() ? "'' is no value" : "");
        });
      }
    }
  }

  void add_gate(CLI::App& command) {
    add_pair(command, gate);
    command
        .add_option("--max", gate.max,
                    std::string("The limit: ") + kLengths +
                        "; or one over B, in front of its faces, and one under it: "
                        "+0.25mm,-0.4mm")
        ->type_name("LENGTH")
        ->required();
    command
        .add_option("--face-max", gate.face_max_a,
                    "Limits of A's faces: a CSV of face, max, counted from 0 as in A's file; a "
                    "number alone is in the files' unit, others have --max. Or a PLY, such as A, "
                    "whose faces have a property max")
        ->type_name("FILE");
    command.add_option("--face-max-b", gate.face_max_b, "The same for B's faces, the way back")
        ->type_name("FILE");
    add_tolerance(command, gate, "1e-7");
    add_symmetric(command, gate);
    command
        .add_option("--area", gate.area,
                    "Ask that so much of A's area is within the limit, such as 99.5%, in place of "
                    "every point")
        ->type_name("SHARE");
    command.add_flag(
        "--worst", gate.worst,
        "After the verdict, go on to the farthest point; with --image, --report or --field "
        "that is so without it");
    add_survey_options(command, gate);
    add_picture_options(command, gate.pictures);
    add_certificate_option(command, gate.pictures);
    command.add_option("--junit", gate.junit, "Write a test suite of one test case: JUnit's XML")
        ->type_name("FILE");
    command.add_flag("--github", gate.github,
                     "Print a workflow annotation for GitHub Actions, and add to the summary of "
                     "the run ($GITHUB_STEP_SUMMARY)");
    add_output_options(command, gate);
    add_search_options(command, gate);
  }

  void add_metrics(CLI::App& command) {
    metrics.metrics = true;
    add_pair(command, metrics);
    add_metrics_options(command, metrics);
    add_tolerance(command, metrics, "1e-6");
    add_effort_option(command, metrics);
    add_output_options(command, metrics);
    add_search_options(command, metrics);
  }

  /// The help on the command that was named, or on the program.
  std::string help(bool shows_all) {
    const std::vector<CLI::App*> named = app.get_subcommands();
    if (!named.empty() && !shows_all) show_few(*named[0]);
    std::string text = without_double_blanks(app.help());
    if (!named.empty() || !shows_all) return text;
    for (const CLI::App* command : app.get_subcommands([](CLI::App*) { return true; }))
      text += "\n" + without_double_blanks(command->help("vkhausdorff"));
    return text;
  }

  /// Finds the command that `words` name, or returns the program itself.
  const CLI::App& named(const Words& words) const {
    if (words.empty()) return app;
    const std::vector<const CLI::App*> commands = app.get_subcommands({});
    const auto found = std::find_if(commands.begin(), commands.end(), [&](const CLI::App* one) {
      return one->get_name() == words[0];
    });
    return found == commands.end() ? app : **found;
  }

  Words option_names(const CLI::App& command) const {
    Words names;
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
  }

  /// The commands that have an option of this name.
  Words commands_with(const std::string& option) const {
    Words names;
    for (const CLI::App* command : app.get_subcommands({})) {
      const Words known = option_names(*command);
      if (std::find(known.begin(), known.end(), option) != known.end())
        names.push_back(command->get_name());
    }
    return names;
  }

  Words command_names() const {
    Words names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
  }
};

std::string listed(const Words& words, const char* last) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? last : ", ") + words[i];
  return text;
}

std::string hint_without_blank(const std::string& option, const std::string& given,
                               const std::string& meant) {
  return option + " '" + given + "': write " + meant + ", without a blank";
}

/// Returns what to write for "--max 0.1 mm" and "--max=0.1 mm"; nothing if no number and unit are
/// so apart.
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

/// Returns where the options of the command, or of the program, are told.
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

/// Returns what to do in place of an option that is gone; nothing of any other.
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

/// Words the error anew: CLI11 reports a missing command for a misspelt one, and an unexpected
/// option for a misspelt one.
std::string usage_message(const Program& program, const CLI::ParseError& error,
                          const Words& words) {
  const CLI::App& command = program.named(words);
  if (&command == &program.app && !words.empty() && !words[0].starts_with('-')) {
    const Words names = program.command_names();
    const std::string meant = name_meant(words[0], names);
    return "unknown command '" + words[0] + "': expected " + listed(names, " or ") +
           (meant.empty() ? "" : "; did you mean " + meant + "?");
  }
  const Words options = program.option_names(command);
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    const bool is_known = std::find(options.begin(), options.end(), name) != options.end();
    if (!name.starts_with("--") || name == "--" || is_known) continue;
    if (std::string hint = gone_hint(name); !hint.empty()) return hint;
    if (const Words others = program.commands_with(name); !others.empty())
      return "unknown option '" + name + "': it is of " + listed(others, " and ");
    const std::string meant = name_meant(name, options);
    return "unknown option '" + name + "'" +
           (meant.empty() ? see_help(command) : ": did you mean " + meant + "?");
  }
  const bool stray = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (std::string hint = stray ? blank_hint(words) : ""; !hint.empty()) return hint;
  if (stray && std::find(words.begin(), words.end(), "--json") != words.end()) {
    return std::string(error.what()) + "; JSON goes into a file by --json=FILE, without a space";
  }
  return error.what() + see_help(command);
}

CommandLine pair_line(Command command, const Typed& typed, const Words& words, const char* name) {
  CommandLine line{.command = command,
                   .help = {},
                   .question = question_of(typed, words, name),
                   .time_limit_s = typed.time ? parse_time(*typed.time)
                                              : std::numeric_limits<double>::infinity(),
                   .outputs = outputs_of(typed),
                   .device = {}};
  line.question.hashes = line.outputs.json || line.outputs.json_file ||
                         line.outputs.pictures.report || line.question.certificate;
  const PicturesAsked& pictures = line.outputs.pictures;
  line.question.faces = line.question.faces || pictures.field;
  if (pictures.image || pictures.points || pictures.of_statistics())
    ask_for(pictures.look, line.question);
  line.question.statistics = line.question.statistics || pictures.of_statistics();
  if (line.question.effort && !line.question.asks_for_survey())
    throw UsageError(
        "--effort: is of figures and faces' bounds: ask for --stats, --signed, --bands, --area, "
        "--field-tol, --field, --image, --report, --figures-csv or --points-out");
  return line;
}

CommandLine help_line(std::string text) {
  CommandLine line;
  line.help = std::move(text);
  return line;
}

}  // namespace

CommandLine understand(const Words& given) {
  Words words = given;
  if (!words.empty() && words[0] == "help") {
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  for (const char* option : {"--json=", "--junit=", "--csv="}) {
    if (std::find(words.begin(), words.end(), option) == words.end()) continue;
    std::string message(option);
    message.append("'': expected the name of a file, as in ").append(option).append("answer.txt");
    throw UsageError(message);
  }
  Program program;
  try {
    program.app.parse(Words(words.rbegin(), words.rend()));  // CLI11 wants them reversed
  } catch (const CLI::CallForHelp&) {
    return help_line(wrapped(program.help(false), terminal_columns()));
  } catch (const CLI::CallForAllHelp&) {
    return help_line(wrapped(program.help(true), terminal_columns()));
  } catch (const CLI::Success& version) {
    std::ostringstream text, none;
    program.app.exit(version, text, none);
    return help_line(text.str());
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_message(program, error, words));
  }
  const std::string name = program.app.get_subcommands()[0]->get_name();
  if (name == "distance") return pair_line(Command::kDistance, program.distance, words, "distance");
  if (name == "gate") return pair_line(Command::kGate, program.gate, words, "gate");
  if (name == "metrics") return pair_line(Command::kMetrics, program.metrics, words, "metrics");
  if (name == "demo") return pair_line(Command::kDemo, program.demo, words, "demo");
  if (name == "batch") return batch_line(program.batch, words);
  if (name == "merge") return merge_line(program.merge);
  if (name == "simplify") return simplify_line(program.simplify, words);
  CommandLine line;
  line.command = Command::kDoctor;
  line.device = program.doctor.device;
  line.outputs = outputs_of(program.doctor);
  return line;
}

}  // namespace vkh
