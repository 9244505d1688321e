#include <algorithm>

#include "paper_figures/before_after.h"
#include "paper_figures/shown.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/part_names.h"
#include "stackabilization/rendering/foot.h"
#include "stackabilization/rendering/structure_views.h"
#include "stackabilization/stacking/rigid_transform.h"
#include "stackabilization/stacking/search.h"
#include "stackabilization/structure/analysis.h"

namespace stackabilization::figures {
namespace {

/// Parts that turn together about the line joint of two parts.
struct Fold {
  std::vector<std::string> joint;  ///< names of the two parts
  std::vector<std::string> moves;  ///< names of the parts that turn
  double degrees = 0;  ///< right-handed about the joint, whose axis points to its greater coordinates
};

struct Figure13Options {
  ModelSource model;
  std::vector<Fold> folds;  ///< one after the other, each about the joint where it is at rest
  int copies = 4;
  Camera camera;
};

Figure13Options read_figure_13(const Fields& fields) {
  Figure13Options options{
      read_model_source(fields.object("model")), {}, read_copies(fields, 2), read_camera(fields)};
  for (const Fields& fold : fields.objects("folds")) {
    options.folds.push_back({fold.texts("joint"), fold.texts("moves"), fold.number("degrees")});
    if (options.folds.back().joint.size() != 2) fold.refuse("joint", "the names of two parts");
  }
  return options;
}

/// The line joint of two parts, its ends as rows.
Points hinge_of(const StructuredShape& structured, const Fold& fold) {
  const std::vector<int> parts = parts_named(structured.shape, fold.joint);
  for (const Relation& relation : structured.structure.relations)
    if (relation.type == RelationType::line_joint &&
        std::is_permutation(relation.parts.begin(), relation.parts.end(), parts.begin(), parts.end()))
      return relation.points;
  throw InputError("the parts '" + fold.joint[0] + "' and '" + fold.joint[1] +
                   "' of the model are not joined along a line");
}

Shape folded(Shape shape, const Points& hinge, const Fold& fold) {
  Eigen::Vector3d axis = (hinge.row(1) - hinge.row(0)).transpose();
  if (axis.sum() < 0) axis = -axis;
  const RigidTransform turn = rotation_about({hinge.row(0).transpose(), Direction(axis)}, fold.degrees);
  std::vector<bool> moves(static_cast<std::size_t>(shape.part_count()), false);
  for (const int part : parts_named(shape, fold.moves)) moves[static_cast<std::size_t>(part)] = true;
  std::vector<bool> moved(static_cast<std::size_t>(shape.vertex_count()), false);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    if (moves[static_cast<std::size_t>(shape.triangle_part[static_cast<std::size_t>(t)])])
      for (int k = 0; k < 3; ++k) moved[static_cast<std::size_t>(shape.triangles(t, k))] = true;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    if (moved[static_cast<std::size_t>(v)])
      shape.vertices.row(v) =
          (turn.rotation * shape.vertices.row(v).transpose() + turn.translation).transpose();
  return shape;
}

/// The open shape with its hinges.
ScenePanel hinged_panel(const Shape& shape, const std::vector<Points>& hinges, const Camera& camera) {
  Scene scene;
  scene.add({shape, {palette::input}});
  ScenePanel panel = scene_panel(std::move(scene), Direction(0, 0, 1), camera);
  for (const Points& hinge : hinges)
    panel.over.lines.push_back(SceneLines{{hinge}, structure_colour::line_joint, 5});
  return panel;
}

Panel folding_stack_panel(const MeasuredShape& shape, const Figure13Options& options,
                          const std::string& title) {
  const Colour colour = title.find("folded") == std::string::npos ? palette::input : palette::output;
  ScenePanel panel = single_stack_panel(shape, options.copies, colour, options.camera);
  panel.over.dimensions = {stack_dimension(shape, options.copies, Anchor::left)};
  return {std::move(panel), title, {}, 1};
}

FigureResult make_figure_13(const Figure13Options& options, const ModelFolder& models) {
  const StructuredShape structured = analyse_structure(models.read(options.model));
  const Direction up(0, 0, 1);
  Shape shape = structured.shape;
  std::vector<Points> hinges;
  for (const Fold& fold : options.folds) {
    hinges.push_back(hinge_of(structured, fold));
    shape = folded(std::move(shape), hinges.back(), fold);
  }
  const MeasuredShape open = measured_shape(structured.shape, up), flat = measured_shape(shape, up);
  Scene folded_scene;
  folded_scene.add({on_ground(flat.shape, up), {palette::output}});
  PanelRow chairs, stacks;
  chairs.scale = stacks.scale = PanelScale::common;
  chairs.height = 0.42;
  stacks.height = 0.62;
  chairs.panels = {{hinged_panel(open.shape, hinges, options.camera), "(a) open", {}, 1},
                   {scene_panel(std::move(folded_scene), up, options.camera), "(b) folded", {}, 1}};
  stacks.panels = {folding_stack_panel(open, options, "(c) open, stacked"),
                   folding_stack_panel(flat, options, "(d) folded, stacked")};
  PanelSheetOptions sheet;
  sheet.legend = {{LegendMark::line, structure_colour::line_joint, "joints about which it folds"}};
  SearchOptions search;
  search.spacing = 0.08;
  search.climbs = 6;
  const Stackability nested = best_direction(StackabilitySolver(open.shape), search).best;
  const auto per_copy = [](const Stackability& one) {
    return one.f_max / one.extent * one.stack_box_volume();
  };
  const auto volume = [&](const MeasuredShape& one) {
    return (1 + (options.copies - 1) * one.measured.f_max / one.measured.extent) *
           one.measured.stack_box_volume();
  };
  const double saving = 1 - volume(flat) / volume(open);
  const std::string stack = "box of a stack of " + std::to_string(options.copies);
  return {panel_sheet({chairs, stacks}, sheet),
          {{"hinges, line joints found on the shape", hinges.size()},
           {"h, open", open.measured.extent, "m"},
           {"h, folded", flat.measured.extent, "m"},
           {"f_max, open", open.measured.f_max, "m"},
           {"f_max, folded", flat.measured.f_max, "m"},
           {stack + ", open (Eq. 2)", volume(open), "m^3"},
           {stack + ", folded (Eq. 2)", volume(flat), "m^3"},
           {"saved by folding first", saving},
           {"room of each further copy, open, straight up", per_copy(open.measured), "m^3"},
           {"room of each further copy, open, nested along its best direction", per_copy(nested), "m^3"},
           {"room of each further copy, folded", per_copy(flat.measured), "m^3"}},
          {{"folded copies take less room than open ones stacked the same way", saving > 0}}};
}

}  // namespace

Figure figure_13() {
  return figure(13, "Folding about joints, then stacking", read_figure_13, make_figure_13);
}

}  // namespace stackabilization::figures
