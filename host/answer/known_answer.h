// An answer as far as it is known, shared with the threads that work on it.
#pragma once

#include <limits>
#include <mutex>
#include <optional>

#include "vkhausdorff/answer.h"
#include "vkhausdorff/question.h"
#include "vkhausdorff/work_meter.h"

namespace vkh {

/// The answer so far, true at any time. Threads may share it.
class KnownAnswer {
 public:
  explicit KnownAnswer(const Question& question);

  /// Takes an answer that has its meshes and its first bound: before it all that is known is
  /// [0, infinity).
  void begin(const Answer& answer);
  void open(const DeviceDescription& device);
  void hear(const Progress& progress);
  void hear_cells(const SideCount& side);
  void hear_leaves(const SideCount& side);
  /// Keeps the answer once all searches have ended; only surveys and certificates may be missing.
  void keep(const Answer& answer);
  /// Keeps the final answer: all work is done.
  void end(const Answer& answer);

  /// Whether keep() was called.
  bool is_final() const;
  Answer answer() const;
  WorkDone done() const;

 private:
  const Question question_;
  mutable std::mutex mutex_;
  Answer known_;
  std::optional<WorkMeter> meter_;
  bool is_final_ = false;
  double farthest_ = std::numeric_limits<double>::infinity();
};

}  // namespace vkh
