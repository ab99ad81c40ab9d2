#include "host/python/arguments.h"

#include <pybind11/numpy.h>

#include <cmath>
#include <cstring>

#include "host/answer/name_meant.h"
#include "host/answer/options_table.h"
#include "host/answer/session.h"
#include "host/python/interpreter.h"
#include "vkhausdorff/error.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

/// Shows any value, but short: never an array.
std::string shown(py::handle given) {
  constexpr size_t kMost = 60;
  if (given.is_none() || PyBool_Check(given.ptr()) || PyLong_CheckExact(given.ptr()) ||
      PyFloat_CheckExact(given.ptr()) || PyUnicode_CheckExact(given.ptr())) {
    const auto text = py::reinterpret_steal<py::object>(PyObject_ASCII(given.ptr()));
    if (text) {
      const std::string line = py::cast<std::string>(text);
      return line.size() <= kMost ? line : line.substr(0, kMost) + "...";
    }
    PyErr_Clear();  // integers of thousands of digits
  }
  return "a value of type " + std::string(Py_TYPE(given.ptr())->tp_name);
}

std::string listed(const std::vector<std::string>& names, size_t from, size_t to) {
  std::string text;
  for (size_t i = from; i < to; ++i) text += (text.empty() ? "" : ", ") + names[i];
  return text;
}

std::string function_of(const Signature& signature) { return signature.function + "()"; }

[[noreturn]] void refuse_stranger(const Signature& signature, const std::string& name) {
  std::vector<KnownName> known;
  for (const std::string& one : signature.names) known.push_back({.name = one});
  for (const Option& option : options()) {
    for (KnownName& one : known) {
      if (one.name == keyword_name(option)) one.also = option.also;
    }
  }
  const std::string meant = name_meant(name, known);
  throw py::type_error(function_of(signature) + " has no argument '" + name + "'; " +
                       (meant.empty() ? "" : "did you mean " + meant + "? ") + "it takes " +
                       listed(signature.names, 0, signature.names.size()));
}

[[noreturn]] void refuse_second(const Signature& signature, const std::string& name) {
  throw py::type_error(function_of(signature) + ": '" + name + "' was given twice");
}

}  // namespace

void refuse_type(const char* name, const char* expected, py::handle given) {
  throw py::type_error(std::string(name) + ": expected " + expected + ", not " + shown(given));
}

void refuse_value(const char* name, const char* expected, py::handle given) {
  throw py::value_error(std::string(name) + ": expected " + expected + ", not " + shown(given));
}

bool is_bool(py::handle given) {
  const char* type = Py_TYPE(given.ptr())->tp_name;
  return PyBool_Check(given.ptr()) || std::strcmp(type, "numpy.bool_") == 0 ||
         std::strcmp(type, "numpy.bool") == 0;
}

std::string text_from(const char* name, const char* expected, py::handle given) {
  if (!py::isinstance<py::str>(given)) refuse_type(name, expected, given);
  Py_ssize_t size = 0;
  const char* text = PyUnicode_AsUTF8AndSize(given.ptr(), &size);
  if (text != nullptr) return {text, static_cast<size_t>(size)};
  PyErr_Clear();  // half of a surrogate pair
  refuse_value(name, expected, given);
}

double number_from(const char* name, const char* expected, py::handle given) {
  const PyNumberMethods* methods = Py_TYPE(given.ptr())->tp_as_number;
  const bool is_number = methods != nullptr &&
                         (methods->nb_float != nullptr || methods->nb_index != nullptr) &&
                         !is_bool(given) && !py::isinstance<py::array>(given);
  if (!is_number) refuse_type(name, expected, given);
  const double value = PyFloat_AsDouble(given.ptr());
  if (PyErr_Occurred() == nullptr) {
    if (std::isnan(value)) refuse_value(name, expected, given);
    return value;
  }
  const bool is_large = PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
  PyErr_Clear();
  is_large ? refuse_value(name, expected, given) : refuse_type(name, expected, given);
}

