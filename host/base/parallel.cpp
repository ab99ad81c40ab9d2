#include "host/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

#include "host/base/float_environment.h"

namespace vkh {

namespace {

std::atomic<size_t> thread_limit = 0;

}  // namespace

size_t thread_count() {
  constexpr size_t kMostThreads = 64;
  const size_t limit = thread_limit;
  const size_t cores = std::thread::hardware_concurrency();
  return std::clamp<size_t>(limit != 0 ? limit : cores, 1, kMostThreads);
}

void limit_threads(size_t threads) { thread_limit = threads; }

size_t threads_for(uint64_t bytes) {
  constexpr uint64_t kEach = uint64_t{1} << 19;
  return std::clamp<size_t>(static_cast<size_t>(bytes / kEach), 1, thread_count());
}

void for_each_index(size_t count, const std::function<void(size_t)>& work, size_t threads) {
  std::atomic<size_t> next = 0;
  std::mutex one_at_a_time;
  size_t least = count;
  std::exception_ptr error;
  const auto some = [&] {
    const FloatEnvironment ours;  // not every system gives a new thread this thread's
    for (size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {  // each earlier item was taken, and its thread ends it
        const std::lock_guard lock(one_at_a_time);
        if (i < least) error = std::current_exception();
        least = std::min(i, least);
        return;
      }
    }
  };
  std::vector<std::future<void>> shares = {};
  shares.push_back(std::async(std::launch::deferred, some));  // runs here, when it is waited for
  for (size_t i = 1; i < std::min(threads, count); ++i)
    shares.push_back(std::async(std::launch::async | std::launch::deferred, some));
  for (std::future<void>& share : shares) share.wait();
  for (std::future<void>& share : shares) share.get();
  if (error) std::rethrow_exception(error);
}

void for_each_range_of(size_t size, size_t count, const RangeWork& work) {
  for_each_index((count + size - 1) / size,
                 [&](size_t i) { work(i, i * size, std::min((i + 1) * size, count)); });
}

void copy_together(void* to, const void* from, size_t bytes) {
  constexpr size_t kPiece = size_t{1} << 22;  // 0.4 ms
  for_each_range_of(kPiece, bytes, [&](size_t, size_t begin, size_t end) {
    std::memcpy(static_cast<std::byte*>(to) + begin, static_cast<const std::byte*>(from) + begin,
                end - begin);
  });
}

}  // namespace vkh
