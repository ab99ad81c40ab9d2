// MadeOnce: values by key, each made by whichever thread asks first.
#include "host/base/made_once.h"

#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace vkh;

}  // namespace

TEST_CASE("threads that ask for one key get one value, which is made once") {
  MadeOnce<std::string, int> values;
  std::atomic<int> made = 0;
  std::vector<int> found(8);
  std::vector<std::thread> threads;
  for (int& one : found)
    threads.emplace_back([&] {
      one = values.get("key", [&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return ++made;
      });
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(made == 1);
  CHECK(found == std::vector<int>(8, 1));
  CHECK(values.get("other", [&] { return ++made; }) == 2);
}

TEST_CASE("an error is thrown to all who ask, until the value is forgotten") {
  MadeOnce<int, int> values;
  const auto fail = []() -> int { throw std::runtime_error("no"); };
  CHECK_THROWS_AS(values.get(1, fail), std::runtime_error);
  CHECK_THROWS_AS(values.get(1, [] { return 5; }), std::runtime_error);
  values.forget(1);
  CHECK(values.get(1, [] { return 5; }) == 5);
}
