// Many pairs, from a list to a file of results: read ahead by all cores, solved side by side on all
// given devices, each line written as soon as its pair ends.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "host/batch/picture_folders.h"
#include "host/batch/reader.h"
#include "host/batch/totals.h"
#include "vkhausdorff/stream.h"

namespace vkh {

struct BatchJob {
  Request asked;                 ///< its question is asked of each, and its time is per pair
  std::vector<Entry> entries;    ///< the pairs of this shard
  size_t unpaired = 0;           ///< files without a partner that are no entries
  std::set<std::string> shared;  ///< shared_files() of the whole list
  std::string results;           ///< the file that lines are added to
  bool resumes = false;          ///< keeps the lines of the file, and does the pairs without one
  bool fails_fast = false;       ///< ends with the first pair that is beyond or has no answer
  StreamOptions devices;
  std::shared_ptr<BatchFolders> folders;  ///< folders of pictures and reports; null: none
  uint64_t read_ahead_bytes = 0;          ///< the limit of files read but not solved; 0: 2 GiB
};

/// Returns the worst code of all pairs, or kExitNotClosed if the batch was interrupted. Prints the
/// totals to `out`. Throws UsageError for a file that has results but is not to be resumed;
/// DeviceError if no device is left, OutputError if a line cannot be written: lines already written
/// stay.
ExitCode run_batch(const BatchJob& job, std::ostream& out);

}  // namespace vkh
