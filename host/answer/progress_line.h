// The progress of a job: a line that rewrites itself on a terminal, a line each ten seconds
// elsewhere.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>

#include "host/base/decimal.h"
#include "host/base/system.h"
#include "vkhausdorff/solve_options.h"
#include "vkhausdorff/work_meter.h"

namespace vkh {

/// Writes seconds as "1:05" or "2:00:05".
inline std::string clock_text(double seconds) {
  const auto all = static_cast<unsigned long long>(std::llround(std::max(seconds, 0.0)));
  std::array<char, 48> text{};
  if (all < 3600) {
    std::snprintf(text.data(), text.size(), "%llu:%02llu", all / 60, all % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%llu:%02llu:%02llu", all / 3600, all / 60 % 60,
                  all % 60);
  }
  return text.data();
}

/// The line of a pair: how much of all work is done, the interval so far, and, if the time is
/// limited, the time left.
inline std::string progress_text(const WorkDone& done, double left_s) {
  std::string text = std::to_string(static_cast<int>(100 * done.fraction)) + " %  [" +
                     decimal(done.lower, 7, Rounding::kDown) + ", " +
                     decimal(done.upper, 7, Rounding::kUp) + "]";
  if (std::isfinite(left_s)) text += "  at most " + clock_text(left_s) + " left";
  return text;
}

/// Describes a search in the method's words, for --verbose.
inline std::string search_words(const Progress& p) {
  std::array<char, 160> words{};
  std::snprintf(words.data(), words.size(), "%s  wave %u  %llu candidates  gap %s",
                p.back ? "h(B,A)" : "h(A,B)", p.wave, static_cast<unsigned long long>(p.candidates),
                number_text(p.gap, std::chars_format::scientific, 2).c_str());
  return words.data();
}

/// Counts the work of a survey or of a certificate, for --verbose.
inline std::string count_words(const char* what, const SideCount& side, const char* of) {
  return std::string(what) + " of " + (side.back ? "B" : "A") + "  " + std::to_string(side.count) +
         " " + of;
}

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

  /// Shows the text that `text` returns, which is called only if a line is due.
  template <class Text>
  void show(const Text& text) {
    const std::lock_guard lock(mutex_);
    if (is_time()) show_line(text());
  }

  /// Shows how many of all pairs are done, and the time left.
  void show_batch(size_t done, size_t all, size_t failed, double seconds_left) {
    const std::lock_guard lock(mutex_);
    if (!is_time()) return;
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(), "%zu/%zu  %zu failed  ETA %s", done, all, failed,
                  clock_text(seconds_left).c_str());
    show_line(line.data());
  }

  /// Takes the line away. Later calls show nothing.
  void end() {
    const std::lock_guard lock(mutex_);
    if (width_ > 0) draw("");
    is_over_ = true;
  }

 private:
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
