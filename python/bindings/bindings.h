#pragma once

#include <pybind11/pybind11.h>

/// What the extension module `stackabilization._core` holds, a source per function.
namespace stackabilization::python {

namespace py = pybind11;

void add_errors(py::module_& module);
void add_mesh(py::module_& module);
void add_commands(py::module_& module);
void add_solver(py::module_& module);
void add_improvement(py::module_& module);

}  // namespace stackabilization::python
