// The stream behind distances(): the package's generator puts pairs in and takes results out.
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <memory>

#include "host/python/answer.h"

namespace vkh::python {

class Pulled;

/// Used by one thread of Python at a time, which the generator ensures.
class PythonStream {
 public:
  PythonStream(const pybind11::args& positional, const pybind11::kwargs& named);
  ~PythonStream();
  PythonStream(const PythonStream&) = delete;
  PythonStream& operator=(const PythonStream&) = delete;

  /// Whether another pair may be put: fewer than `ahead` pairs are put and not taken, and their
  /// meshes are within AskingStream::kReadAhead.
  bool has_room() const;
  /// Puts a pair without waiting. Throws the error in the arrays; `b`: None with against=.
  void put(size_t index, const pybind11::object& id, const pybind11::object& a,
           const pybind11::object& b);
  /// Returns a Result, or None: if none is there yet, or with `waits` if none will be. Throws
  /// DeviceError if no device is left.
  pybind11::object take(bool waits);
  /// Waits until nothing runs. Does nothing if there is nothing to close.
  void close();

 private:
  /// A pair that is put and not taken.
  struct Waiting {
    pybind11::object id;
    uint64_t bytes = 0;
  };

  std::shared_ptr<Pulled> pulled_;
  std::map<size_t, Waiting> waiting_;
  uint64_t bytes_ = 0;  // of all that wait
};

/// Defines the class _Stream of _core.
void define_many(pybind11::module_& m);

/// Ends every stream at the end of the interpreter. Never takes the GIL.
void end_streams();

}  // namespace vkh::python
