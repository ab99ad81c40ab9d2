#include "vkhausdorff/together.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "host/base/float_environment.h"
#include "host/base/parallel.h"
#include "host/base/rounding.h"
#include "host/solve/held_pairs.h"
#include "host/solve/join_reports.h"
#include "host/solve/part.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"

namespace vkh {
namespace {

using Clock = std::chrono::steady_clock;

/// The state of a part: what its run has reported so far, and its outcome.
struct PartState {
  FaceRanges ranges;
  Progress last{.upper = std::numeric_limits<double>::infinity()};
  double proven = 0;  ///< a lower bound of its distance, and so of A's
  double known = 0;   ///< the largest bound that others had proven and it was given
  size_t device = 0;  ///< the device of the report
  std::optional<Report> report;
};

class Together {
 public:
  Together(std::span<Solver* const> solvers, const Mesh& a, const Mesh& b,
           const SolveOptions& options)
      : solvers_(solvers), a_(a), b_(b), options_(options), lost_(solvers.size()) {
    const size_t count = std::min(solvers.size(), a.faces.size());
    for (size_t i = 0; i < count; ++i) {
      parts_.emplace_back();
      parts_.back().ranges = part_by_turns(a.faces.size(), i, count);
      waiting_.push_back(i);
    }
  }

  Report run() {
    work_off();
    Report all = joined();
    // The bound that a part was given may be larger than the final witness proves: by a rounding,
    // or because the device that had proven it was lost. The part is then given the smaller one,
    // and goes on from there.
    if (may_still_close(all)) {
      for (PartState& part : parts_) part.proven = 0;
      options_.known_lower = std::max(options_.known_lower, all.lower);
      work_off();
      all = joined();
    }
    all.left_out = std::move(left_out_);
    all.times.wall_ms = 1000 * elapsed_s();
    return all;
  }

 private:
  double elapsed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// Solves every waiting part, on every device that is left. Throws the last device's error if a
  /// part has no answer.
  void work_off() {
    for_each_index(
        solvers_.size(), [&](size_t i) { work(i); }, solvers_.size());
    if (error_) std::rethrow_exception(error_);
    for (const size_t number : waiting_) {
      if (!parts_[number].report) std::rethrow_exception(loss_);
    }
    waiting_.clear();
  }

  /// Runs one device: part after part, until none is waiting and none can be given back any more.
  void work(size_t device) {
    std::unique_lock lock(mutex_);
    while (!lost_[device]) {
      changed_.wait(lock, [&] { return !waiting_.empty() || running_ == 0 || error_; });
      if (waiting_.empty() || error_) return;
      const size_t number = waiting_.front();
      waiting_.pop_front();
      ++running_;
      lock.unlock();
      attempt(device, number);
      lock.lock();
      --running_;
      changed_.notify_all();
    }
  }

