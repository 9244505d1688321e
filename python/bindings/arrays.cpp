#include "bindings/arrays.h"

#include <cstdint>
#include <utility>

#include "stackabilization/core/errors.h"

namespace stackabilization::python {

namespace {

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

/// What NumPy makes of the values. Raises InputError from what NumPy, or the object itself, says against it.
py::array array_of(const py::object& values, const std::string& what, const char* expected) {
  const std::string sentence = what + " expects " + expected;
  const py::module_ numpy = py::module_::import("numpy");
  try {
    const py::array array = numpy.attr("asarray")(values);
    const bool masked = py::hasattr(values, "mask") && numpy.attr("any")(values.attr("mask")).cast<bool>();
    if (!masked) return array;
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_Exception) || error.matches(PyExc_MemoryError)) throw;
    py::raise_from(error, py::module_::import("stackabilization._core").attr("InputError").ptr(),
                   sentence.c_str());
    throw py::error_already_set();
  }
  throw InputError(sentence + " without masked values");
}

/// An array of shape (n, 3).
py::array rows_of(const py::object& values, const std::string& what) {
  constexpr const char* expected = "an array of shape (n, 3)";
  py::array array = array_of(values, what, expected);
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw InputError(what + " expects " + expected + ", found " + shape_text(array));
  return array;
}

/// Letters of NumPy's kinds: whole numbers, and those with a point.
bool is_of_kind(const py::array& array, const char* kinds) {
  return std::string(kinds).find(array.dtype().kind()) != std::string::npos;
}

/// Without a copy where the array is like that already.
template <class Value>
py::array_t<Value> in_c_order(const py::array& array) {
  return py::array_t<Value, py::array::c_style | py::array::forcecast>::ensure(array);
}

void check_whole(const py::array& array, const std::string& what) {
  if (!is_of_kind(array, "iu"))
    throw InputError(what + " expects whole numbers, found " + std::string(py::str(array.dtype())));
}

/// The numbers of an array as 32 bits; `refuse` is called with the row and the text of one that does not fit.
template <class Value, class Refuse>
void narrow(const py::array_t<Value>& from, std::int32_t* to, const Refuse& refuse) {
  const Value* const values = from.data();
  for (py::ssize_t i = 0; i < from.size(); ++i) {
    if (!std::in_range<std::int32_t>(values[i])) refuse(i, std::to_string(values[i]));
    to[i] = static_cast<std::int32_t>(values[i]);
  }
}

/// The same for any type of whole numbers.
template <class Refuse>
void narrow_any(const py::array& from, std::int32_t* to, const Refuse& refuse) {
  if (from.dtype().kind() == 'u')
    narrow(in_c_order<std::uint64_t>(from), to, refuse);
  else if (from.itemsize() <= 4)
    narrow(in_c_order<std::int32_t>(from), to, refuse);
  else
    narrow(in_c_order<std::int64_t>(from), to, refuse);
}

}  // namespace

py::array_t<double> rows_of_doubles(const py::object& values, const std::string& what) {
  const py::array array = rows_of(values, what);
  if (!is_of_kind(array, "iuf"))
    throw InputError(what + " expects numbers, found " + std::string(py::str(array.dtype())));
  return py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
}

Eigen::Map<const Points> as_points(const py::array_t<double>& rows) {
  return {rows.data(), rows.shape(0), 3};
}

std::shared_ptr<const py::array_t<double>> shared(py::array_t<double> rows) {
  return {new py::array_t<double>(std::move(rows)), [](const py::array_t<double>* array) {
            if (PyGILState_Check() != 0) delete array;
          }};
}

Triangles triangles_of(const py::object& values) {
  const py::array array = rows_of(values, "faces");
  check_whole(array, "faces");
  const auto refuse = [](py::ssize_t at, const std::string& vertex) {
    throw InputError("row " + std::to_string(at / 3) + " of faces refers to vertex " + vertex);
  };
  Triangles triangles(array.shape(0), 3);
  narrow_any(array, triangles.data(), refuse);
  for (Eigen::Index i = 0; i < triangles.size(); ++i)
    if (triangles.data()[i] < 0) refuse(i, std::to_string(triangles.data()[i]));
  return triangles;
}

std::vector<std::int32_t> whole_numbers(const py::object& values, const std::string& what) {
  const py::array array = array_of(values, what, "whole numbers");
  if (array.ndim() != 1)
    throw InputError(what + " expects one whole number per face, found an array of shape " +
                     shape_text(array));
  check_whole(array, what);
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(array.size()));
  narrow_any(array, numbers.data(), [&](py::ssize_t row, const std::string& number) {
    throw InputError("row " + std::to_string(row) + " of " + what + " is " + number);
  });
  return numbers;
}

Eigen::Vector3d vector_of(const py::object& values, const std::string& what) {
  const py::array array = array_of(values, what, "three numbers");
  if (array.ndim() != 1 || array.shape(0) != 3 || !is_of_kind(array, "iuf"))
    throw UsageError(what + " expects three numbers");
  const auto numbers = py::array_t<double, py::array::forcecast>::ensure(array);
  return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

}  // namespace stackabilization::python
