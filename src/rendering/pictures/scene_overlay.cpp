#include "rendering/pictures/scene_overlay.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stackabilization/core/errors.h"

namespace stackabilization::detail {
namespace {

constexpr double dimension_room = 2.6;  ///< em beside the picture for each dimension

/// Points that must be in the picture besides the scene.
Points reach_of(const SceneOverlay& over, const Frame& axes) {
  std::vector<Eigen::Vector3d> points;
  for (const SceneLines& item : over.lines)
    for (const Points& line : item.polylines)
      for (Eigen::Index i = 0; i < line.rows(); ++i) points.emplace_back(line.row(i).transpose());
  for (const SceneArrow& arrow : over.arrows) points.insert(points.end(), {arrow.from, arrow.to});
  for (const SceneRing& ring : over.rings)
    for (const double side : {-ring.radius, ring.radius})
      points.insert(points.end(), {ring.centre + side * axes.u, ring.centre + side * axes.v});
  Points result(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    result.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  return result;
}

int dimensions_at(const SceneOverlay& over, Anchor side) {
  return static_cast<int>(
      std::count_if(over.dimensions.begin(), over.dimensions.end(), [side](const SceneDimension& dimension) {
        return (dimension.side == Anchor::right) == (side == Anchor::right);
      }));
}

/// Returns the rectangle without the space for dimensions.
Rectangle inner_place(const SceneOverlay& over, const Rectangle& place, double size) {
  const double left = dimension_room * size * dimensions_at(over, Anchor::left);
  const double right = dimension_room * size * dimensions_at(over, Anchor::right);
  return {place.x + left, place.y, std::max(1.0, place.width - left - right), place.height};
}

/// Returns the scene with all points that must be in the picture.
Scene framed_scene(const ScenePanel& panel, const View& turned) {
  Scene framed = panel.scene;
  Points reach = reach_of(panel.over, {turned.right, turned.up, turned.towards});
  if (reach.rows() > 0) framed.add(SceneLines{{std::move(reach)}});
  return framed;
}

constexpr double margin = 0.02;  ///< of the smaller side

View view_of(const ScenePanel& panel, const Rectangle& inner, std::optional<double> pixels_per_unit) {
  ViewOptions options;
  options.azimuth_degrees = panel.azimuth_degrees;
  options.elevation_degrees = panel.elevation_degrees;
  options.width = std::max(1, static_cast<int>(inner.width));
  options.height = std::max(1, static_cast<int>(inner.height));
  options.margin = margin;
  options.pixels_per_unit = pixels_per_unit;
  return fit_view(framed_scene(panel, turned_view(panel.up, options)), panel.up, options);
}

/// Draws an overlay in the picture of a view.
class OverlayDrawer {
 public:
  OverlayDrawer(const ScenePanel& panel, const View& view, const Rectangle& inner, double size)
      : panel_(panel), view_(view), inner_(inner), size_(size) {}

  Elements elements();

 private:
  Eigen::Vector2d at(const Eigen::Vector3d& point) const {
    return Eigen::Vector2d(inner_.x, inner_.y) + view_.project(point);
  }
  void add_lines(const SceneLines& lines);
  void add_arrow(const SceneArrow& arrow);
  void add_dimensions(Anchor side);
  Range breadth() const;

  const ScenePanel& panel_;
  const View& view_;
  Rectangle inner_;
  double size_;
  Elements elements_;
};

void OverlayDrawer::add_lines(const SceneLines& lines) {
  for (const Points& line : lines.polylines) {
    PlanePoints points(line.rows(), 2);
    for (Eigen::Index i = 0; i < line.rows(); ++i) points.row(i) = at(line.row(i).transpose()).transpose();
    if (points.rows() == 1)
      elements_.emplace_back(FilledPolygon{circle(points.row(0).transpose(), 2 * lines.width), lines.colour});
    else
      elements_.emplace_back(Polyline{std::move(points), lines.colour, lines.width});
  }
}

void OverlayDrawer::add_arrow(const SceneArrow& arrow) {
  const Eigen::Vector2d from = at(arrow.from), to = at(arrow.to);
  const double length = (to - from).norm(), shaft = arrow.width * size_;
  if (!(length > 0)) return;
  const double head = std::min(5 * shaft, 0.7 * length);
  const Eigen::Vector2d along = (to - from) / length, across(-along.y(), along.x());
  const Eigen::Vector2d neck = to - head * along;
  PlanePoints tip(3, 2), line(2, 2);
  tip << to.transpose(), (neck + 0.42 * head * across).transpose(), (neck - 0.42 * head * across).transpose();
  line << from.transpose(), (neck + 0.2 * head * along).transpose();
  // The white rim sets it off from whatever is behind it.
  elements_.emplace_back(Polyline{line, palette::white, shaft + 3});
  elements_.emplace_back(Polyline{std::move(line), arrow.colour, shaft});
  elements_.emplace_back(FilledPolygon{std::move(tip), arrow.colour});
}

/// Of the scene in the drawing, pixels.
Range OverlayDrawer::breadth() const {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const SceneMesh& mesh : panel_.scene.meshes)
    for (const std::int32_t vertex : mesh.shape.triangles.reshaped<Eigen::RowMajor>()) {
      const double x = at(mesh.shape.vertices.row(vertex).transpose()).x();
      range.low = std::min(range.low, x);
      range.high = std::max(range.high, x);
    }
  return range.low <= range.high ? range : Range{inner_.x, inner_.right()};
}

void OverlayDrawer::add_dimensions(Anchor side) {
  const Range scene = breadth();
  const bool right = side == Anchor::right;
  double x = right ? scene.high + 0.7 * size_ : scene.low - 0.7 * size_;
  for (const SceneDimension& dimension : panel_.over.dimensions) {
    if ((dimension.side == Anchor::right) != right) continue;
    const Elements lines =
        vertical_dimension({x, at(dimension.from).y(), at(dimension.to).y(), dimension.caption, side}, size_);
    elements_.insert(elements_.end(), lines.begin(), lines.end());
    x += (right ? 1 : -1) * dimension_room * size_;
  }
}

Elements OverlayDrawer::elements() {
  const SceneOverlay& over = panel_.over;
  for (const SceneLines& lines : over.lines) add_lines(lines);
  for (const SceneRing& ring : over.rings) {
    const Elements marks = ring_mark(at(ring.centre), ring.radius * view_.pixels_per_unit, ring.colour);
    elements_.insert(elements_.end(), marks.begin(), marks.end());
  }
  for (const SceneArrow& arrow : over.arrows) add_arrow(arrow);
  for (const SceneLabel& label : over.labels)
    elements_.emplace_back(Text{at(label.at), label.text, size_, label.colour, label.anchor, true});
  add_dimensions(Anchor::left);
  add_dimensions(Anchor::right);
  return std::move(elements_);
}

}  // namespace

double scale_of(const ScenePanel& panel, const Rectangle& place, double text_size) {
  return view_of(panel, inner_place(panel.over, place, text_size), std::nullopt).pixels_per_unit;
}

double height_at(const ScenePanel& panel, const Rectangle& place, const SceneStyle& style) {
  const double scale = style.pixels_per_unit.value_or(scale_of(panel, place, style.text_size));
  ViewOptions options;
  options.azimuth_degrees = panel.azimuth_degrees;
  options.elevation_degrees = panel.elevation_degrees;
  const View view = turned_view(panel.up, options);
  const Range along = scene_extent(framed_scene(panel, view), view.up);
  return scale * along.length() + 2 * margin * std::min(place.width, place.height) + 1;
}

Elements scene_elements(const ScenePanel& panel, const Rectangle& place, const SceneStyle& style) {
  const Rectangle inner = inner_place(panel.over, place, style.text_size);
  const View view = view_of(panel, inner, style.pixels_per_unit);
  const Rectangle picture{inner.x, inner.y, static_cast<double>(view.width),
                          static_cast<double>(view.height)};
  Elements elements{PlacedImage{picture, render(panel.scene, view), Sampling::smooth}};
  for (DrawingElement& element : OverlayDrawer(panel, view, picture, style.text_size).elements())
    elements.push_back(std::move(element));
  return elements;
}

}  // namespace stackabilization::detail
