// The command line: what was typed, and what it asks for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/cli/pictures.h"
#include "host/job/pair_job.h"

namespace vkh {

using Words = std::vector<std::string>;

enum class Command { kHelp, kDistance, kGate, kDemo, kDoctor };

/// Where answers go besides the table.
struct Outputs {
  bool json = false;  ///< one object on stdout instead of the table
  std::optional<std::string> json_file, junit_file;
  bool github = false;
  bool verbose = false;
  PicturesAsked pictures;
};

struct CommandLine {
  Command command = Command::kHelp;
  std::string help;         ///< kHelp: what is to be printed
  PairJob job;              ///< of distance, gate and demo
  double time_limit_s = 0;  ///< infinite: none
  Outputs outputs;
  std::string device;  ///< of doctor
};

/// Throws UsageError: one line that says what was expected, and what a misspelt option may mean.
CommandLine understand(const Words& words);

}  // namespace vkh
