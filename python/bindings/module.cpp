#include "apps/common/version.h"
#include "bindings/bindings.h"

PYBIND11_MODULE(_core, module) {
  using namespace stackabilization::python;
  module.doc() = "The compiled part of stackabilization: see that package.";
  module.attr("version") = stackabilization::apps::version_number();
  add_errors(module);
  add_mesh(module);
  add_commands(module);
  add_solver(module);
  add_improvement(module);
}
