// Independent pieces of work on a few threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace vkh {

/// The number of cores, within reason, or what limit_threads() set.
size_t thread_count();
/// Sets thread_count() for the whole process, from 1 to 64, for a program that shares its cores; 0:
/// the number of cores. It may be called at any time: work that has begun keeps its threads.
void limit_threads(size_t threads);

/// The number of threads worth waking to write this many bytes.
size_t threads_for(uint64_t bytes);

/// Calls work(0) to work(count - 1), in any order and several at once, here and on other threads if
/// any are available, on `threads` in all. After all calls have ended, throws the exception of the
/// least index that threw, no matter which came first. The other threads, fewer than
/// thread_count() for all calls together, wait for more work until the process ends.
void for_each_index(size_t count, const std::function<void(size_t)>& work,
                    size_t threads = thread_count());

/// Calls work(number, begin, end) for all ranges of `size` of `count` items, the last one perhaps
/// of fewer, as for_each_index does.
using RangeWork = std::function<void(size_t number, size_t begin, size_t end)>;
void for_each_range_of(size_t size, size_t count, const RangeWork& work);

constexpr size_t kBlock = size_t{1} << 15;
inline size_t block_count(size_t count) { return (count + kBlock - 1) / kBlock; }
inline void for_each_block(size_t count, const RangeWork& work) {
  for_each_range_of(kBlock, count, work);
}

/// Copies as memcpy does, on several threads if that pays.
void copy_together(void* to, const void* from, size_t bytes);

}  // namespace vkh
