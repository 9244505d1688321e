#include "stackabilization/core/errors.h"

#include <CLI/Error.hpp>
#include <string>

#include "apps/common/interrupt.h"
#include "bindings/bindings.h"

namespace stackabilization::python {

namespace {

/// The classes live as long as the interpreter.
struct ErrorClasses {
  PyObject *input, *usage, *output, *render;
};

ErrorClasses& classes() {
  static ErrorClasses known{};
  return known;
}

PyObject* new_class(py::module_& module, const char* name, const char* doc, const py::tuple& bases) {
  const std::string full_name = std::string("stackabilization.") + name;
  PyObject* const made = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, bases.ptr(), nullptr);
  module.attr(name) = py::handle(made);
  return made;
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    PyErr_SetString(classes().input, error.what());
  } catch (const UsageError& error) {
    PyErr_SetString(classes().usage, error.what());
  } catch (const OutputError& error) {
    PyErr_SetString(classes().output, error.what());
  } catch (const RenderError& error) {
    PyErr_SetString(classes().render, error.what());
  } catch (const CLI::Error& error) {
    PyErr_SetString(classes().usage, error.what());
  } catch (const apps::Interrupted& error) {
    PyErr_SetString(PyExc_KeyboardInterrupt, error.what());
  }
}

}  // namespace

void add_errors(py::module_& module) {
  const py::handle value_error = PyExc_ValueError, os_error = PyExc_OSError, error = PyExc_RuntimeError;
  PyObject* const base = new_class(module, "Error", "Base of the errors of this package.",
                                   py::make_tuple(py::handle(PyExc_Exception)));
  const py::handle own(base);
  classes() = {
      new_class(module, "InputError",
                "A mesh or a file cannot be used; the message names the place and what was expected there.",
                py::make_tuple(own, value_error)),
      new_class(module, "UsageError",
                "An argument is out of range or does not fit the others; the message names it.",
                py::make_tuple(own, value_error)),
      new_class(module, "OutputError", "A file cannot be written.", py::make_tuple(own, os_error)),
      new_class(module, "RenderError", "A picture cannot be drawn.", py::make_tuple(own, error))};
  py::register_exception_translator(translate);
}

}  // namespace stackabilization::python
