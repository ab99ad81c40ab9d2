// Threads that share out one job, which may be called off, and the memory that they fill.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "host/base/large_pages.h"
#include "host/base/parallel.h"

namespace vkh {

class ThreadPool {
 public:
  ThreadPool() = default;
  /// Uses one thread per core for `threads` of 0. One thread at a time calls `keep_going`, and none
  /// after it has returned false. Then every call of the pool ends with Interrupted, whose text is
  /// `called_off`.
  ThreadPool(size_t threads, std::function<bool()> keep_going, std::string called_off)
      : threads_(threads == 0 ? thread_count() : threads),
        keep_going_(std::move(keep_going)),
        called_off_(std::move(called_off)) {}
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  size_t threads() const { return threads_; }

  /// Throws Interrupted once `keep_going` returned false.
  void check_going() const;

  /// Calls work(0) to work(count - 1), several at once. If one throws, no more are begun.
  void for_each(size_t count, const std::function<void(size_t)>& work) const;

  /// Elements of a part, 0.1 to 1 ms of work: enough to be worth a thread, and to be called off in
  /// time.
  static constexpr size_t kPart = size_t{1} << 14;
  static constexpr size_t parts_of(size_t count) { return (count + kPart - 1) / kPart; }

  /// Calls work(part, begin, end) for the elements 0 to count - 1, kPart at a time: the same parts
  /// on any number of threads.
  void for_parts(size_t count, const RangeWork& work) const;

  /// The sum over the parts of work(begin, end).
  size_t sum_parts(size_t count, const std::function<size_t(size_t, size_t)>& work) const;

 private:
  size_t threads_ = thread_count();
  std::function<bool()> keep_going_;
  std::string called_off_;
  mutable std::mutex asking_;
  mutable std::atomic<bool> stopped_ = false;
};

/// Memory for `size` plain values, which are not set yet.
template <class T>
class Array {
 public:
  Array() = default;
  explicit Array(size_t size) : data_(new T[size]), size_(size) {
    prefer_large_pages(data_.get(), size * sizeof(T));
  }

  size_t size() const { return size_; }
  T* data() const { return data_.get(); }
  T& operator[](size_t i) const { return data_[i]; }
  T* begin() const { return data(); }
  T* end() const { return data() + size_; }

 private:
  std::unique_ptr<T[]> data_;
  size_t size_ = 0;
};

/// An array of `size` copies of `value`.
template <class T>
Array<T> filled(const ThreadPool& pool, size_t size, T value) {
  Array<T> array(size);
  pool.for_parts(size, [&](size_t, size_t begin, size_t end) {
    std::fill(array.begin() + begin, array.begin() + end, value);
  });
  return array;
}

/// Resizes an empty vector, and can be called off. A system gives out memory page by page at the
/// first write, which takes longer than writing: so each thread touches some pages.
template <class T>
void resize_together(const ThreadPool& pool, std::vector<T>& vector, size_t size) {
  constexpr size_t kPage = 4096;
  vector.reserve(size);
  prefer_large_pages(vector.data(), size * sizeof(T));
  auto* const bytes = reinterpret_cast<std::byte*>(vector.data());
  pool.for_parts(size, [&](size_t, size_t begin, size_t end) {
    for (size_t at = begin * sizeof(T); at < end * sizeof(T); at += kPage)
      new (bytes + at) std::byte{0};
  });
  constexpr size_t kStep = size_t{1} << 20;  // 10 ms at most
  while (vector.size() < size) {
    pool.check_going();
    vector.resize(std::min(size, vector.size() + kStep));
  }
}

/// Turns counts of parts into the offsets where each part begins; returns the sum.
size_t starts_of(std::vector<size_t>& counts);

}  // namespace vkh
