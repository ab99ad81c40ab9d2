// Counts a survey's effort and time, and asks its caller whether to go on.
#pragma once

#include <algorithm>
#include <chrono>

#include "vkhausdorff/survey.h"

namespace vkh {

/// The number of cells of a submission that makes it take as long as it should. No result depends
/// on it.
class BatchSize {
 public:
  BatchSize(size_t first, size_t most, double submission_ms)
      : size_(first), most_(most), submission_ms_(submission_ms) {}
  size_t size() const { return size_; }
  /// Notes that a submission of `cells` cells took `ms`.
  void note(size_t cells, double ms) {
    if (ms <= submission_ms_ && cells < size_)
      return;  // a short one shows only the cost that every submission has
    const double fits = submission_ms_ * static_cast<double>(cells) / std::max(ms, 1e-6);
    const size_t most = std::min(4 * size_, most_);
    size_ = fits >= static_cast<double>(most) ? most
                                              : std::max(static_cast<size_t>(fits) / 4 * 4, kLeast);
  }

 private:
  static constexpr size_t kLeast = 64;  // halves come in twos, and parts in fours
  size_t size_;
  const size_t most_;
  const double submission_ms_;
};

class SurveyMeter {
 public:
  /// `keeps_time_for_sides`: cells are split in the first part of the time alone. The options
  /// outlive it.
  SurveyMeter(const SurveyOptions& options, bool on_cpu, bool keeps_time_for_sides)
      : options_(options),
        ms_of_cells_(1000 * options.time_limit_s * (keeps_time_for_sides ? kPartOfCells : 1)),
        effort_(options.effort.value_or(default_effort(on_cpu))),
        bounds_(on_cpu ? 1024 : 65536, kMostBounds, options.submission_ms),
        looks_(on_cpu ? 65536 : kMostLooks, kMostLooks, options.submission_ms),
        sides_(on_cpu ? 1024 : 65536, kMostLooks, options.submission_ms) {}

  /// Whether the caller lets the survey go on, without regard to time.
  bool is_wanted() {
    if (ended_ != SurveyEnd::kCancelled && options_.goes_on && !options_.goes_on(bounded_))
      ended_ = SurveyEnd::kCancelled;
    return ended_ != SurveyEnd::kCancelled;
  }
  /// Asks the caller first, so that a cancelled survey does not count as ended by time.
  bool goes_on() { return goes_on(ended_, ms_of_cells_); }
  /// The same for the work on sides, which has some time of its own.
  bool sides_go_on() { return goes_on(sides_ended_, 1000 * options_.time_limit_s); }
  /// The reason why one of the functions above returned false; kMet if none has.
  SurveyEnd ended() const { return std::max(ended_, sides_ended_); }

  size_t effort() const { return effort_; }
  size_t effort_left() const { return effort_ - std::min(spent_, effort_); }
  void spend(size_t cells) { spent_ += cells; }

  BatchSize& bounds() { return bounds_; }  ///< of submissions that bound cells
  BatchSize& looks() { return looks_; }    ///< of submissions that look at cells with bounds
  BatchSize& sides() { return sides_; }    ///< of submissions that find sides
  double sides_ms() const { return sides_ms_; }
  void note_sides(double ms) { sides_ms_ += ms; }
  size_t bounded() const { return bounded_; }
  void note_bounded(size_t cells) { bounded_ += cells; }
  /// Calls `work`, whose time counts as the device's, and returns how long it took.
  template <class Work>
  double on_device(const Work& work) {
    const Clock::time_point start = Clock::now();
    work();
    const double ms = ms_since(start);
    device_ms_ += ms;
    return ms;
  }
  double device_ms() const { return device_ms_; }
  double ms() const { return ms_before_ + ms_since(start_); }
  /// Begins a new time limit for what follows, and forgets what ended the work before.
  void go_on(double time_limit_s) {
    ms_before_ = ms();
    start_ = Clock::now();
    ms_of_cells_ = 1000 * time_limit_s;
    ended_ = SurveyEnd::kMet;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  }

  bool goes_on(SurveyEnd& ended, double limit_ms) {
    if (ended != SurveyEnd::kMet) return false;
    if (!is_wanted()) {
      ended = SurveyEnd::kCancelled;
    } else if (ms_since(start_) > limit_ms) {
      ended = SurveyEnd::kTime;
    }
    return ended == SurveyEnd::kMet;
  }

  static constexpr double kPartOfCells = 0.7;
  static constexpr size_t kMostBounds = size_t{1} << 20, kMostLooks = size_t{1} << 24;
  const SurveyOptions& options_;
  Clock::time_point start_ = Clock::now();
  double ms_before_ = 0, ms_of_cells_;
  const size_t effort_;
  size_t spent_ = 0;
  BatchSize bounds_, looks_, sides_;
  size_t bounded_ = 0;
  double device_ms_ = 0, sides_ms_ = 0;
  SurveyEnd ended_ = SurveyEnd::kMet, sides_ended_ = SurveyEnd::kMet;
};

}  // namespace vkh
