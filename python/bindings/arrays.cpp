#include "bindings/arrays.h"

#include <limits>

#include "stackabilization/core/errors.h"

namespace stackabilization::python {

namespace {

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

/// What NumPy makes of the values. Throws InputError when that is nothing.
py::array array_of(const py::object& values, const std::string& what) {
  py::array array = py::array::ensure(values);
  if (!array) {
    PyErr_Clear();
    throw InputError(what + " expects an array of shape (n, 3)");
  }
  return array;
}

void check_rows(const py::array& array, const std::string& what) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw InputError(what + " expects an array of shape (n, 3), found " + shape_text(array));
}

/// Letters of NumPy's kinds: whole numbers, and those with a point.
bool is_of_kind(const py::array& array, const char* kinds) {
  return std::string(kinds).find(array.dtype().kind()) != std::string::npos;
}

}  // namespace

py::array_t<double> rows_of_doubles(const py::object& values, const std::string& what) {
  const py::array array = array_of(values, what);
  check_rows(array, what);
  if (!is_of_kind(array, "iuf"))
    throw InputError(what + " expects numbers, found " + std::string(py::str(array.dtype())));
  return py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
}

Eigen::Map<const Points> as_points(const py::array_t<double>& rows) {
  return {rows.data(), rows.shape(0), 3};
}

Triangles triangles_of(const py::object& values) {
  const py::array array = array_of(values, "faces");
  check_rows(array, "faces");
  if (!is_of_kind(array, "iu"))
    throw InputError("faces expects whole numbers, found " + std::string(py::str(array.dtype())));
  const auto rows = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
  Triangles triangles(rows.shape(0), 3);
  for (py::ssize_t t = 0; t < rows.shape(0); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const std::int64_t vertex = rows.at(t, corner);
      if (vertex < 0 || vertex > std::numeric_limits<std::int32_t>::max())
        throw InputError("row " + std::to_string(t) + " of faces refers to vertex " + std::to_string(vertex));
      triangles(t, corner) = static_cast<std::int32_t>(vertex);
    }
  return triangles;
}

Eigen::Vector3d vector_of(const py::object& values, const std::string& what) {
  const py::array array = py::array::ensure(values);
  if (!array) PyErr_Clear();
  if (!array || array.ndim() != 1 || array.shape(0) != 3 || !is_of_kind(array, "iuf"))
    throw UsageError(what + " expects three numbers");
  const auto numbers = py::array_t<double, py::array::forcecast>::ensure(array);
  return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

}  // namespace stackabilization::python
