#include "host/base/thread_pool.h"

#include <utility>

#include "vkhausdorff/error.h"

namespace vkh {

void ThreadPool::check_going() const {
  if (!keep_going_) return;
  if (const std::unique_lock lock(asking_, std::try_to_lock); lock.owns_lock()) {
    if (!stopped_ && !keep_going_()) stopped_ = true;
  }
  if (stopped_) throw Interrupted(called_off_);
}

void ThreadPool::for_each(size_t count, const std::function<void(size_t)>& work) const {
  std::atomic<bool> failed = false;
  for_each_index(
      count,
      [&](size_t i) {
        if (failed) return;
        try {
          check_going();
          work(i);
        } catch (...) {
          failed = true;
          throw;
        }
      },
      threads_);
}

void ThreadPool::for_parts(size_t count, const RangeWork& work) const {
  for_each(parts_of(count),
           [&](size_t part) { work(part, part * kPart, std::min(count, (part + 1) * kPart)); });
}

size_t ThreadPool::sum_parts(size_t count,
                             const std::function<size_t(size_t, size_t)>& work) const {
  std::atomic<size_t> sum = 0;
  for_parts(count, [&](size_t, size_t begin, size_t end) { sum += work(begin, end); });
  return sum;
}

size_t starts_of(std::vector<size_t>& counts) {
  size_t sum = 0;
  for (size_t& count : counts) sum += std::exchange(count, sum);
  return sum;
}

}  // namespace vkh
