// A device, a solver and its pipelines, made while the program reads its files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vkhausdorff/device.h"
#include "vkhausdorff/solver.h"

namespace vkh {

struct Opened {
  std::unique_ptr<Device> device;
  std::unique_ptr<Solver> solver;
};

struct Session {
  std::unique_ptr<Device> device;
  std::unique_ptr<Solver> solver;
  std::vector<Opened> more;  ///< the other devices, if several were asked for
  double setup_ms = 0;       ///< the time to make it
};

/// Splits "all", every GPU, or the CPU device where there is none; else names that DeviceRequest
/// takes, between commas, unless it is a device's name that has some. Throws UsageError for an
/// empty one.
std::vector<std::string> selectors_of(const std::string& text);

/// Throws what Device and Solver throw. `selector`: DeviceRequest::selector, or a text for
/// selectors_of(), if `several` may be asked for. `cache_folder`: see Solver.
Session open_session(const std::string& selector, bool several, const EngineOptions& engine,
                     const std::filesystem::path& cache_folder);

}  // namespace vkh
