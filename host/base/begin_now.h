// Work that goes on beside its caller, and may be left behind when the program ends.
#pragma once

#include <future>
#include <system_error>
#include <thread>

namespace vkh {

/// Runs `work` on a thread of its own, or, where there is none to be had, when its result is asked
/// for. A result that nobody asks for is not waited for: the program must end by end_process.
template <class Work>
auto begin_now(Work work) {
  std::packaged_task<decltype(work())()> task(work);
  auto result = task.get_future();
  try {
    std::thread(std::move(task)).detach();
  } catch (const std::system_error&) {
    return std::async(std::launch::deferred, work);
  }
  return result;
}

}  // namespace vkh
