#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/common/common_options.h"
#include "apps/common/measurement.h"
#include "apps/common/values.h"
#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "bindings/job.h"
#include "stackabilization/envelope/separation_gradient.h"
#include "stackabilization/stacking/measure_many.h"

namespace stackabilization::python {

namespace {

ContactSemantics semantics_named(const std::string& name) {
  for (const ContactSemantics known : {ContactSemantics::solid, ContactSemantics::closed})
    if (apps::name_of(known) == name) return known;
  throw UsageError("semantics expects one of solid|closed, found '" + name + "'");
}

BoxModel boxes_named(const std::string& name) {
  for (const BoxModel known : {BoxModel::oriented, BoxModel::frame})
    if (apps::name_of(known) == name) return known;
  throw UsageError("boxes expects one of oriented|frame, found '" + name + "'");
}

py::array_t<double> array_of(const Eigen::Vector3d& vector) {
  py::array_t<double> array(3);
  std::copy_n(vector.data(), 3, array.mutable_data());
  return array;
}

py::array_t<double> array_of(const Eigen::Matrix3d& matrix) {
  py::array_t<double> array({3, 3});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) array.mutable_at(i, j) = matrix(i, j);
  return array;
}

/// (by upper corners, by lower corners, by direction); None where a triangle has no area.
py::object gradient_tuple(const Shape& below, const Shape& above, const Direction& direction,
                          const Separation& separation) {
  try {
    const SeparationGradient gradient = separation_gradient(below, above, direction, separation);
    return py::make_tuple(array_of(gradient.upper), array_of(gradient.lower), array_of(gradient.direction));
  } catch (const UsageError&) {
    return py::none();
  }
}

/// None when nothing blocks; else the value as a fraction in decimal, its length, the witness and a gradient.
py::object separation_tuple(const Shape& below, const Shape& above, const Direction& direction,
                            const Separation& separation) {
  if (!separation.blocked) return py::none();
  const Witness& witness = separation.witness;
  return py::make_tuple(separation.value.numerator(), separation.value.denominator(), separation.length,
                        py::make_tuple(witness.upper_triangle, witness.lower_triangle,
                                       array_of(witness.upper_point), array_of(witness.lower_point)),
                        gradient_tuple(below, above, direction, separation));
}

/// A mesh prepared for many directions.
class Solver {
 public:
  Solver(const std::shared_ptr<Shape>& mesh, const std::string& semantics, const std::string& boxes)
      : mesh_(mesh) {
    StackabilityOptions options;
    options.semantics = semantics_named(semantics);
    options.boxes = boxes_named(boxes);
    options.flat_shapes = FlatShapes::measure;
    solver_ = run_as_job(py::none(), [mesh, options](JobState&) {
      return std::make_shared<StackabilitySolver>(*mesh, options);
    });
  }

  py::object separation(const py::object& along) const {
    const Direction direction(vector_of(along, "direction"));
    const Separation found = run_as_job(
        py::none(), [solver = solver_, direction](JobState&) { return solver->separation(direction); });
    return separation_tuple(*mesh_, *mesh_, direction, found);
  }

  std::string measure(const std::string& name, const py::object& along) const {
    const Direction direction(vector_of(along, "direction"));
    return run_as_job(py::none(), [name, direction, mesh = mesh_, solver = solver_](JobState&) {
      const apps::Model model{name, *mesh, inspect(*mesh)};
      apps::Json document = apps::document_head("measure", model);
      apps::add_measurement(document, apps::measure_exactly(*solver, direction), model);
      document["findings"] = apps::to_json(model.findings);
      return document.dump();
    });
  }

  py::tuple measure_many(const py::object& rows, const py::object& threads,
                         const py::object& progress) const {
    const std::shared_ptr<const py::array_t<double>> directions = shared(rows_of_doubles(rows, "directions"));
    apps::CommonOptions common;
    if (!threads.is_none()) common.threads = apps::parse_threads(py::str(threads));
    const std::vector<Stackability> measured =
        run_as_job(progress, [solver = solver_, common, directions](JobState& job) {
          const apps::ThreadLimit limit(common);
          return stackabilization::measure_many(*solver, as_points(*directions),
                                                {[&job](double fraction) { job.tell("Measuring", fraction); },
                                                 [&job] { return job.stopped.load(); }});
        });
    const auto count = static_cast<py::ssize_t>(measured.size());
    py::array_t<double> f_max(count), height(count), stackability(count);
    for (py::ssize_t i = 0; i < count; ++i) {
      const Stackability& values = measured[static_cast<std::size_t>(i)];
      f_max.mutable_at(i) = values.f_max;
      height.mutable_at(i) = values.extent;
      stackability.mutable_at(i) = values.value;
    }
    return py::make_tuple(f_max, height, stackability);
  }

  const std::shared_ptr<Shape>& mesh() const { return mesh_; }

 private:
  std::shared_ptr<Shape> mesh_;
  std::shared_ptr<const StackabilitySolver> solver_;
};

py::object separation_of(const std::shared_ptr<Shape>& below, const std::shared_ptr<Shape>& above,
                         const py::object& along, const std::string& semantics) {
  const Direction direction(vector_of(along, "direction"));
  SeparationOptions options;
  options.semantics = semantics_named(semantics);
  const Separation found = run_as_job(py::none(), [=](JobState&) {
    const SeparationTree tree_below(*below);
    return below == above ? separation(tree_below, tree_below, direction, options)
                          : separation(tree_below, SeparationTree(*above), direction, options);
  });
  return separation_tuple(*below, *above, direction, found);
}

}  // namespace

void add_solver(py::module_& module) {
  using namespace py::literals;
  py::class_<Solver>(module, "Solver")
      .def(py::init<const std::shared_ptr<Shape>&, const std::string&, const std::string&>(), "mesh"_a,
           "semantics"_a, "boxes"_a)
      .def("separation", &Solver::separation, "direction"_a)
      .def("measure", &Solver::measure, "name"_a, "direction"_a)
      .def("measure_many", &Solver::measure_many, "directions"_a, "threads"_a, "progress"_a)
      .def_property_readonly("mesh", &Solver::mesh);
  module.def("separation", &separation_of, "below"_a, "above"_a, "direction"_a, "semantics"_a);
}

}  // namespace stackabilization::python
