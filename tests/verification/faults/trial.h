// Tries one fault at a time in an action, and reports the outcome.
#pragma once

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/verification/faults/test_layer.h"
#include "vkhausdorff/error.h"

namespace vkh::test {

inline const TestLayer& layer() {
  static const TestLayer one;
  return one;
}

/// Work that is not given back wakes no waiting thread: a hang ends the test.
class Watchdog {
 public:
  Watchdog() { alarm(60); }
  ~Watchdog() { alarm(0); }
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
};

/// The calls that a fault is tried at: all of them with VKH_FAULTS=all; otherwise the first, the
/// second, the one in the middle and the last; if a trial takes long, the first and the last, or
/// the first.
enum class Places { kFour, kEnds, kFirst };
inline std::set<size_t> places_of(size_t count, Places places) {
  const char* wanted = std::getenv("VKH_FAULTS");
  if (wanted == nullptr || std::string(wanted) != "all") {
    if (places == Places::kFirst) return {1};
    if (places == Places::kEnds) return {1, count};
    return {1, std::min<size_t>(2, count), (count + 1) / 2, count};
  }
  std::set<size_t> all;
  for (size_t n = 1; n <= count; ++n) all.insert(n);
  return all;
}

/// Every fault as text for VKH_LAYER_FAIL: each called function, at its places, with each of its
/// errors.
inline std::vector<std::string> faults_of(const std::vector<std::string>& calls,
                                          Places places = Places::kFour) {
  std::map<std::string, size_t> counts;
  for (const std::string& call : calls) ++counts[call];
  std::vector<std::string> faults;
  for (const auto& [call, count] : counts) {
    for (const size_t n : places_of(count, places)) {
      for (const char* error : layer().errors_of(call))
        faults.push_back(call + ":" + std::to_string(n) + ":" + error);
    }
  }
  return faults;
}

/// Lines of out/faults.txt: action, fault, outcome.
class FaultTable {
 public:
  explicit FaultTable(const std::string& name)
      : out_(VKH_FAULTS_FOLDER "/faults_" + name +
             (std::getenv("VKH_LAYER_HIDE") != nullptr ? "_hidden" : "") +
             (std::getenv("VKH_FAULTS") != nullptr ? "_all.txt" : ".txt")) {}
  void add(const std::string& what, const std::string& fault, const std::string& end) {
    out_ << what << '\t' << fault << '\t' << end << '\n';
    out_.flush();
    ++count_;
  }
  size_t count() const { return count_; }

 private:
  std::ofstream out_;
  size_t count_ = 0;
};

/// Does `work`, which returns its outcome as text. Only a DeviceError of one line may leave it.
inline std::string ended(const std::function<std::string()>& work) {
  try {
    return work();
  } catch (const DeviceError& error) {
    const std::string text = error.what();
    CHECK(text.find('\n') == std::string::npos);
    CHECK(!text.empty());
    return "DeviceError: " + text;
  }
}

}  // namespace vkh::test
