// The progress of a job: a line that rewrites itself on a terminal, a line each ten seconds
// elsewhere.
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>

#include "host/base/decimal.h"
#include "host/base/system.h"
#include "host/solve/solve_options.h"

namespace vkh {

/// Writes to stderr. Threads may share it.
class ProgressLine {
 public:
  ProgressLine() : is_terminal_(is_error_terminal()) {}
  ~ProgressLine() { end(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows how much of the files is read, before there is a run.
  void show_reading(uint64_t bytes, uint64_t all) {
    const std::lock_guard lock(mutex_);
    if (!is_time()) return;
    std::array<char, 80> line{};
    std::snprintf(line.data(), line.size(), "reading  %llu of %llu MB",
                  static_cast<unsigned long long>(bytes / 1'000'000),
                  static_cast<unsigned long long>(all / 1'000'000));
    show_line(line.data());
  }

  void show(const Progress& p) {
    const std::lock_guard lock(mutex_);
    if (!is_time()) return;
    std::array<char, 160> line{};
    std::snprintf(
        line.data(), line.size(), "%s  wave %u  %llu candidates  [%s, %s]  gap %s",
        p.back ? "h(B,A)" : "h(A,B)", p.wave, static_cast<unsigned long long>(p.candidates),
        decimal(p.lower, 7, Rounding::kDown).c_str(), decimal(p.upper, 7, Rounding::kUp).c_str(),
        number_text(p.gap, std::chars_format::scientific, 2).c_str());
    show_line(line.data());
  }

  /// Shows, after a run, how much of a mesh is bounded.
  void show_survey(size_t cells) { show_count("survey", cells, "cells bounded"); }
  /// Shows, after a run, how many leaves of a mesh's certificate are made so far.
  void show_proof(size_t leaves) { show_count("certificate", leaves, "leaves"); }

  /// Shows how many of all pairs are done, and the time left.
  void show_batch(size_t done, size_t all, size_t failed, double seconds_left) {
    const std::lock_guard lock(mutex_);
    if (!is_time()) return;
    const auto left = static_cast<unsigned long long>(std::llround(seconds_left));
    std::array<char, 48> eta{};
    std::array<char, 160> line{};
    if (left < 3600) {
      std::snprintf(eta.data(), eta.size(), "%llu:%02llu", left / 60, left % 60);
    } else {
      std::snprintf(eta.data(), eta.size(), "%llu:%02llu:%02llu", left / 3600, left / 60 % 60,
                    left % 60);
    }
    std::snprintf(line.data(), line.size(), "%zu/%zu  %zu failed  ETA %s", done, all, failed,
                  eta.data());
    show_line(line.data());
  }

  /// Takes the line away. Later calls show nothing.
  void end() {
    const std::lock_guard lock(mutex_);
    if (width_ > 0) draw("");
    is_over_ = true;
  }

 private:
  void show_count(const char* what, size_t count, const char* of) {
    const std::lock_guard lock(mutex_);
    if (!is_time()) return;
    std::array<char, 80> line{};
    std::snprintf(line.data(), line.size(), "%s  %llu %s", what,
                  static_cast<unsigned long long>(count), of);
    show_line(line.data());
  }

  using Clock = std::chrono::steady_clock;

  bool is_time() const {
    constexpr std::chrono::milliseconds kRedraw(100);
    constexpr std::chrono::seconds kAnotherLine(10);
    if (is_over_) return false;
    if (is_terminal_) return width_ == 0 || Clock::now() - last_ >= kRedraw;
    return Clock::now() - last_ >= kAnotherLine;
  }

  void show_line(const std::string& line) {
    last_ = Clock::now();
    if (is_terminal_) return draw(line);
    std::fprintf(stderr, "%s\n", line.c_str());
    std::fflush(stderr);
  }

  /// Overwrites the older line with blanks: not every console of Windows takes escape sequences.
  void draw(const std::string& line) {
    const size_t blanks = line.size() < width_ ? width_ - line.size() : 0;
    std::fprintf(stderr, "\r%s%s", line.c_str(), std::string(blanks, ' ').c_str());
    if (line.empty()) std::fputc('\r', stderr);
    std::fflush(stderr);
    width_ = line.size();
  }

  const bool is_terminal_;
  std::mutex mutex_;
  bool is_over_ = false;
  size_t width_ = 0;  ///< the width of the current line
  Clock::time_point last_ = Clock::now();
};

}  // namespace vkh
