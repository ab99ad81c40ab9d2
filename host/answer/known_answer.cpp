#include "host/answer/known_answer.h"

#include <algorithm>

#include "host/answer/steps.h"

namespace vkh {

KnownAnswer::KnownAnswer(const Question& question)
    : question_(question), known_(unread_answer(question)) {}

void KnownAnswer::begin(const Answer& answer) {
  const std::lock_guard lock(mutex_);
  known_ = answer;
  farthest_ = answer.a_to_b.upper;
  meter_.emplace(question_, known_);
}

void KnownAnswer::open(const DeviceDescription& device) {
  const std::lock_guard lock(mutex_);
  known_.a_to_b.device = device;
  if (known_.b_to_a) known_.b_to_a->device = device;
}

void KnownAnswer::hear(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  if (meter_) meter_->hear(progress);
  // A later search begins with wider bounds, and without the witness that is kept.
  if (is_final_) return;
  // The progress covers a part of A's faces and bounds none of the others.
  if (question_.is_by_face()) return;
  Report& r = progress.back && known_.b_to_a ? *known_.b_to_a : known_.a_to_b;
  r.lower = progress.lower;
  r.upper = std::min(progress.upper, farthest_);
}

void KnownAnswer::hear_cells(const SideCount& side) {
  const std::lock_guard lock(mutex_);
  if (meter_) meter_->hear_cells(side);
}

void KnownAnswer::hear_leaves(const SideCount& side) {
  const std::lock_guard lock(mutex_);
  if (meter_) meter_->hear_leaves(side);
}

void KnownAnswer::keep(const Answer& answer) {
  const std::lock_guard lock(mutex_);
  known_ = answer;
  is_final_ = true;
  if (meter_) meter_->take(answer);
}

void KnownAnswer::end(const Answer& answer) {
  const std::lock_guard lock(mutex_);
  known_ = answer;
  is_final_ = true;
  if (meter_) meter_->end(answer);
}

bool KnownAnswer::is_final() const {
  const std::lock_guard lock(mutex_);
  return is_final_;
}

Answer KnownAnswer::answer() const {
  const std::lock_guard lock(mutex_);
  return known_;
}

WorkDone KnownAnswer::done() const {
  const std::lock_guard lock(mutex_);
  return meter_ ? meter_->done() : WorkDone{};
}

}  // namespace vkh
