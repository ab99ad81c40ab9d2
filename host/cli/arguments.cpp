#include "host/cli/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

#include "host/answer/options.h"
#include "host/base/error.h"
#include "host/cli/help_text.h"
#include "host/cli/pictures.h"

namespace vkh {
namespace {

constexpr const char* kStandardOutput = "true";  ///< what CLI11 makes of a lone --json

/// As typed.
struct Typed {
  std::string file_a, file_b;
  std::string tolerance, max, face_max_a, face_max_b, unit, device;
  std::optional<std::string> memory, time, waves, max_input;
  std::vector<std::string> enabled, disabled;
  std::string preset;
  std::string json, junit, area, field_tolerance;
  TypedPictures pictures;
  std::vector<std::string> bands;
  bool github = false, verbose = false, symmetric = false, verify = false, no_cache = false,
       statistics = false;
};

void check_names(const char* option, const std::vector<std::string>& names,
                 const std::vector<std::string>& known) {
  const auto stranger = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return std::find(known.begin(), known.end(), name) == known.end();
  });
  if (stranger == names.end()) return;
  std::string list;
  for (const std::string& k : known) list.append(list.empty() ? "" : ", ").append(k);
  throw UsageError(std::string(option) + " '" + *stranger + "': expected one of " + list);
}

SolveOptions options_of(const Typed& typed) {
  SolveOptions options;
  if (typed.memory) options.memory_bytes = parse_memory(*typed.memory);
  if (typed.waves) options.wave_limit = parse_waves(*typed.waves);
  check_names("--enable", typed.enabled, switch_names());
  check_names("--disable", typed.disabled, switch_names());
  if (!typed.preset.empty()) check_names("--preset", {typed.preset}, preset_names());
  options.preset = typed.preset;
  options.enabled = typed.enabled;
  options.disabled = typed.disabled;
  return options;
}

SurveyWish survey_of(const Typed& typed) {
  SurveyWish wish;
  wish.faces = !typed.field_tolerance.empty();
  if (wish.faces)
    wish.face_tolerance =
        parse_length("--field-tol", typed.field_tolerance, PlainNumber::kFraction);
  for (const std::string& band : typed.bands)
    wish.bands.push_back(parse_length("--bands", band, PlainNumber::kRefused));
  wish.statistics = typed.statistics || !typed.bands.empty();
  if (!typed.area.empty()) wish.area = parse_share("--area", typed.area);
  wish.area_requested = typed.area;
  return wish;
}

void check_together(const Typed& typed) {
  const bool by_face = !typed.face_max_a.empty() || !typed.face_max_b.empty();
  if (!typed.face_max_b.empty() && !typed.symmetric)
    throw UsageError("--face-max-b: limits of B's faces are asked about by --symmetric alone");
  if (by_face && typed.verify) throw UsageError("--verify: is not to be had with --face-max");
  if (by_face && !typed.area.empty())
    throw UsageError("--area: faces with limits of their own are asked about whole");
  if (!typed.pictures.certificate.empty() && (by_face || !typed.area.empty()))
    throw UsageError("--certificate: is of the interval, not to be had with --area or --face-max");
}

PairJob job_of(const Typed& typed, const Words& words, const char* command) {
  PairJob job;
  job.command = command;
  job.words = words;
  job.file_a = typed.file_a;
  job.file_b = typed.file_b;
  if (!typed.unit.empty()) check_unit("--unit", typed.unit);
  job.unit = typed.unit;
  job.tolerance = parse_length("--tol", typed.tolerance, PlainNumber::kFraction);
  if (!typed.max.empty()) job.max = parse_length("--max", typed.max, PlainNumber::kRefused);
  job.face_max_a = typed.face_max_a;
  job.face_max_b = typed.face_max_b;
  job.proof = !typed.pictures.certificate.empty();
  check_together(typed);
  job.symmetric = typed.symmetric;
  job.survey = survey_of(typed);
  job.verify = typed.verify;
  job.device = typed.device;
  job.caches = !typed.no_cache;
  job.options = options_of(typed);
  if (typed.max_input) job.limits.max_input_bytes = parse_size("--max-input", *typed.max_input);
  return job;
}

Outputs outputs_of(const Typed& typed) {
  Outputs outputs;
  outputs.json = typed.json == kStandardOutput;
  if (!typed.json.empty() && !outputs.json) outputs.json_file = typed.json;
  if (!typed.junit.empty()) outputs.junit_file = typed.junit;
  outputs.github = typed.github;
  outputs.verbose = typed.verbose;
  outputs.pictures = asked_of(typed.pictures);
  return outputs;
}

void add_device_option(CLI::App& command, Typed& typed) {
  command.add_option("--device", typed.device,
                     "An index from 'doctor', gpu, cpu, or part of a name [best: discrete, "
                     "integrated, virtual, CPU]");
}

