// A line of a batch's results: one pair's answer or failure, one JSON object of
// docs/schema/pair.schema.json.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/answer/exit_code.h"
#include "vkhausdorff/answer.h"

namespace vkh {

/// The name of a line: the pair's id in its list, and a hash of all that its answer depends on (the
/// inputs' bytes, the options, this version).
struct ResultName {
  std::string id, key;
};

/// The beginning of each line.
inline constexpr std::string_view kResultStart = "{\"schema\":\"vkhausdorff.pair/";

struct Result {
  ResultName name;
  ExitCode code = kExitClosed;
  Answer answer;                          ///< of a failure: what is known of the inputs and the run
  std::optional<Failure> failure;         ///< there is no answer
  double gpu_ms = 0;                      ///< of both directions
  std::vector<std::string> lacking = {};  ///< members that the line lacks: an older program's

  bool has_answer() const { return !failure; }
  /// The answer's first line, or the error.
  std::string words() const { return failure ? failure->message : in_words(answer); }
  /// Whether another run of the same inputs would give the same result, except for times.
  bool is_final() const;
  /// Whether the upper end of the whole interval was sought.
  bool is_upper_sought() const;
  /// Whether it is the failure of a file that has no partner, in a batch of two folders.
  bool is_unpaired() const {
    return answer.inputs[0].path.empty() != answer.inputs[1].path.empty();
  }
  /// Whether the key covers all files that were read; before 0.2.0 it covered the two that a list
  /// names.
  bool names_files() const;
};

Result result_of(ResultName name, Answer answer);
Result result_of(ResultName name, Failure failure, Answer known);

/// The line without a newline. Values that only one run or machine has come last, in `run`.
std::string to_line(const Result& result);
/// The same line without `run`: the part that two runs have in common.
std::string without_run(const std::string& line);

/// Reads a line. Throws InputError with the error but without the file's name: for a bound that is
/// missing, or another number in hexadecimal than in decimal, and for what contradicts the rest of
/// a line that lacks nothing.
Result read_result(std::string_view line);

}  // namespace vkh
