#include "host/survey/normal_goals.h"

#include <algorithm>

namespace vkh {

NormalGoals::NormalGoals(const SurveyOptions& options, const SurveyedPair& pair, WaveSurvey& waves)
    : options_(options),
      waves_(waves),
      bands_(FiguresAsked(options, pair).bands()),
      shares_(bands_.size(), 1) {}

Tally NormalGoals::asked() const {
  return {.at = bands_, .moments = Threshold{kAnyDistance, kAnyDistance}, .of_normals = true};
}

bool NormalGoals::look(const Tallied& /*tallied*/) {
  const std::optional<Tallied> tallied = waves_.tally_now(asked());
  if (!tallied) return false;
  mean_ = FiguresAsked::width(tallied->moments.mean);
  for (size_t i = 0; i < bands_.size(); ++i) shares_[i] = FiguresAsked::width(tallied->shares[i]);
  return false;
}

bool NormalGoals::are_met() const {
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (is_open(i)) return false;
  }
  return !is_open_mean();
}

gpu::SurveyPlan NormalGoals::plan(double whole) const {
  gpu::SurveyPlan plan{};
  plan.of_whole = static_cast<float>(1 / whole);
  plan.of_normals = 1;
  plan.most = edge_of({kAnyDistance, kAnyDistance});
  plan.mean_classes = gpu::kAllClasses;
  if (is_open_mean()) plan.mean = static_cast<float>(weight_of_width(mean_));
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (is_open(i)) add_open(bands_[i], weight_of_width(shares_[i]), plan);
  }
  return plan;
}

double NormalGoals::part() const {
  double part = 0;
  if (is_open_mean()) part = part_to_split(mean_, options_.cosine_tolerance);
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (is_open(i)) part = std::max(part, part_to_split(shares_[i], options_.agreeing_tolerance));
  }
  return part;
}

}  // namespace vkh
