// Files of Fields.
#pragma once

#include <pybind11/pybind11.h>

namespace vkh::python {

/// Defines _save_field(), which Field.save() calls.
void define_field(pybind11::module_& m);

}  // namespace vkh::python
