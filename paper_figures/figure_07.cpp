#include <algorithm>

#include "paper_figures/figure.h"
#include "paper_figures/shown.h"
#include "stackabilization/rendering/structure_views.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/ctrl_grp_files.h"

namespace stackabilization::figures {
namespace {

struct Figure07Options {
  ModelSource model;
  Camera camera;
};

Figure07Options read_figure_07(const Fields& fields) {
  return {read_model_source(fields.object("model")), read_camera(fields)};
}

long count(const Structure& structure, RelationType type) {
  return std::count_if(structure.relations.begin(), structure.relations.end(),
                       [type](const Relation& relation) { return relation.type == type; });
}

FigureResult make_figure_07(const Figure07Options& options, const ModelFolder& models) {
  const StructuredShape structured = analyse_structure(models.read(options.model));
  const Structure& structure = structured.structure;
  const Direction up(0, 0, 1);
  PanelRow row;
  row.height = 0.78;
  row.scale = PanelScale::common;
  row.panels = {{scene_panel(parts_scene(structured), up, options.camera), "(a) parts", {}, 1},
                {scene_panel(primitives_scene(structured), up, options.camera), "(b) joints", {}, 1}};
  PanelSheetOptions sheet;
  sheet.legend = {{LegendMark::dot, structure_colour::point_joint, "point joint"},
                  {LegendMark::bar, structure_colour::line_joint, "line joint"},
                  {LegendMark::line, structure_colour::symmetry, "symmetry plane"}};
  const long points = count(structure, RelationType::point_joint),
             lines = count(structure, RelationType::line_joint);
  return {panel_sheet({row}, sheet),
          {{"parts", structure.parts.size()},
           {"point joints", points},
           {"line joints", lines},
           {"symmetric pairs of parts", count(structure, RelationType::symmetry)},
           {"self-symmetries of parts", count(structure, RelationType::self_symmetry)}},
          {{"both kinds of joints are found: point joints and line joints", points > 0 && lines > 0}}};
}

}  // namespace

Figure figure_07() {
  return figure(7, "Point joints (green balls) and line joints (red bars)", read_figure_07, make_figure_07);
}

}  // namespace stackabilization::figures
