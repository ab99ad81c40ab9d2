// PairStream: every pair that is pushed is delivered once, with the answer that it has alone.
#include "vkhausdorff/stream.h"

#include <doctest/doctest.h>

#include <atomic>
#include <map>
#include <mutex>
#include <thread>

#include "host/answer/session.h"
#include "host/solve/byte_budget.h"
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using MeshPointer = std::shared_ptr<const Mesh>;

MeshPointer kept(Mesh mesh) { return std::make_shared<const Mesh>(std::move(mesh)); }

/// Pairs of different sizes and questions.
std::vector<StreamPair> pairs() {
  std::vector<StreamPair> all;
  const MeshPointer field = kept(height_field(24, 1));
  for (size_t i = 0; i < 18; ++i) {
    StreamPair pair;
    pair.number = i;
    pair.a = i % 3 == 0 ? field
                        : kept(soup(static_cast<uint32_t>(i), static_cast<uint32_t>(20 + 10 * i)));
    pair.b = i % 2 == 0 ? kept(translated(*field, {0, 0, 0.1 * static_cast<double>(i)}))
                        : kept(soup(static_cast<uint32_t>(100 + i), 60));
    pair.symmetric = i % 5 == 0;
    pair.options.tolerance = i % 4 == 0 ? 1e-4 : 1e-6;
    if (i % 6 == 1) pair.options.limit = {0.3, 0.3};
    all.push_back(std::move(pair));
  }
  return all;
}

/// A stream's deliveries, by number.
struct Sink {
  std::mutex mutex;
  std::map<size_t, StreamResult> results;
  std::function<void(StreamResult&&)> deliver() {
    return [this](StreamResult&& result) {
      const std::lock_guard lock(mutex);
      const size_t number = result.number;
      CHECK(results.emplace(number, std::move(result)).second);
    };
  }
};

}  // namespace

TEST_CASE("a stream's answers are those of each pair alone, whatever runs beside it") {
  Solver solver(test_device());
  std::vector<SymmetricReport> alone;  // one way is all that some have
  for (const StreamPair& pair : pairs()) {
    if (pair.symmetric) {
      alone.push_back(solver.symmetric(*pair.a, *pair.b, pair.options));
    } else {
      alone.emplace_back().a_to_b = solver.distance(*pair.a, *pair.b, pair.options);
    }
  }
  for (const auto& shape : {std::pair<size_t, size_t>{1, 1}, {5, 1}, {4, 3}}) {
    const size_t together = shape.first, lanes = shape.second;
    CAPTURE(together);
    CAPTURE(lanes);
    Sink sink;
    StreamOptions options;
    options.together = together;
    options.lanes = lanes;
    options.waiting = 3;
    PairStream stream(options, sink.deliver());
    for (StreamPair& pair : pairs()) CHECK(stream.push(std::move(pair)));
    stream.finish();
    CHECK(stream.devices().size() == 1);
    CHECK(stream.times().lanes_s > 0);
    REQUIRE(sink.results.size() == pairs().size());
    for (const StreamPair& pair : pairs()) {
      CAPTURE(pair.number);
      const StreamResult& found = sink.results.at(pair.number);
      REQUIRE(!found.error);
      REQUIRE(found.b_to_a.has_value() == pair.symmetric);
      check_same(found.a_to_b, alone[pair.number].a_to_b);
      if (pair.symmetric) check_same(*found.b_to_a, alone[pair.number].b_to_a);
    }
  }
}

TEST_CASE("a B that pairs share is prepared, and the answers are those of a prepared B") {
  Solver solver(test_device());
  const MeshPointer b = kept(icosphere(1.0, 3));
  Sink sink;
  PairStream stream({}, sink.deliver());
  std::vector<MeshPointer> all;
  for (int i = 0; i < 6; ++i)
    all.push_back(kept(translated(icosphere(1.0, 2), {0, 0, i < 5 ? 0.1 * i : 100.0})));
  for (size_t i = 0; i < all.size(); ++i) {
    StreamPair pair;
    pair.number = i;
    pair.a = all[i];
    pair.b = b;
    pair.shares_b = true;
    pair.symmetric = i % 2 == 1;
    stream.push(std::move(pair));
  }
  stream.finish();
  const PreparedMesh prepared = solver.prepare(*b);
  for (size_t i = 0; i < all.size(); ++i) {
    const StreamResult& result = sink.results.at(i);
    REQUIRE(result.b_to_a.has_value() == (i % 2 == 1));
    if (!result.b_to_a) {
      check_same(result.a_to_b, solver.distance(*all[i], prepared));
      continue;
    }
    const PairView view{.a = *all[i], .b = *b, .prepared = &prepared};
    const SymmetricReport both = std::move(solver.symmetrics({&view, 1})[0]);
    check_same(result.a_to_b, both.a_to_b);
    check_same(*result.b_to_a, both.b_to_a);
  }
}