Arguments::Arguments(const Signature& signature, const py::args& positional,
                     const py::kwargs& named)
    : signature_(signature), values_(signature.names.size()) {
  const std::string function = function_of(signature);
  if (positional.size() > signature.positional)
    throw py::type_error(function + " takes " + listed(signature.names, 0, signature.positional) +
                         " by position and the rest by name; " + std::to_string(positional.size()) +
                         " were given");
  for (size_t i = 0; i < positional.size(); ++i) values_[i] = positional[i];
  for (const auto& [key, value] : named) {
    const std::string name = py::cast<std::string>(key);
    const size_t place = place_of(name);
    if (place == values_.size()) refuse_stranger(signature, name);
    if (values_[place]) refuse_second(signature, name);
    values_[place] = py::reinterpret_borrow<py::object>(value);
  }
  for (size_t i = 0; i < signature.required; ++i) {
    if (!values_[i])
      throw py::type_error(function + " needs " + listed(signature.names, 0, signature.required) +
                           "; '" + signature.names[i] + "' is missing");
  }
}

size_t Arguments::place_of(const std::string& name) const {
  size_t place = 0;
  while (place < values_.size() && name != signature_.names[place]) ++place;
  return place;
}

const py::object* Arguments::find(const char* name) const {
  const size_t place = place_of(name);
  return place < values_.size() && values_[place] ? &values_[place] : nullptr;
}

const py::object& Arguments::at(const char* name) const { return *find(name); }

bool Arguments::flag(const char* name) const {
  const py::object* given = find(name);
  if (given == nullptr) return false;
  if (!is_bool(*given)) refuse_type(name, "True or False", *given);
  return PyObject_IsTrue(given->ptr()) == 1;
}

std::string Arguments::text(const char* name, const char* expected) const {
  const py::object* given = find(name);
  return given == nullptr ? std::string() : text_from(name, expected, *given);
}

std::string Arguments::device(const char* expected) const {
  const py::object* given = find("device");
  if (given == nullptr || py::isinstance<py::str>(*given)) return text("device", expected);
  const std::optional<uint64_t> index = whole("device", expected);
  if (!index) refuse_type("device", expected, *given);
  return std::to_string(*index);
}

std::vector<std::string> Arguments::devices(const char* expected) const {
  const std::string text = device(expected);
  const WithoutGil outside;
  try {
    return selectors_of(text);
  } catch (const UsageError&) {
    throw UsageError("device: expected names between commas, or 'all', not '" + text + "'");
  }
}

std::vector<std::string> Arguments::texts(const char* name) const {
  constexpr const char* kExpected = "a list of names";
  const py::object* given = find(name);
  std::vector<std::string> texts;
  if (given == nullptr) return texts;
  if (!py::isinstance<py::list>(*given) && !py::isinstance<py::tuple>(*given) &&
      !PyAnySet_Check(given->ptr()))
    refuse_type(name, kExpected, *given);
  for (const py::handle item : *given) {
    if (!py::isinstance<py::str>(item)) refuse_type(name, kExpected, item);
    texts.push_back(py::cast<std::string>(item));
  }
  return texts;
}

std::optional<double> Arguments::number(const char* name, const char* expected) const {
  const py::object* given = find(name);
  if (given == nullptr || given->is_none()) return std::nullopt;
  return number_from(name, expected, *given);
}

std::optional<uint64_t> Arguments::whole(const char* name, const char* expected) const {
  const py::object* given = find(name);
  if (given == nullptr || given->is_none()) return std::nullopt;
  if (is_bool(*given) || py::isinstance<py::array>(*given)) refuse_type(name, expected, *given);
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(given->ptr()));
  if (!index) {
    PyErr_Clear();
    refuse_type(name, expected, *given);
  }
  const uint64_t value = PyLong_AsUnsignedLongLong(index.ptr());
  if (PyErr_Occurred() == nullptr) return value;
  PyErr_Clear();
  refuse_value(name, expected, *given);
}

}  // namespace vkh::python
