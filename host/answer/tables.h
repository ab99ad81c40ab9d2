// A batch's results as people and build servers take them.
#pragma once

#include <functional>
#include <string>

#include "host/answer/record.h"

namespace vkh {

/// CSV (RFC 4180): a heading, and a row a pair. `with_run`: with columns that two runs do not have
/// in common, times.
std::string csv_heading(bool with_run);
std::string csv_row(const Record& record, bool with_run);

/// A test case of JUnit's: failed where it is beyond the limit, in error where it is undecided, not
/// closed or without an answer.
JunitCase junit_case(const Record& record, bool with_run);

}  // namespace vkh
