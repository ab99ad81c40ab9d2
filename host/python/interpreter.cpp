#include "host/python/interpreter.h"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace vkh::python {
namespace {

namespace py = pybind11;

// Counts the threads that are in calls of ours.
struct State {
  std::mutex mutex;  // never held by one that waits for the GIL
  std::condition_variable changed;
  int outside = 0;       // without the GIL
  int inside = 0;        // with the GIL, or waiting for it
  bool ending = false;   // nothing starts, what runs is cancelled
  bool is_over = false;  // no thread comes back
  std::thread::id ender;
};

// This is never destroyed: threads may wait in it when the process exits. A forked process gets a
// new one.
std::atomic<State*> g_state = nullptr;
std::atomic<bool> g_used = false, g_forked = false;

State& state() { return *g_state; }

[[noreturn]] void sleep_for_ever() {
  for (;;) pause();
}

void check_not_forked() {
  if (!g_forked) return;
  throw std::runtime_error(
      "vkhausdorff was used before this process was forked, and a device does not survive that; "
      "start processes by 'spawn', or fork before the first use");
}

void after_fork() {
  if (g_used) g_forked = true;
  g_state = new State;
}

void move_one(int& from, int& to) {
  --from;
  ++to;
  state().changed.notify_all();
}

// Gives the GIL away for good, on a thread that must not come back.
void leave_python() {
  State& s = state();
  std::unique_lock lock(s.mutex);
  if (s.is_over) {
    lock.unlock();
    PyEval_SaveThread();
    sleep_for_ever();
  }
  move_one(s.inside, s.outside);
}

// A driver's own exit handlers join its threads (Mesa's does), which a forked process does not
// have.
void leave_at_once(int status, void*) {
  std::fflush(nullptr);
  _exit(status);
}

// The argument is by value: pybind11's type of a translator.
void translate(std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param)
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Ended&) {
    if (std::this_thread::get_id() == state().ender) {
      PyErr_SetString(PyExc_RuntimeError, "the interpreter is ending: no run can be started");
    } else {
      PyErr_SetNone(PyExc_SystemExit);
    }
  }
}

}  // namespace

void watch_interpreter() {
  g_state = new State;
  pthread_atfork(nullptr, nullptr, after_fork);
  py::register_exception_translator(translate);
}

void end_interpreter(const std::function<void()>& end, const std::function<void()>& free) {
  if (g_forked) {
    on_exit(leave_at_once, nullptr);  // the last one registered is the first one called
    return;
  }
  constexpr std::chrono::milliseconds kPatience(1000), kStep(20);
  State& s = state();
  const auto interrupt = std::signal(SIGINT, SIG_DFL);  // for a user who does not want to wait
  bool all_came = false;
  {
    const py::gil_scoped_release release;
    std::unique_lock lock(s.mutex);
    s.ender = std::this_thread::get_id();
    s.ending = true;
    s.changed.notify_all();
    const auto late = std::chrono::steady_clock::now() + kPatience;
    while (s.outside > 0 || (s.inside > 0 && std::chrono::steady_clock::now() < late))
      s.changed.wait_for(lock, kStep);
    s.is_over = true;
    all_came = s.inside == 0;
    lock.unlock();
    end();
  }
  std::signal(SIGINT, interrupt);
  if (all_came) free();
}

bool is_ending() {
  const std::lock_guard lock(state().mutex);
  return state().ending;
}

void mark_used() { g_used = true; }

bool is_forked() { return g_forked; }

Call::Call() : state_(g_state) {
  check_not_forked();
  const std::lock_guard lock(state().mutex);
  if (state().ending) throw Ended{};
  ++state().inside;
}

Call::~Call() {
  if (state_ != g_state) return;  // the other side of a fork
  const std::lock_guard lock(state().mutex);
  --state().inside;
  state().changed.notify_all();
}

WithoutGil::WithoutGil() {
  check_not_forked();
  leave_python();
  thread_ = PyEval_SaveThread();
}

WithoutGil::~WithoutGil() {
  PyEval_RestoreThread(thread_);
  if (g_forked) return;
  const std::lock_guard lock(state().mutex);
  move_one(state().outside, state().inside);
}

bool ask(Reply (*question)(void*), void* about) {
  {
    const std::lock_guard lock(state().mutex);
    if (state().ending) throw Ended{};
    move_one(state().outside, state().inside);
  }
  Reply reply = Reply::kCancel;
  PyGILState_STATE gil{};
  // After its end, the interpreter ends a thread that wants the GIL by unwinding it: not through
  // the driver and noexcept code. Nothing else comes here: this is C. It is not caught by reference
  // to abi::__forced_unwind, of which there is no object.
  try {
    gil = PyGILState_Ensure();
    reply = question(about);
  } catch (...) {
    sleep_for_ever();
  }
  if (!g_forked) leave_python();
  PyGILState_Release(gil);
  check_not_forked();
  if (reply == Reply::kRaised) throw Raised{};
  return reply == Reply::kGoOn;
}

void change_when(const std::function<bool()>& ready, const std::function<void()>& change) {
  State& s = state();
  std::unique_lock lock(s.mutex);
  s.changed.wait(lock, [&] { return s.ending || ready(); });
  if (s.ending) throw Ended{};
  change();
  s.changed.notify_all();
}

void change_now(const std::function<void()>& change) {
  const std::lock_guard lock(state().mutex);
  change();
  state().changed.notify_all();
}

}  // namespace vkh::python
