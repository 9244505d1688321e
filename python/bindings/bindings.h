#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <memory>
#include <string>

#include "stackabilization/core/shape.h"

/// What the extension module `stackabilization._core` holds, a source per function.
namespace stackabilization::python {

namespace py = pybind11;

/// By the names that a command knows them by.
using Meshes = std::map<std::string, std::shared_ptr<Shape>>;

void add_errors(py::module_& module);
void add_mesh(py::module_& module);
void add_commands(py::module_& module);
void add_solver(py::module_& module);
void add_improvement(py::module_& module);

}  // namespace stackabilization::python
