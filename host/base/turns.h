// What one thread at a time may use.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>

#include "host/base/error.h"

namespace vkh {

class Turns {
 public:
  /// Waits for the turns of other threads. Throws UsageError within a turn of this one, which it
  /// would wait for for ever.
  class Turn {
   public:
    explicit Turn(Turns& turns) : turns_(turns) {
      if (turns.owner_ == std::this_thread::get_id())
        throw UsageError("a progress callback started another run of its own Solver");
      turns.mutex_.lock();
      turns.owner_ = std::this_thread::get_id();
    }
    ~Turn() {
      turns_.owner_ = std::thread::id();
      turns_.mutex_.unlock();
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    Turns& turns_;
  };

 private:
  std::mutex mutex_;
  std::atomic<std::thread::id> owner_ = std::thread::id();  // only its own thread sees itself here
};

}  // namespace vkh
