// A line of a batch's results: one pair's answer or failure, one JSON object of
// docs/schema/pair.schema.json.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/answer/exit_code.h"
#include "vkhausdorff/answer.h"

namespace vkh {

/// The name of a line: the pair's id in its list, and a hash of all that its answer depends on (the
/// inputs' bytes, the options, this version).
struct RecordName {
  std::string id, key;
};

/// The beginning of each line.
inline constexpr std::string_view kRecordStart = "{\"schema\":\"vkhausdorff.pair/";

/// The line without a newline. Values of one run or machine alone come last, in `run`.
std::string to_record(const RecordName& name, const Answer& answer);
std::string to_record(const RecordName& name, const Failure& failure, const Answer& known);

/// The same line without `run`: the part that two runs have in common.
std::string without_run(const std::string& line);

/// An enclosure of a distance.
struct Bounds {
  double lower = 0, upper = std::numeric_limits<double>::infinity();
  /// Whether both may be true of one distance.
  bool meets(const Bounds& other) const { return lower <= other.upper && other.lower <= upper; }
};

/// A line's content, for tables and for merging.
struct Record {
  RecordName name;
  ExitCode code = kExitClosed;
  std::string status, verdict;  ///< empty: a failure; no limit was asked about
  double lower = 0, upper = std::numeric_limits<double>::infinity();
  /// The forward direction and, if both were asked for, the reverse; else [0, infinity).
  std::array<Bounds, 2> directions;
  double gap = 0, diagonal = 0;  ///< diag(A), to nearest; 0: not known
  Limit limit;                   ///< the limit in the unit; 0: none was asked about
  bool is_by_area = false;       ///< a share of the area is to be within it
  std::string unit;
  struct Side {
    std::string path, sha256;
    uint64_t faces = 0;
    bool names_files = false;  ///< the line lists the other files read, as lines do since 0.2.0
    std::vector<Note> notes = {};
  };
  std::array<Side, 2> inputs;
  /// The signed figures of A, where they were asked for.
  struct Signed {
    Enclosure over, under;
    std::optional<Enclosure> mean = {};        ///< none: figures were not asked for
    std::vector<Percentile> percentiles = {};  ///< as many as kSignedShares, with `mean`
    std::optional<double> unsigned_share =
        {};  ///< no more of A's area has no side; none: A has none
  };
  std::optional<Signed> sides;
  std::optional<Metrics> metrics;  ///< where they were asked for
  std::vector<Note> notes;         ///< on the pair
  std::string words;               ///< the answer's first line, or the error
  std::string error_file;  ///< the file that an error is about, as an input's path; or empty
  double total_ms = 0, gpu_ms = 0;
  std::string host, started;

  /// Whether another run of the same inputs would give the same result, but for times.
  bool is_final() const;
  /// Whether the upper end was sought: is_upper_sought() of the answer.
  bool is_upper_sought() const {
    return is_by_area || code != kExitBeyond || is_farthest_known(lower, upper);
  }
  /// Whether it is the failure of a file that has no partner, in a batch of two folders.
  bool is_unpaired() const { return inputs[0].path.empty() != inputs[1].path.empty(); }
  /// Whether the key covers all files that were read; before 0.2.0 it covered the two that a list
  /// names.
  bool names_files() const { return inputs[0].names_files && inputs[1].names_files; }
};

/// The content of the line that to_record() makes.
Record record_of(const RecordName& name, const Answer& answer);
Record record_of(const RecordName& name, const Failure& failure, const Answer& known);

/// Reads a line. Throws InputError with the error but without the file's name. A bound that differs
/// from the decimal beside it is wrong, and so is an interval whose lower end is above its upper.
Record read_record(std::string_view line);

}  // namespace vkh
