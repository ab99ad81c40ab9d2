#include "host/app/help_groups.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <vector>

namespace vkh {
namespace {

using Names = std::vector<std::string_view>;

struct HelpOfCommand {
  Names few;  ///< the options of --help, besides those that are required; empty: all
  std::string codes;
};

constexpr const char* kOutputCode = "6 the answer was given and an output could not be written";
constexpr const char* kOrder = "The worst counts: 5, 4, 6, 2, 1, 3, 0 in this order.";

const std::map<std::string, HelpOfCommand>& help_of_commands() {
  static const std::map<std::string, HelpOfCommand> known{
      {"distance",
       {{"tol", "symmetric", "unit", "stats", "field", "image", "report", "json", "device", "time"},
        std::string("0 closed; 2 usage; 3 not closed within the budget (the interval is true); 4 "
                    "bad input; 5 device or driver; ") +
            kOutputCode + "."}},
      {"gate",
       {{"max", "unit", "symmetric", "worst", "area", "report", "json", "junit", "github", "time"},
        std::string("0 PASS; 1 FAIL; 2 usage; 3 UNDECIDED (the interval is true); 4 bad input; 5 "
                    "device or driver; ") +
            kOutputCode + "."}},
      {"metrics",
       {{"percentile", "bands", "figures", "normals", "unit", "tol", "effort", "json", "device",
         "time"},
        std::string("0 each figure is as narrow as it is to be; 2 usage; 3 a figure is not "
                    "(intervals are true); 4 bad input, or a mesh without area; 5 device or "
                    "driver; ") +
            kOutputCode + "."}},
      {"batch",
       {{"out", "max", "unit", "symmetric", "against", "csv", "junit", "github", "report-dir",
         "resume"},
        std::string(
            "0 each pair is closed or PASS; 1 a pair is a FAIL; 2 usage, or the options of a pair; "
            "3 a pair is not closed, UNDECIDED or left (intervals are true); 4 the list, a file of "
            "a pair, or a mesh without a partner; 5 device or driver; 6 an output could not be "
            "written. ") +
            kOrder}},
      {"merge",
       {{},
        std::string("0 each pair is closed or PASS; 1 a pair is a FAIL; 2 usage, or the options of "
                    "a pair; 3 a pair is not closed, UNDECIDED or, by --list, without a result; 4 "
                    "the results that are read, or a file of a pair; 5 a pair's device or driver; "
                    "6 an output could not be written. ") +
            kOrder}},
      {"simplify",
       {{"max", "out", "one-way", "lock-borders", "unit", "levels", "certificate", "json", "device",
         "time"},
        std::string("0 a mesh was written; 2 usage; 3 none was found, and nothing is written; 4 "
                    "bad input; 5 device or driver; 6 the result could not be written.")}},
      {"demo",
       {{"tol", "symmetric", "stats", "image", "report", "json", "verify", "verbose", "device",
         "time"},
        std::string("0 closed; 2 usage; 3 not closed within the budget (the interval is true); 5 "
                    "device or driver; ") +
            kOutputCode + "."}},
      {"doctor",
       {{},
        "0 the self-check passed; 2 usage; 5 no device, or one that is not to be trusted; 6 the "
        "findings could not be printed or written."}}};
  return known;
}

struct HelpGroup {
  const char* heading;
  Names names;
};

const std::vector<HelpGroup>& help_groups() {
  static const std::vector<HelpGroup> known{
      {"What is asked",
       {"max",       "face-max",     "face-max-b", "area",       "worst",   "tol",
        "symmetric", "polygons",     "bodies",     "points",     "part",    "known-lower",
        "stats",     "signed",       "metrics",    "percentile", "bands",   "figures",
        "normals",   "max-distance", "field-tol",  "effort",     "against", "allow-unpaired",
        "one-way",   "lock-borders", "levels",     "ratio"}},
      {"What the meshes are in, and where A lies",
       {"unit", "unit-a", "unit-b", "transform", "scale", "align", "save-transform"}},
      {"What is printed and written",
       {"out", "csv", "json", "junit", "github", "field", "image", "report", "title", "figures-csv",
        "points-out", "image-dir", "report-dir", "certificate", "verbose", "verify",
        "reproducible"}},
      {"How it is drawn", {"view", "up", "size", "map", "range", "steps"}},
      {"How a batch goes on",
       {"resume", "shard", "fail-fast", "list", "together", "lanes", "read-ahead"}},
      {"What it may cost, and how it is done",
       {"device", "time", "memory", "max-input", "waves", "preset", "enable", "disable",
        "no-cache"}}};
  return known;
}

bool is_among(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_of_help(const CLI::App& command, const CLI::Option* option) {
  return option == command.get_help_ptr() || option == command.get_help_all_ptr();
}

}  // namespace

std::string exit_codes_text(const std::string& command) {
  return "Exit codes: " + help_of_commands().at(command).codes;
}

void group_options(CLI::App& command) {
  const bool is_short = help_of_commands().at(command.get_name()).few.empty();
  for (CLI::Option* option : command.get_options()) {
    if (is_short) break;
    for (const HelpGroup& group : help_groups()) {
      if (is_among(group.names, option->get_single_name())) option->group(group.heading);
    }
  }
  const std::string footer = command.get_footer();
  command.footer(footer + (footer.empty() ? "" : "\n\n") + exit_codes_text(command.get_name()));
}

void show_few(CLI::App& command) {
  const auto known = help_of_commands().find(command.get_name());
  if (known == help_of_commands().end() || known->second.few.empty()) return;
  size_t hidden = 0;
  for (CLI::Option* option : command.get_options()) {
    if (option->get_positional() || is_of_help(command, option)) continue;
    const bool is_shown =
        option->get_required() || is_among(known->second.few, option->get_single_name());
    option->group(is_shown ? "Options" : "");
    hidden += is_shown ? 0 : 1;
  }
  command.footer("--help-all shows " + std::to_string(hidden) + " more options.\n\n" +
                 command.get_footer());
}

}  // namespace vkh
