// A question about two meshes on its way to an answer, on a thread of its own: a search, and what
// else is asked for (fields, statistics, certificates, limits of faces, the host's check).
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <stop_token>
#include <thread>

#include "vkhausdorff/answer.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/question.h"
#include "vkhausdorff/solver.h"
#include "vkhausdorff/work_meter.h"

namespace vkh {

class AskingState;

/// Threads may share an Asking. It leaves a thread behind only after leave().
class Asking {
 public:
  using Deadline = std::chrono::steady_clock::time_point;

  /// Begins at once, on a thread; if no thread can be started, it returns once all work is done.
  /// `question`: its files, devices and hashes are ignored; budget.time_limit_s counts from now and
  /// covers all work. `solvers`: one, or several on devices of their own for one direction, which
  /// share A's faces; the first also surveys and proves. They must outlive the Asking, and no other
  /// code may use them meanwhile. `stop`: a request ends the work as cancel() does. Throws
  /// UsageError for null meshes, for no Solver, and for a question whose members contradict each
  /// other for any meshes.
  Asking(Question question, std::shared_ptr<const ReadMesh> a, std::shared_ptr<const ReadMesh> b,
         std::span<Solver* const> solvers, std::stop_token stop = {});
  /// Begins with the state of host/answer/asking_state.h, as the program does for files.
  explicit Asking(std::shared_ptr<AskingState> state);
  /// Cancels what is not done, and waits, unless leave() came.
  ~Asking();
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;

  /// Ends the work soon, with a true answer. Does not wait.
  void cancel();
  /// Waits until all work is done, or until the deadline. Returns whether it is done.
  bool wait(Deadline deadline) const;
  /// Returns what is known so far. It may be called at any time, also after an error; the intervals
  /// are true, though they may be wide.
  Answer known() const;
  /// Returns how much of all work is done, and the interval so far.
  WorkDone done() const;
  /// Waits until all work is done. Throws UsageError, InputError, DeviceError and what else Solver
  /// throws.
  Answer answer() const;
  /// Stops waiting: a driver may hang, so the thread is left running with everything that it uses.
  /// The process must then end without exit handlers, by std::_Exit or quick_exit.
  void leave();

 private:
  std::shared_ptr<AskingState> state_;
  std::thread thread_;
};

}  // namespace vkh
