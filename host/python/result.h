// The result that Python gets: one object for a directed or a symmetric distance, plain values in
// it.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "host/python/mesh.h"
#include "vkhausdorff/answer.h"

namespace vkh::python {

/// In a symmetric run, the witness is that of the direction with the larger lower bound, always in
/// terms of A and B.
struct Result {
  double lower = 0, upper = 0;
  Status status = Status::kClosed;
  std::optional<Verdict> verdict;  ///< present if a limit was given
  SurfacePoint witness_a, witness_b;
  pybind11::dict stats;
  pybind11::list notes;  ///< dicts of each note
  pybind11::object survey = pybind11::none(), survey_back = pybind11::none();  ///< for A, for B
  std::optional<size_t> index = {};           ///< number of a pair in distances()
  pybind11::object id = pybind11::none();     ///< the pair's id in distances(), if it has one
  pybind11::object error = pybind11::none();  ///< the exception, instead of an answer

  bool closed() const { return status == Status::kClosed; }
  /// Whether the upper end was sought: vkh::is_upper_sought() of the answer.
  bool is_upper_sought() const;
  /// Returns "pass", "fail", "undecided"; null without a limit.
  const char* verdict_name() const;
};

/// Defines the class Result.
void define_result(pybind11::module_& m);

/// All four rows of a matrix, as the keyword transform takes them.
pybind11::list matrix_rows(const MatrixRows& matrix);

/// The values of an answer, with the GIL. `a` and `b`: the meshes as they were measured, which
/// fields keep for their files; null where no field is asked for.
Result result_of(const Question& question, const Answer& answer, const MeshPointer& a,
                 const MeshPointer& b);

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