void add_search_options(CLI::App& command, Typed& typed) {
  add_device_option(command, typed);
  command.add_option("--time", typed.time,
                     "Answer after so long, from the program's start: 250ms, 10s, 2min [no limit]");
  command.add_option("--memory", typed.memory,
                     "Device memory for the search, such as 512MiB or 2G [chosen from the meshes]");
  command.add_option("--waves", typed.waves, "End the search after so many waves [no limit]")
      ->type_name("N");
  command.add_option("--preset", typed.preset,
                     "Which parts of the method are on: default, what pays on the device; paper, "
                     "what the paper has; baseline-gpu, the paper's baseline [default]");
  command
      .add_option("--enable", typed.enabled,
                  "Switch on parts that the preset has not, by name: u4,sort")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--disable", typed.disabled, "Switch off parts of the method, by name: a,b")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_flag("--no-cache", typed.no_cache,
                   "Neither read nor write compiled pipelines in the user's cache folder");
}

void add_output_options(CLI::App& command, Typed& typed) {
  command
      .add_flag("--json", typed.json,
                "Print one JSON object instead of the table; --json=FILE, without a space, writes "
                "it beside the table")
      ->type_name("[=FILE]");
  command.add_flag("--verbose", typed.verbose,
                   "Also print switches, stages, waves and culled candidates");
  command.add_flag("--verify", typed.verify,
                   "Check the answer on the host: the witness against every face of B, by brute "
                   "force in 113-bit arithmetic; the parts of A as exact integers");
}

constexpr const char* kLengths =
    "0.1mm (um, cm, m, in and ft, too), 0.1abs in the files' own unit, 0.1% of A's bounding-box "
    "diagonal, 1e-6diag";

void add_survey_options(CLI::App& command, Typed& typed) {
  command.add_flag("--stats", typed.statistics,
                   "Also enclose the mean over A's area, the root mean square and percentiles");
  command
      .add_option("--bands", typed.bands,
                  "And the shares of A's area within these distances: 0.1mm,0.5mm")
      ->delimiter(',')
      ->type_name("LENGTH,..")
      ->allow_extra_args(false);
  command
      .add_option("--field-tol", typed.field_tolerance,
                  "Bound the largest distance on each face of A, to so much [1 % of the largest]")
      ->type_name("LENGTH");
}

void add_pair(CLI::App& command, Typed& typed) {
  command.add_option("A", typed.file_a, "Mesh to start from (OBJ, STL, PLY, OFF, glTF, 3MF)")
      ->required();
  command.add_option("B", typed.file_b, "Mesh to go to")->required();
  command
      .add_option("--unit", typed.unit,
                  "What the files are in, where they do not say: um, mm, cm, m, in or ft")
      ->type_name("UNIT");
  command.add_option(
      "--max-input", typed.max_input,
      "Refuse a file of more bytes, or with a mesh that takes more, such as 100M or 2GiB; reading "
      "takes up to six times that [no limit]");
}

void add_tolerance(CLI::App& command, Typed& typed, const char* by_default) {
  typed.tolerance = by_default;
  command
      .add_option("--tol", typed.tolerance,
                  std::string("Width of the interval: ") + kLengths +
                      ", or a number alone, which is a fraction of the diagonal")
      ->type_name("LENGTH")
      ->default_str(by_default);
}

void add_symmetric(CLI::App& command, Typed& typed) {
  command.add_flag("--symmetric", typed.symmetric,
                   "Both directions: max(h(A,B), h(B,A)) instead of h(A,B)");
}

/// The commands, each with what was typed for it: their defaults differ.
struct Program {
  CLI::App app{
      "Encloses the directed Hausdorff distance h(A,B) of two triangle meshes in a certified "
      "interval, or proves that it is within a limit or beyond.",
      "vkhausdorff"};
  Typed distance, gate, demo, doctor;

