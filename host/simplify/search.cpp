#include "host/simplify/search.h"

#include <algorithm>
#include <cmath>

namespace vkh {
namespace {

// Errors are estimates, far from distances as a rule, so that the range is wide.
constexpr size_t kSteps = 16;
constexpr double kLargest = 16, kSmallest = 1.0 / 256;
constexpr int kBisections = 2;

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

void Search::try_whole() { attempt(collapser_.faces()); }

void Search::scan_errors() {
  const double limit = options_.max.within;
  double failed = 2 * error_of_step(limit, 0);
  for (size_t step = 0; step < kSteps && goes_on(); ++step) {
    const double error = error_of_step(limit, step);
    const Outcome outcome = attempt(collapser_.collapse(collapser_.faces(), {.error = error}));
    if (outcome == Outcome::kUseless) return;  // smaller errors leave as many faces as A has
    if (outcome == Outcome::kFailed) {
      failed = error;
      continue;
    }
    best_error_ = error;
    return bisect_error(error, failed);
  }
}

void Search::bisect_error(double passes, double fails) {
  for (int i = 0; i < kBisections && goes_on(); ++i) {
    const double error = std::sqrt(passes * fails);
    const Outcome outcome = attempt(collapser_.collapse(collapser_.faces(), {.error = error}));
    if (outcome == Outcome::kPassed) best_error_ = error;
    (outcome == Outcome::kFailed ? fails : passes) = error;
  }
  failed_error_ = fails;
}

}  // namespace vkh
