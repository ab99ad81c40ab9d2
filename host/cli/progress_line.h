// How a run goes, for whoever watches.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "host/base/decimal.h"
#include "host/run/solve_options.h"

namespace vkh {

using Clock = std::chrono::steady_clock;

inline double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// A line on stderr that rewrites itself, on a terminal only.
class ProgressLine {
 public:
  ProgressLine() : shown_(isatty(STDERR_FILENO) == 1) {}
  ~ProgressLine() {
    if (drawn_) std::fputs("\r\033[K", stderr);
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const Progress& p) {
    constexpr double kRedrawMs = 100;
    if (!shown_ || (drawn_ && ms_since(last_) < kRedrawMs)) return;
    std::fprintf(stderr, "\r\033[K%s  wave %u  %llu candidates  [%s, %s]  gap %.2e",
                 p.back ? "h(B,A)" : "h(A,B)", p.wave,
                 static_cast<unsigned long long>(p.candidates),
                 decimal(p.lower, 7, Rounding::kDown).c_str(),
                 decimal(p.upper, 7, Rounding::kUp).c_str(), p.gap);
    std::fflush(stderr);
    drawn_ = true;
    last_ = Clock::now();
  }

 private:
  bool shown_;
  bool drawn_ = false;
  Clock::time_point last_;
};

}  // namespace vkh
