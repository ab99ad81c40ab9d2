// A line of a batch's results: one pair's answer or failure, one JSON object of
// docs/schema/pair.schema.json.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "host/answer/answer.h"
#include "host/record/exit_code.h"

namespace vkh {

/// What names a line: the pair's id in its list, and a hash of what its answer depends on (the
/// inputs' bytes, the options, this version).
struct RecordName {
  std::string id, key;
};

/// How each line begins.
inline constexpr std::string_view kRecordStart = "{\"schema\":\"vkhausdorff.pair/";

/// Without a newline. What one run or machine alone has comes last, in `run`.
std::string to_record(const RecordName& name, const Answer& answer);
std::string to_record(const RecordName& name, const Failure& failure, const Answer& known);

/// The same line without `run`: what two runs have in common.
std::string without_run(const std::string& line);

/// What a line says, for tables and for merging.
struct Record {
  RecordName name;
  ExitCode code = kExitClosed;
  std::string status, verdict;  ///< empty: a failure; no limit was asked about
  double lower = 0, upper = std::numeric_limits<double>::infinity();
  double gap = 0, diagonal = 0;  ///< diag(A), to nearest; 0: not known
  std::string unit;
  struct Side {
    std::string path, sha256;
    uint64_t faces = 0;
  };
  std::array<Side, 2> inputs;
  std::string words;  ///< the answer's first line, or what went wrong
  double total_ms = 0, gpu_ms = 0;
  std::string host, started;

  /// Another run of the same inputs would say the same, but for times.
  bool is_final() const;
};

/// Throws InputError: what is wrong, without the file's name.
Record read_record(std::string_view line);

}  // namespace vkh
