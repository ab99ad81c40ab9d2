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

/// Made, used and closed within a Call. Freed by its last owner, or at the interpreter's end.
class Session {
 public:
  explicit Session(const std::string& device);
  /// Does not wait: a thread with a run in flight has a share of the session. In a forked process
  /// nothing is freed: the device is the parent's.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void prepare(Mesh b);

  /// Runs `work` without the GIL, one caller at a time. Between submissions of a run, the callback
  /// that `listen_to` put into its options checks for signals. Throws a RuntimeError, not a
  /// deadlock, if called from within itself, by a progress callback; a ValueError once closed; a
  /// DeviceError if the device is lost meanwhile. The next call opens it anew, with what was
  /// prepared.
  void use(const std::function<void(Solver&)>& work);
  /// A function of a mesh that measures to the prepared one.
  using ToPrepared = std::function<Report(const Mesh&, const SolveOptions&)>;
  /// Does the same, with a function to the prepared mesh.
  void distance(const std::function<void(const ToPrepared&)>& work);
  /// Does the same, and passes the mesh that was prepared.
  void with_prepared(const std::function<void(Solver&, const PreparedMesh&)>& work);

  /// Waits for the run of another thread. In a callback of its own run it waits for nothing: that
  /// run goes on, and is the last.
  void close();

  /// Frees all at the end of the interpreter: no Session has a device afterwards.
  static void free_all();

 private:
  struct Parts;
  class Turn;
  void reopen();
  void run(const std::function<void(Solver&)>& work);

  std::string selector_;
  std::unique_ptr<Parts> parts_;  // null if a lost device could not be opened anew
  std::optional<Mesh> lost_b_;    // mesh that was prepared on a device that was lost
  bool is_lost_ = false;
  std::thread::id owner_;
  bool is_closed_ = false;
};

/// Makes a run end with KeyboardInterrupt (or what else a signal's handler raises), and calls
/// `progress(wave, lower, upper)`, unless that is None; false from it cancels.
void listen_to(const pybind11::object& progress, SolveOptions& options);

/// Called within a run, between its submissions: throws if a signal's handler raised.
void hear_signals();

}  // namespace vkh::python
