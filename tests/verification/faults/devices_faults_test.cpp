// A device that is lost, or has no memory, while several work on one pair: the others do its part,
// or the error is reported. An interval is never false.
#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/verification/faults/trial.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/together.h"

namespace {

using namespace vkh;
using namespace vkh::test;

struct One {
  Device device{DeviceRequest{}};
  Solver solver{device};
};

/// New ones for each fault: a device that was lost stays so.
struct Two {
  std::array<One, 2> ones;
  std::vector<Solver*> solvers{&ones[0].solver, &ones[1].solver};

  explicit Two(const SolveOptions& options) {
    for (Solver* solver : solvers) solver->make_ready(options.engine);
  }
};

SolveOptions options() {
  SolveOptions out;
  out.tolerance = 1e-7;
  out.engine.fine = true;
  out.memory_bytes = 64 << 10;  // many submissions
  return out;
}

const Mesh& a() {
  static const Mesh one = height_field(16, 1);
  return one;
}
const Mesh& b() {
  static const Mesh one = height_field(16, 2);
  return one;
}
const Interval& exact() {
  static const Interval one = reference_hausdorff(a(), b(), 1e-9);
  return one;
}

/// One of the two is lost, or neither, if the call comes too late.
void check_one_lost(const std::string& fault) {
  CAPTURE(fault);
  Two two(options());
  const Watchdog watchdog;
  layer().arm(fault);
  const Report r = distance_over(two.solvers, a(), b(), options());
  const bool is_late = layer().injected() == 0;
  layer().arm("");
  CHECK(r.lower <= exact().upper);
  CHECK(r.upper >= exact().lower);
  CHECK(r.status == Status::kClosed);
  CHECK(r.left_out.size() == (is_late ? 0 : 1));
  CHECK(r.more_devices.size() == (is_late ? 1 : 0));
}

}  // namespace

TEST_CASE("a device that is lost leaves its part to the other") {
  layer();
  size_t submissions = 0;
  {
    Two two(options());
    layer().arm("");
    distance_over(two.solvers, a(), b(), options());
    submissions = layer().count("vkQueueSubmit");
  }
  REQUIRE(submissions > 6);
  for (const size_t n :
       {size_t{1}, size_t{2}, size_t{3}, size_t{5}, submissions / 2, submissions - 1})
    check_one_lost("vkQueueSubmit:" + std::to_string(n) + ":VK_ERROR_DEVICE_LOST");
  check_one_lost("vkWaitForFences:4:VK_ERROR_DEVICE_LOST");
  check_one_lost("vkQueueSubmit:4:VK_ERROR_OUT_OF_HOST_MEMORY");
}

TEST_CASE("where all are lost, that is said") {
  for (const char* from : {"1", "3", "5"}) {  // of more than six, as above
    Two two(options());
    const Watchdog watchdog;
    layer().arm("vkQueueSubmit:" + std::string(from) + "+:VK_ERROR_DEVICE_LOST");
    CHECK_THROWS_AS(distance_over(two.solvers, a(), b(), options()), DeviceError);
    layer().arm("");
  }
}

TEST_CASE("points of a device that is lost are the other's, with the same bits") {
  const std::vector<DVec3> points = soup(5, 12'000).vertices;
  ClosestPoints alone;
  {
    Two two(options());
    alone = two.solvers[0]->closest(b(), points);
  }
  for (const char* fault :
       {"vkQueueSubmit:1", "vkQueueSubmit:2", "vkQueueSubmit:4", "vkWaitForFences:3"}) {
    CAPTURE(fault);
    Two two(options());
    const Watchdog watchdog;
    layer().arm(std::string(fault) + ":VK_ERROR_DEVICE_LOST");
    const ClosestPoints found = closest_over(two.solvers, b(), points);
    CHECK(layer().injected() == 1);
    layer().arm("");
    CHECK(found.lower == alone.lower);
    CHECK(found.upper == alone.upper);
    CHECK(found.faces == alone.faces);
    CHECK(found.points == alone.points);
  }
  Two two(options());
  layer().arm("vkQueueSubmit:3+:VK_ERROR_DEVICE_LOST");
  CHECK_THROWS_AS(closest_over(two.solvers, b(), points), DeviceError);
  layer().arm("");
}

TEST_CASE("no memory on either is an error, and both go on to work") {
  Two two(options());
  layer().arm("vkAllocateMemory:1+:VK_ERROR_OUT_OF_DEVICE_MEMORY");
  CHECK_THROWS_AS(distance_over(two.solvers, a(), b(), options()), DeviceError);
  layer().arm("");
  CHECK(distance_over(two.solvers, a(), b(), options()).status == Status::kClosed);
}
