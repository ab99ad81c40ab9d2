// The rows of vkh_bench's CSV: one per pair and variant.
#pragma once

#include <string>
#include <vector>

#include "tools/bench/manifest.h"
#include "vkhausdorff/report.h"

namespace vkh::bench {

/// A variant's results for a pair.
struct Outcome {
  std::string variant;
  std::vector<Report> reports;  ///< of its repeats; of a run that did not close, that one alone
  std::vector<Report> staged;   ///< of other runs, with a timestamp after each stage
  double load_ms = 0;           ///< both files
  double setup_ms = 0;          ///< device and this variant's pipelines, once per process

  const Report& last() const { return reports.back(); }
  bool closed() const { return last().status == Status::kClosed; }
  /// Every run gave the same interval to the last bit.
  bool repeats() const;
};

/// The middle value; of an even number of values the larger of the two.
double median(std::vector<double> values);
/// The time from the uploaded meshes to the report.
double gpu_ms(const Report& report);

/// Whether there can be one distance in all the intervals.
bool intervals_meet(const std::vector<Outcome>& outcomes);

void print_header();
/// `meets`: for all variants of the pair.
void print_row(const Row& row, const Outcome& outcome, bool meets);

}  // namespace vkh::bench
