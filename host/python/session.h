// A device and a solver that Python threads may share: one run at a time, without the GIL.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "host/python/mesh.h"
#include "vkhausdorff/device_description.h"
#include "vkhausdorff/solver.h"
#include "vkhausdorff/work_meter.h"

namespace vkh::python {

/// Made, used and closed within a Call. Freed by its last owner, or at the interpreter's end.
class Session {
 public:
  /// Opens the devices, one or several. `owner`: "Device" or "Solver", for messages.
  Session(std::vector<std::string> devices, const char* owner);
  /// Does not wait: a thread with a run in flight has a share of the session. In a forked process
  /// nothing is freed: the device is the parent's.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Names a mesh that is kept on each device; 0 names none.
  using Key = uint64_t;
  /// Prepares `b` and keeps it until it is dropped. Throws as use() does, and keeps nothing then.
  Key prepare(MeshPointer b);
  /// Does not wait: a run that has the mesh goes on with it, and frees it. Needs no GIL.
  void drop(Key key);

  /// Runs `work` without the GIL, one caller at a time. Between submissions of a run, the callback
  /// (hear) checks for signals. Throws a RuntimeError, not a
  /// deadlock, if called from within itself, by a progress callback; a ValueError once closed, or
  /// if `key` was dropped; a DeviceError if the device is lost meanwhile. The next call opens it
  /// again, and each prepared mesh is prepared again at its next use.
  ///
  /// The first device's Solver is used; the second argument is the mesh that `key` names, or null.
  using Work = std::function<void(Solver&, const PreparedMesh*)>;
  void use(const Work& work, Key key = 0);
  /// Does the same with all devices; the second argument has the mesh on each, or is empty.
  using WorkOver =
      std::function<void(std::span<Solver* const>, std::span<const PreparedMesh* const>)>;
  void use_all(const WorkOver& work, Key key = 0);

  /// Frees the device, after the run of another thread. In a callback of its own run it does not
  /// wait: that run goes on, and is the last one.
  void close();

  /// Describes the first open device, or the one that was open last.
  DeviceDescription description() const;

  /// Frees all at the end of the interpreter: no Session has a device afterwards.
  static void free_all();

 private:
  struct Opened;
  class Turn;
  void open();
  void run(const WorkOver& work, Key key);
  std::shared_ptr<const PreparedMesh> prepared(Opened& on, Key key);
  bool has_lost_one() const;
  void end_turn();
  pybind11::value_error closed() const;

  const std::vector<std::string> selectors_;
  const char* const owner_name_;
  // These belong to the thread that has the turn.
  std::vector<std::unique_ptr<Opened>> opened_;  // empty if a lost device could not be opened again
  std::map<Key, MeshPointer> meshes_;            // meshes that were prepared and not dropped
  bool is_lost_ = false;
  Key last_key_ = 0;
  // These belong to the lock of change_now().
  std::vector<Key> dropped_;
  std::thread::id owner_;
  bool is_closed_ = false;
  DeviceDescription description_;
};

/// Calls `progress(wave, lower, upper)`, unless it is None, and returns false if that cancels.
/// Called within a run, between its submissions; throws if a signal's handler raised.
bool hear(const pybind11::object& progress, const Progress& p);

/// Calls `on_progress(fraction, lower, upper)` in the same way.
bool hear(const pybind11::object& on_progress, const WorkDone& done);

/// Called the same way: throws if a signal's handler raised.
void hear_signals();

}  // namespace vkh::python
