// The command line: the words that the user typed, and the request that they make.
#pragma once

#include <string>
#include <vector>

#include "host/answer/request.h"

namespace vkh {

using Words = std::vector<std::string>;

struct CommandLine {
  std::string help;  ///< a text to print, without further work; empty: there is a request
  Request asked;
};

/// Throws UsageError: one line with the expected form, and the option that a misspelt one may mean.
CommandLine understand(const Words& words);

}  // namespace vkh
