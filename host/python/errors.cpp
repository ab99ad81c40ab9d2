#include "host/python/errors.h"

#include "host/python/mesh.h"
#include "vkhausdorff/error.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

PyObject* g_device_error = nullptr;  // the module keeps it

PyObject* type_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
    case ErrorKind::kInput:
      return PyExc_ValueError;
    case ErrorKind::kDevice:
    case ErrorKind::kDeviceLost:
    case ErrorKind::kMemory:
      return g_device_error;
    case ErrorKind::kOutput:
      return PyExc_OSError;
    case ErrorKind::kInterrupted:
    case ErrorKind::kInternal:
      break;
  }
  return PyExc_RuntimeError;
}

/// A name is bytes of the system's, which need not be UTF-8.
py::object decoded(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeFSDefaultAndSize(text.data(), static_cast<py::ssize_t>(text.size())));
}

/// Adds what is known to the current exception. Failing to add an attribute is no error.
void add_place(const std::string& file, const std::string& place) {
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  for (const auto& [name, text] : {std::pair{"file", &file}, {"place", &place}}) {
    const py::object given = text->empty() ? py::object() : decoded(*text);
    if (given && value != nullptr) PyObject_SetAttrString(value, name, given.ptr());
  }
  PyErr_Clear();
  PyErr_Restore(type, value, trace);
}

void raise(const Error& error) {
  PyErr_SetString(type_of(error.kind()), error.what());
  add_place(error.file(), error.place());
}

// The argument is by value: pybind11's type of a translator.
void translate_error(std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param)
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const FileFault& fault) {
    raise(fault);
    add_place(fault.path, "");
  } catch (const Error& error) {
    raise(error);
  }
}

}  // namespace

void define_errors(py::module_& m) {
  g_device_error = py::register_exception<DeviceError>(m, "DeviceError", PyExc_RuntimeError).ptr();
  py::register_exception_translator(translate_error);
}

}  // namespace vkh::python
