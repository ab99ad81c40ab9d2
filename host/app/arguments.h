// The command line: the words that the user typed, and the request that they make.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/app/picture_options.h"
#include "host/batch/list.h"
#include "host/batch/picture_folders.h"
#include "vkhausdorff/question.h"
#include "vkhausdorff/stream.h"

namespace vkh {

using Words = std::vector<std::string>;

enum class Command { kHelp, kDistance, kGate, kMetrics, kDemo, kDoctor, kBatch, kMerge, kSimplify };

/// The places for answers besides the table.
struct Outputs {
  bool json = false;  ///< one object on stdout instead of the table
  std::optional<std::string> json_file, junit_file, transform_file;
  bool github = false;
  bool verbose = false;
  PicturesAsked pictures;
};

/// Tables of many pairs, besides a line for each.
struct TablesAsked {
  std::optional<std::string> csv, junit;
};

struct BatchAsked {
  std::string list;     ///< a file, or else:
  std::string against;  ///< one B for each of `parts`
  std::vector<std::string> parts;
  std::string folder_a, folder_b;  ///< or folders, whose meshes are paired by their names
  bool allows_unpaired = false;    ///< a file without a partner there is no failure
  std::string results;
  Shard shard;
  bool resumes = false, fails_fast = false;
  bool github = false;    ///< annotations and a summary for GitHub Actions
  StreamOptions devices;  ///< the options that Question does not have
  std::string device;     ///< names between commas, or all
  uint64_t read_ahead_bytes = 0;
  double time_limit_s = 0;  ///< the limit of a pair; infinite: none
  TablesAsked tables;
  FoldersAsked folders;
};

struct MergeAsked {
  std::vector<std::string> files;
  std::string results;
  std::string list;           ///< the list whose ids must be there; empty: no check
  bool reproducible = false;  ///< leaves out what differs between two runs
  TablesAsked tables;
};

struct SimplifyAsked {
  std::string out, certificate;  ///< files; no certificate: empty
  bool lock_borders = false;
  size_t levels = 0;  ///< 0: one mesh, as few faces as are found
  double ratio = 0.5;
};

struct CommandLine {
  Command command = Command::kHelp;
  std::string help;         ///< the text to print for kHelp
  Question question;        ///< what distance, gate, demo and batch ask
  double time_limit_s = 0;  ///< infinite: none
  Outputs outputs;
  std::string device;  ///< the device of doctor
  BatchAsked batch = {};
  MergeAsked merge = {};
  SimplifyAsked simplify = {};  ///< besides what `question` and `outputs` have
};

/// Throws UsageError: one line with the expected form, and the option that a misspelt one may mean.
CommandLine understand(const Words& words);

}  // namespace vkh
