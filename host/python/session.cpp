#include "host/python/session.h"

#include <optional>
#include <set>
#include <stdexcept>

#include "host/base/error.h"
#include "host/gpu/device.h"
#include "host/python/interpreter.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

// This is never destroyed: see interpreter.cpp.
std::set<Session*>& sessions_alive() {
  static auto* alive = new std::set<Session*>;
  return *alive;
}

struct Heard {
  PyObject* progress;
  const Progress* p;
};

Reply ask_python(void* data) {
  const auto& [progress, p] = *static_cast<const Heard*>(data);
  if (PyErr_CheckSignals() != 0) return Reply::kRaised;
  if (progress == Py_None) return Reply::kGoOn;
  PyObject* answer = PyObject_CallFunction(progress, "Idd", p->wave, p->lower, p->upper);
  if (answer == nullptr) return Reply::kRaised;
  const int wanted = answer == Py_None ? 1 : PyObject_IsTrue(answer);
  Py_DECREF(answer);
  if (wanted < 0) return Reply::kRaised;
  return wanted == 1 ? Reply::kGoOn : Reply::kCancel;
}

}  // namespace

struct Session::Parts {
  explicit Parts(const std::string& selector)
      : device(DeviceRequest{.selector = selector}), solver(device) {}
  Device device;
  Solver solver;
  std::optional<PreparedMesh> b;
};

class Session::Turn {
 public:
  explicit Turn(Session& session) : owner_(session.owner_) {
    const std::thread::id me = std::this_thread::get_id();
    bool is_nested = false, is_closed = false;
    change_when([&] { return owner_ == std::thread::id() || owner_ == me; },
                [&] {
                  is_nested = owner_ == me;
                  is_closed = session.is_closed_;
                  if (!is_nested && !is_closed) owner_ = me;
                });
    if (is_closed) throw py::value_error("this Solver is closed");
    if (is_nested)
      throw std::runtime_error("a progress callback started another run on the same device");
  }
  ~Turn() {
    change_now([&] { owner_ = {}; });
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  std::thread::id& owner_;
};

Session::Session(const std::string& device) : selector_(device) {
  mark_used();
  const WithoutGil outside;
  parts_ = std::make_unique<Parts>(device);
  change_now([&] { sessions_alive().insert(this); });
}

Session::~Session() {
  if (is_forked()) {
    static_cast<void>(parts_.release());
    return;
  }
  change_now([&] { sessions_alive().erase(this); });
}

void Session::prepare(Mesh b) {
  use([&](Solver& solver, const PreparedMesh*) {
    parts_->b.emplace(solver.prepare(std::move(b)));
  });
}

// If a step throws, the session stays lost, and the next call repeats all of this: B is kept until
// it is prepared again.
void Session::reopen() {
  if (parts_ != nullptr && parts_->b) lost_b_ = parts_->b->mesh();
  parts_.reset();
  parts_ = std::make_unique<Parts>(selector_);
  if (lost_b_) parts_->b.emplace(parts_->solver.prepare(*lost_b_));
  lost_b_.reset();
  is_lost_ = false;
}

// A lost device may show itself by another error first, so that it is checked after each.
void Session::run(const Work& work) {
  try {
    if (is_lost_) reopen();
    work(parts_->solver, parts_->b ? &*parts_->b : nullptr);
  } catch (const DeviceError& error) {
    if (parts_ != nullptr) is_lost_ = parts_->device.is_lost();
    if (!is_lost_) throw;
    throw DeviceLost(std::string(error.what()) + "; the next call opens a device anew");
  }
}

void Session::use(const Work& work) {
  try {
    const WithoutGil outside;
    const Turn turn(*this);
    run(work);
    if (is_ending()) throw Ended{};
  } catch (const Raised&) {
    throw py::error_already_set();
  }
}

void Session::close() {
  const WithoutGil outside;
  const std::thread::id me = std::this_thread::get_id();
  change_when([&] { return owner_ == std::thread::id() || owner_ == me; },
              [&] { is_closed_ = true; });
}

void Session::free_all() {
  for (Session* session : sessions_alive()) session->parts_.reset();
}

bool hear(const py::object& progress, const Progress& p) {
  Heard heard{progress.ptr(), &p};
  return ask(ask_python, &heard);
}

void hear_signals() {
  Heard heard{Py_None, nullptr};
  ask(ask_python, &heard);
}

}  // namespace vkh::python
