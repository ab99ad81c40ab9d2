// A device and a solver that Python threads may share: one run at a time, without the GIL.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "host/device.h"
#include "host/solver.h"

namespace vkh::python {

class Session {
 public:
  explicit Session(const std::string& device);

  /// Runs `work` without the GIL, one caller at a time. Between submissions of a run, what
  /// `listen_to` put into its options hears of signals. A RuntimeError, not a deadlock, if called
  /// from within itself, by a progress callback.
  void use(const std::function<void(Solver&)>& work);

 private:
  std::mutex mutex_;
  std::mutex owner_mutex_;
  std::thread::id owner_;
  std::optional<Device> device_;
  std::optional<Solver> solver_;
};

/// Makes a run end with KeyboardInterrupt (or what else a signal's handler raises), and calls
/// `progress(wave, lower, upper)`, unless that is None; false from it cancels.
void listen_to(const pybind11::object& progress, SolveOptions& options);

}  // namespace vkh::python
