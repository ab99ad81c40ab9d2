// A device, a solver and its pipelines, made while the program reads its files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vkhausdorff/device.h"
#include "vkhausdorff/solver.h"

namespace vkh {

struct Opened {
  std::unique_ptr<Device> device;  ///< null: the solver is native
  std::unique_ptr<Solver> solver;
};

struct Session {
  std::unique_ptr<Device> device;  ///< null: the solver is native
  std::unique_ptr<Solver> solver;
  std::vector<Opened> more;  ///< the other devices, if several were asked for
  double setup_ms = 0;       ///< the time to make it
};

/// Splits a list of devices: "all" is every GPU, or the CPU device if there is none; otherwise
/// selectors of DeviceRequest between commas, unless the whole is the name of a device. Throws
/// UsageError for an empty selector, and for kNative beside others.
std::vector<std::string> selectors_of(const std::string& text);

struct SessionRequest {
  std::string selector;  ///< DeviceRequest::selector or kNative; a text for selectors_of()
  bool several = false;  ///< ... which may name several devices
  size_t threads = 0;    ///< NativeProcessor::threads
  EngineOptions engine = {};
  std::filesystem::path cache_folder = {};  ///< see Solver
};

/// Throws what selectors_of(), Device and Solver throw.
Session open_session(const SessionRequest& request);

}  // namespace vkh
