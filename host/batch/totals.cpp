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

/// "FAIL at least 0.347 mm, 3.47 times its limit id". Leaves out the upper end, which means nothing
/// for a FAIL.
std::string in_a_row(const Counted& one) {
  const std::string lower = decimal(one.lower, 7, Rounding::kDown);
  const bool has_upper = one.rank.outcome != Outcome::kBeyond;
  std::string text = one.word + std::string("  ");
  text += has_upper ? "[" + lower + ", " + decimal(one.upper, 7, Rounding::kUp) + "]"
                    : "at least " + lower;
  if (!one.unit.empty()) text += " " + one.unit;
  if (one.rank.has_limit)
    text += (has_upper ? ", at least " : ", ") + decimal(one.rank.size, 3, Rounding::kDown) +
            " times its limit";
  return text + "  " + printable(one.rank.id);
}

}  // namespace

std::string percent_up(double ratio) {
  return decimal(multiply_up(100, ratio), 3, Rounding::kUp) + " %";
}

Counted counted(const Result& result) {
  const Answer& answer = result.answer;
  const CertifiedInterval whole = interval_of(answer);
  Counted one{.rank = rank_of(result),
              .code = result.code,
              .is_unpaired = result.is_unpaired(),
              .has_metrics = answer.metrics.has_value(),
              .failure = result.failure ? result.name.id + ": " + result.words() : "",
              .word = outcome_word(result),
              .lower = whole.lower,
              .upper = whole.upper,
              .unit = answer.unit};
  const double diagonal = answer.a_to_b.diagonal_a;
  const bool has_ratio = !answer.max && std::isfinite(whole.upper) && diagonal > 0;
  if (has_ratio) one.ratio = divide_up(whole.upper, diagonal);
  return one;
}

void Totals::add(const Counted& one) {
  worst_ = worse(worst_, one.code);
  if (!one.has_answer()) {
    unpaired_ += one.is_unpaired ? 1 : 0;
    if (++failed_ <= kTop) failures_.push_back(one.failure);
    return;
  }
  has_metrics_ = has_metrics_ || one.has_metrics;
  const Outcome outcome = one.rank.outcome;
  ++(outcome == Outcome::kBeyond   ? beyond_
     : outcome == Outcome::kOpen   ? open_
     : outcome == Outcome::kWithin ? within_
                                   : closed_);
  put_in_order(one);
  if (one.ratio) ratios_.push_back(*one.ratio);
}

void Totals::put_in_order(const Counted& one) {
  if (top_.size() == kTop && !is_worse(one.rank, top_.back().rank)) return;
  const auto place = std::find_if(
      top_.begin(), top_.end(), [&](const Place& other) { return is_worse(one.rank, other.rank); });
  top_.insert(place, {one.rank, in_a_row(one)});
  if (top_.size() > kTop) top_.pop_back();
}

void Totals::add_kept(const Counted& one) {
  ++kept_;
  add(one);
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