TEST_CASE("an error is the pair's own, and ends nothing") {
  Sink sink;
  StreamOptions options;
  options.together = 18;
  PairStream stream(options, sink.deliver());
  for (StreamPair& pair : pairs()) {
    if (pair.number % 7 == 3) pair.options.engine.enabled = {"no such switch"};
    if (pair.number % 7 == 4) pair.options.tolerance = -1;
    stream.push(std::move(pair));
  }
  stream.finish();
  REQUIRE(sink.results.size() == pairs().size());
  for (const auto& [number, result] : sink.results) {
    const bool is_wrong = number % 7 == 3 || number % 7 == 4;
    CHECK((result.error != nullptr) == is_wrong);
    if (is_wrong) CHECK_THROWS_AS(std::rethrow_exception(result.error), UsageError);
  }
}

TEST_CASE("a pair without a mesh is that pair's error, and a stream without a device is refused") {
  Sink sink;
  PairStream stream({}, sink.deliver());
  std::vector<StreamPair> some = pairs();
  some.resize(4);
  some[1].a = nullptr;
  some[2].b = nullptr;
  some[2].shares_b = true;
  for (StreamPair& pair : some) stream.push(std::move(pair));
  stream.finish();
  REQUIRE(sink.results.size() == 4);
  for (const auto& [number, result] : sink.results)
    CHECK((result.error != nullptr) == (number == 1 || number == 2));
  CHECK_THROWS_AS(std::rethrow_exception(sink.results.at(1).error), UsageError);
  CHECK_THROWS_AS(std::rethrow_exception(sink.results.at(2).error), UsageError);
  StreamOptions nowhere;
  nowhere.devices = {};
  CHECK_THROWS_AS(PairStream(nowhere, sink.deliver()), UsageError);
}

TEST_CASE("progress names the stream's pair, and devices can be waited for") {
  Sink sink;
  PairStream stream({}, sink.deliver());
  stream.wait_until_open();
  CHECK(stream.devices().size() == 1);
  std::atomic<size_t> calls = 0, others = 0;
  for (StreamPair& pair : pairs()) {
    pair.options.progress = [&calls, &others, number = pair.number](const Progress& p) {
      ++calls;
      if (p.pair != number) ++others;
      return true;
    };
    stream.push(std::move(pair));
  }
  stream.finish();
  CHECK(calls > 0);
  CHECK(others == 0);
}

TEST_CASE("a stream that is cancelled delivers what ran, truly, and no more") {
  std::atomic<size_t> delivered = 0;
  {
    StreamOptions options;
    options.waiting = 100;
    PairStream stream(options, [&](StreamResult&& result) {
      ++delivered;
      CHECK(result.a_to_b.lower <= result.a_to_b.upper);
    });
    for (StreamPair& pair : pairs()) stream.push(std::move(pair));
    stream.cancel();
    CHECK(!stream.push(std::move(pairs()[0])));
    CHECK_NOTHROW(stream.finish());
  }
  CHECK(delivered < pairs().size());
  // A stream that is never finished ends with its running pairs.
  PairStream left({}, [](StreamResult&&) {});
  left.push(std::move(pairs()[0]));
}

TEST_CASE("devices that are not there, or named twice, are said") {
  for (const auto& [devices, all] :
       {std::pair<std::vector<std::string>, size_t>{{"no such device"}, 1}, {{"cpu", "cpu"}, 1}}) {
    StreamOptions options;
    options.devices = devices;
    PairStream stream(options, [](StreamResult&&) {});
    CHECK_THROWS_AS(
        [&] {
          for (StreamPair& pair : pairs()) stream.push(std::move(pair));
          stream.finish();
        }(),
        std::runtime_error);
  }
  CHECK(selectors_of("0,1") == std::vector<std::string>{"0", "1"});
  CHECK(selectors_of("") == std::vector<std::string>{""});
  CHECK_THROWS_AS(selectors_of("0,,1"), UsageError);
}

TEST_CASE("a budget is never exceeded, but by one that is larger than all of it") {
  ByteBudget budget(100);
  std::vector<std::thread> threads;
  std::atomic<uint64_t> taken = 0, most = 0;
  for (int i = 0; i < 40; ++i) {
    threads.emplace_back([&, i] {
      const uint64_t bytes = i % 10 == 9 ? 500 : 30;
      CHECK(budget.take(budget.ticket(), bytes));
      const uint64_t now = taken += bytes;
      CHECK((now <= 100 || now == 500));
      uint64_t before = most;
      while (before < now && !most.compare_exchange_weak(before, now)) {
      }
      std::this_thread::yield();
      taken -= bytes;
      budget.give(bytes);
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(budget.largest() == 500);
  budget.close();
  CHECK(!budget.take(budget.ticket(), 1));
}
