// The events that end a job before its answer is final: its time, Ctrl-C or SIGTERM.
#pragma once

#include <chrono>
#include <limits>

#include "host/base/system.h"
#include "vkhausdorff/report.h"

namespace vkh {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Stop {
 public:
  /// `start`: of the process. The time counts from it, so it includes reading and pipelines.
  Stop(Clock::time_point start, double seconds) : start_(start), seconds_(seconds) {}

  double elapsed_s() const { return seconds_since(start_); }
  double left_s() const { return seconds_ - elapsed_s(); }
  bool is_asked() const { return is_interrupted() || left_s() <= 0; }
  Status why() const { return is_interrupted() ? Status::kCancelled : Status::kTime; }

 private:
  Clock::time_point start_;
  double seconds_;
};

}  // namespace vkh
