#include "host/python/session.h"

#include <algorithm>
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

struct Session::Opened {
  explicit Opened(const std::string& selector)
      : device(selector == kNative ? nullptr
                                   : std::make_unique<Device>(DeviceRequest{.selector = selector})),
        solver(device == nullptr ? std::make_unique<Solver>(NativeProcessor{})
                                 : std::make_unique<Solver>(*device)) {}
  std::unique_ptr<Device> device;  // null: the processor alone
  std::unique_ptr<Solver> solver;
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

Session::Session(std::vector<std::string> devices, const char* owner)
    : selectors_(std::move(devices)), owner_name_(owner) {
  mark_used();
  const WithoutGil outside;
  open();
  change_now([&] { sessions_alive().insert(this); });
}

Session::~Session() {
  if (is_forked()) {
    for (auto& one : opened_) static_cast<void>(one.release());
    return;
  }
  change_now([&] { sessions_alive().erase(this); });
}

// If it throws, the session stays lost, and the next call does it again.
void Session::open() {
  opened_.clear();
  std::vector<std::unique_ptr<Opened>> all;
  for (const std::string& selector : selectors_) all.push_back(std::make_unique<Opened>(selector));
  opened_ = std::move(all);
  is_lost_ = false;
  change_now([&] { description_ = opened_.front()->solver->description(); });
}

pybind11::value_error Session::closed() const {
  return pybind11::value_error(std::string("this ") + owner_name_ + " is closed");
}

// Also frees meshes that are dropped meanwhile. A forked process frees nothing: it is the parent's.
void Session::end_turn() {
  for (bool is_over = is_forked(); !is_over;) {
    std::vector<Key> dropped;
    bool is_closed = false;
    change_now([&] {
      dropped.swap(dropped_);
      is_closed = is_closed_;
      is_over = dropped.empty() && !(is_closed && !opened_.empty());
      if (is_over) owner_ = {};
    });
    for (const Key key : dropped) {
      meshes_.erase(key);
      for (auto& one : opened_) one->prepared.erase(key);
    }
    if (is_closed) opened_.clear();
  }
}

std::shared_ptr<const PreparedMesh> Session::prepared(Opened& on, Key key) {
  const auto mesh = meshes_.find(key);
  if (mesh == meshes_.end()) throw py::value_error("this Solver is closed");
  std::shared_ptr<const PreparedMesh>& kept = on.prepared[key];
  if (kept == nullptr)
    kept = std::make_shared<const PreparedMesh>(on.solver->prepare(*mesh->second));
  return kept;
}

bool Session::has_lost_one() const {
  return std::any_of(opened_.begin(), opened_.end(), [](const auto& one) {
    return one->device != nullptr && one->device->is_lost();
  });
}

// A lost device may first show as another error, so it is checked after each error; or it shows no
// error if other devices did its part.
void Session::run(const WorkOver& work, Key key) {
  try {
    if (is_lost_) open();
    std::vector<Solver*> solvers;
    std::vector<std::shared_ptr<const PreparedMesh>> kept;  // they may be dropped meanwhile
    std::vector<const PreparedMesh*> b;
    for (auto& one : opened_) {
      solvers.push_back(one->solver.get());
      if (key == 0) continue;
      kept.push_back(prepared(*one, key));
      b.push_back(kept.back().get());
    }
    work(solvers, b);
    if (opened_.size() > 1) is_lost_ = has_lost_one();
  } catch (const DeviceError& error) {
    if (!opened_.empty()) is_lost_ = has_lost_one();
    if (!is_lost_) throw;
    throw DeviceLost(std::string(error.what()) + "; the next call opens a device anew");
  }
}

void Session::use(const Work& work, Key key) {
  use_all(
      [&work](std::span<Solver* const> solvers, std::span<const PreparedMesh* const> b) {
        work(*solvers.front(), b.empty() ? nullptr : b.front());
      },
      key);
}

void Session::use_all(const WorkOver& work, Key key) {
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
    run([](auto, auto) {}, key);
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
  for (Session* session : sessions_alive()) session->opened_.clear();
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
