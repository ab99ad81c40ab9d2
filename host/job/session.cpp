#include "host/job/session.h"

#include <chrono>

namespace vkh {

Session open_session(const std::string& selector, const SolveOptions& options,
                     const std::filesystem::path& cache_folder) {
  const auto start = std::chrono::steady_clock::now();
  Session session;
  session.device = std::make_unique<Device>(DeviceRequest{.selector = selector});
  session.solver = std::make_unique<Solver>(*session.device, cache_folder);
  session.solver->make_ready(options);
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  session.setup_ms = taken.count();
  return session;
}

}  // namespace vkh
