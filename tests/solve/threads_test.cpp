// Several threads on one Device, and on one Solver. It runs under the validation layer,
// VKH_VALIDATION=1, which reports two threads in one queue.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr size_t kThreads = 4;
constexpr int kRepeats = 5;

void on_threads(const std::function<void(size_t)>& work) {
  std::vector<std::string> failures(kThreads);
  std::vector<std::thread> threads;
  for (size_t i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      try {
        work(i);
      } catch (const std::exception& error) {
        failures[i] = error.what();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::string& failure : failures) CHECK(failure == "");
}

/// One pair a thread, each with a distance of its own.
struct Pairs {
  std::vector<Mesh> a, b;
  std::vector<Report> expected;
  Pairs() {
    for (unsigned i = 0; i < kThreads; ++i) {
      a.push_back(height_field(12 + 4 * i, 1 + i));
      b.push_back(height_field(16, 7 + i));
      expected.push_back(solver().distance(a[i], b[i]));
    }
  }
  void check(size_t i, const Report& r) const { check_same(r, expected[i]); }
  void check(const std::vector<std::vector<Report>>& reports) const {
    for (size_t i = 0; i < kThreads; ++i) {
      CHECK(reports[i].size() == kRepeats);
      for (const Report& r : reports[i]) check(i, r);
    }
  }
};

const Pairs& pairs() {
  static const Pairs made;
  return made;
}

void check_one_device(Device& device) {
  const uint32_t before = test_device().validation_messages();
  std::vector<std::vector<Report>> reports(kThreads);
  on_threads([&](size_t i) {
    Solver mine(device);
    for (int k = 0; k < kRepeats; ++k)
      reports[i].push_back(mine.distance(pairs().a[i], pairs().b[i]));
  });
  pairs().check(reports);
  CHECK(test_device().validation_messages() == before);
}

}  // namespace

TEST_CASE("four threads, each with a Solver of its own, on one owned Device") {
  pairs();
  check_one_device(test_device());
}

TEST_CASE("four threads on one adopted Device whose owner has no mutex") {
  pairs();
  Device adopted(handles_of(test_device()));
  check_one_device(adopted);
}

TEST_CASE("four threads take turns on one Solver, and share a prepared mesh") {
  pairs();
  const uint32_t before = test_device().validation_messages();
  Solver one(test_device());
  std::vector<std::vector<Report>> reports(kThreads);
  on_threads([&](size_t i) {
    for (int k = 0; k < kRepeats; ++k)
      reports[i].push_back(one.distance(pairs().a[i], pairs().b[i]));
  });
  pairs().check(reports);

  const PreparedMesh prepared = one.prepare(pairs().b[0]);
  const Report alone = one.distance(pairs().a[1], prepared);
  std::vector<Report> shared(kThreads);
  on_threads([&](size_t i) {
    Solver mine(test_device());
    const PreparedMesh another = one.prepare(pairs().b[i]);  // while others run on it
    for (int k = 0; k < kRepeats; ++k)
      shared[i] = (i % 2 == 0 ? one : mine).distance(pairs().a[1], prepared);
  });
  for (const Report& r : shared) {
    CHECK(r.lower == alone.lower);
    CHECK(r.upper == alone.upper);
  }
  CHECK(test_device().validation_messages() == before);
}

TEST_CASE("a run started in a progress callback of its own Solver is an error, not a deadlock") {
  SolveOptions options;
  options.memory_bytes = 64 << 10;  // more than one submission
  int calls = 0;
  options.progress = [&](const Progress&) {
    ++calls;
    CHECK_THROWS_AS(solver().distance(pairs().a[0], pairs().b[0]), UsageError);
    CHECK_THROWS_AS(solver().prepare(pairs().b[0]), UsageError);
    Solver other(test_device());  // another one may run meanwhile
    pairs().check(1, other.distance(pairs().a[1], pairs().b[1]));
    return calls < 2;
  };
  const Report r = solver().distance(height_field(24, 1), height_field(24, 3), options);
  CHECK(r.status == Status::kCancelled);
  CHECK(calls == 2);
  pairs().check(0, solver().distance(pairs().a[0], pairs().b[0]));
}
