// A batch's results as tables for people and build servers.
#pragma once

#include <functional>
#include <string>

#include "host/answer/record.h"

namespace vkh {

/// CSV (RFC 4180): a heading, and a row per pair. `with_run`: with times, which two runs do not
/// have in common.
std::string csv_heading(bool with_run);
std::string csv_row(const Record& record, bool with_run);

/// A JUnit test case: failed where it is beyond the limit, in error where it is undecided, not
/// closed or without an answer.
JunitCase junit_case(const Record& record, bool with_run);

}  // namespace vkh
