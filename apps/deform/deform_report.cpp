#include <algorithm>

#include "apps/common/edit_grammar.h"
#include "apps/common/explanation_report.h"
#include "apps/common/structure_report.h"
#include "apps/common/text.h"
#include "apps/deform/deform_run.h"
#include "stackabilization/deformation/tolerances.h"

namespace stackabilization::apps {

namespace {

/// Largest residuals, fraction of the diagonal; nothing where there is no such relation.
struct LargestResiduals {
  std::optional<double> joint, symmetry;
};

LargestResiduals largest_residuals(const DeformRun& run) {
  LargestResiduals largest;
  for (std::size_t i = 0; i < run.residuals.size(); ++i) {
    const bool is_joint = run.rest.structure.relations[i].is_joint();
    std::optional<double>& value = is_joint ? largest.joint : largest.symmetry;
    value = std::max(value.value_or(0), run.residuals[i]);
  }
  return largest;
}

Eigen::Vector3d extents(const Shape& shape) {
  return {range_along(shape, Eigen::Vector3d::UnitX()).length(),
          range_along(shape, Eigen::Vector3d::UnitY()).length(),
          range_along(shape, Eigen::Vector3d::UnitZ()).length()};
}

double extent_along(const Shape& shape, const Direction& direction) {
  return range_along(shape, direction.unit()).length();
}

std::string extents_text(const Shape& shape, Unit unit) {
  const Eigen::Vector3d size = extents(shape);
  return rounded(size.x()) + " x " + rounded(size.y()) + " x " + quantity(size.z(), unit);
}

Json refusal_json(const Refusal& refusal, const Structure& structure) {
  Json relation = nullptr;
  if (refusal.relation >= 0) {
    relation = to_json(structure.relations.at(static_cast<std::size_t>(refusal.relation)), structure);
    relation["index"] = refusal.relation;
  }
  return {{"reason", describe(refusal, structure)},
          {"relation", relation},
          {"amount", std::max(refusal.amount, 0.0)}};
}

Json relations_after_json(const DeformRun& run) {
  Json list = Json::array();
  for (std::size_t i = 0; i < run.residuals.size(); ++i) {
    Json relation = to_json(run.rest.structure.relations[i], run.rest.structure);
    relation["residual"] = run.residuals[i];
    list.push_back(std::move(relation));
  }
  return list;
}

Json primitives_after_json(const DeformRun& run) {
  Json list = Json::array();
  for (std::size_t i = 0; i < run.result.design.primitives.size(); ++i) {
    Json primitive = {{"part", run.rest.shape.part_names[i]}};
    primitive.update(to_json(run.result.design.primitives[i]));
    list.push_back(std::move(primitive));
  }
  return list;
}

void add_residual_lines(TextTable& table, const DeformRun& run) {
  const LargestResiduals largest = largest_residuals(run);
  if (largest.joint)
    table.add("Joints", small_percent(*largest.joint),
              run.following == Following::smooth
                  ? "of the diagonal: the largest gap at a joint, beyond a slack of " +
                        small_percent(tolerance::joint_slack)
                  : "of the diagonal: the largest gap at a joint");
  if (largest.symmetry)
    table.add("Symmetries", small_percent(*largest.symmetry), "of the diagonal: the largest deviation");
}

}  // namespace

void add_deformation(Json& document, const DeformRun& run) {
  const Shape& before = run.rest.shape;
  document["deformation"] = name_of(run.kind);
  document["edits"] = edit_texts(run.edits, before.part_names);
  document["refusal"] =
      run.result.refusal ? refusal_json(*run.result.refusal, run.rest.structure) : Json(nullptr);
  document["size_before"] = to_json(extents(before));
  if (run.constraints.keep_extent)
    document["extent_before"] = extent_along(before, *run.constraints.keep_extent);
  if (run.result.refusal) return;
  document["size_after"] = to_json(extents(run.result.design.shape));
  if (run.constraints.keep_extent)
    document["extent_after"] = extent_along(run.result.design.shape, *run.constraints.keep_extent);
  const Displacement moved = displacement(before, run.result.design.shape);
  const LargestResiduals largest = largest_residuals(run);
  document["displacement"] = {{"root_mean_square", moved.root_mean_square}, {"largest", moved.largest}};
  document["residuals"] = {{"joint", to_json(largest.joint)}, {"symmetry", to_json(largest.symmetry)}};
  document["explanation"] = explanation_json(run.explanation, before.part_names);
  document["primitives"] = primitives_after_json(run);
  document["relations"] = relations_after_json(run);
}

std::string deformation_text(const DeformRun& run, const Model& model) {
  const Shape& before = run.rest.shape;
  TextTable table;
  add_model_line(table, model);
  const std::vector<std::string> lines = edit_texts(run.edits, before.part_names);
  for (std::size_t i = 0; i < lines.size(); ++i) table.add(i == 0 ? "Edits" : "", lines[i]);
  if (const std::optional<Refusal>& refusal = run.result.refusal) {
    const Structure& structure = run.rest.structure;
    if (refusal->relation >= 0) {
      const Relation& relation = structure.relations.at(static_cast<std::size_t>(refusal->relation));
      table.add("Breaks", small_percent(std::max(refusal->amount, 0.0)),
                "of the diagonal: " + describe(relation, structure));
    }
    return table.text() + "Refused: " + describe(*refusal, structure) + "\n";
  }
  const std::vector<std::string> words = explanation_lines(run.explanation);
  for (std::size_t i = 0; i < words.size(); ++i) table.add(i == 0 ? "Changes" : "", words[i]);
  const Shape& after = run.result.design.shape;
  const Displacement moved = displacement(before, after);
  table.add("Moved", quantity(moved.root_mean_square, before.unit),
            "root mean square over the vertices; " + quantity(moved.largest, before.unit) + " at most");
  table.add("Size", extents_text(after, before.unit), "was " + extents_text(before, before.unit));
  if (run.constraints.keep_extent)
    table.add("Extent", quantity(extent_along(after, *run.constraints.keep_extent), before.unit),
              "along " + vector_text(run.constraints.keep_extent->vector()) + ", was " +
                  quantity(extent_along(before, *run.constraints.keep_extent), before.unit));
  add_residual_lines(table, run);
  return table.text();
}

std::vector<std::string> deformation_notes(const DeformRun& run) {
  const std::string edits = joined(edit_texts(run.edits, run.rest.shape.part_names), ";  ");
  const Displacement moved = displacement(run.rest.shape, run.result.design.shape);
  return {edits, name_of(run.kind) + ": vertices moved by " +
                     quantity(moved.root_mean_square, run.rest.shape.unit) + " (root mean square)"};
}

Json handles_json(const DeformationModel& model, const Shape& shape) {
  Json list = Json::array();
  for (const Handle& handle : model.handles())
    list.push_back({{"handle", handle_text(handle, shape.part_names)},
                    {"kind", handle_kind_names().at(static_cast<std::size_t>(handle.kind))},
                    {"centre", to_json(model.centre(handle))}});
  return list;
}

std::string handles_text(const DeformationModel& model, const Shape& shape) {
  const double size = extents(shape).norm();
  ColumnTable table({"handle", "centre"});
  for (const Handle& handle : model.handles())
    table.add({handle_text(handle, shape.part_names), point_text(model.centre(handle), size)});
  return table.text();
}

}  // namespace stackabilization::apps
