// Errors of C++ as Python's exceptions.
#pragma once

#include <pybind11/pybind11.h>

namespace vkh::python {

/// Defines DeviceError, and translates every Error: its exception has `file` and `place` where
/// these are known.
void define_errors(pybind11::module_& m);

}  // namespace vkh::python
