#include "host/python/session.h"

#include <stdexcept>

namespace vkh::python {
namespace {

namespace py = pybind11;

class Owner {
 public:
  Owner(std::mutex& mutex, std::thread::id& owner) : mutex_(mutex), owner_(owner) {
    set(std::this_thread::get_id());
  }
  ~Owner() { set({}); }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;

 private:
  void set(std::thread::id id) {
    const std::lock_guard lock(mutex_);
    owner_ = id;
  }
  std::mutex& mutex_;
  std::thread::id& owner_;
};

}  // namespace

Session::Session(const std::string& device) {
  const py::gil_scoped_release release;
  device_.emplace(DeviceRequest{.selector = device});
  solver_.emplace(*device_);
}

void Session::use(const std::function<void(Solver&)>& work) {
  const py::gil_scoped_release release;
  {
    const std::lock_guard lock(owner_mutex_);
    if (owner_ == std::this_thread::get_id())
      throw std::runtime_error("a progress callback started another run on the same device");
  }
  const std::lock_guard lock(mutex_);
  const Owner owner(owner_mutex_, owner_);
  work(*solver_);
}

void listen_to(const py::object& progress, SolveOptions& options) {
  options.progress = [&progress](const Progress& p) {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress.is_none()) return true;
    const py::object wanted = progress(p.wave, p.lower, p.upper);
    return wanted.is_none() || py::cast<bool>(wanted);
  };
}

}  // namespace vkh::python
