// The options of commands about many pairs.
#pragma once

#include "host/app/typed.h"

namespace vkh {

/// The options as the user typed them.
struct TypedMany {
  Typed of_pairs;
  std::vector<std::string> files;
  std::string against, results, list, shard, csv;
  std::optional<std::string> read_ahead;
  size_t together = 0, lanes = 0;
  bool resumes = false, fails_fast = false, reproducible = false;
  bool allows_unpaired = false;
};

void add_batch(CLI::App& command, TypedMany& typed);
void add_merge(CLI::App& command, TypedMany& typed);

/// Throw UsageError.
CommandLine batch_line(const TypedMany& typed, const Words& words);
CommandLine merge_line(const TypedMany& typed);

}  // namespace vkh
