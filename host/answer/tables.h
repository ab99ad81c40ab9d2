// A batch's results as tables for people and build servers.
#pragma once

#include <functional>
#include <string>

#include "host/answer/result.h"

namespace vkh {

/// The optional columns of a CSV.
struct CsvColumns {
  bool run = false;      ///< times, which differ from run to run
  bool sides = false;    ///< signed figures: some result has them
  bool metrics = false;  ///< some result has them
  bool normals = false;  ///< some result's metrics have figures of normals
  size_t distances = 0;  ///< the most distances that a result's metrics have shares within
};
/// CSV (RFC 4180): a heading, and a row per pair.
std::string csv_heading(const CsvColumns& with);
std::string csv_row(const Result& result, const CsvColumns& with);

/// A JUnit test case: failed where it is beyond the limit, in error where it is undecided, not
/// closed or without an answer.
JunitCase junit_case(const Result& result, bool with_run);

}  // namespace vkh
