// The program: reads what people typed, runs the solver, prints one answer, and turns whatever went
// wrong into one line on stderr and an exit code.
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>

#include "host/answer/answer.h"
#include "host/answer/options.h"
#include "host/base/error.h"
#include "host/base/float_environment.h"
#include "host/check/verify.h"
#include "host/cli/doctor.h"
#include "host/cli/out_of_memory.h"
#include "host/cli/progress_line.h"
#include "host/cli/reading.h"
#include "host/cli/session.h"
#include "host/demo/default_pair.h"
#include "host/gpu/device.h"
#include "host/system/output_file.h"
#include "host/system/system.h"

namespace vkh {
namespace {

enum ExitCode {
  kExitClosed = 0,
  kExitUsage = 2,
  kExitNotClosed = 3,
  kExitBadInput = 4,
  kExitDevice = 5,
  kExitNotWritten = 6,     ///< the answer was given and an output could not be written
  kExitInterrupted = 130,  ///< by Ctrl-C, before there was an interval; what a shell says of it
  kExitInternal = 70,      ///< a bug of ours; sysexits.h's EX_SOFTWARE
};

constexpr const char* kStandardOutput = "true";  ///< what CLI11 makes of a lone --json

using Words = std::vector<std::string>;

/// As typed.
struct Arguments {
  std::string file_a, file_b;
  std::string tolerance = "1e-6", device, memory, time, waves, max_input;
  std::vector<std::string> enabled, disabled;
  std::string preset;
  bool verbose = false, symmetric = false, verify = false, no_cache = false;
  std::string json;  ///< empty: none; or kStandardOutput; or a file
};

/// Understood, before any file or device is touched.
struct Request {
  Tolerance tolerance;
  SolveOptions options;
  ReadLimits limits;
};

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

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

Request understand(const Arguments& arguments) {
  Request request;
  request.tolerance = parse_tolerance(arguments.tolerance);
  SolveOptions& options = request.options;
  options.tolerance = request.tolerance.value;
  options.tolerance_is_absolute = request.tolerance.is_absolute;
  if (!arguments.memory.empty()) options.memory_bytes = parse_memory(arguments.memory);
  if (!arguments.time.empty()) options.time_limit_s = parse_time(arguments.time);
  if (!arguments.max_input.empty())
    request.limits.max_input_bytes = parse_size("--max-input", arguments.max_input);
  if (!arguments.waves.empty()) options.wave_limit = parse_waves(arguments.waves);
  check_names("--enable", arguments.enabled, switch_names());
  check_names("--disable", arguments.disabled, switch_names());
  if (!arguments.preset.empty()) check_names("--preset", {arguments.preset}, preset_names());
  options.preset = arguments.preset;
  options.enabled = arguments.enabled;
  options.coverage = arguments.verify;
  options.disabled = arguments.disabled;
  return request;
}

std::vector<std::string> input_notes(const MeshPair& pair) {
  std::vector<std::string> notes;
  for (const std::string& note : pair.a.notes) notes.push_back("A: " + note);
  for (const std::string& note : pair.b.notes) notes.push_back("B: " + note);
  if (!pair.a.unit.empty() && !pair.b.unit.empty() && pair.a.unit != pair.b.unit) {
    notes.push_back("A is in " + pair.a.unit + " and B in " + pair.b.unit +
                    ": neither was converted");
  }
  return notes;
}

void solve(Solver& solver, const MeshPair& pair, bool symmetric, SolveOptions options,
           Answer& answer) {
  ProgressLine line;
  options.progress = [&line](const Progress& progress) {
    line.show(progress);
    return !is_interrupted();  // the first Ctrl-C ends the run with the interval that it has
  };
  if (!symmetric) {
    answer.a_to_b = solver.distance(pair.a, pair.b, options);
    return;
  }
  SymmetricReport both = solver.symmetric(pair.a, pair.b, options);
  answer.a_to_b = std::move(both.a_to_b);
  answer.b_to_a = std::move(both.b_to_a);
}

Answer answer_for(const Arguments& arguments, const Request& request, const MeshPair& pair,
                  Session& session) {
  Answer answer{.file_a = pair.a.name,
                .file_b = pair.b.name,
                .tolerance = request.tolerance,
                .notes = input_notes(pair),
                .a_to_b = {},
                .b_to_a = {}};
  solve(*session.solver, pair, arguments.symmetric, request.options, answer);
  const uint64_t in_host = std::max(answer.a_to_b.host_memory_bytes,
                                    answer.b_to_a ? answer.b_to_a->host_memory_bytes : 0);
  if (in_host > 0) {
    answer.notes.push_back("the device has too little memory: it reads " +
                           std::to_string((in_host + 0xfffff) >> 20) +
                           " MiB from the host's, slowly");
  }
  if (arguments.verify) {
    answer.a_to_b.witness_check = verify_witness(pair.a, pair.b, answer.a_to_b);
    if (answer.b_to_a) {
      answer.b_to_a->witness_check = verify_witness(pair.b, pair.a, *answer.b_to_a);
    }
  }
  return answer;
}

int complain(std::string message, ExitCode code) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fprintf(stderr, "vkhausdorff: %s\n", message.c_str());
  std::fflush(stderr);
  return code;
}

void check_printed() {
  if (!std::cout.flush()) throw OutputError("cannot write the answer to standard output");
}

/// Whether every output was written. The answer is printed whatever becomes of a file, and after
/// it: whoever reads standard output may close it early, and that ends the program.
bool print(const Arguments& arguments, const Answer& answer, const OutputFile* json_file) {
  std::string not_written;
  try {
    if (json_file != nullptr) json_file->write(to_json(answer) + '\n');
  } catch (const OutputError& error) {
    not_written = error.what();
  }
  if (arguments.json == kStandardOutput) {
    std::cout << to_json(answer) << '\n';
  } else {
    print_table(std::cout, answer, arguments.verbose);
  }
  if (not_written.empty()) {
    check_printed();
    return true;
  }
  std::cout.flush();
  complain(not_written, kExitNotWritten);
  return false;
}

/// After the answer is printed: whoever asked wants to see what was refuted.
void check_verified(const Answer& answer) {
  for (const Report* r : {&answer.a_to_b, answer.b_to_a ? &*answer.b_to_a : nullptr}) {
    if (r == nullptr || !r->witness_check) continue;
    if (!r->coverage_check || !r->coverage_check->holds) {
      throw DeviceError("--verify: a part of A is in no bound: do not trust this device or driver");
    }
    if (r->witness_check->holds) continue;
    throw DeviceError(
        "--verify: the host finds the witness closer than the certified lower bound: "
        "do not trust this device or driver");
  }
}

template <typename Load>
int run_pair(const Arguments& arguments, Load load) {
  note_interrupts();
  const Request request = understand(arguments);
  std::optional<OutputFile> json_file;
  if (!arguments.json.empty() && arguments.json != kStandardOutput)
    json_file.emplace("--json", arguments.json, std::vector{arguments.file_a, arguments.file_b});
  const auto start = Clock::now();
  auto opening = begin_now([selector = arguments.device, options = request.options,
                            cache = arguments.no_cache ? "" : user_cache_folder()] {
    return open_session(selector, options, cache);
  });
  const MeshPair pair = load(request.limits);
  const double load_ms = ms_since(start);
  Session session = opening.get();  // taken apart after the answer is out
  Answer answer = answer_for(arguments, request, pair, session);
  for (Report* report : {&answer.a_to_b, answer.b_to_a ? &*answer.b_to_a : nullptr}) {
    if (report == nullptr) continue;
    report->times.load_ms = load_ms;
    report->times.setup_ms = session.setup_ms;
  }
  const bool is_written = print(arguments, answer, json_file ? &*json_file : nullptr);
  check_verified(answer);
  if (!is_written) return kExitNotWritten;
  return interval_of(answer).status == Status::kClosed ? kExitClosed : kExitNotClosed;
}

int run_distance(const Arguments& arguments) {
  return run_pair(arguments, [&](const ReadLimits& limits) {
    return read_pair(arguments.file_a, arguments.file_b, limits);
  });
}

int run_demo(const Arguments& arguments) {
  return run_pair(arguments, [](const ReadLimits&) { return default_pair(); });
}

int run_doctor(const Arguments& arguments) {
  const bool passed = examine_devices(std::cout, arguments.device);
  check_printed();
  if (!passed) throw DeviceError("the self-check failed: do not trust this device or driver");
  return kExitClosed;
}

void add_device_option(CLI::App& command, Arguments& arguments) {
  command.add_option("--device", arguments.device,
                     "An index from 'doctor', gpu, cpu, or part of a name [best: discrete, "
                     "integrated, virtual, CPU]");
}

void add_run_options(CLI::App& command, Arguments& arguments) {
  command.add_option("--tol", arguments.tolerance,
                     "Width of the interval: fraction of A's bounding-box diagonal (1e-6), percent "
                     "of it (0.1%) or the files' own units (0.01abs) [1e-6]");
  add_device_option(command, arguments);
  command.add_option(
      "--memory", arguments.memory,
      "Device memory for the search, such as 512MiB or 2GiB [chosen from the meshes]");
  command.add_option("--time", arguments.time,
                     "End the search after so long, such as 250ms, 10s or 2min [never]");
  command.add_option("--waves", arguments.waves, "End the search after so many waves [never]")
      ->type_name("N");
  command
      .add_flag("--json", arguments.json,
                "Print one JSON object instead of the table; --json=FILE, without a space, writes "
                "it beside the table")
      ->type_name("[=FILE]");
  command.add_option("--preset", arguments.preset,
                     "Which parts of the method are on: default, what pays on the device; paper, "
                     "what the paper has; baseline-gpu, the paper's baseline [default]");
  command
      .add_option("--enable", arguments.enabled,
                  "Switch on parts that the preset has not, by name: u4,sort")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option("--disable", arguments.disabled, "Switch off parts of the method, by name: a,b")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_flag("--verbose", arguments.verbose,
                   "Also print stages, waves and culled candidates");
  command.add_flag("--verify", arguments.verify,
                   "Check the answer on the host: the witness against every face of B, by brute "
                   "force in 113-bit arithmetic; the parts of A as exact integers");
  command.add_flag("--no-cache", arguments.no_cache,
                   "Neither read nor write compiled pipelines in the user's cache folder");
  command.add_flag("--symmetric", arguments.symmetric,
                   "Both directions: the interval of max(h(A,B), h(B,A))");
}

/// CLI11 says that a command is missing where one was misspelt.
std::string usage_message(const CLI::ParseError& error, const Words& words) {
  const bool misspelt =
      dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && !words.empty();
  static constexpr std::array kCommands = {"distance", "demo", "doctor"};
  if (misspelt && std::find(kCommands.begin(), kCommands.end(), words[0]) == kCommands.end())
    return "unknown command '" + words[0] + "': expected distance, demo or doctor";
  const bool stray = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (stray && std::find(words.begin(), words.end(), "--json") != words.end()) {
    return std::string(error.what()) + "; JSON goes into a file by --json=FILE, without a space";
  }
  return std::string(error.what()) + " (see vkhausdorff --help)";
}

int run(const Words& words) {
  CLI::App app(
      "Encloses the directed Hausdorff distance h(A,B) of two triangle meshes in a "
      "certified interval.",
      "vkhausdorff");
  app.set_version_flag("--version", std::string("vkhausdorff ") + program_version());
  app.footer(
      "Exit codes: 0 closed, 2 usage, 3 not closed within the budget (the interval is still "
      "true), 4 bad input, 5 device or driver, 6 the answer was given and an output could not be "
      "written, 130 Ctrl-C before there was an interval.");
  app.require_subcommand(1);
  app.allow_windows_style_options(false);  // one command line everywhere; and /folder is a name
  if (std::find(words.begin(), words.end(), "--json=") != words.end())
    throw UsageError("--json='': expected the name of a file, as in --json=answer.json");
  Arguments arguments;
  CLI::App* distance = app.add_subcommand("distance", "Distance of two mesh files");
  distance->add_option("A", arguments.file_a, "Mesh to start from (OBJ, STL, PLY, OFF, glTF, 3MF)")
      ->required();
  distance->add_option("B", arguments.file_b, "Mesh to go to")->required();
  add_run_options(*distance, arguments);
  distance->add_option(
      "--max-input", arguments.max_input,
      "Refuse a file of more bytes, or with a mesh that takes more, such as 100M or "
      "2GiB; reading takes up to six times that [no limit]");
  CLI::App* demo = app.add_subcommand("demo", "Distance of a built-in pair");
  add_run_options(*demo, arguments);
  CLI::App* doctor = app.add_subcommand("doctor", "Devices, drivers and a self-check");
  add_device_option(*doctor, arguments);
  try {
    app.parse(Words(words.rbegin(), words.rend()));  // as CLI11 wants them
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    throw UsageError(usage_message(error, words));
  }
  if (distance->parsed()) return run_distance(arguments);
  return demo->parsed() ? run_demo(arguments) : run_doctor(arguments);
}

int run_and_catch(const Words& words) {
  try {
    return run(words);
  } catch (const UsageError& error) {
    return complain(error.what(), kExitUsage);
  } catch (const InputError& error) {
    return complain(error.what(), kExitBadInput);
  } catch (const DeviceError& error) {
    return complain(error.what(), kExitDevice);
  } catch (const OutputError& error) {
    return complain(error.what(), kExitNotWritten);
  } catch (const Interrupted& error) {
    return complain(error.what(), kExitInterrupted);
  } catch (const std::bad_alloc&) {
    return complain_of_memory(kExitDevice);
  } catch (const std::exception& error) {
    return complain(std::string("internal error: ") + error.what(), kExitInternal);
  } catch (...) {
    return complain("internal error", kExitInternal);
  }
}

int run_in_console(int argc, char** argv) {
  const Console console;
  const int code = run_and_catch(command_line(argc, argv));
  std::cout.flush();
  std::fflush(nullptr);
  return code;
}

}  // namespace
}  // namespace vkh

// Without exit handlers: after a bad file, a thread may still be at work on the other one or in the
// driver. Where there was an answer the device is gone by now: Mesa saves what it compiled then.
int main(int argc, char** argv) {
  const vkh::FloatEnvironment ours;
  vkh::end_where_memory_ends(vkh::kExitDevice);
  const int code = vkh::run_in_console(argc, argv);
#ifdef __SANITIZE_ADDRESS__
  __lsan_do_leak_check();
#endif
  vkh::end_process(code);
}
