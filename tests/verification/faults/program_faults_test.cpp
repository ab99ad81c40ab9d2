// The program under faults: of Vulkan calls, by the test layer, and of its own allocations. Each
// run ends with exit code 5 and one line on stderr, or with the answer that is possible without it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/program.h"
#include "tests/verification/faults/trial.h"

namespace {

using namespace vkh::test;

FaultTable& table() {
  static FaultTable one("program");
  return one;
}

std::string square(const std::string& name, double z) {
  std::ostringstream obj;
  obj << "v 0 0 " << z << "\nv 1 0 " << z << "\nv 1 1 " << z << "\nv 0 1 " << z
      << "\nf 1 2 3\nf 1 3 4\n";
  return write_file(name, obj.str());
}

Words pair() {
  return {"distance", square("a.obj", 0), square("b.obj", 0.25), "--json", "--no-cache"};
}

std::string interval_in(const std::string& out) {
  const auto json = nlohmann::json::parse(out, nullptr, false);
  if (!json.is_object() || !json.contains("interval")) return out;
  const auto& interval = json["interval"];
  return interval["lower_hex"].get<std::string>() + " " + interval["upper_hex"].get<std::string>();
}

Outcome run_with(const Words& words,
                 const std::vector<std::pair<const char*, std::string>>& given) {
  const Watchdog watchdog;
  for (const auto& [name, value] : given) setenv(name, value.c_str(), 1);
  Outcome outcome = run(words);
  for (const auto& [name, value] : given) unsetenv(name);
  return outcome;
}

/// Requires exit code 5, one line on stderr; or the result without the fault.
void check_ended(const Outcome& outcome, const std::string& answer) {
  CAPTURE(outcome.err);
  CAPTURE(outcome.out);
  if (outcome.exit_code == 0) {
    CHECK(interval_in(outcome.out) == answer);
    return;
  }
  CHECK(outcome.exit_code == 5);
  CHECK(outcome.err.starts_with("vkhausdorff: "));
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.find("internal error") == std::string::npos);
}

std::string line_of(const Outcome& outcome) {
  return outcome.exit_code == 0 ? "answer"
                                : std::to_string(outcome.exit_code) + " " +
                                      outcome.err.substr(0, outcome.err.find('\n'));
}

/// The first call of each function; of each the first error that it may return, and a lost device.
std::vector<std::string> first_faults(const Words& words) {
  const std::string log = folder() / "calls";
  const Outcome outcome = run_with(words, {{"VKH_LAYER_LOG", log}});
  REQUIRE(outcome.exit_code == 0);
  std::istringstream lines(read_file(log));
  std::set<std::string> calls;
  for (std::string line; std::getline(lines, line);) calls.insert(line);
  std::vector<std::string> faults;
  for (const std::string& call : calls) {
    for (const char* error : layer().errors_of(call)) {
      const bool is_first = error == layer().errors_of(call)[0];
      if (is_first || std::string(error) == "VK_ERROR_DEVICE_LOST")
        faults.push_back(call + ":1:" + error);
    }
  }
  return faults;
}

void try_fault(const Words& words, const std::string& fault, const std::string& answer) {
  CAPTURE(fault);
  const std::string count = write_file("count", "");
  const Outcome outcome = run_with(words, {{"VKH_LAYER_FAIL", fault}, {"VKH_LAYER_COUNT", count}});
  check_ended(outcome, answer);
  const std::string counts = read_file(count);
  CAPTURE(counts);
  // Without an instance there is nothing to count.
  if (!fault.starts_with("vkCreateInstance"))
    CHECK(counts.starts_with("violations 0\ninjected 1\nlive 0\n"));
  table().add(words[0], fault, line_of(outcome));
}

TEST_CASE("distance: each Vulkan function fails") {
  layer();
  const Words words = pair();
  const std::string answer = interval_in(run(words).out);
  const std::vector<std::string> faults = first_faults(words);
  REQUIRE(faults.size() > 25);
  for (const std::string& fault : faults) try_fault(words, fault, answer);
}

TEST_CASE("doctor, demo and both ways: the device is lost, or has no memory") {
  layer();
  for (const char* fault :
       {"vkQueueSubmit:1:VK_ERROR_DEVICE_LOST", "vkWaitForFences:2:VK_ERROR_DEVICE_LOST",
        "vkAllocateMemory:2:VK_ERROR_OUT_OF_DEVICE_MEMORY"})
    try_fault({"doctor"}, fault, "");
  try_fault({"demo", "--no-cache"}, "vkWaitForFences:3:VK_ERROR_DEVICE_LOST", "");
  try_fault(pair() + Words{"--symmetric"}, "vkQueueSubmit:2:VK_ERROR_DEVICE_LOST", "");
}

// The requested layer features are there: otherwise the tests above would prove nothing.
TEST_CASE("the layer lowers, hides, and holds the program to it") {
  layer();
  unsetenv("VKH_LAYER_KEEP_GOING");
  const auto ends = [](const char* name, const char* value) {
    const Watchdog watchdog;
    setenv(name, value, 1);
    const Outcome outcome = finish(start(pair()));
    unsetenv(name);
    CAPTURE(value);
    CHECK(outcome.exit_code != 0);
    return outcome.err;
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(ends("VKH_LAYER_LIMITS", "apiVersion=1.1"), "Vulkan 1.2 is missing"));
  CHECK(has(ends("VKH_LAYER_LIMITS", "maxComputeSharedMemorySize=1024"), "shared memory"));
  CHECK(has(ends("VKH_LAYER_HIDE", "scalarBlockLayout"), "scalarBlockLayout is missing"));
  CHECK(has(ends("VKH_LAYER_LIMITS", "maxMemoryAllocationSize=65536"), "maxMemoryAllocationSize"));
  CHECK(has(ends("VKH_LAYER_LIMITS", "maxStorageBufferRnage=1"), "makes no sense"));
  CHECK(has(ends("VKH_LAYER_FAIL", "vkQueueSubmit:1:VK_ERROR_MEMORY_MAP_FAILED"), "no sense"));
  setenv("VKH_LAYER_KEEP_GOING", "1", 1);
}

#ifndef VKH_SANITIZED  // their run time comes first in a process, or not at all
TEST_CASE("distance: the program's own allocations fail") {
  const Words words = pair();
  const std::string answer = interval_in(run(words).out);
  const std::string count = folder() / "allocations";
  const std::pair<const char*, std::string> preload{"LD_PRELOAD", VKH_PRELOAD_NEW};
  REQUIRE(run_with(words, {preload, {"VKH_COUNT_NEW", count}}).exit_code == 0);
  const uint64_t all = std::stoull(read_file(count));
  REQUIRE(all > 500);
  const char* wanted = std::getenv("VKH_FAULTS");
  const bool is_long = wanted != nullptr && std::string(wanted) == "all";
  const uint64_t places = is_long ? std::min<uint64_t>(all, 400) : 24;
  for (uint64_t i = 0; i < places; ++i) {
    const std::string n =
        std::to_string(1 + i * (all - 1) / (places - 1)) + (i % 2 == 0 ? "" : "+");
    CAPTURE(n);
    const Outcome outcome = run_with(words, {preload, {"VKH_FAIL_NEW", n}});
    check_ended(outcome, answer);
    table().add(words[0], "allocation " + n + " of " + std::to_string(all), line_of(outcome));
  }
}
#endif

}  // namespace
