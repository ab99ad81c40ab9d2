// The promises to a program that embeds vkh::Solver: B kept for many A's, a device of its own, both
// directions in one call.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "host/gpu/vulkan_api.h"
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/frame.h"

namespace {

using namespace vkh;
using namespace vkh::test;

std::string text(const Report& r) {
  return std::string(status_name(r.status)) + " [" + std::to_string(r.lower) + ", " +
         std::to_string(r.upper) + "]";
}

struct Kind {
  std::string name;
  Mesh mesh;
};

// A's for one B of about unit size: inside it, across it, around it, far away, tiny, in float64.
std::vector<Kind> many_a() {
  return {{"like B", icosphere(1.0, 2)},
          {"inside", translated(icosphere(0.1, 1), {0.3, -0.2, 0.1})},
          {"beside", translated(icosphere(1.0, 2), {2.5, 0, 0})},
          {"around", icosphere(3.0, 2)},
          {"float32 soup", in_float32(soup(1, 40))},
          {"tiny", scaled(icosphere(1.0, 1), -20)},
          {"a point", single_triangle({0.1, 0.2, 0.7}, {0.1, 0.2, 0.7}, {0.1, 0.2, 0.7})},
          {"far away", translated(icosphere(1.0, 2), {1e6, 0, 0})},
          {"huge", icosphere(1e9, 1)}};
}

}  // namespace

// --- B kept ---

TEST_CASE("many A's against one prepared B: each interval holds the distance") {
  for (const bool rounded : {false, true}) {
    CAPTURE(rounded);
    const Mesh b =
        rounded ? in_float32(height_field(16, 1)) : translated(height_field(16, 1), {0.1, 0, 0});
    const PreparedMesh prepared = solver().prepare(b);
    for (const auto& [name, a] : many_a()) {
      const auto& called = name;
      CAPTURE(called);
      const Report r = solver().distance(a, prepared);
      const Report plain = solver().distance(a, b);
      CAPTURE(text(r));
      CAPTURE(text(plain));
      const double size = diagonal(joined(a, b));
      CHECK(interval(r).meets(reference_hausdorff(a, b, 1e-10 * size)));
      CHECK(interval(r).meets(interval(plain)));
      // Below the resolution of 48 bits in a frame, the frame decides whether a run closes.
      if (plain.tolerance > 1e-9 * size) CHECK(r.status == plain.status);
      if (prepared.serves(a)) {
        CHECK(r.times.hierarchy_ms == 0);  // it was built before
      } else {
        check_same(r, plain);
      }
      CHECK(plain.times.hierarchy_ms > 0);
    }
  }
}

TEST_CASE("a prepared B serves what is near it, and falls back for what is not") {
  const PreparedMesh prepared = solver().prepare(icosphere(1.0, 2));
  CHECK(prepared.mesh().faces.size() == 320);
  CHECK(prepared.serves(icosphere(1.0, 1)));
  CHECK(prepared.serves(icosphere(3.0, 1)));
  CHECK(prepared.serves(scaled(icosphere(1.0, 1), -60)));
  CHECK_FALSE(prepared.serves(icosphere(9.0, 1)));
  CHECK_FALSE(prepared.serves(translated(icosphere(1.0, 1), {100, 0, 0})));
  const Mesh point = single_triangle({5, 5, 5}, {5, 5, 5}, {5, 5, 5});
  const Mesh near = translated(icosphere(1e-9, 1), {5, 5, 5});
  const PreparedMesh prepared_point = solver().prepare(point);
  CHECK_FALSE(prepared_point.serves(near));
  check_same(solver().distance(near, prepared_point), solver().distance(near, point));
}

TEST_CASE("an answer does not depend on the A's before it") {
  const PreparedMesh prepared = solver().prepare(height_field(16, 1));
  std::vector<Report> first;
  for (const auto& [name, a] : many_a()) first.push_back(solver().distance(a, prepared));
  const std::vector<Kind> again = many_a();
  for (size_t i = again.size(); i-- > 0;) {
    CAPTURE(again[i].name);
    check_same(solver().distance(again[i].mesh, prepared), first[i]);
  }
}

