// Prints the options table and the commands as JSON, for tools/options/make_pages.py.
//
//   vkh_print_options [--keys]
//
// --keys: reads command lines, a list of lists of words, and prints the keys of their pairs.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "host/answer/options_table.h"
#include "host/app/commands.h"
#include "host/app/program.h"

namespace vkh {
namespace {

using Json = nlohmann::ordered_json;

struct NamedFunction {
  const char* name;
  Functions bit;
};
constexpr NamedFunction kFunctions[] = {{"distance", kPyDistance},      {"gate", kPyGate},
                                        {"metrics", kPyMetrics},        {"distances", kPyMany},
                                        {"Solver.distance", kPySolver}, {"read", kPyRead},
                                        {"simplify", kPySimplify}};

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::kFlag:
      return "flag";
    case Kind::kText:
      return "text";
    case Kind::kFile:
      return "file";
    case Kind::kInput:
      return "input";
    case Kind::kFolder:
      return "folder";
    case Kind::kUnit:
      return "unit";
    case Kind::kLength:
      return "length";
    case Kind::kTolerance:
      return "tolerance";
    case Kind::kLengths:
      return "lengths";
    case Kind::kNames:
      return "names";
    case Kind::kChoice:
      return "choice";
    case Kind::kShare:
      return "share";
    case Kind::kPercentile:
      return "percentile";
    case Kind::kAngle:
      return "angle";
    case Kind::kSize:
      return "size";
    case Kind::kTime:
      return "time";
    case Kind::kCount:
      return "count";
    case Kind::kNumber:
      return "number";
    case Kind::kPart:
      return "part";
  }
  return "";
}

Json names_of(Commands bits) {
  Json names = Json::array();
  for (const Command& command : commands()) {
    if ((command.bit & bits) != 0) names.push_back(command.name);
  }
  return names;
}

Json json_of(const Option& option) {
  Json uses = Json::array(), functions = Json::object(), bits = Json::object();
  for (const Use& use : option.uses)
    uses.push_back({{"of", names_of(use.of)},
                    {"help", use.help},
                    {"otherwise", use.otherwise},
                    {"required", use.required},
                    {"more", use.more}});
  for (const NamedFunction& function : kFunctions) {
    if ((option.functions & function.bit) == 0) continue;
    functions[function.name] = keyword_default(option, function.bit);
    bits[function.name] = function.bit;
  }
  return {{"name", option.name},
          {"kind", name_of(option.kind)},
          {"group", heading_of(option.group)},
          {"shape", shape_of(option)},
          {"choices", option.choices},
          {"uses", uses},
          {"column", option.is_column},
          {"keyword", keyword_name(option)},
          {"functions", functions},
          {"bits", bits},
          {"unlike", option.unlike},
          {"own", std::holds_alternative<Own>(option.target)}};
}

Json json_of(const Command& command) {
  Json positionals = Json::array();
  for (const Positional& one : command.positionals)
    positionals.push_back({{"name", one.name}, {"several", one.is_several}});
  return {{"name", command.name}, {"does", command.does}, {"positionals", positionals}};
}

}  // namespace
}  // namespace vkh

int main(int argc, char** argv) {
  using namespace vkh;
  if (argc > 1 && argv[1] == std::string_view("--keys")) {
    Json keys = Json::array();
    for (std::vector<std::string> words : Json::parse(std::cin)) {
      std::ranges::reverse(words);  // as CLI11 takes them
      Program program;
      program.app().parse(words);
      keys.push_back(key_text(program.asked()));
    }
    std::puts(keys.dump().c_str());
    return 0;
  }
  Json all{{"commands", Json::array()}, {"options", Json::array()}};
  for (const Command& command : commands()) all["commands"].push_back(json_of(command));
  for (const Option& option : options()) all["options"].push_back(json_of(option));
  std::puts(all.dump(1).c_str());
  return 0;
}
