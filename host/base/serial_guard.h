// A guard that one thread at a time may hold.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>

#include "vkhausdorff/error.h"

namespace vkh {

class SerialGuard {
 public:
  /// Waits while other threads hold the guard. Throws UsageError if this thread already holds it,
  /// since it would wait forever.
  class Hold {
   public:
    explicit Hold(SerialGuard& guard) : guard_(guard) {
      if (guard.owner_ == std::this_thread::get_id())
        throw UsageError("a progress callback started another run of its own Solver");
      guard.mutex_.lock();
      guard.owner_ = std::this_thread::get_id();
    }
    ~Hold() {
      guard_.owner_ = std::thread::id();
      guard_.mutex_.unlock();
    }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    SerialGuard& guard_;
  };

 private:
  std::mutex mutex_;
  std::atomic<std::thread::id> owner_ = std::thread::id();  // a thread sees only itself here
};

}  // namespace vkh
