#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "rendering/drawing/legend.h"
#include "rendering/drawing/plot_parts.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/scene.h"

namespace stackabilization {
namespace {

/// Marks lie this far off the surface, fraction of the shape's extent along the direction.
constexpr double mark_distance = 0.002;

/// The shape with two parts: enough draft, and less.
Shape by_draft(const Shape& shape, const DraftAnalysis& draft, double min_draft) {
  Shape sorted = shape;
  sorted.part_names = {"enough", "less"};
  for (std::size_t t = 0; t < draft.triangles.size(); ++t)
    sorted.triangle_part[t] = draft.triangles[t].angle < min_draft ? 1 : 0;
  return sorted;
}

/// The pieces of undercuts, `shift` before and behind their triangles: which side is outside, an open surface
/// does not say.
Shape undercut_marks(const Shape& shape, const DraftAnalysis& draft, double shift) {
  Eigen::Index corners = 0, triangles = 0;
  for (const UndercutPiece& piece : draft.undercuts) {
    corners += 2 * piece.corners.rows();
    triangles += 2 * std::max<Eigen::Index>(0, piece.corners.rows() - 2);
  }
  Points points(corners, 3);
  Triangles faces(triangles, 3);
  corners = triangles = 0;
  for (const UndercutPiece& piece : draft.undercuts) {
    const Eigen::Vector3d a = shape.corner(piece.triangle, 0), b = shape.corner(piece.triangle, 1),
                          c = shape.corner(piece.triangle, 2);
    const Eigen::RowVector3d normal = (b - a).cross(c - a).stableNormalized().transpose();
    for (const double side : {shift, -shift}) {
      points.middleRows(corners, piece.corners.rows()) = piece.corners.rowwise() + side * normal;
      for (Eigen::Index k = 2; k < piece.corners.rows(); ++k)
        faces.row(triangles++) << static_cast<std::int32_t>(corners),
            static_cast<std::int32_t>(corners + k - 1), static_cast<std::int32_t>(corners + k);
      corners += piece.corners.rows();
    }
  }
  return make_shape(std::move(points), std::move(faces));
}

}  // namespace

Drawing draft_picture(const Shape& shape, const DraftAnalysis& draft, const Direction& direction,
                      const DraftPictureOptions& options) {
  const double size = options.width / 70.0, margin = 1.5 * size;
  Drawing drawing{options.width, options.height, {}};
  const detail::Heading heading = detail::heading(options.title, options.notes, options.width, size);
  drawing.add(heading.elements);
  const double top = heading.bottom + size, legend_height = 2.5 * size;
  const double column = (options.width - 3 * margin) / 2;
  const double height = options.height - top - legend_height - margin;
  Scene scene;
  scene.add(SceneMesh{by_draft(shape, draft, options.min_draft), {palette::output, palette::input}});
  if (!draft.undercuts.empty()) {
    const double shift = mark_distance * range_along(shape, direction.unit()).length();
    scene.add(SceneMesh{undercut_marks(shape, draft, shift), {palette::contact}, 1, Finish::plain});
  }
  const std::array<double, 2> elevations{25, -25};
  for (std::size_t k = 0; k < elevations.size(); ++k) {
    ViewOptions view;
    view.width = static_cast<int>(column);
    view.height = static_cast<int>(height);
    view.elevation_degrees = elevations[k];
    const Rectangle place{margin + static_cast<double>(k) * (column + margin), top, column, height};
    drawing.add(PlacedImage{place, render(scene, fit_view(scene, direction, view))});
  }
  drawing.add(detail::legend({{LegendMark::swatch, palette::output, "leaves the mould"},
                              {LegendMark::swatch, palette::input, "with little draft"},
                              {LegendMark::swatch, palette::contact, "undercut"}},
                             {margin, top + height + 0.5 * size, options.width - 2 * margin, legend_height},
                             size));
  return drawing;
}

}  // namespace stackabilization
