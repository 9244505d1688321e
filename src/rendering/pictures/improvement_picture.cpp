#include <algorithm>
#include <array>

#include "rendering/drawing/legend.h"
#include "rendering/drawing/plot_parts.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/rendering/foot.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/scene.h"
#include "stackabilization/rendering/stacking_scene.h"

namespace stackabilization {
namespace {

struct ImprovementSide {
  const MeasuredShape& what;
  Colour colour;
  std::string name;
};

/// Regions of a shape that was moved.
std::vector<ContactRegion> moved(std::vector<ContactRegion> regions, const Eigen::Vector3d& shift) {
  for (ContactRegion& region : regions)
    for (ContactPolygon& polygon : region.polygons) {
      polygon.upper_points.rowwise() += shift.transpose();
      polygon.lower_points.rowwise() += shift.transpose();
    }
  return regions;
}

/// Returns the shape with its foot at the origin.
Scene scene_of(const ImprovementSide& side, const Direction& up) {
  const Eigen::Vector3d to_origin = -foot_of(side.what.shape, up);
  return touching_scene({transformed(side.what.shape, Eigen::Matrix3d::Identity(), to_origin), {side.colour}},
                        moved(side.what.contacts, to_origin), up);
}

/// Title and numbers of one side, below its picture.
detail::Elements caption(const ImprovementSide& side, const Rectangle& place, double size) {
  const Stackability& measured = side.what.measured;
  const Unit unit = side.what.shape.unit;
  std::vector<LegendEntry> entries{{LegendMark::swatch, side.colour, side.name}};
  if (!side.what.contacts.empty())
    entries.push_back({LegendMark::swatch, palette::contact, "where copies touch"});
  detail::Elements elements = detail::legend(entries, {place.x, place.y, place.width, 2 * size}, size);
  const std::string numbers = "S = " + fixed_text(measured.value, 4) + " " +
                              direction_text(measured.direction) +
                              "     f_max = " + detail::length_text(measured.f_max, unit) +
                              "     h = " + detail::length_text(measured.extent, unit);
  elements.emplace_back(
      detail::fitted({{place.x, place.y + 3.4 * size}, numbers, 1.1 * size, palette::ink}, place.width));
  return elements;
}

}  // namespace

Drawing improvement_picture(const ImprovedShape& shapes, const ImprovementPictureOptions& options) {
  if (shapes.before.measured.direction != shapes.after.measured.direction)
    throw UsageError("a picture of before and after needs both measured along the same direction");
  const Direction up(shapes.after.measured.direction);
  const std::array<ImprovementSide, 2> sides{
      {{shapes.before, palette::input, "before"}, {shapes.after, palette::output, "after"}}};
  const double size = options.width / 60.0, margin = 1.5 * size;
  Drawing drawing{options.width, options.height, {}};
  const detail::Heading heading = detail::heading(options.title, options.notes, options.width, size);
  drawing.add(heading.elements);
  const double top = heading.bottom + size, column = (options.width - 3 * margin) / 2;
  const double height = std::max(options.height - top - 5.5 * size, size);
  ViewOptions view_options;
  view_options.width = static_cast<int>(column);
  view_options.height = static_cast<int>(height);
  const std::array<Scene, 2> scenes{scene_of(sides[0], up), scene_of(sides[1], up)};
  Scene both = scenes[0];
  both.add(scenes[1]);
  const View view = fit_view(both, up, view_options);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Rectangle place{margin + static_cast<double>(k) * (column + margin), top, column, height};
    drawing.add(PlacedImage{place, render(scenes[k], view)});
    drawing.add(caption(sides[k], {place.x, place.bottom() + 0.3 * size, column, 5 * size}, size));
  }
  return drawing;
}

}  // namespace stackabilization
