#include "paper_figures/figure.h"
#include "paper_figures/shown.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/rendering/foot.h"
#include "stackabilization/rendering/stacking_scene.h"

namespace stackabilization::figures {
namespace {

constexpr int envelope_samples = 1000;

struct Figure02Options {
  ModelSource model;
  Direction direction;
  Camera camera;
};

Figure02Options read_figure_02(const Fields& fields) {
  return {read_model_source(fields.object("model")), Direction(fields.vector("direction")),
          read_camera(fields)};
}

/// The shape with h at its side and r above it.
ScenePanel shape_panel(const MeasuredShape& shape, const Camera& camera) {
  const Direction direction(shape.measured.direction);
  const Eigen::Vector3d up = direction.unit(), foot = foot_of(shape.shape, direction);
  const Eigen::Vector3d top = foot + shape.measured.extent * up;
  Scene scene;
  scene.add({shape.shape, {palette::input}});
  ScenePanel panel = scene_panel(std::move(scene), direction, camera);
  const Eigen::Vector3d tip = top + 0.35 * shape.measured.extent * up;
  panel.over.dimensions = {{foot, top, "h", Anchor::left}};
  panel.over.arrows = {{top + 0.04 * shape.measured.extent * up, tip}};
  panel.over.labels = {{tip - 0.1 * shape.measured.extent * up, "  r"}};
  return panel;
}

/// Two copies as close as they come.
ScenePanel stacked_panel(const MeasuredShape& shape, const Camera& camera) {
  const Direction direction(shape.measured.direction);
  const Eigen::Vector3d up = direction.unit(), foot = foot_of(shape.shape, direction);
  const Eigen::Vector3d top = foot + shape.measured.extent * up, lift = shape.measured.f_max * up;
  ScenePanel panel = scene_panel(stack_of(shape, 2, palette::input), direction, camera);
  panel.over.dimensions = {{top, top + lift, "f_max", Anchor::right}};
  return panel;
}

FigureResult make_figure_02(const Figure02Options& options, const ModelFolder& models) {
  const MeasuredShape shape = measured_shape(models.read(options.model), options.direction);
  const HeightField field = height_field_by_scanline(
      shape.shape, options.direction, window_around(shape.shape, options.direction, envelope_samples));
  const Stackability& measured = shape.measured;
  PanelRow row;
  row.height = 0.62;
  row.scale = PanelScale::common;
  row.panels = {
      {shape_panel(shape, options.camera), "(a) shape", {}, 1},
      {scene_panel(envelope_scene(shape.shape, shape.contacts, field), options.direction, options.camera),
       "(b) envelopes",
       {},
       1},
      {stacked_panel(shape, options.camera), "(c) stacked", {}, 1}};
  PanelSheetOptions sheet;
  sheet.legend = {{LegendMark::swatch, palette::upper, "upper envelope"},
                  {LegendMark::swatch, palette::lower, "lower envelope"},
                  contact_entry()};
  const double sampled = maximum_gap(field).value;
  return {panel_sheet({row}, sheet),
          {{"h", measured.extent, unit_symbol(shape.shape.unit)},
           {"f_max, exact", measured.f_max, unit_symbol(shape.shape.unit)},
           {"largest sampled gap u - l", sampled, unit_symbol(shape.shape.unit)},
           {"contact regions", shape.contacts.size()},
           {"S", measured.value}},
          {{"the two envelopes touch in contact regions when the copy above is f_max higher",
            !shape.contacts.empty()},
           {"the largest gap between the envelopes is f_max: no sample exceeds it",
            sampled <= measured.f_max * (1 + tolerance::relative)}}};
}

}  // namespace

Figure figure_02() {
  return figure(2, "Envelopes, extent h, stacking direction r and contact regions", read_figure_02,
                make_figure_02);
}

}  // namespace stackabilization::figures
