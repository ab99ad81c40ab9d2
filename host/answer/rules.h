// Options together: the combinations that are refused, and what some options imply.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "host/answer/request.h"

namespace vkh {

/// Returns an option's name as messages have it: --face-max on the command line.
using Naming = std::function<std::string(std::string_view option)>;
std::string with_dashes(std::string_view option);

/// Throws UsageError for the first rule that what is asked breaks.
void check_together(const Request& asked, const Naming& naming);

/// Fills in what the options that were given imply. Throws UsageError for figures that no metrics
/// have. Call it once, after check_together().
void complete(Request& asked, const Naming& naming);

}  // namespace vkh
