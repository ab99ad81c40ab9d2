// Starts work beside its caller that may be left behind when the program ends.
#pragma once

#include <future>
#include <system_error>
#include <thread>
#include <utility>

namespace vkh {

/// Leaves a thread running that nothing joins (system_posix.cpp, system_windows.cpp).
void leave_thread(std::thread thread);

/// Runs `work` on a thread of its own or, if none is available, when its result is requested. No
/// thread waits for a result that is never requested: the program must end by end_process.
template <class Work>
auto begin_now(Work work) {
  std::packaged_task<decltype(work())()> task(work);
  auto result = task.get_future();
  try {
    leave_thread(std::thread(std::move(task)));
  } catch (const std::system_error&) {
    return std::async(std::launch::deferred, work);
  }
  return result;
}

}  // namespace vkh
