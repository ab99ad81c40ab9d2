// Tells GitHub Actions about a batch: docs.github.com, "Workflow commands for GitHub Actions".
#pragma once

#include <string>

#include "host/batch/batch.h"

namespace vkh {

struct GithubTexts {
  /// An annotation of all pairs, then one of each that is no PASS or has notes, the worst first:
  /// GitHub shows ten errors and ten warnings of a step.
  std::string annotations;
  std::string summary;  ///< Markdown for the run's page: all pairs, and a table of the worst
};

/// Reads the batch's lines from its file of results. Throws InputError.
GithubTexts github_texts(const BatchJob& batch);

}  // namespace vkh
