// distance_over and closest_over: one question on several devices. They use two drivers if
// VKH_TEST_SECOND_DEVICE names one; otherwise two logical devices of one.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "host/solve/held_pairs.h"
#include "tests/shapes/hard_pairs.h"
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/together.h"

namespace {

using namespace vkh;
using namespace vkh::test;

DeviceRequest second_request() {
  const char* name = std::getenv("VKH_TEST_SECOND_DEVICE");
  const char* validation = std::getenv("VKH_VALIDATION");
  return {.selector = name != nullptr ? name : "",
          .validation = validation != nullptr && *validation != '\0'};
}

struct Other {
  Device device{second_request()};
  Solver solver{device};
};

Other& other() {
  static Other& one = kept<Other>();
  return one;
}

std::vector<Solver*> both() { return {&solver(), &other().solver}; }

std::vector<ReferencePair> pairs() {
  std::vector<ReferencePair> all;
  all.push_back(with_reference("spheres", icosphere(1.0, 2),
                               translated(icosphere(1.1, 3), {0.1, 0.2, 0.05})));
  all.push_back(with_reference("field", height_field(24, 1), height_field(24, 3)));
  all.push_back(with_reference("far", translated(soup(1, 40), {5e5, 0, -3e5}),
                               translated(soup(2, 60), {5e5, 0, -3e5})));
  all.push_back(with_reference("noise", noisy(icosphere(1, 3), 0.02, 1), icosphere(1, 3)));
  all.push_back(with_reference("itself", height_field(8, 1), height_field(8, 1)));
  return all;
}

/// Enough points for several shares of each device, some of them far away.
std::vector<DVec3> scattered_points() {
  std::vector<DVec3> points;
  for (const Mesh& mesh : {soup(5, 12'000), translated(soup(6, 40), {1e9, 0, 0})})
    points.insert(points.end(), mesh.vertices.begin(), mesh.vertices.end());
  return points;
}

bool has_row_of(const ClosestPoints& found, const ClosestPoints& alone, size_t i) {
  return found.lower[i] == alone.lower[i] && found.upper[i] == alone.upper[i] &&
         found.points[i] == alone.points[i] && found.faces[i] == alone.faces[i];
}

}  // namespace

TEST_CASE("closest points over two devices have the bits that one of them finds alone") {
  const Mesh b = noisy(icosphere(1, 3), 0.02, 1);
  const std::vector<DVec3> points = scattered_points();
  const ClosestPoints first = solver().closest(b, points),
                      second = other().solver.closest(b, points);
  const PreparedMesh on_first = solver().prepare(b), on_second = other().solver.prepare(b);
  const std::vector<const PreparedMesh*> prepared{&on_first, &on_second};
  for (const ClosestPoints& found :
       {closest_over(both(), b, points), closest_over(both(), prepared, points)}) {
    REQUIRE(found.lower.size() == points.size());
    size_t strangers = 0;
    for (size_t i = 0; i < points.size(); ++i)
      strangers += has_row_of(found, first, i) || has_row_of(found, second, i) ? 0 : 1;
    CHECK(strangers == 0);
  }
  CHECK(closest_over(both(), b, {}).lower.empty());
}

TEST_CASE("closest points over devices: who calls them off, and what is wrong") {
  const Mesh b = icosphere(1, 3);
  std::vector<DVec3> points = scattered_points();
  const auto here = std::this_thread::get_id();
  size_t most = 0;
  closest_over(both(), b, points, [&](size_t done) {
    CHECK(std::this_thread::get_id() == here);
    CHECK(done >= most);
    most = done;
    return true;
  });
  CHECK(most > 0);
  CHECK(most <= points.size());
  CHECK_THROWS_AS(closest_over(both(), b, points, [](size_t) { return false; }), Interrupted);
  const auto enough = [](size_t) -> bool { throw std::runtime_error("enough"); };
  CHECK_THROWS_WITH(closest_over(both(), b, points, enough), "enough");
  CHECK_THROWS_AS(closest_over({}, b, points), UsageError);
  const PreparedMesh one = solver().prepare(b);
  const std::vector<const PreparedMesh*> too_few{&one};
  CHECK_THROWS_AS(closest_over(both(), too_few, points), UsageError);
  points.back().y = NAN;
  CHECK_THROWS_WITH_AS(closest_over(both(), b, points),
                       doctest::Contains(("row " + std::to_string(points.size() - 1)).c_str()),
                       InputError);
}

TEST_CASE("two devices enclose what one does, and close it") {
  for (const ReferencePair& pair : pairs()) {
    CAPTURE(pair.name);
    for (const double tolerance : {1e-3, 1e-6, 1e-8}) {
      CAPTURE(tolerance);
      SolveOptions options;
      options.tolerance = tolerance;
      const Report alone = solver().distance(pair.a, pair.b, options);
      const Report r = distance_over(both(), pair.a, pair.b, options);
      CHECK(r.status == alone.status);
      CHECK(r.tolerance == alone.tolerance);
      CHECK(interval(r).meets(pair.exact));
      CHECK(interval(r).meets(interval(alone)));
      CHECK(r.mesh_a.faces == pair.a.faces.size());
      CHECK(r.more_devices.size() <= 1);
      CHECK(r.left_out.empty());
      CHECK(r.witness_a.face < pair.a.faces.size());
    }
  }
}

/// The number of pairs of each family of hard pairs, from $VKH_TEST_SEEDS.
TEST_CASE("hard pairs: never a false interval, and closed where one device closes") {
  const char* text = std::getenv("VKH_TEST_SEEDS");
  const uint64_t seeds = text != nullptr ? std::strtoull(text, nullptr, 10) : 1;
  size_t closed = 0, wider = 0;
  for (size_t family = 0; family < family_names().size(); ++family) {
    for (uint64_t seed = 0; seed < seeds; ++seed) {
      const HardPair hard = hard_pair(family, 7000 + seed);
      CAPTURE(family_names()[family]);
      CAPTURE(seed);
      SolveOptions options;
      options.tolerance = hard.tolerance;
      const Report alone = solver().distance(hard.pair.a, hard.pair.b, options);
      const Report r = distance_over(both(), hard.pair.a, hard.pair.b, options);
      CHECK(interval(r).meets(interval(alone)));
      if (hard.exact) CHECK(interval(r).contains(*hard.exact));
      closed += r.status == Status::kClosed ? 1 : 0;
      wider += alone.status == Status::kClosed && r.status != Status::kClosed ? 1 : 0;
    }
  }
  CHECK(closed > 0);
  CHECK(wider == 0);
}

TEST_CASE("the distance of v and its lid, whose vertices say 0") {
  const Report r = distance_over(both(), v_lid(), v_sheet());
  CHECK(r.lower <= v_lid_distance());
  CHECK(r.upper >= v_lid_distance());
  CHECK(r.status == Status::kClosed);
}

TEST_CASE("more devices than faces, the same device twice, one, none") {
  const Mesh one = single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), b = soup(2, 80);
  const Interval exact = reference_hausdorff(one, b, 1e-9);
  Solver third(test_device());
  const std::vector<Solver*> three{&solver(), &other().solver, &third};
  CHECK(interval(distance_over(three, one, b)).meets(exact));
  const std::vector<Solver*> twice{&solver(), &solver()};
  CHECK(interval(distance_over(twice, one, b)).meets(exact));
  const std::vector<Solver*> alone{&solver()};
  check_same(distance_over(alone, one, b), solver().distance(one, b));
  CHECK_THROWS_AS(distance_over({}, one, b), UsageError);
  SolveOptions wrong;
  wrong.tolerance = -1;
  CHECK_THROWS_AS(distance_over(both(), soup(1, 40), b, wrong), UsageError);
}

TEST_CASE("nothing is lost of A") {
  const Mesh a = noisy(icosphere(1, 3), 0.02, 1), b = icosphere(1, 3);
  SolveOptions options;
  options.engine.coverage = true;
  const Report r = distance_over(both(), a, b, options);
  REQUIRE(r.coverage_check.has_value());
  CHECK(r.coverage_check->holds);
  CHECK(r.coverage_check->whole == a.faces.size());
}

TEST_CASE("budgets and Ctrl-C leave a true interval") {
  const Mesh a = height_field(24, 1), b = height_field(24, 3);
  const Interval exact = reference_hausdorff(a, b, 1e-9);
  SolveOptions options;
  options.tolerance = 1e-9;
  options.wave_limit = 2;
  Report r = distance_over(both(), a, b, options);
  CHECK(r.status == Status::kWaves);
  CHECK(interval(r).meets(exact));
  options.wave_limit = UINT32_MAX;
  options.time_limit_s = 1e-9;
  r = distance_over(both(), a, b, options);
  CHECK(r.status == Status::kTime);
  CHECK(interval(r).meets(exact));
  options.time_limit_s = INFINITY;
  options.memory_bytes = 64 << 10;  // more than one submission
  std::atomic<int> inside = 0, calls = 0;
  options.progress = [&](const Progress& progress) {
    CHECK(++inside == 1);  // one at a time
    CHECK(progress.lower <= progress.upper);
    CHECK(progress.lower <= exact.upper);
    CHECK(progress.upper >= exact.lower);
    --inside;
    return ++calls < 4;
  };
  r = distance_over(both(), a, b, options);
  CHECK(r.status == Status::kCancelled);
  CHECK(interval(r).meets(exact));
}

TEST_CASE("what the caller throws comes out once all runs have ended, and all goes on to work") {
  const Mesh a = height_field(24, 1), b = height_field(24, 3);
  SolveOptions options;
  options.memory_bytes = 64 << 10;
  options.progress = [](const Progress&) -> bool { throw std::runtime_error("enough"); };
  CHECK_THROWS_WITH(distance_over(both(), a, b, options), "enough");
  CHECK(distance_over(both(), a, b).status == Status::kClosed);
}

TEST_CASE("a limit is decided, and one that is beyond ends all") {
  const Mesh a = noisy(icosphere(1, 3), 0.02, 1), b = icosphere(1, 3);
  const Interval exact = reference_hausdorff(a, b, 1e-9);
  SolveOptions options;
  options.limit = {1.5 * exact.upper, 1.5 * exact.upper};
  Report r = distance_over(both(), a, b, options);
  CHECK(verdict_of(r.lower, r.upper, options.limit) == Verdict::kWithin);
  options.limit = {0.5 * exact.lower, 0.5 * exact.lower};
  r = distance_over(both(), a, b, options);
  CHECK(verdict_of(r.lower, r.upper, options.limit) == Verdict::kBeyond);
  CHECK(interval(r).meets(exact));
}

TEST_CASE("what becomes known between submissions prunes, and nothing known changes no bit") {
  const Mesh a = height_field(48, 1), b = height_field(48, 3);
  SolveOptions options;
  options.memory_bytes = 256 << 10;  // many submissions
  const Report alone = solver().distance(a, b, options);
  const auto with = [&](const std::function<double()>& known_since) {
    return distance_since(solver(), {a, b}, options, known_since);
  };
  check_same(with([] { return 0.0; }), alone);
  int asked = 0;
  const Report pruned = with([&] { return ++asked > 1 ? 2 * alone.upper : 0; });
  CHECK(asked > 1);
  CHECK(pruned.candidates < alone.candidates);
  CHECK(interval(pruned).meets(interval(alone)));
}

TEST_CASE("the layer has nothing to say") { CHECK(other().device.validation_messages() == 0); }
