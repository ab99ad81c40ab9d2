#include "vkhausdorff/work_meter.h"

#include <algorithm>
#include <cmath>

namespace vkh {
namespace {

size_t searches_of(const Question& question, size_t directions) {
  const bool has_worst =
      question.worst && question.max && !question.area && !question.is_by_face() && !question.part;
  return has_worst ? 2 * directions : directions;
}

}  // namespace

WorkMeter::WorkMeter(const Question& question, const Answer& known)
    : directions_(question.symmetric ? 2 : 1),
      searches_(searches_of(question, directions_)),
      surveys_(question.asks_for_survey() ? directions_ : 0),
      proofs_(question.certificate ? directions_ : 0),
      is_by_face_(question.is_by_face()),
      wave_limit_(question.budget.wave_limit),
      farthest_(known.a_to_b.upper),
      tolerance_(known.a_to_b.tolerance) {
  known_.fill({0, farthest_});
  if (!question.symmetric) known_[1].upper = 0;
  done_.upper = farthest_;
}

double WorkMeter::part_of_search(const Progress& progress) const {
  const double width = std::min(progress.upper, farthest_) - progress.lower;
  if (!(width > 0)) return 1;
  const double part = std::log(farthest_ / width) / std::log(farthest_ / tolerance_);
  const double waves =
      wave_limit_ == 0 ? 1 : static_cast<double>(progress.wave) / static_cast<double>(wave_limit_);
  return std::max(std::isfinite(part) ? std::clamp(part, 0.0, 1.0) : 0.0, std::min(waves, 1.0));
}

void WorkMeter::reach(double steps) {
  const auto all = static_cast<double>(searches_ + surveys_ + proofs_);
  done_.fraction = std::max(done_.fraction, std::min(steps / all, 1.0));
}

void WorkMeter::narrow(size_t direction, const Interval& interval) {
  Interval& known = known_[direction];
  known.lower = std::max(known.lower, interval.lower);
  known.upper = std::min(known.upper, interval.upper);
  done_.lower = std::max({done_.lower, known_[0].lower, known_[1].lower});
  done_.upper = std::min(done_.upper, std::max(known_[0].upper, known_[1].upper));
}

// With limits by face the progress is of some of A's faces, and does not bound the others.
void WorkMeter::hear(const Progress& progress) {
  if (is_by_face_) return;
  const size_t direction = progress.back && directions_ == 2 ? 1 : 0;
  narrow(direction, {progress.lower, progress.upper});
  reach(static_cast<double>(std::min(rounds_ * directions_, searches_ - directions_) + direction) +
        part_of_search(progress));
}

void WorkMeter::hear_cells(const SideCount& side) {
  const auto count = static_cast<double>(side.count);
  const auto faces = static_cast<double>(std::max<size_t>(side.faces, 1));
  const auto effort = static_cast<double>(std::max<size_t>(side.effort, 1));
  const double part = count <= faces
                          ? 0.5 * count / faces
                          : 0.5 + 0.5 * std::log(count / faces) / std::log1p(effort / faces);
  reach(static_cast<double>(searches_ + (side.back ? 1 : 0)) + std::min(part, 1.0));
}

void WorkMeter::hear_leaves(const SideCount& side) {
  const auto count = static_cast<double>(side.count);
  const double part = count / (count + static_cast<double>(std::max<size_t>(side.faces, 1)));
  reach(static_cast<double>(searches_ + surveys_ + (side.back ? 1 : 0)) + part);
}

void WorkMeter::take(const Answer& answer) {
  narrow(0, {answer.a_to_b.lower, answer.a_to_b.upper});
  if (answer.b_to_a && directions_ == 2) narrow(1, {answer.b_to_a->lower, answer.b_to_a->upper});
  ++rounds_;
  const size_t searched = std::min(rounds_ * directions_, searches_);
  reach(static_cast<double>(rounds_ < 3 ? searched : searches_ + surveys_));
}

void WorkMeter::end(const Answer& answer) {
  take(answer);
  done_.fraction = 1;
}

}  // namespace vkh
