#include <memory>
#include <utility>

#include "apps/common/interrupt.h"
#include "apps/common/rendering.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/curve_plot.h"
#include "stackabilization/rendering/depth_raster.h"
#include "stackabilization/rendering/pictures.h"

namespace stackabilization::apps {

namespace {

void write_picture(const PictureFile& file, const Drawing& drawing) {
  const DeferredInterrupts until_written;
  write_drawing(file.path, drawing);
  if (until_written.requested()) throw Interrupted();
}

MeasuredShape measured_shape(const DesignView& design) {
  return {design.shape, design.measured, design.contacts};
}

}  // namespace

void require_rendering() {}

HeightField depth_buffer_field(const Shape& shape, const Direction& direction, const Window& window) {
  return height_field_by_depth_buffer(shape, direction, window);
}

DepthBufferMaker depth_buffer_maker(const Shape& shape) {
  try {
    const auto rasterizer = std::make_shared<DepthRasterizer>(shape);
    const auto make = [rasterizer](const Shape&, const Direction& direction, const Window& window) {
      return rasterizer->height_field(direction, window);
    };
    return {HeightFieldMaker{depth_buffer_name, make, depth_buffer_precision, depth_buffer_excess}, {}};
  } catch (const RenderError& error) {
    return {std::nullopt, error.what()};
  }
}

void write_measurement_picture(const PictureFile& file, const Shape& shape, const Measurement& measurement) {
  PictureOptions options;
  options.title = file.title;
  const std::vector<ContactRegion>& touching =
      measurement.layer ? measurement.layer->contacts.regions : measurement.contacts.regions;
  write_picture(file, measure_picture(shape, measurement.values, touching, options));
}

void write_map_picture(const PictureFile& file, const StackabilityMap& map) {
  MapPictureOptions options;
  options.title = file.title;
  write_picture(file, map_picture(map, options));
}

void write_stack_picture(const PictureFile& file, const PlacedCopies& stack) {
  StackPictureOptions options;
  options.title = file.title;
  options.notes = stack.notes;
  options.separators = stack.separators;
  write_picture(file, stack_picture(stack.copies, stack.direction, options));
}

void write_drop_picture(const PictureFile& file, DropView view) {
  DropPictureOptions options;
  options.title = file.title;
  options.notes = std::move(view.notes);
  write_picture(file, drop_picture({std::move(view.base), std::move(view.shape), view.place,
                                    std::move(view.map), view.direction},
                                   options));
}

void write_draft_picture(const PictureFile& file, const DraftView& view) {
  DraftPictureOptions options;
  options.title = file.title;
  options.notes = view.notes;
  options.min_draft = view.min_draft;
  write_picture(file, draft_picture(view.shape, view.draft, view.direction, options));
}

void write_structure_picture(const PictureFile& file, const StructuredShape& structured) {
  StructurePictureOptions options;
  options.title = file.title;
  write_picture(file, structure_picture(structured, options));
}

void write_deformation_picture(const PictureFile& file, const EditedShape& edited) {
  DeformationPictureOptions options;
  options.title = file.title;
  options.notes = edited.notes;
  options.curves = edited.curves;
  std::vector<Handle> handles;
  for (const Edit& edit : edited.edits) handles.push_back(edit.handle);
  write_picture(file, deformation_picture(edited.rest, edited.design, handles, options));
}

void write_design_sheet(const PictureFile& file, const DesignSheet& sheet) {
  DesignSheetOptions options;
  options.title = file.title;
  options.notes = sheet.notes;
  std::vector<DesignTile> tiles;
  for (const DesignSheet::Tile& tile : sheet.tiles) {
    tiles.push_back({tile.design.shape, tile.design.primitives, {}, tile.contacts, tile.captions});
    if (tile.edited) tiles.back().handles.push_back(*tile.edited);
  }
  write_picture(file, design_sheet(tiles, sheet.direction, options));
}

std::string rendering_missing() {
  return {};
}

void write_improvement_picture(const PictureFile& file, const ComparedDesigns& designs) {
  ImprovementPictureOptions options;
  options.title = file.title;
  options.notes = designs.notes;
  write_picture(
      file, improvement_picture({measured_shape(designs.before), measured_shape(designs.after)}, options));
}

void write_front_picture(const PictureFile& file, const std::vector<Eigen::Vector2d>& points) {
  CurvePlot plot;
  plot.x.title = "stackability S";
  plot.y.title = "change, per cent";
  PlotSeries series;
  series.mark = PlotMark::circle;
  series.points = points;
  for (std::size_t k = 0; k < points.size(); ++k)
    plot.notes.push_back({points[k], (k == 0 ? "at rest" : std::to_string(k)) + "  ", palette::ink,
                          k == 0 ? Anchor::left : Anchor::right});
  plot.series = {std::move(series)};
  CurvePlotOptions options;
  options.title = file.title;
  write_picture(file, curve_plot(plot, options));
}

void write_stacks_picture(const PictureFile& file, const ComparedDesigns& designs, int copies) {
  StacksPictureOptions options;
  options.title = file.title;
  options.notes = designs.notes;
  options.copies = copies;
  write_picture(file,
                stacks_picture({measured_shape(designs.before), measured_shape(designs.after)}, options));
}

}  // namespace stackabilization::apps
