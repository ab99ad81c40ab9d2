// Limits the bytes that may lie in memory: each reader takes its share before it reads, one after
// the other, and gives it back when it is done.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace vkh {

class ByteBudget {
 public:
  explicit ByteBudget(uint64_t bytes) : most_(bytes) {}

  /// A place in the order of take().
  uint64_t ticket() {
    const std::lock_guard lock(mutex_);
    return next_++;
  }
  /// Waits for earlier tickets, and for room; a request larger than the whole budget waits until
  /// nothing else is taken. Returns false if the budget was closed.
  bool take(uint64_t ticket, uint64_t bytes) {
    std::unique_lock lock(mutex_);
    turn_.wait(lock, [&] {
      return is_closed_ || (ticket == turn_of_ && (taken_ == 0 || taken_ + bytes <= most_));
    });
    if (is_closed_) return false;
    ++turn_of_;
    taken_ += bytes;
    largest_ = taken_ > largest_ ? taken_ : largest_;
    turn_.notify_all();
    return true;
  }
  void give(uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    taken_ -= bytes;
    turn_.notify_all();
  }
  void close() {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
    turn_.notify_all();
  }
  uint64_t largest() const {  ///< the most that was taken at a time
    const std::lock_guard lock(mutex_);
    return largest_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable turn_;
  uint64_t most_, taken_ = 0, largest_ = 0, next_ = 0, turn_of_ = 0;
  bool is_closed_ = false;
};

}  // namespace vkh
