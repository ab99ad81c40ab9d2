// Tells GitHub Actions about a batch: docs.github.com, "Workflow commands for GitHub Actions".
#pragma once

#include <string>

#include "host/batch/batch.h"

namespace vkh {

struct GithubTexts {
  /// An annotation about all pairs, and then one for each pair that is no PASS or has notes, the
  /// worst first: GitHub shows ten errors and ten warnings per step.
  std::string annotations;
  std::string summary;  ///< Markdown for the run's page: all pairs, and a table of the worst
};

/// Reads the batch's lines from its file of results. Throws InputError.
GithubTexts github_texts(const BatchJob& batch);

}  // namespace vkh