TEST_CASE("several B's are kept at once, outlive each other, and may be moved") {
  const Mesh a = icosphere(1.0, 2);
  std::vector<PreparedMesh> kept;
  std::vector<Mesh> meshes = {icosphere(1.1, 3), cube(0.5), v_sheet()};
  for (const Mesh& b : meshes) kept.push_back(solver().prepare(b));
  for (size_t i = 0; i < kept.size(); ++i) {
    CHECK(interval(solver().distance(a, kept[i])).meets(interval(solver().distance(a, meshes[i]))));
  }
  kept.erase(kept.begin());
  CHECK(interval(solver().distance(a, kept[0])).meets(interval(solver().distance(a, meshes[1]))));
  // Another solver of the same device, with other switches.
  Solver other(test_device());
  SolveOptions options;
  options.engine.disabled = {"u3"};
  CHECK(interval(other.distance(a, kept[1], options))
            .meets(interval(solver().distance(a, meshes[2]))));
}

TEST_CASE("budgets hold for a prepared B, too") {
  const Mesh b = height_field(24, 3);
  const Mesh a = height_field(24, 1);
  const Interval exact = reference_hausdorff(a, b, 1e-9);
  const PreparedMesh prepared = solver().prepare(b);
  SolveOptions options;
  options.wave_limit = 1;
  const Report one = solver().distance(a, prepared, options);
  CHECK(one.status == Status::kWaves);
  CHECK(interval(one).meets(exact));
  options = {};
  options.memory_bytes = 64 << 10;
  int calls = 0;
  options.progress = [&](const Progress&) { return ++calls < 2; };
  const Report cancelled = solver().distance(a, prepared, options);
  CHECK(cancelled.status == Status::kCancelled);
  CHECK(calls == 2);
  CHECK(interval(cancelled).meets(exact));
  // A caller may leave by an exception; the solver is then as good as new.
  options.progress = [](const Progress&) -> bool { throw std::runtime_error("enough"); };
  CHECK_THROWS_WITH(solver().distance(a, prepared, options), "enough");
  CHECK(solver().distance(a, prepared).status == Status::kClosed);
}

// --- Adopted device ---

namespace {

void check_refused(const AdoptedDevice& adopted, const std::string& reason) {
  try {
    const Device device(adopted);
    FAIL("accepted");
  } catch (const DeviceError& error) {
    CHECK_MESSAGE(std::string(error.what()).find(reason) != std::string::npos, error.what());
  }
}

}  // namespace

TEST_CASE("somebody else's device gives the same answers and is left as it was") {
  // The validation layer, where it is on, reports objects that are left when this one is destroyed.
  auto theirs = std::make_unique<Device>(
      DeviceRequest{.selector = "", .validation = std::getenv("VKH_VALIDATION") != nullptr});
  const Mesh a = icosphere(1.0, 2);
  const Mesh b = translated(icosphere(1.1, 3), {0.1, 0.2, 0.05});
  Report embedded;
  {
    Device ours(handles_of(*theirs));
    CHECK(ours.description().name == theirs->description().name);
    CHECK(ours.handle() == theirs->handle());
    Solver solver(ours);
    const PreparedMesh prepared = solver.prepare(b);
    embedded = solver.distance(a, b);
    CHECK(interval(solver.distance(a, prepared)).meets(interval(embedded)));
  }
  check_same(solver().distance(a, b), embedded);
  CHECK(theirs->vk().DeviceWaitIdle(theirs->handle()) == VK_SUCCESS);  // still there
  CHECK(theirs->validation_messages() == 0);
}

