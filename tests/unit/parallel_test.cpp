// for_each_index: work shared by threads that wait for more, nested, failing, and in a fork.
#include "host/base/parallel.h"

#include <doctest/doctest.h>
#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace vkh;

namespace {

constexpr size_t kThreads = 4;

// As many threads as there would be on four cores, since there are no more helpers than other
// cores.
struct FourCores {
  FourCores() { limit_threads(kThreads); }
  ~FourCores() { limit_threads(0); }
};

// Waits in each of kThreads items until all have begun: no thread has two of them.
std::set<std::thread::id> threads_of_one_call() {
  const FourCores limit;
  std::mutex mutex;
  std::set<std::thread::id> threads;
  std::atomic<size_t> begun = 0;
  for_each_index(
      kThreads,
      [&](size_t) {
        {
          const std::lock_guard lock(mutex);
          threads.insert(std::this_thread::get_id());
        }
        ++begun;
        while (begun < kThreads) std::this_thread::yield();
      },
      kThreads);
  return threads;
}

size_t sum_to(size_t count) {
  std::atomic<size_t> sum = 0;
  for_each_index(
      count, [&](size_t i) { sum += i; }, kThreads);
  return sum;
}

}  // namespace

TEST_CASE("threads that have ended their work take more") {
  std::set<std::thread::id> all;
  for (int i = 0; i < 50; ++i) {
    const std::set<std::thread::id> threads = threads_of_one_call();
    CHECK(threads.size() == kThreads);
    all.insert(threads.begin(), threads.end());
  }
  CHECK(all.size() < 2 * kThreads);
}

TEST_CASE("each item is done once, in calls from several threads and within calls") {
  std::vector<std::atomic<int>> done(1000);
  std::vector<std::thread> callers;
  for (size_t caller = 0; caller < 4; ++caller) {
    callers.emplace_back([&] {
      for_each_index(
          10,
          [&](size_t ten) {
            for_each_index(
                100, [&](size_t i) { ++done[100 * ten + i]; }, kThreads);
          },
          kThreads);
    });
  }
  for (std::thread& caller : callers) caller.join();
  CHECK(std::all_of(done.begin(), done.end(), [](const auto& count) { return count == 4; }));
}

TEST_CASE("the error of the least item that failed is thrown, after all have ended") {
  for (int i = 0; i < 20; ++i) {
    std::atomic<int> inside = 0;
    const auto fail = [&](size_t item) {
      ++inside;
      if (item % 3 == 1) {
        --inside;
        throw std::runtime_error(std::to_string(item));
      }
      --inside;
    };
    CHECK_THROWS_WITH_AS(for_each_index(100, fail, kThreads), "1", std::runtime_error);
    CHECK(inside == 0);
  }
}

#ifndef _WIN32
TEST_CASE("a forked process has threads of its own") {
  CHECK(threads_of_one_call().size() == kThreads);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const bool is_right = threads_of_one_call().size() == kThreads && sum_to(1000) == 499500;
    _exit(is_right ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(sum_to(1000) == 499500);
}
#endif
