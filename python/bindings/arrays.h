#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

/// NumPy arrays and this library's matrices.
namespace stackabilization::python {

namespace py = pybind11;

/// An n x 3 array of doubles in C order. Such an array is taken as it is, anything else is converted. Throws
/// InputError, in words that name it as `what`, for another shape and for what is not numbers.
py::array_t<double> rows_of_doubles(const py::object& values, const std::string& what);

/// The same array for a computation without the interpreter's lock. Where that outlives everybody else, the
/// array stays in memory for good: only who has the lock may let it go.
std::shared_ptr<const py::array_t<double>> shared(py::array_t<double> rows);

/// The same array as a matrix, without a copy; it must outlive the matrix.
Eigen::Map<const Points> as_points(const py::array_t<double>& rows);

/// m x 3 whole numbers of any type as triangles. Throws InputError as above, and for a number that is no row
/// of a matrix that long.
Triangles triangles_of(const py::object& values);

/// A view of memory that `owner` keeps alive; nobody can write through it.
template <class Value>
py::array_t<Value> view_of(const Value* data, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array_t<Value> view(std::move(shape), data, owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

/// k whole numbers of any type. Throws InputError as above.
std::vector<std::int32_t> whole_numbers(const py::object& values, const std::string& what);

/// Three numbers. Throws UsageError, or InputError for what is no array, in words that name it as `what`.
Eigen::Vector3d vector_of(const py::object& values, const std::string& what);

}  // namespace stackabilization::python