TEST_CASE("two threads share one adopted queue under its mutex") {
  std::mutex queue_mutex;
  AdoptedDevice handles = handles_of(test_device());
  handles.queue_mutex = &queue_mutex;
  const Mesh a = height_field(16, 1);
  const Mesh b = height_field(16, 2);
  const Report expected = solver().distance(a, b);
  std::vector<Report> reports(2);
  std::vector<std::thread> threads;
  for (Report& report : reports) {
    threads.emplace_back([&handles, &a, &b, &report] {
      Device device(handles);
      Solver mine(device);
      for (int repeat = 0; repeat < 3; ++repeat) report = mine.distance(a, b);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Report& report : reports) check_same(report, expected);
}

TEST_CASE("an adopted device that cannot be used is refused with the reason") {
  const AdoptedDevice good = handles_of(test_device());
  AdoptedDevice bad = good;
  bad.queue = VK_NULL_HANDLE;
  check_refused(bad, "a handle is null");
  bad = good;
  bad.get_instance_proc_addr = nullptr;
  check_refused(bad, "a handle is null");
  bad = good;
  bad.queue_family = 99;
  check_refused(bad, "queue family 99");
}

// --- Both directions ---

TEST_CASE("symmetric: the larger direction, the other pruned by it, all of it true") {
  const struct {
    std::string name;
    Mesh a, b;
  } pairs[] = {
      {"twin", height_field(24, 1), height_field(24, 3)},
      {"a sphere and a field", icosphere(0.5, 3), translated(height_field(40, 2), {0.3, 0, 0})},
      {"a cap", joined(height_field(40, 1), translated(cube(0.1), {0, 0, 0.4})),
       height_field(40, 2)},
      {"soups", soup(1, 60), soup(2, 80)},
      {"V", v_lid(), v_sheet()}};
  for (const auto& [name, a, b] : pairs) {
    const auto& called = name;
    CAPTURE(called);
    const Report there = solver().distance(a, b);
    SolveOptions absolute;
    absolute.tolerance = there.tolerance;
    absolute.tolerance_is_absolute = true;
    const Report back = solver().distance(b, a, absolute);
    const SymmetricReport both = solver().symmetric(a, b);
    CAPTURE(text(back));
    CAPTURE(text(both.b_to_a));
    check_same(both.a_to_b, there);
    CHECK(both.b_to_a.known_lower == there.lower);
    CHECK(interval(both.b_to_a).meets(interval(back)));
    CHECK(both.b_to_a.candidates <= back.candidates);
    const vkh::CertifiedInterval whole = both.interval();
    CHECK(whole.lower <= std::max(there.upper, back.upper));
    CHECK(whole.upper >= std::max(there.lower, back.lower));
    CHECK(whole.status == Status::kClosed);
    CHECK(whole.upper - whole.lower <= there.tolerance);
  }
}

TEST_CASE("what the other direction exceeds is never refined") {
  // One far cube decides h(A,B); the reverse direction, two height fields apart, takes waves by
  // itself.
  const Mesh b = height_field(40, 2);
  const Mesh a = joined(height_field(40, 1), translated(cube(0.1), {0, 0, 0.4}));
  const SymmetricReport both = solver().symmetric(a, b);
  const Report back = solver().distance(b, a);
  CHECK(back.waves > 1);
  CHECK(both.b_to_a.status == Status::kPruned);
  CHECK(both.b_to_a.waves == 1);
  CHECK(both.b_to_a.candidates < back.candidates);
  CHECK(both.b_to_a.upper <= both.a_to_b.lower + both.a_to_b.tolerance);
}

TEST_CASE("symmetric runs keep to their budgets and say which direction is under way") {
  const Mesh a = height_field(24, 1);
  const Mesh b = height_field(24, 3);
  SolveOptions options;
  options.memory_bytes = 64 << 10;
  bool forward = false, back = false;
  options.progress = [&](const Progress& p) {
    (p.back ? back : forward) = true;
    CHECK((!p.back || forward));
    return true;
  };
  CHECK(solver().symmetric(a, b, options).interval().status == Status::kClosed);
  CHECK(forward);
  CHECK(back);
  int calls = 0;
  options.progress = [&](const Progress&) { return ++calls < 1; };
  const SymmetricReport cancelled = solver().symmetric(a, b, options);
  CHECK(calls == 1);  // the reverse direction does not call it again
  CHECK(cancelled.a_to_b.status == Status::kCancelled);
  const Interval exact_there = reference_hausdorff(a, b, 1e-9);
  const Interval exact_back = reference_hausdorff(b, a, 1e-9);
  const vkh::CertifiedInterval whole = cancelled.interval();
  CHECK(whole.lower <= std::max(exact_there.upper, exact_back.upper));
  CHECK(whole.upper >= std::max(exact_there.lower, exact_back.lower));
}

TEST_CASE("a known lower bound that is no bound costs width, not truth") {
  const Mesh a = height_field(24, 1);
  const Mesh b = height_field(24, 3);
  const Interval exact = reference_hausdorff(a, b, 1e-9);
  for (const double factor : {0.5, 0.999, 1.0, 1.1, 3.0, 1e9}) {
    CAPTURE(factor);
    SolveOptions options;
    options.known_lower = factor * exact.upper;
    const Report r = solver().distance(a, b, options);
    CAPTURE(text(r));
    CHECK(interval(r).meets(exact));
    CHECK((r.status == Status::kClosed || r.status == Status::kPruned));
    if (r.status == Status::kPruned) CHECK(r.upper <= options.known_lower + r.tolerance);
  }
  SolveOptions wrong;
  wrong.known_lower = -1;
  CHECK_THROWS_AS(solver().distance(a, b, wrong), UsageError);
}
