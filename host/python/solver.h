// The functions that Python calls: distance(), gate(), closest(), and the Solver that keeps B.
#pragma once

#include <memory>

#include "host/python/answer.h"
#include "host/python/mesh.h"
#include "host/python/session.h"

namespace vkh::python {

pybind11::object distance(const pybind11::args& positional, const pybind11::kwargs& named);
/// Does the same with a limit: the result has a verdict.
pybind11::object metrics(const pybind11::args& positional, const pybind11::kwargs& named);
pybind11::object gate(const pybind11::args& positional, const pybind11::kwargs& named);
/// Returns an Alignment of the package's.
pybind11::object align(const pybind11::args& positional, const pybind11::kwargs& named);
/// Returns a Closest of the package's.
pybind11::object closest(const pybind11::args& positional, const pybind11::kwargs& named);

/// Returns a Simplified of the package's.
pybind11::object simplified(const pybind11::args& positional, const pybind11::kwargs& named);
/// Returns a list of them, the finest first.
pybind11::object simplified_levels(const pybind11::args& positional, const pybind11::kwargs& named);

/// Frees the devices that distance() keeps, and those of all Solvers.
void free_devices();

/// A device that Solvers and calls share.
class PythonDevice {
 public:
  PythonDevice(const pybind11::args& positional, const pybind11::kwargs& named);
  ~PythonDevice();
  PythonDevice(const PythonDevice&) = delete;
  PythonDevice& operator=(const PythonDevice&) = delete;

  const std::shared_ptr<Session>& session() const { return session_; }
  void close();

 private:
  std::shared_ptr<Session> session_;
};

/// Mesh B, prepared on its own device, or on a shared one.
class PythonSolver {
 public:
  PythonSolver(const pybind11::args& positional, const pybind11::kwargs& named);
  ~PythonSolver();
  PythonSolver(const PythonSolver&) = delete;
  PythonSolver& operator=(const PythonSolver&) = delete;

  pybind11::object distance(const pybind11::args& positional, const pybind11::kwargs& named);
  pybind11::object closest(const pybind11::args& positional, const pybind11::kwargs& named);
  void close();

 private:
  std::shared_ptr<Session> open_session() const;

  ShapedMesh b_;
  std::shared_ptr<Session> session_;  // shared with the calls in flight on other threads
  Session::Key key_ = 0;              // of b_
  bool shares_device_ = false;
};

}  // namespace vkh::python
