// The totals of a batch, for people to read at its end.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "host/answer/rank.h"
#include "host/answer/result.h"
#include "vkhausdorff/stream.h"

namespace vkh {

/// Writes a percentage such as "2.64 %", rounded up.
std::string percent_up(double ratio);

/// The values of a result that totals use.
struct Counted {
  Rank rank;
  ExitCode code = kExitClosed;
  bool is_unpaired = false, has_metrics = false;
  std::string failure;  ///< why there is no answer
  const char* word = "";
  double lower = 0, upper = 0;
  std::string unit;
  std::optional<double> ratio = {};  ///< upper end over diag(A), if there is no limit

  bool has_answer() const { return rank.outcome != Outcome::kNoAnswer; }
};
Counted counted(const Result& result);

class Totals {
 public:
  void add(const Result& result) { add(counted(result)); }
  void add(const Counted& one);
  /// Adds a result of an earlier run, which this run need not do again.
  void add_kept(const Counted& one);

  size_t pairs() const { return closed_ + within_ + beyond_ + open_ + failed_; }
  size_t failed() const { return failed_; }
  ExitCode worst() const { return worst_; }

  struct Run {
    size_t left = 0;  ///< pairs without a line
    double wall_s = 0, read_s = 0;
    StreamTimes device;
    std::vector<DeviceDescription> devices;
    std::string results;  ///< the results file
    bool has_limit = false;
    size_t unpaired = 0;  ///< files without a partner that have no line
  };
  /// Prints a line in words, then a table.
  void print(std::ostream& out, const Run& run) const;
  /// Returns that line: how many pairs have the requested result.
  std::string in_words(const Run& run) const;
  /// Returns "median 2.64 %, ..., largest 5.8 %": upper bounds of pairs without a limit, as shares
  /// of diag(A); with one a run stops before its upper bound is found. Empty: none.
  std::string percentiles() const;
  /// Prints the totals of merged results; `missing`: pairs that have none.
  void print_merged(std::ostream& out, size_t missing, const std::string& results) const;

 private:
  struct Place {
    Rank rank;
    std::string text;
  };
  void put_in_order(const Counted& one);
  void print_worst(std::ostream& out) const;
  void print_failures(std::ostream& out) const;
  void print_percentiles(std::ostream& out) const;

  ExitCode worst_ = kExitClosed;
  size_t closed_ = 0, within_ = 0, beyond_ = 0, open_ = 0, failed_ = 0, kept_ = 0;
  bool has_metrics_ = false;           // some result has metrics
  size_t unpaired_ = 0;                // failures of files without a partner
  std::vector<Place> top_;             // the worst answers, in order
  std::vector<double> ratios_;         // upper / diag(A), without a limit
  std::vector<std::string> failures_;  // the first failures
};

}  // namespace vkh