  Program() {
    app.set_version_flag("-V,--version", std::string("vkhausdorff ") + program_version());
    app.footer(
        "Exit codes: 0 closed, or PASS; 1 FAIL; 2 usage; 3 not closed within the budget, or "
        "UNDECIDED (the interval is true); 4 bad input; 5 device or driver; 6 the answer was given "
        "and an output could not be written.");
    app.require_subcommand(1);
    app.allow_windows_style_options(false);  // one command line everywhere; and /folder is a name

    CLI::App* command = app.add_subcommand("distance", "Distance of two mesh files");
    add_pair(*command, distance);
    add_tolerance(*command, distance, "1e-6");
    add_symmetric(*command, distance);
    add_survey_options(*command, distance);
    add_picture_options(*command, distance.pictures);
    add_certificate_option(*command, distance.pictures);
    add_output_options(*command, distance);
    add_search_options(*command, distance);

    command = app.add_subcommand("gate", "Is the distance of two mesh files within a limit?");
    add_pair(*command, gate);
    command->add_option("--max", gate.max, std::string("The limit: ") + kLengths)
        ->type_name("LENGTH")
        ->required();
    command
        ->add_option(
            "--face-max", gate.face_max_a,
            "A CSV of face, max: limits of A's faces, counted from 0; a number alone is in "
            "the files' unit. Others have --max")
        ->type_name("FILE");
    command->add_option("--face-max-b", gate.face_max_b, "The same for B's faces, the way back")
        ->type_name("FILE");
    add_tolerance(*command, gate, "1e-7");
    add_symmetric(*command, gate);
    command
        ->add_option("--area", gate.area,
                     "Ask that so much of A's area is within the limit, such as 99.5%, in place of "
                     "every point")
        ->type_name("SHARE");
    add_survey_options(*command, gate);
    add_picture_options(*command, gate.pictures);
    add_certificate_option(*command, gate.pictures);
    command->add_option("--junit", gate.junit, "Write a test suite of one test case: JUnit's XML")
        ->type_name("FILE");
    command->add_flag("--github", gate.github,
                      "Print a workflow annotation for GitHub Actions, and add to the summary of "
                      "the run ($GITHUB_STEP_SUMMARY)");
    add_output_options(*command, gate);
    add_search_options(*command, gate);

    command = app.add_subcommand("demo", "Distance of a built-in pair");
    add_tolerance(*command, demo, "1e-8");
    add_symmetric(*command, demo);
    add_survey_options(*command, demo);
    add_picture_options(*command, demo.pictures);
    add_output_options(*command, demo);
    add_search_options(*command, demo);

    command = app.add_subcommand("doctor", "Devices, drivers and a self-check");
    add_device_option(*command, doctor);
  }

  /// The command that `words` name, or the program itself.
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

/// CLI11 says that a command is missing where one was misspelt, and that an option was not expected
/// where one was.
std::string usage_message(const Program& program, const CLI::ParseError& error,
                          const Words& words) {
  const CLI::App& command = program.named(words);
  if (&command == &program.app && !words.empty() && !words[0].starts_with('-')) {
    const Words names = program.command_names();
    const std::string meant = closest_name(words[0], names);
    return "unknown command '" + words[0] + "': expected " + listed(names, " or ") +
           (meant.empty() ? "" : "; did you mean " + meant + "?");
  }
  const Words options = program.option_names(command);
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    const bool is_known = std::find(options.begin(), options.end(), name) != options.end();
    if (!name.starts_with("--") || name == "--" || is_known) continue;
    const std::string meant = closest_name(name, options);
    return "unknown option '" + name + "'" +
           (meant.empty() ? " (see vkhausdorff --help)" : ": did you mean " + meant + "?");
  }
  const bool stray = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (stray && std::find(words.begin(), words.end(), "--json") != words.end()) {
    return std::string(error.what()) + "; JSON goes into a file by --json=FILE, without a space";
  }
  return std::string(error.what()) + " (see vkhausdorff --help)";
}

CommandLine pair_line(Command command, const Typed& typed, const Words& words, const char* name) {
  CommandLine line{.command = command,
                   .help = {},
                   .job = job_of(typed, words, name),
                   .time_limit_s = typed.time ? parse_time(*typed.time)
                                              : std::numeric_limits<double>::infinity(),
                   .outputs = outputs_of(typed),
                   .device = {}};
  line.job.hashes =
      line.outputs.json || line.outputs.json_file || line.outputs.pictures.report || line.job.proof;
  line.job.survey.faces = line.job.survey.faces || line.outputs.pictures.of_cells();
  line.job.survey.statistics =
      line.job.survey.statistics || line.outputs.pictures.report.has_value();
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
  for (const char* option : {"--json=", "--junit="}) {
    if (std::find(words.begin(), words.end(), option) == words.end()) continue;
    std::string message(option);
    message.append("'': expected the name of a file, as in ").append(option).append("answer.txt");
    throw UsageError(message);
  }
  Program program;
  try {
    program.app.parse(Words(words.rbegin(), words.rend()));  // as CLI11 wants them
  } catch (const CLI::Success& help) {
    std::ostringstream text, none;
    program.app.exit(help, text, none);
    return help_line(wrapped(text.str(), terminal_columns()));
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_message(program, error, words));
  }
  const std::string name = program.app.get_subcommands()[0]->get_name();
  if (name == "distance") return pair_line(Command::kDistance, program.distance, words, "distance");
  if (name == "gate") return pair_line(Command::kGate, program.gate, words, "gate");
  if (name == "demo") return pair_line(Command::kDemo, program.demo, words, "demo");
  CommandLine line;
  line.command = Command::kDoctor;
  line.device = program.doctor.device;
  return line;
}

}  // namespace vkh
