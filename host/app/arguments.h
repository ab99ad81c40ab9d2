// The command line: what was typed, and what it asks for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/answer/pair_job.h"
#include "host/app/picture_options.h"
#include "host/batch/folders.h"
#include "host/batch/list.h"
#include "host/solve/stream.h"

namespace vkh {

using Words = std::vector<std::string>;

enum class Command { kHelp, kDistance, kGate, kDemo, kDoctor, kBatch, kMerge };

/// Where answers go besides the table.
struct Outputs {
  bool json = false;  ///< one object on stdout instead of the table
  std::optional<std::string> json_file, junit_file;
  bool github = false;
  bool verbose = false;
  PicturesAsked pictures;
};

/// Tables of many pairs, besides a line each.
struct TablesAsked {
  std::optional<std::string> csv, junit;
};

struct BatchAsked {
  std::string list;     ///< a file, or else:
  std::string against;  ///< one B for each of `parts`
  std::vector<std::string> parts;
  std::string results;
  Shard shard;
  bool resumes = false, fails_fast = false;
  StreamOptions devices;  ///< but for what PairJob says
  std::string device;     ///< names between commas, or all
  uint64_t read_ahead_bytes = 0;
  double time_limit_s = 0;  ///< of a pair; infinite: none
  TablesAsked tables;
  FoldersAsked folders;
};

struct MergeAsked {
  std::vector<std::string> files;
  std::string results;
  std::string list;           ///< whose ids are to be there; empty: whatever there is
  bool reproducible = false;  ///< without what two runs do not have in common
  TablesAsked tables;
};

struct CommandLine {
  Command command = Command::kHelp;
  std::string help;         ///< kHelp: what is to be printed
  PairJob job;              ///< of distance, gate, demo and batch
  double time_limit_s = 0;  ///< infinite: none
  Outputs outputs;
  std::string device;  ///< of doctor
  BatchAsked batch = {};
  MergeAsked merge = {};
};

/// Throws UsageError: one line that says what was expected, and what a misspelt option may mean.
CommandLine understand(const Words& words);

}  // namespace vkh
