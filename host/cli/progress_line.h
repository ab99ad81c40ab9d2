// How far a run is, on a terminal.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
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

  /// Files, before there is a run.
  void show_reading(uint64_t bytes, uint64_t all) {
    if (!is_time()) return;
    std::array<char, 80> line{};
    std::snprintf(line.data(), line.size(), "reading  %llu of %llu MB",
                  static_cast<unsigned long long>(bytes / 1'000'000),
                  static_cast<unsigned long long>(all / 1'000'000));
    draw(line.data());
    last_ = Clock::now();
  }

  void show(const Progress& p) {
    if (!is_time()) return;
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

  bool is_time() const {
    constexpr std::chrono::milliseconds kRedraw(100);
    return shown_ && (width_ == 0 || Clock::now() - last_ >= kRedraw);
  }

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
