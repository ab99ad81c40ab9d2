#include "host/app/commands.h"

#include <algorithm>

#include "host/batch/list.h"

namespace vkh {
namespace {

const std::string kOutputCode = "6 the answer was given and an output could not be written";
const std::string kOrder = " The worst counts: 5, 4, 6, 2, 1, 3, 0 in this order.";
const std::string kClosed =
    "0 closed; 2 usage; 3 not closed within the budget (the interval is true); ";

std::vector<Command> commands_of_a_pair() {
  const std::vector<Positional> pair{{"A", "Mesh to start from (OBJ, STL, PLY, OFF, glTF, 3MF)"},
                                     {"B", "Mesh to go to"}};
  return {{.name = "distance",
           .bit = kDistance,
           .does = "Distance of two mesh files",
           .positionals = pair,
           .codes = kClosed + "4 bad input; 5 device or driver; " + kOutputCode + "."},
          {.name = "gate",
           .bit = kGate,
           .does = "Is the distance of two mesh files within a limit?",
           .positionals = pair,
           .codes = "0 PASS; 1 FAIL; 2 usage; 3 UNDECIDED (the interval is true); 4 bad input; 5 "
                    "device or driver; " +
                    kOutputCode + "."},
          {.name = "metrics",
           .bit = kMetrics,
           .does = "Figures of two mesh files by the names that papers use, both directions",
           .positionals = pair,
           .codes = "0 each figure is as narrow as asked; 2 usage; 3 a figure is not "
                    "(intervals are true); 4 bad input, or a mesh without area; 5 device or "
                    "driver; " +
                    kOutputCode + "."}};
}

std::vector<Command> commands_of_many() {
  return {
      {.name = "batch",
       .bit = kBatch,
       .does = "Distances or verdicts of many pairs",
       .positionals = {{"LIST",
                        "A list of pairs; or two folders, A's and B's, whose meshes are paired by "
                        "their names; with --against, meshes to start from, each a pair",
                        true}},
       .footer = "LIST has " + list_columns() +
                 ": JSONL, or CSV with a heading. Its files' names are of its own folder.",
       .codes = "0 each pair is closed or PASS; 1 a pair is a FAIL; 2 usage, or the options of a "
                "pair; 3 a pair is not closed, UNDECIDED or left (intervals are true); 4 the list, "
                "a file of a pair, or a mesh without a partner; 5 device or driver; 6 an output "
                "could not be written." +
                kOrder},
      {.name = "merge",
       .bit = kMerge,
       .does = "Results of several batches as one, by id",
       .positionals = {{"RESULTS", "Results of batches; or the answers of all parts of one pair",
                        true}},
       .codes = "0 each pair is closed or PASS; 1 a pair is a FAIL; 2 usage, or the options of a "
                "pair; 3 a pair is not closed, UNDECIDED or, by --list, without a result; 4 the "
                "results that are read, or a file of a pair; 5 a pair's device or driver; 6 an "
                "output could not be written." +
                kOrder}};
}

std::vector<Command> other_commands() {
  return {
      {.name = "simplify",
       .bit = kSimplify,
       .does = "Fewer faces, within a proven limit",
       .positionals = {{"A", "Mesh to simplify (OBJ, STL, PLY, OFF, glTF, 3MF)"}},
       .footer = "The result is read back as it was written, and measured, before it has its name. "
                 "UVs, normals and colours are dropped. The distance alone is proven: neither that "
                 "the result is watertight nor how its faces are turned.",
       .codes = "0 a mesh was written; 2 usage; 3 none was found, and nothing is written; 4 bad "
                "input; 5 device or driver; 6 the result could not be written."},
      {.name = "demo",
       .bit = kDemo,
       .does = "Distance of a built-in pair",
       .codes = kClosed + "5 device or driver; " + kOutputCode + "."},
      {.name = "doctor",
       .bit = kDoctor,
       .does = "Devices, drivers and a self-check",
       .codes = "0 the self-check passed; 2 usage; 5 no device, or one that is not to be trusted; "
                "6 the findings could not be printed or written."}};
}

}  // namespace

const std::vector<Command>& commands() {
  static const std::vector<Command> known = [] {
    std::vector<Command> all;
    for (auto* some : {commands_of_a_pair, commands_of_many, other_commands})
      for (Command& command : some()) all.push_back(std::move(command));
    return all;
  }();
  return known;
}

const Command* command_of(std::string_view name) {
  const auto found = std::find_if(commands().begin(), commands().end(),
                                  [&](const Command& one) { return one.name == name; });
  return found == commands().end() ? nullptr : &*found;
}

}  // namespace vkh
