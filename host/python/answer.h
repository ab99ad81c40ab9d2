// Converts an answer to plain Python values, of which _result.py makes the result.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "host/python/mesh.h"
#include "vkhausdorff/answer.h"

namespace vkh::python {

/// All four rows of a matrix, as the keyword transform takes them.
pybind11::list matrix_rows(const MatrixRows& matrix);

/// The parts of a Result by their names in _result.py. Needs the GIL. A symmetric distance has the
/// witness of the direction with the larger lower bound, always in terms of A and B. `a` and `b`:
/// the meshes as they were measured, which fields keep for their files; null where no field is
/// asked for.
pybind11::dict parts_of(const Question& question, const Answer& answer, const MeshPointer& a,
                        const MeshPointer& b);
/// Makes a Result of them. A pair that failed has only an `error`.
pybind11::object result_of(const pybind11::dict& parts);

/// Defines what a Result takes from C++.
void define_result(pybind11::module_& m);

// Python can make objects that no constructor has seen: Solver.__new__, or a subclass that uses
// itself before super().__init__().
template <class T>
T& made(const pybind11::object& object, const char* name) {
  if (!pybind11::isinstance<T>(object))
    throw pybind11::type_error("expected a vkhausdorff." + std::string(name) +
                               ", not a value of type " + Py_TYPE(object.ptr())->tp_name);
  auto* instance = reinterpret_cast<pybind11::detail::instance*>(object.ptr());
  if (!instance->get_value_and_holder().holder_constructed())
    throw pybind11::type_error("this " + std::string(name) + " was never made: " + name +
                               ".__init__ was not called");
  return pybind11::cast<T&>(object);
}

}  // namespace vkh::python
