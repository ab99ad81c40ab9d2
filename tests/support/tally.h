// The record of a test of many cases: the first violations in hexadecimal, and the worst measured
// values, so that one line of doctest covers all of them.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/vec3.hpp>
#include <map>
#include <string>

namespace vkh::test {

inline std::string hex(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}
inline std::string hex(const glm::dvec3& v) {
  return "(" + hex(v.x) + ", " + hex(v.y) + ", " + hex(v.z) + ")";
}

class Tally {
 public:
  explicit Tally(std::string name) : name_(std::move(name)) {}

  /// `describe` gives the case as text, and is called for the first violations only.
  template <class F>
  void require(bool holds, const char* claim, const F& describe) {
    ++checks_;
    if (holds) return;
    const uint64_t seen = violations_[claim]++;
    ++violation_count_;
    if (seen < 1) log_ += "\n  violated: " + std::string(claim) + "\n    " + describe();
  }

  /// Keeps the largest value of a measure and its case.
  template <class F>
  void measure(const char* what, double value, const F& describe) {
    const auto [it, first] = worst_.try_emplace(what);
    if (!first && !(value > it->second.value)) return;
    it->second = {value, describe()};
  }
  double worst(const char* what) const {
    const auto it = worst_.find(what);
    return it == worst_.end() ? 0.0 : it->second.value;
  }
  void count(const char* what, bool yes) { counts_[what] += yes ? 1u : 0u; }
  uint64_t counted(const char* what) const {
    const auto it = counts_.find(what);
    return it == counts_.end() ? 0 : it->second;
  }

  uint64_t violated() const { return violation_count_; }
  /// Enough violations are known: the rest of the cases need not run.
  bool hopeless() const { return violation_count_ >= 1000; }

  /// Prints the worst cases, and fails for any violation.
  void conclude(uint64_t least_checks) const {
    std::string text = name_ + ": " + std::to_string(checks_) + " checks";
    for (const auto& [what, count] : counts_) text += "\n  " + what + ": " + std::to_string(count);
    for (const auto& [what, worst] : worst_) {
      char value[32];
      std::snprintf(value, sizeof value, "%.4g", worst.value);
      text += "\n  worst " + what + ": " + value + "  " + worst.where;
    }
    for (const auto& [claim, count] : violations_) {
      text += "\n  " + std::to_string(count) + " times violated: " + claim;
    }
    std::printf("%s%s\n", text.c_str(), log_.c_str());
    INFO(name_ << log_);
    CHECK(violation_count_ == 0);
    CHECK(checks_ >= least_checks);
  }

 private:
  struct Worst {
    double value = 0.0;
    std::string where;
  };
  std::string name_, log_;
  uint64_t checks_ = 0, violation_count_ = 0;
  std::map<std::string, uint64_t> violations_, counts_;
  std::map<std::string, Worst> worst_;
};

}  // namespace vkh::test