  void attempt(size_t device, size_t number) {
    try {
      const auto known_since = [this, number] {
        const std::lock_guard lock(mutex_);
        return known_to(number);
      };
      const auto alone = [&](const Mesh& a, const Mesh& b, const SolveOptions& options) {
        return distance_since(*solvers_[device], {a, b}, options, known_since);
      };
      Report r = distance_of_part(alone, a_, parts_[number].ranges, b_, options_for(number));
      const std::lock_guard lock(mutex_);
      PartState& part = parts_[number];
      if (options_.engine.certified) part.proven = std::max(part.proven, r.lower);
      if (options_.limit.beyond > 0 && r.lower > options_.limit.beyond) is_over_ = true;
      part.report = part.report ? narrowed(*part.report, std::move(r)) : std::move(r);
      part.device = device;
    } catch (const DeviceError& error) {
      give_back(device, number, error.what());
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }

  /// Gives the part back without the bound that the lost device proved: no device has a witness for
  /// it.
  void give_back(size_t device, size_t number, const std::string& why) {
    const std::lock_guard lock(mutex_);
    lost_[device] = true;
    loss_ = std::current_exception();
    left_out_.push_back({device, why});
    parts_[number].proven = 0;
    waiting_.push_back(number);
  }

  SolveOptions options_for(size_t number) {
    SolveOptions out = options_;
    constexpr double kLeastTime = 1e-3;  // even a spent budget buys a first, true interval
    out.time_limit_s = std::max(options_.time_limit_s - elapsed_s(), kLeastTime);
    const std::lock_guard lock(mutex_);
    out.known_lower = known_to(number);
    out.progress = [this, number](const Progress& progress) { return advance(number, progress); };
    return out;
  }

  double known_to(size_t number) {
    double known = options_.known_lower;
    for (size_t i = 0; i < parts_.size(); ++i) {
      if (i != number) known = std::max(known, parts_[i].proven);
    }
    parts_[number].known = std::max(parts_[number].known, known);
    return known;
  }

  /// Reports the progress of all parts to the callback. Its exception ends the other runs, too.
  bool advance(size_t number, const Progress& progress) {
    const std::lock_guard lock(mutex_);
    PartState& part = parts_[number];
    part.last = progress;
    if (options_.engine.certified) part.proven = std::max(part.proven, progress.lower);
    is_over_ = is_over_ || error_;
    if (!is_over_ && options_.progress) is_over_ = !listen();
    return !is_over_;
  }

  bool listen() {
    Progress all;
    for (const PartState& part : parts_) {
      all.wave = std::max(all.wave, part.last.wave);
      all.candidates += part.last.candidates;
      all.lower = std::max({all.lower, part.proven, part.last.lower});
      all.upper = std::max(all.upper, part.last.upper);
    }
    all.gap = gap_of(all.lower, all.upper, diagonal_a_);
    return options_.progress(all);
  }

  Report joined() {
    std::vector<Report> reports;
    for (const PartState& part : parts_) reports.push_back(*part.report);
    Report all = joined_report(reports);
    std::map<size_t, DeviceDescription> devices;
    for (size_t i = 0; i < parts_.size(); ++i) devices[parts_[i].device] = reports[i].device;
    all.device = devices.begin()->second;
    for (auto next = ++devices.begin(); next != devices.end(); ++next)
      all.more_devices.push_back(next->second);
    // Each part's known_lower may include bounds that other parts proved; the whole reports only
    // the one that the caller gave.
    all.known_lower = asked_known_;
    all.status = joined_status(all, reports);
    return all;
  }

  /// Makes every part wait again that stopped at a bound which is no longer proven.
  bool may_still_close(const Report& all) {
    if (all.status == Status::kClosed || is_over_ || options_.time_limit_s <= elapsed_s())
      return false;
    for (size_t i = 0; i < parts_.size(); ++i) {
      const double upper = parts_[i].report->upper;
      if (is_within(parts_[i].known, upper, all.tolerance) &&
          !is_within(all.lower, upper, all.tolerance))
        waiting_.push_back(i);
    }
    return !waiting_.empty();
  }

  std::span<Solver* const> solvers_;
  const Mesh& a_;
  const Mesh& b_;
  SolveOptions options_;
  const double asked_known_ = options_.known_lower;
  const double diagonal_a_ = diagonal(bounding_box(a_));
  const Clock::time_point start_ = Clock::now();

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::vector<PartState> parts_;
  std::deque<size_t> waiting_;
  size_t running_ = 0;
  std::vector<bool> lost_;  // one per device
  std::vector<LeftOut> left_out_;
  std::exception_ptr loss_, error_;
  bool is_over_ = false;
};

}  // namespace

Report distance_over(std::span<Solver* const> solvers, const Mesh& a, const Mesh& b,
                     const SolveOptions& options) {
  if (solvers.empty()) throw UsageError("no device was given");
  if (solvers.size() == 1) return solvers[0]->distance(a, b, options);
  const FloatEnvironment ours;
  check_mesh(a);
  return Together(solvers, a, b, options).run();
}

}  // namespace vkh
