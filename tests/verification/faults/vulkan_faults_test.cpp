// Every Vulkan call that may fail, failed on purpose by the test layer with every error that it may
// return: each ends in a DeviceError or in the answer that is possible without it; nothing is left,
// and nothing that failed to be made is used.
#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "host/app/self_test.h"
#include "tests/shapes/shapes.h"
#include "tests/support/tally.h"
#include "tests/verification/faults/trial.h"
#include "vkhausdorff/device.h"
#include "vkhausdorff/solver.h"

namespace {

using namespace vkh;
using namespace vkh::test;

bool is_validated() {
  const char* text = std::getenv("VKH_VALIDATION");
  return text != nullptr && *text != '\0';
}

DeviceRequest request(bool validation) {
  layer();  // before the first instance
  const char* selector = std::getenv("VKH_TEST_DEVICE");
  return {.selector = selector != nullptr ? selector : "", .validation = validation};
}

std::string interval_text(const Report& r) {
  return "[" + hex(r.lower) + ", " + hex(r.upper) + "] " + status_name(r.status);
}

FaultTable& table() {
  static FaultTable one("vulkan");
  return one;
}

/// A wait is as many calls as it takes slices, and a run as many submissions as the clock asks for:
/// a fault for a later call may come too late. Then there is the answer.
void check_end(const std::string& what, const std::string& fault, const std::string& end,
               const std::string& answer) {
  const bool is_first = fault.find(":1:") != std::string::npos;
  const bool is_late = layer().injected() == 0 && !is_first && end == answer;
  CHECK((is_late || layer().injected() == 1));
  CHECK(layer().violations() == 0);
  CHECK((end == answer || end.starts_with("DeviceError: ")));
  table().add(what, fault, is_late ? "too late" : end == answer ? "answer" : end);
}

/// Runs `work` as it is, then with each fault. It destroys all that it makes.
void try_all(const std::string& what, const std::function<std::string()>& work,
             Places places = Places::kFour) {
  const uint32_t alive = layer().live();
  layer().arm("");
  const std::string answer = ended(work);
  CAPTURE(what);
  REQUIRE(answer.find("Error") == std::string::npos);
  REQUIRE(layer().live() == alive);
  const std::vector<std::string> faults = faults_of(layer().calls(), places);
  REQUIRE(faults.size() > 10);
  for (const std::string& fault : faults) {
    CAPTURE(fault);
    const Watchdog watchdog;
    layer().arm(fault);
    const std::string end = ended(work);
    CAPTURE(end);
    check_end(what, fault, end, answer);
    CHECK(layer().live() == alive);
  }
  layer().arm("");
}

TEST_CASE("a list of devices") {
  try_all("list", [] { return std::to_string(list_devices().size()) + " devices"; });
}

TEST_CASE("a start: instance, device, pipelines") {
  const auto work = [] {
    Device device(request(false));
    Solver solver(device);
    solver.make_ready();
    return std::string("ready");
  };
  try_all("start", work, Places::kEnds);
}

TEST_CASE("the self-test of the doctor") {
  Device device(request(is_validated()));
  const auto work = [&] {
    const SelfTestResult r = run_self_test(device);
    return r.fault.empty() ? "passed" : "Error: " + r.fault;
  };
  try_all("doctor", work, Places::kFirst);
  CHECK(device.validation_messages() == 0);
}

/// A solver that is kept, whose buffers go between two trials.
struct Kept {
  Device device{request(is_validated())};
  std::optional<Solver> solver{std::in_place, device};
  const Mesh a = noisy(icosphere(1, 2), 0.05, 1), b = icosphere(1, 2);
  SolveOptions options;

  Kept() {
    options.memory_bytes = 4 << 20;
    options.engine.coverage = true;
    solver->make_ready(options.engine);
  }

  /// A run for which there is no memory leaves the solver without buffers.
  void forget_buffers() {
    SolveOptions large = options;
    large.memory_bytes = 256 << 20;
    layer().arm("vkAllocateMemory:1+:VK_ERROR_OUT_OF_DEVICE_MEMORY");
    CHECK_THROWS_AS(solver->distance(a, b, large), DeviceError);
    layer().arm("");
  }
};

/// The same as try_all, with a solver that has to work again afterwards.
void try_kept(const std::string& what, const std::function<std::string(Kept&)>& work,
              Places places = Places::kFour) {
  {
    Kept kept;
    work(kept);  // every pipeline
    kept.forget_buffers();
    const std::string answer = ended([&] { return work(kept); });
    CAPTURE(what);
    REQUIRE(answer.find("Error") == std::string::npos);
    const std::vector<std::string> faults = faults_of(layer().calls(), places);
    REQUIRE(faults.size() > 10);
    for (const std::string& fault : faults) {
      CAPTURE(fault);
      const Watchdog watchdog;
      kept.forget_buffers();
      layer().arm(fault);
      const std::string end = ended([&] { return work(kept); });
      CAPTURE(end);
      check_end(what, fault, end, answer);
      layer().arm("");
      CHECK(ended([&] { return work(kept); }) == answer);
    }
    CHECK(kept.device.validation_messages() == 0);
  }
  CHECK(layer().violations() == 0);
  CHECK(layer().live() == 0);
}

TEST_CASE("a distance, and the same solver again") {
  try_kept("distance",
           [](Kept& k) { return interval_text(k.solver->distance(k.a, k.b, k.options)); });
}

TEST_CASE("a prepared mesh") {
  try_kept("prepared", [](Kept& k) {
    const PreparedMesh b = k.solver->prepare(k.b);
    return interval_text(k.solver->distance(k.a, b, k.options));
  });
}

TEST_CASE("two pairs at once, and both ways") {
  const auto work = [](Kept& k) {
    const std::array pairs{PairView{k.a, k.b}, PairView{k.b, k.a}};
    const std::vector<Report> reports = k.solver->distances(pairs, k.options);
    const SymmetricReport both = k.solver->symmetric(k.a, k.b, k.options);
    return interval_text(reports[0]) + interval_text(reports[1]) + interval_text(both.b_to_a);
  };
  try_kept("together", work, Places::kEnds);
}

// After the fault the solver is destroyed at once, even if the device is still busy.
TEST_CASE("a device that is lost stays lost, and goes away") {
  for (const std::string fault :
       {"vkQueueSubmit:1:VK_ERROR_DEVICE_LOST", "vkWaitForFences:2:VK_ERROR_DEVICE_LOST",
        "vkGetQueryPoolResults:1:VK_ERROR_DEVICE_LOST",
        "vkWaitForFences:1:VK_ERROR_OUT_OF_HOST_MEMORY"}) {
    CAPTURE(fault);
    const Watchdog watchdog;
    {
      Kept kept;
      const bool is_lost = std::string(fault).find("LOST") != std::string::npos;
      layer().arm(fault);
      CHECK_THROWS_AS(kept.solver->distance(kept.a, kept.b, kept.options), DeviceError);
      if (is_lost)
        CHECK_THROWS_AS(kept.solver->distance(kept.a, kept.b, kept.options), DeviceError);
      kept.solver.reset();
      CHECK(kept.device.validation_messages() == 0);
    }
    CHECK(layer().violations() == 0);
    CHECK(layer().live() == 0);
  }
}

}  // namespace
