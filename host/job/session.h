// A device, a solver and its pipelines, made while the program reads its files.
#pragma once

#include <future>
#include <memory>
#include <string>
#include <system_error>
#include <thread>

#include "host/gpu/device.h"
#include "host/solve/solver.h"

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

struct Session {
  std::unique_ptr<Device> device;
  std::unique_ptr<Solver> solver;
  double setup_ms = 0;  ///< what making it took
};

/// Throws what Device and Solver throw. `cache_folder`: see Solver.
Session open_session(const std::string& selector, const SolveOptions& options,
                     const std::filesystem::path& cache_folder);

}  // namespace vkh
