#include "host/batch/totals.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "host/base/decimal.h"
#include "host/base/rounding.h"

namespace vkh {
namespace {

constexpr size_t kTop = 5;

std::string number(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string count_of(size_t count, const char* what) { return std::to_string(count) + " " + what; }

/// "FAIL  at least 0.347 mm, 3.47 times its limit  id". The upper end of a FAIL means nothing.
std::string in_a_row(const Record& record) {
  const std::string lower = decimal(record.lower, 7, Rounding::kDown);
  const bool has_upper = outcome_of(record) != Outcome::kBeyond;
  std::string text = outcome_word(record) + std::string("  ");
  text += has_upper ? "[" + lower + ", " + decimal(record.upper, 7, Rounding::kUp) + "]"
                    : "at least " + lower;
  if (!record.unit.empty()) text += " " + record.unit;
  const std::string share = share_of_limit_text(record);
  if (!share.empty()) text += (has_upper ? ", at least " : ", ") + share + " times its limit";
  return text + "  " + printable(record.name.id);
}

}  // namespace

std::string percent_up(double ratio) {
  return decimal(multiply_up(100, ratio), 3, Rounding::kUp) + " %";
}

void Totals::add(const Record& record) {
  worst_ = worse(worst_, record.code);
  if (record.status.empty()) {
    unpaired_ += record.is_unpaired() ? 1 : 0;
    if (++failed_ <= kTop) failures_.push_back(record.name.id + ": " + record.words);
    return;
  }
  const bool has_verdict = !record.verdict.empty();
  has_metrics_ = has_metrics_ || record.metrics.has_value();
  ++(record.code == kExitBeyond      ? beyond_
     : record.code == kExitNotClosed ? open_
     : has_verdict                   ? within_
                                     : closed_);
  put_in_order(record);
  const bool has_ratio = !has_verdict && std::isfinite(record.upper) && record.diagonal > 0;
  if (has_ratio) ratios_.push_back(divide_up(record.upper, record.diagonal));
}

void Totals::put_in_order(const Record& record) {
  Rank rank = rank_of(record);
  if (top_.size() == kTop && !is_worse(rank, top_.back().rank)) return;
  const auto place = std::find_if(top_.begin(), top_.end(),
                                  [&](const Place& other) { return is_worse(rank, other.rank); });
  top_.insert(place, {std::move(rank), in_a_row(record)});
  if (top_.size() > kTop) top_.pop_back();
}

void Totals::add_kept(const Record& record) {
  ++kept_;
  add(record);
}

std::string Totals::in_words(const Run& run) const {
  if (pairs() + run.left == 0) return "no pairs";
  const std::string all = count_of(pairs() + run.left, "pairs");
  std::string rest;
  const auto add = [&](size_t count, const char* what) {
    if (count > 0) rest += "; " + count_of(count, what);
  };
  const auto add_without_answer = [&] {
    add(failed_ - unpaired_, "without an answer");
    add(unpaired_ + run.unpaired, "without a partner");
  };
  if (within_ + beyond_ > 0 || run.has_limit) {
    const char* verdict = beyond_ > 0                      ? "FAIL"
                          : open_ + failed_ + run.left > 0 ? "UNDECIDED"
                                                           : "PASS";
    add(open_, "undecided");
    add(closed_, "without a limit");
    add_without_answer();
    add(run.left, "left");
    return std::string(verdict) + "  " + std::to_string(within_) + " of " + all +
           " are within their limit, " + std::to_string(beyond_) + " are beyond it, proven" + rest;
  }
  add(open_, has_metrics_ ? "with a figure that is wider" : "not closed");
  add_without_answer();
  add(run.left, "left");
  return std::to_string(closed_) + " of " + all +
         (has_metrics_ ? " have all figures as narrow as asked"
                       : " have an interval within the tolerance") +
         rest;
}

std::string Totals::percentiles() const {
  if (ratios_.empty()) return "";
  std::vector<double> sorted = ratios_;
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return percent_up(sorted[std::max<size_t>(rank, 1) - 1]);
  };
  return "median " + at(0.5) + ", p90 " + at(0.9) + ", p99 " + at(0.99) + ", largest " + at(1);
}

void Totals::print_percentiles(std::ostream& out) const {
  if (!ratios_.empty()) print_row(out, "upper", "of diag(A): " + percentiles());
}

void Totals::print_worst(std::ostream& out) const {
  for (const Place& place : top_) print_row(out, &place == top_.data() ? "worst" : "", place.text);
}

void Totals::print_failures(std::ostream& out) const {
  for (const std::string& failure : failures_)
    print_row(out, &failure == failures_.data() ? "failed" : "", printable(failure));
  if (failed_ > failures_.size())
    print_row(out, "", "and " + std::to_string(failed_ - failures_.size()) + " more");
}

void Totals::print(std::ostream& out, const Run& run) const {
  out << in_words(run) << '\n';
  const size_t done = pairs() - kept_;
  std::string now =
      count_of(done, done == 1 ? "pair" : "pairs") + " in " + number("%.2f s", run.wall_s);
  if (done > 0 && run.wall_s > 0)
    now += ", " + number("%.4g a second", static_cast<double>(done) / run.wall_s);
  if (kept_ > 0) now += "; " + count_of(kept_, kept_ == 1 ? "was done before" : "were done before");
  print_row(out, "pairs", now);
  print_row(out, "time",
            "reading " + number("%.2f s", run.read_s) + " of all threads, devices ready after " +
                number("%.2f s", run.device.start_s) + ", lanes busy " +
                number("%.2f s", run.device.lanes_s) + ", GPU time " +
                number("%.2f s", run.device.gpu_s));
  print_percentiles(out);
  print_worst(out);
  print_failures(out);
  for (const DeviceDescription& device : run.devices)
    print_row(out, &device == run.devices.data() ? "devices" : "",
              std::to_string(device.index) + " " + device.name + ", driver " + device.driver);
  print_row(out, "results", printable(run.results));
}

void Totals::print_merged(std::ostream& out, size_t missing, const std::string& results) const {
  Run run;
  run.left = missing;
  out << in_words(run) << '\n';
  print_percentiles(out);
  print_worst(out);
  print_failures(out);
  print_row(out, "results", printable(results));
}

}  // namespace vkh
