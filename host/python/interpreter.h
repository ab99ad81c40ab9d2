// The interpreter around a run: its lock (the GIL), its end, and forks of its process.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

namespace vkh::python {

/// The interpreter ends, and nothing may run any more. Python sees SystemExit, which ends a thread
/// silently, as the interpreter would; on the thread that ends it, RuntimeError.
struct Ended {};
/// A Python exception is set, and is on its way through code that does not have the GIL.
struct Raised {};

/// Called once, when the module is made.
void watch_interpreter();
/// Called when the interpreter begins to end, with the GIL: ends all runs, waits for their threads,
/// calls `end`, which ends threads that are not Python's, without the GIL, and then `free`, with
/// it, if all came. A thread that stays in a callback of Python's is left there; it never comes
/// back to us.
void end_interpreter(const std::function<void()>& end, const std::function<void()>& free);
bool is_ending();

/// A device does not survive a fork: after `mark_used`, a forked process is recognised.
void mark_used();
bool is_forked();

/// Surrounds each call from Python. Throws Ended, and RuntimeError in a forked process.
class Call {
 public:
  Call();
  ~Call();
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

 private:
  const void* state_;
};

/// Used within a Call: other threads of Python run as long as it lives. Python must not be touched.
class WithoutGil {
 public:
  WithoutGil();
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  PyThreadState* thread_;
};

enum class Reply { kGoOn, kCancel, kRaised };
/// Asks Python from within a WithoutGil. `question` has the GIL. It must hold nothing in C++
/// objects: at the interpreter's end, its thread may never return from Python. Throws what a Call
/// does, and Raised.
bool ask(Reply (*question)(void*), void* about);

/// Waits until `ready` returns true, then calls `change` under the same lock, so that no other
/// change comes between. Throws Ended.
void change_when(const std::function<bool()>& ready, const std::function<void()>& change);
void change_now(const std::function<void()>& change);

}  // namespace vkh::python
