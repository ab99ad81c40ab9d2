// Many pairs, from a list to a file of results: read ahead by all cores, solved side by side on all
// devices that are given, each line there as soon as its pair ends.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "host/batch/folders.h"
#include "host/batch/reader.h"
#include "host/batch/totals.h"
#include "host/solve/stream.h"

namespace vkh {

struct BatchJob {
  PairJob pair;                  ///< what is asked of each; options.time_limit_s holds a pair's run
  std::vector<Entry> entries;    ///< of this shard
  std::set<std::string> shared;  ///< shared_files() of the whole list
  std::string results;           ///< the file that lines are added to
  bool resumes = false;          ///< keeps its lines, and does what they do not have
  bool fails_fast = false;       ///< ends with the first pair that is beyond or has no answer
  StreamOptions devices;
  std::shared_ptr<BatchFolders> folders;  ///< where pictures and reports go; none: there are none
  uint64_t read_ahead_bytes = 0;          ///< of files that are read and not solved; 0: 2 GiB
};

/// Returns the worst code of all pairs, or kExitNotClosed where the batch was interrupted. Prints
/// to `out` what it came to. Throws UsageError for a file that has results and is not to be
/// resumed; DeviceError where no device is left, OutputError where a line cannot be written: lines
/// that are there stay.
ExitCode run_batch(const BatchJob& job, std::ostream& out);

}  // namespace vkh
