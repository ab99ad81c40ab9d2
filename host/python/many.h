// The stream behind distances(): the package's generator puts pairs in and takes results out.
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <memory>

#include "host/python/result.h"
#include "vkhausdorff/question.h"

namespace vkh::python {

class Flow;

/// Used by one thread of Python at a time; the generator that has it sees to that.
class PythonStream {
 public:
  PythonStream(const pybind11::args& positional, const pybind11::kwargs& named);
  ~PythonStream();
  PythonStream(const PythonStream&) = delete;
  PythonStream& operator=(const PythonStream&) = delete;

  bool has_room() const;
  /// Puts a pair without waiting. Throws the error in the arrays; `b`: None with against=.
  void put(size_t index, const pybind11::object& id, const pybind11::object& a,
           const pybind11::object& b);
  /// Returns a Result, or None: if none is there yet, or with `waits` if none will be.
  pybind11::object take(bool waits);
  /// Waits until nothing runs. Does nothing if there is nothing to close.
  void close();

 private:
  std::shared_ptr<Flow> flow_;
  Question question_;                       // of all pairs
  std::map<size_t, pybind11::object> ids_;  // for pairs that are put and not taken
};

/// Defines the class _Stream of _core, and _failed().
void define_many(pybind11::module_& m);

}  // namespace vkh::python
