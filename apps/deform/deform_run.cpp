#include "apps/deform/deform_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "apps/common/edit_grammar.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/factory.h"

namespace stackabilization::apps {

namespace {

DeformationConstraints constraints_of(const DeformCommandOptions& options, const Shape& shape) {
  DeformationConstraints constraints;
  if (options.keep_extent) constraints.keep_extent = Direction(*options.keep_extent);
  constraints.extent_ends = options.extent_ends.value_or(ExtentEnds::free);
  constraints.box_tolerance = options.box_tolerance;
  constraints.fixed_parts = parts_named("--fix", options.fixed_parts, shape);
  constraints.fixed_points = options.fixed_points;
  try {
    validate(constraints, shape);
  } catch (const UsageError& error) {
    // The other options have been looked at.
    throw UsageError(std::string("--fix-point: ") + error.what());
  }
  return constraints;
}

}  // namespace

std::unique_ptr<DeformationModel> model_for_edits(const DeformCommandOptions& options, StructuredShape rest) {
  DeformationModelOptions model{options.kind, {}, {}, options.following.value_or(Following::free)};
  if (options.direction) model.direction = Direction(*options.direction);
  model.limits = {std::numeric_limits<std::size_t>::max(), ControllerLimits().max_joint_points};
  return deformation_model(std::move(rest), model);
}

DeformRun run_deform(const DeformCommandOptions& options, const StructuredModel& input) {
  DeformRun run;
  run.kind = options.kind;
  run.following = options.following.value_or(Following::free);
  run.rest = input.structured;
  for (const std::string& text : options.edits)
    run.edits.push_back(parse_edit(text, run.rest.shape.part_names, run.rest.structure.diagonal));
  run.constraints = constraints_of(options, run.rest.shape);
  const std::unique_ptr<DeformationModel> model = model_for_edits(options, run.rest);
  run.result = model->deformed(run.edits, run.constraints);
  for (const Edit& edit : run.edits)
    if (std::vector<std::int32_t> curve = model->curve(edit.handle); !curve.empty())
      run.curves.push_back(std::move(curve));
  if (!run.result.refusal) {
    run.residuals = model->relation_residuals(run.result.design);
    run.explanation = explain(run.rest, run.result.design.shape, {Eigen::Vector3d::UnitZ(), run.edits, {}});
  }
  if (!model->capabilities().edits_primitives) run.result.design.primitives.clear();  // nobody edited them
  return run;
}

Displacement displacement(const Shape& before, const Shape& after) {
  std::vector<bool> used(static_cast<std::size_t>(before.vertex_count()));
  for (const std::int32_t vertex : before.triangles.reshaped<Eigen::RowMajor>())
    used[static_cast<std::size_t>(vertex)] = true;
  double squares = 0, largest = 0;
  Eigen::Index count = 0;
  for (Eigen::Index v = 0; v < before.vertex_count(); ++v) {
    if (!used[static_cast<std::size_t>(v)]) continue;
    const double length = (after.vertices.row(v) - before.vertices.row(v)).norm();
    squares += length * length;
    largest = std::max(largest, length);
    ++count;
  }
  return {std::sqrt(squares / static_cast<double>(std::max<Eigen::Index>(count, 1))), largest};
}

}  // namespace stackabilization::apps
