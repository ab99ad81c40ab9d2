#include "host/python/python_tree.h"

#include <algorithm>

namespace vkh::python {

namespace py = pybind11;

PythonTree::PythonTree(std::initializer_list<std::string_view> flat) : flat_(flat) {}

void PythonTree::bound(const char* name, double bound, Rounding) {
  key(name);
  number(bound);
}

void PythonTree::text(std::string_view text) { put(text_object(text)); }

void PythonTree::open_object() {
  const py::object around = open_.back();
  const bool is_flat = py::isinstance<py::dict>(around) &&
                       std::find(flat_.begin(), flat_.end(), key_) != flat_.end();
  if (is_flat)
    open_.push_back(around);
  else
    open(py::dict());
}

void PythonTree::put(const py::object& value) {
  const py::object& around = open_.back();
  if (py::isinstance<py::dict>(around))
    around[py::str(key_)] = value;
  else
    py::reinterpret_borrow<py::list>(around).append(value);
}

void PythonTree::open(const py::object& value) {
  put(value);
  open_.push_back(value);
}

py::str text_object(std::string_view text) {
  PyObject* made =
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace");
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(made);
}

py::dict counts_dict(const MeshCounts& counts) {
  constexpr bool kAreKnown = true;
  return members_of("", [&](auto& v) { visit(v, counts, kAreKnown); });
}

py::dict device_dict(const DeviceDescription& device) {
  return members_of("", [&](auto& v) {
    visit(v, device);
    v.text("driver", device.driver);
  });
}

}  // namespace vkh::python
