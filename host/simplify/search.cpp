#include "host/simplify/search.h"

#include <algorithm>
#include <cmath>

namespace vkh {
namespace {

// Errors are estimates, far from distances as a rule, so that the range is wide.
constexpr size_t kSteps = 16;
constexpr double kLargest = 16, kSmallest = 1.0 / 256;
constexpr int kBisections = 2;

// A mesh of more faces is collapsed once, to a 28th of the limit; what comes after starts from a
// result of a fifth of its own error. Up to here meshoptimizer takes less time than the judge.
constexpr size_t kLarge = size_t{1} << 17;
constexpr size_t kFirst = 11, kStride = 3;

double error_of_step(double limit, size_t step) {
  const double share = static_cast<double>(step) / (kSteps - 1);
  return limit * kLargest * std::pow(kSmallest / kLargest, share);
}

}  // namespace

Search::Outcome Search::attempt(Faces faces) {
  if (faces.empty()) return Outcome::kFailed;
  if (has_best() && faces.size() >= best_.size()) return Outcome::kUseless;
  if (faces == failed_ || !goes_on()) return Outcome::kFailed;
  const uint64_t smallest = has_best() ? best_.size() : collapser_.faces().size();
  if (options_.progress && !options_.progress({tried_, smallest, faces.size()})) judge_.call_off();
  if (!goes_on()) return Outcome::kFailed;
  ++tried_;
  Deviation deviation = judge_.decide(collapser_.mesh_of(faces));
  if (deviation.verdict == Verdict::kWithin) {
    best_ = std::move(faces);
    return Outcome::kPassed;
  }
  failed_ = std::move(faces);
  why_ = std::move(deviation);
  return Outcome::kFailed;
}

bool Search::is_large() const { return collapser_.faces().size() > kLarge; }

void Search::try_whole() { attempt(collapser_.faces()); }

void Search::make_candidates() {
  if (!goes_on()) return;
  const double limit = options_.max.within;
  candidates_.resize(kFirst + 1);
  if (is_large()) {
    for (size_t step = kFirst + 1; step-- > 0 && goes_on();) {
      const Faces& from =
          step == kFirst ? collapser_.faces() : candidates_[std::min(step + kStride, kFirst)];
      candidates_[step] = collapser_.collapse(from, {.error = error_of_step(limit, step)});
    }
    return;
  }
  const ThreadPool pool, one(1, {}, {});
  pool.for_each(candidates_.size(), [&](size_t step) {
    candidates_[step] =
        collapser_.collapse(collapser_.faces(), {.error = error_of_step(limit, step)}, {}, one);
  });
}

Faces Search::candidate(size_t step) {
  if (step < candidates_.size()) return std::move(candidates_[step]);
  return collapser_.collapse(collapser_.faces(),
                             {.error = error_of_step(options_.max.within, step)});
}

void Search::scan_errors() {
  make_candidates();
  const double limit = options_.max.within;
  double failed = 2 * error_of_step(limit, 0);
  for (size_t step = 0; step < kSteps && goes_on(); ++step) {
    const double error = error_of_step(limit, step);
    const Outcome outcome = attempt(candidate(step));
    if (outcome == Outcome::kUseless) return;  // smaller errors leave as many faces as A has
    if (outcome == Outcome::kFailed) {
      failed = error;
      continue;
    }
    best_error_ = error;
    candidates_.clear();
    return bisect_error(error, failed);
  }
}

void Search::bisect_error(double passes, double fails) {
  for (int i = 0; i < kBisections && goes_on(); ++i) {
    const double error = std::sqrt(passes * fails);
    const Outcome outcome =
        attempt(collapser_.collapse(is_large() ? best_ : collapser_.faces(), {.error = error}));
    if (outcome == Outcome::kPassed) best_error_ = error;
    (outcome == Outcome::kFailed ? fails : passes) = error;
  }
  failed_error_ = fails;
}

}  // namespace vkh
