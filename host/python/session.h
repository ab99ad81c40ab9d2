// A device and a solver that Python threads may share: one run at a time, without the GIL.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "host/solve/solver.h"

namespace vkh::python {

/// Made, used and closed within a Call. Freed by whoever has it last, or at the interpreter's end.
class Session {
 public:
  explicit Session(const std::string& device);
  /// Waits for nobody: who has a run in flight has a share of the session. In a forked process
  /// nothing is freed: the device is the parent's.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void prepare(Mesh b);

  /// Runs `work` without the GIL, one caller at a time. Between submissions of a run, what
  /// `listen_to` put into its options hears of signals. A RuntimeError, not a deadlock, if called
  /// from within itself, by a progress callback. A ValueError once closed. Where the device is lost
  /// meanwhile, a DeviceError; the next call opens it anew, with what was prepared.
  void use(const std::function<void(Solver&)>& work);
  /// From a mesh to what was prepared.
  using ToPrepared = std::function<Report(const Mesh&, const SolveOptions&)>;
  void distance(const std::function<void(const ToPrepared&)>& work);  ///< likewise
  /// And with the mesh that was prepared.
  void with_prepared(const std::function<void(Solver&, const Mesh&)>& work);

  /// Waits for the run of another thread. In a callback of its own run it waits for nothing: that
  /// run goes on, and is the last.
  void close();

  /// For the end of the interpreter: no Session has a device afterwards.
  static void free_all();

 private:
  struct Parts;
  class Turn;
  void reopen();
  void run(const std::function<void(Solver&)>& work);

  std::string selector_;
  std::unique_ptr<Parts> parts_;  // null where a lost device could not be opened anew
  std::optional<Mesh> lost_b_;    // what was prepared on a device that was lost
  bool is_lost_ = false;
  std::thread::id owner_;
  bool is_closed_ = false;
};

/// Makes a run end with KeyboardInterrupt (or what else a signal's handler raises), and calls
/// `progress(wave, lower, upper)`, unless that is None; false from it cancels.
void listen_to(const pybind11::object& progress, SolveOptions& options);

/// From within a run, between its submissions: throws where a signal's handler raised.
void hear_signals();

}  // namespace vkh::python
