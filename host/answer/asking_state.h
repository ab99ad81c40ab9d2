// A question on its way to an answer on a thread of its own: its source, its pair, and what is
// known of its answer, at any time.
#pragma once

#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "host/answer/asked_pair.h"
#include "vkhausdorff/asking.h"

namespace vkh {

/// Supplies the meshes and devices of a question, and hears of its progress. read(), open() and
/// end() are called in this order, on the working thread; an exception from one of them ends the
/// question.
class AskingSource {
 public:
  virtual ~AskingSource() = default;
  /// Gives the pair its meshes.
  virtual void read(AskedPair& pair) = 0;
  /// Returns the solvers, one at least, and writes the milliseconds that opening them took.
  virtual std::span<Solver* const> open(double& ms) = 0;
  /// Adds to the answer what only the source knows, such as hashes.
  virtual void end(Answer& /*answer*/) {}

  /// Whether the caller has called it off; the seconds left for all work. Called at any time.
  virtual bool is_called_off() const { return false; }
  virtual double left_s() const = 0;
  /// Hears how far all work is. `words`: returns a description in terms of the method.
  virtual void hear(const WorkDone& /*done*/, const std::function<std::string()>& /*words*/) {}
};

/// Threads may share it.
class AskingState {
 public:
  /// Throws UsageError as unread_answer() does.
  AskingState(Question question, std::unique_ptr<AskingSource> source);

  /// Does all the work, on the calling thread.
  void run();
  void cancel() { stop_.request_stop(); }
  bool wait(Asking::Deadline deadline) const;
  /// Throws what the work threw; waits for it.
  void check() const { result_.get(); }

  /// The answer so far, true at any time: before the meshes are read all that is known is
  /// [0, infinity).
  Answer known() const;
  WorkDone done() const;
  /// Whether all searches have ended: only surveys and certificates may be missing.
  bool is_final() const;
  /// The pair, once the work is done.
  AskedPair& pair() { return pair_; }

 private:
  void work();
  Observer observer();
  bool is_called_off() const { return stop_.stop_requested() || source_->is_called_off(); }
  void report(const std::function<std::string()>& words);
  void begin();
  void open(const DeviceDescription& device);
  void end();
  void hear(const Progress& progress);
  void keep(const Answer& answer);

  const Question question_;
  const std::unique_ptr<AskingSource> source_;
  AskedPair pair_;  // of the thread that works, until is_over_
  mutable std::mutex mutex_;
  Answer known_;
  std::optional<WorkMeter> meter_;
  bool is_final_ = false, is_over_ = false;
  double farthest_ = std::numeric_limits<double>::infinity();
  std::stop_source stop_;
  std::promise<void> over_;
  std::shared_future<void> result_ = over_.get_future().share();
};

}  // namespace vkh
