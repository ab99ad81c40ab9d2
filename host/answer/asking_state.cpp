#include "host/answer/asking_state.h"

#include <algorithm>
#include <utility>

#include "host/answer/progress_line.h"
#include "host/base/float_environment.h"

namespace vkh {

AskingState::AskingState(Question question, std::unique_ptr<AskingSource> source)
    : question_(std::move(question)),
      source_(std::move(source)),
      pair_(question_),
      known_(pair_.answer()) {}

void AskingState::run() {
  try {
    work();
    over_.set_value();
  } catch (...) {
    over_.set_exception(std::current_exception());
  }
}

void AskingState::work() {
  const FloatEnvironment ours;
  const Observer heard = observer();
  source_->read(pair_);
  if (!question_.align) begin();
  const std::span<Solver* const> solvers = source_->open(pair_.answer().waits.start);
  Solver& first = *solvers.front();
  pair_.fit(first, heard);
  begin();
  open(first.description());
  pair_.solve(solvers, heard);
  pair_.finish(first, heard);
  source_->end(pair_.answer());
  end();
}

Observer AskingState::observer() {
  return {.goes_on = [this] { return !is_called_off() && source_->left_s() > 0; },
          .left_s = [this] { return source_->left_s(); },
          .search =
              [this](const Progress& progress) {
                hear(progress);
                report([&] { return search_words(progress); });
                return !is_called_off();
              },
          .cells =
              [this](const SideCount& side) {
                {
                  const std::lock_guard lock(mutex_);
                  meter_->hear_cells(side);
                }
                report([&] { return count_words("survey", side, "cells bounded"); });
              },
          .leaves =
              [this](const SideCount& side) {
                {
                  const std::lock_guard lock(mutex_);
                  meter_->hear_leaves(side);
                }
                report([&] { return count_words("certificate", side, "leaves"); });
              },
          .found = [this](const Answer& answer) { keep(answer); }};
}

void AskingState::report(const std::function<std::string()>& words) {
  source_->hear(done(), words);
}

// Takes the answer that has its meshes and its first bound.
void AskingState::begin() {
  const std::lock_guard lock(mutex_);
  known_ = pair_.answer();
  farthest_ = known_.a_to_b.upper;
  meter_.emplace(question_, known_);
}

void AskingState::open(const DeviceDescription& device) {
  const std::lock_guard lock(mutex_);
  known_.a_to_b.device = device;
  if (known_.b_to_a) known_.b_to_a->device = device;
}

void AskingState::hear(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  meter_->hear(progress);
  // A later search begins with wider bounds, and without the witness that is kept.
  if (is_final_) return;
  // With limits by face the progress is of some of A's faces, and does not bound the others.
  if (question_.is_by_face()) return;
  Report& r = progress.back && known_.b_to_a ? *known_.b_to_a : known_.a_to_b;
  r.lower = progress.lower;
  r.upper = std::min(progress.upper, farthest_);
}

void AskingState::keep(const Answer& answer) {
  const std::lock_guard lock(mutex_);
  known_ = answer;
  is_final_ = true;
  meter_->take(answer);
}

void AskingState::end() {
  const std::lock_guard lock(mutex_);
  is_final_ = is_over_ = true;
  meter_->end(pair_.answer());
}

bool AskingState::wait(Asking::Deadline deadline) const {
  return result_.wait_until(deadline) == std::future_status::ready;
}

Answer AskingState::known() const {
  const std::lock_guard lock(mutex_);
  return is_over_ ? pair_.answer() : known_;
}

WorkDone AskingState::done() const {
  const std::lock_guard lock(mutex_);
  return meter_ ? meter_->done() : WorkDone{};
}

bool AskingState::is_final() const {
  const std::lock_guard lock(mutex_);
  return is_final_;
}

}  // namespace vkh
