#include "host/survey/face_goals.h"

#include <algorithm>
#include <iterator>

#include "host/survey/area_table.h"

namespace vkh {
namespace {

constexpr auto kAnyFloat = static_cast<float>(kAnyDistance);

}  // namespace

// A width in the frame. The difference of a face's two distances is rounded to a float.
double FaceGoals::tolerance() const {
  const SurveyOptions& options = asked_.options;
  const double wanted = options.field_tolerance > 0 ? asked_.frame.to_frame(options.field_tolerance)
                                                    : options.face_tolerance * distances_.reached();
  return (wanted - 2 * asked_.displacement) * (1 - 1e-6);
}

gpu::SurveyPlan FaceGoals::plan(double /*whole*/) const {
  gpu::SurveyPlan plan{};
  plan.faces = 1;
  plan.face_tolerance = -kAnyFloat;
  std::fill(std::begin(plan.face_within), std::end(plan.face_within), -kAnyFloat);
  plan.face_beyond = kAnyFloat;
  if (is_by_verdict_) {
    std::fill(std::begin(plan.face_within), std::end(plan.face_within),
              edge_of(asked_.threshold(asked_.options.limit.within)).down);
    plan.face_beyond = edge_of(asked_.threshold(asked_.options.limit.beyond)).up;
  } else {
    plan.face_tolerance = static_cast<float>(tolerance());
  }
  return plan;
}

}  // namespace vkh
