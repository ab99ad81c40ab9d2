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

/// Throws UsageError for the first rule that the request breaks.
void check_together(const Request& asked, const Naming& naming);

/// Fills in what the options that were given imply. Throws UsageError for unknown figures of
/// metrics, and for the first rule of questions that is broken. Call it once, after
/// check_together().
void complete(Request& asked, const Naming& naming);

/// Throws UsageError for the first rule that a complete question breaks. unread_answer() calls it
/// for every question.
void check_question(const Question& question);

}  // namespace vkh
