#include "host/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "host/base/begin_now.h"
#include "host/base/float_environment.h"
#include "host/base/system.h"

namespace vkh {

namespace {

std::atomic<size_t> thread_limit = 0;

/// Threads that wait for work and never end: waking them costs less than starting new ones
/// (docs/log/startup.md).
class Helpers {
 public:
  /// Calls work(), which throws nothing, here and on `most` helpers, or on fewer if there are none.
  /// Returns when all of them have ended. A helper that comes too late does not call it.
  void share(const std::function<void()>& work, size_t most) {
    Job job(work, most);
    size_t waiting = 0;
    {
      const std::lock_guard lock(mutex_);
      jobs_.push_back(&job);
      open_ += most;
      hire();
      waiting = idle_;
    }
    for (size_t i = 0; i < std::min(most, waiting); ++i) has_work_.notify_one();
    work();
    std::unique_lock lock(mutex_);
    std::erase(jobs_, &job);
    open_ -= job.open;
    job.left.wait(lock, [&] { return job.inside == 0; });
  }

 private:
  struct Job {
    Job(const std::function<void()>& what, size_t most) : work(what), open(most) {}
    const std::function<void()>& work;
    size_t open;        // helpers that may still come
    size_t inside = 0;  // helpers that are at work
    std::condition_variable left;
  };

  // Loops that run side by side share the helpers: if each had its own, those of a batch's workers
  // would take the cores from its readers (docs/log/startup.md).
  void hire() {
    const size_t most = thread_count() - 1;
    try {
      for (; idle_ < open_ && hired_ < most; ++idle_, ++hired_)
        leave_thread(std::thread([this] { help(); }));
    } catch (...) {  // goes on with fewer
    }
  }

  [[noreturn]] void help() {
    std::unique_lock lock(mutex_);
    for (;;) {
      has_work_.wait(lock, [&] { return !jobs_.empty(); });
      Job& job = *jobs_.front();
      if (--job.open == 0) jobs_.erase(jobs_.begin());
      --open_;
      ++job.inside;
      --idle_;
      lock.unlock();
      job.work();
      lock.lock();
      ++idle_;
      if (--job.inside == 0) job.left.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable has_work_;
  std::vector<Job*> jobs_;       // with places for helpers
  size_t open_ = 0;              // those places
  size_t idle_ = 0, hired_ = 0;  // helpers
};

// It is never destroyed, since threads wait in it when the process exits. A forked process has none
// of these threads, and gets another one.
std::atomic<Helpers*> g_helpers = nullptr;
void renew_helpers() { g_helpers = new Helpers; }

Helpers& helpers() {
  [[maybe_unused]] static const bool is_made = [] {
    renew_helpers();
    call_in_forks(renew_helpers);
    return true;
  }();
  return *g_helpers;
}

}  // namespace

size_t thread_count() {
  constexpr size_t kMostThreads = 64;
  const size_t limit = thread_limit;
  const size_t cores = std::thread::hardware_concurrency();
  return std::clamp<size_t>(limit != 0 ? limit : cores, 1, kMostThreads);
}

void limit_threads(size_t threads) { thread_limit = threads; }

size_t threads_for(uint64_t bytes) {
  constexpr uint64_t kEach = uint64_t{1} << 17;
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
  if (std::min(threads, count) > 1) {
    helpers().share(some, std::min(threads, count) - 1);
  } else {
    some();
  }
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
