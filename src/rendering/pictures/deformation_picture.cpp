#include <algorithm>
#include <array>
#include <utility>

#include "rendering/drawing/legend.h"
#include "rendering/drawing/plot_parts.h"
#include "rendering/pictures/handle_marks.h"
#include "rendering/scene/structure_scene.h"
#include "stackabilization/rendering/pictures.h"

namespace stackabilization {
namespace {

struct DeformationSide {
  const Shape& shape;
  const std::vector<Primitive>& primitives;
  Colour colour;
  std::string caption;
};

/// Edited handles.
struct Edited {
  const std::vector<Handle>& handles;
  const std::vector<std::vector<std::int32_t>>& curves;
};

std::vector<Points> lines_of(const Edited& edited, const DeformationSide& side) {
  std::vector<Points> lines = detail::lines_of(edited.handles, side.shape, side.primitives);
  for (const std::vector<std::int32_t>& curve : edited.curves)
    lines.emplace_back(side.shape.vertices(curve, Eigen::all));
  return lines;
}

}  // namespace

Drawing deformation_picture(const StructuredShape& rest, const Design& design,
                            const std::vector<Handle>& handles, const DeformationPictureOptions& options) {
  std::vector<Primitive> at_rest;
  if (!design.primitives.empty())  // else the handles are not those of primitives
    for (const Part& part : rest.structure.parts) at_rest.push_back(part.primitive);
  const std::array<DeformationSide, 2> sides{{{rest.shape, at_rest, palette::input, "before"},
                                              {design.shape, design.primitives, palette::output, "after"}}};
  const Edited edited{handles, options.curves};
  const double size = options.width / 60.0, margin = 1.5 * size;
  Drawing drawing{options.width, options.height, {}};
  const detail::Heading heading = detail::heading(options.title, options.notes, options.width, size);
  drawing.add(heading.elements);
  const double top = heading.bottom + size, column = (options.width - 3 * margin) / 2;
  const double height = options.height - top - 3 * size;
  ViewOptions view_options;
  view_options.width = static_cast<int>(column);
  view_options.height = static_cast<int>(height);
  const std::array<Scene, 2> scenes{detail::edited_scene(sides[0].shape, sides[0].colour, handles),
                                    detail::edited_scene(sides[1].shape, sides[1].colour, handles)};
  Scene both = scenes[0];
  both.add(scenes[1]);
  for (const DeformationSide& side : sides) both.add(SceneLines{lines_of(edited, side)});
  const View view = fit_view(both, Direction(0, 0, 1), view_options);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Rectangle place{margin + static_cast<double>(k) * (column + margin), top, column, height};
    drawing.add(PlacedImage{place, render(scenes[k], view)});
    drawing.add(detail::handle_marks(lines_of(edited, sides[k]), view, place));
    std::vector<LegendEntry> entries{{LegendMark::swatch, sides[k].colour, sides[k].caption}};
    if (!handles.empty()) entries.push_back({LegendMark::line, palette::contact, "what was edited"});
    drawing.add(detail::legend(entries, {place.x, place.bottom() + 0.3 * size, column, 2 * size}, size));
  }
  return drawing;
}

}  // namespace stackabilization
