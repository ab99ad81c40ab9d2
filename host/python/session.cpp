#include "host/python/session.h"

#include <set>
#include <stdexcept>

#include "host/python/interpreter.h"
#include "vkhausdorff/device.h"
#include "vkhausdorff/error.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

// This is never destroyed: see interpreter.cpp.
std::set<Session*>& sessions_alive() {
  static auto* alive = new std::set<Session*>;
  return *alive;
}

/// A call of Python's: exactly one of `p` and `done` is there, unless `callback` is None.
struct Heard {
  PyObject* callback;
  const Progress* p = nullptr;
  const WorkDone* done = nullptr;
};

Reply ask_python(void* data) {
  const auto& [callback, p, done] = *static_cast<const Heard*>(data);
  if (PyErr_CheckSignals() != 0) return Reply::kRaised;
  if (callback == Py_None) return Reply::kGoOn;
  PyObject* answer =
      p != nullptr
          ? PyObject_CallFunction(callback, "Idd", p->wave, p->lower, p->upper)
          : PyObject_CallFunction(callback, "ddd", done->fraction, done->lower, done->upper);
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
  std::map<Key, std::shared_ptr<const PreparedMesh>> prepared;
};

/// The right to use the device, which one thread has at a time. At its end the meshes that were
/// dropped are freed, and the device if it was closed.
class Session::Turn {
 public:
  /// Throws if the session is closed, or this thread has its turn already.
  explicit Turn(Session& session) : session_(session) {
    const std::thread::id me = std::this_thread::get_id();
    bool is_nested = false, is_closed = false;
    change_when([&] { return session.owner_ == std::thread::id() || session.owner_ == me; },
                [&] {
                  is_nested = session.owner_ == me;
                  is_closed = session.is_closed_;
                  if (!is_nested && !is_closed) session.owner_ = me;
                });
    if (is_closed) throw session.closed();
    if (is_nested)
      throw std::runtime_error("a progress callback started another run on the same device");
  }
  ~Turn() { session_.end_turn(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  Session& session_;
};

Session::Session(const std::string& device, const char* owner)
    : selector_(device), owner_name_(owner) {
  mark_used();
  const WithoutGil outside;
  open();
  change_now([&] { sessions_alive().insert(this); });
}

Session::~Session() {
  if (is_forked()) {
    static_cast<void>(parts_.release());
    return;
  }
  change_now([&] { sessions_alive().erase(this); });
}

// If it throws, the session stays lost, and the next call does it again.
void Session::open() {
  parts_.reset();
  parts_ = std::make_unique<Parts>(selector_);
  is_lost_ = false;
  change_now([&] { description_ = parts_->device.description(); });
}

pybind11::value_error Session::closed() const {
  return pybind11::value_error(std::string("this ") + owner_name_ + " is closed");
}

// Frees meshes that are dropped meanwhile, too. A forked process leaves all to its parent.
void Session::end_turn() {
  for (bool is_over = is_forked(); !is_over;) {
    std::vector<Key> dropped;
    bool is_closed = false;
    change_now([&] {
      dropped.swap(dropped_);
      is_closed = is_closed_;
      is_over = dropped.empty() && !(is_closed && parts_ != nullptr);
      if (is_over) owner_ = {};
    });
    for (const Key key : dropped) {
      meshes_.erase(key);
      if (parts_ != nullptr) parts_->prepared.erase(key);
    }
    if (is_closed) parts_.reset();
  }
}

std::shared_ptr<const PreparedMesh> Session::prepared(Key key) {
  const auto mesh = meshes_.find(key);
  if (mesh == meshes_.end()) throw py::value_error("this Solver is closed");
  std::shared_ptr<const PreparedMesh>& kept = parts_->prepared[key];
  if (kept == nullptr)
    kept = std::make_shared<const PreparedMesh>(parts_->solver.prepare(*mesh->second));
  return kept;
}

// A lost device may show itself by another error first, so that it is checked after each.
void Session::run(const Work& work, Key key) {
  try {
    if (is_lost_) open();
    const auto b = key == 0 ? nullptr : prepared(key);
    work(parts_->solver, b.get());
  } catch (const DeviceError& error) {
    if (parts_ != nullptr) is_lost_ = parts_->device.is_lost();
    if (!is_lost_) throw;
    throw DeviceLost(std::string(error.what()) + "; the next call opens a device anew");
  }
}

void Session::use(const Work& work, Key key) {
  try {
    const WithoutGil outside;
    const Turn turn(*this);
    run(work, key);
    if (is_ending()) throw Ended{};
  } catch (const Raised&) {
    throw py::error_already_set();
  }
}

Session::Key Session::prepare(MeshPointer b) {
  const WithoutGil outside;
  const Turn turn(*this);
  const Key key = ++last_key_;
  meshes_.emplace(key, std::move(b));
  try {
    run([](Solver&, const PreparedMesh*) {}, key);
    if (is_ending()) throw Ended{};
  } catch (...) {
    drop(key);
    throw;
  }
  return key;
}

void Session::drop(Key key) {
  bool has_turn = false;
  change_now([&] {
    dropped_.push_back(key);
    has_turn = owner_ == std::thread::id();
    if (has_turn) owner_ = std::this_thread::get_id();
  });
  if (has_turn) end_turn();
}

void Session::close() {
  const WithoutGil outside;
  const std::thread::id me = std::this_thread::get_id();
  bool is_nested = false;
  change_when([&] { return owner_ == std::thread::id() || owner_ == me; },
              [&] {
                is_nested = owner_ == me;
                is_closed_ = true;
                owner_ = me;
              });
  if (!is_nested) end_turn();
}

DeviceDescription Session::description() const {
  DeviceDescription description;
  change_now([&] { description = description_; });
  return description;
}

void Session::free_all() {
  for (Session* session : sessions_alive()) session->parts_.reset();
}

bool hear(const py::object& progress, const Progress& p) {
  Heard heard{.callback = progress.ptr(), .p = &p};
  return ask(ask_python, &heard);
}

bool hear(const py::object& on_progress, const WorkDone& done) {
  Heard heard{.callback = on_progress.ptr(), .done = &done};
  return ask(ask_python, &heard);
}

void hear_signals() {
  Heard heard{.callback = Py_None};
  ask(ask_python, &heard);
}

}  // namespace vkh::python
