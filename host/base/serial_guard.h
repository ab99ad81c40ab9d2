// What one thread at a time may use.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>

#include "host/base/error.h"

namespace vkh {

class SerialGuard {
 public:
  /// Waits for the guard of other threads. Throws UsageError within a turn of this one, which it
  /// would wait for for ever.
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
  std::atomic<std::thread::id> owner_ = std::thread::id();  // only its own thread sees itself here
};

}  // namespace vkh
