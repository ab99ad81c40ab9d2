// How far a run is, on a terminal.
#pragma once

#include <array>
#include <chrono>
#include <cstdio>
#include <string>

#include "host/base/decimal.h"
#include "host/run/solve_options.h"
#include "host/system/system.h"

namespace vkh {

/// A line on stderr that rewrites itself, on a terminal only.
class ProgressLine {
 public:
  ProgressLine() : shown_(is_error_terminal()) {}
  ~ProgressLine() {
    if (width_ > 0) draw("");
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const Progress& p) {
    constexpr std::chrono::milliseconds kRedraw(100);
    if (!shown_ || (width_ > 0 && Clock::now() - last_ < kRedraw)) return;
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(), "%s  wave %u  %llu candidates  [%s, %s]  gap %.2e",
                  p.back ? "h(B,A)" : "h(A,B)", p.wave,
                  static_cast<unsigned long long>(p.candidates),
                  decimal(p.lower, 7, Rounding::kDown).c_str(),
                  decimal(p.upper, 7, Rounding::kUp).c_str(), p.gap);
    draw(line.data());
    last_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Over the older line, by blanks: not every console of Windows takes escape sequences.
  void draw(const std::string& line) {
    const size_t blanks = line.size() < width_ ? width_ - line.size() : 0;
    std::fprintf(stderr, "\r%s%s", line.c_str(), std::string(blanks, ' ').c_str());
    if (line.empty()) std::fputc('\r', stderr);
    std::fflush(stderr);
    width_ = line.size();
  }

  bool shown_;
  size_t width_ = 0;  ///< of the line that is there
  Clock::time_point last_;
};

}  // namespace vkh
