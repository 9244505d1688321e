#include "stackabilization/rendering/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "stackabilization/core/errors.h"

namespace stackabilization {
namespace {

/// Bounds of everything in a scene along three axes.
struct Bounds {
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;

  void include(const Eigen::Array3d& p) {
    low = low.min(p);
    high = high.max(p);
  }
};

template <typename Visit>
void for_each_point(const Scene& scene, const Visit& visit) {
  for (const SceneMesh& mesh : scene.meshes)
    for (const std::int32_t vertex : mesh.shape.triangles.reshaped<Eigen::RowMajor>())
      visit(Eigen::Vector3d(mesh.shape.vertices.row(vertex).transpose()));
  for (const SceneLines& item : scene.lines)
    for (const Points& line : item.polylines)
      for (Eigen::Index i = 0; i < line.rows(); ++i) visit(Eigen::Vector3d(line.row(i).transpose()));
}

/// Shape made of a fan per polygon.
Shape fans(const std::vector<const Points*>& polygons, const Eigen::Vector3d& shift) {
  Eigen::Index vertices = 0, triangles = 0;
  for (const Points* polygon : polygons) {
    vertices += polygon->rows();
    triangles += std::max<Eigen::Index>(0, polygon->rows() - 2);
  }
  Points points(vertices, 3);
  Triangles faces(triangles, 3);
  Eigen::Index vertex = 0, face = 0;
  for (const Points* polygon : polygons) {
    points.middleRows(vertex, polygon->rows()) = polygon->rowwise() + shift.transpose();
    for (Eigen::Index k = 2; k < polygon->rows(); ++k)
      faces.row(face++) = Eigen::RowVector3<std::int32_t>(static_cast<std::int32_t>(vertex),
                                                          static_cast<std::int32_t>(vertex + k - 1),
                                                          static_cast<std::int32_t>(vertex + k));
    vertex += polygon->rows();
  }
  return make_shape(std::move(points), std::move(faces));
}

}  // namespace

void Scene::add(const Scene& other) {
  meshes.insert(meshes.end(), other.meshes.begin(), other.meshes.end());
  lines.insert(lines.end(), other.lines.begin(), other.lines.end());
}

Eigen::Vector2d View::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d offset = point - centre;
  return {width / 2.0 + pixels_per_unit * right.dot(offset), height / 2.0 - pixels_per_unit * up.dot(offset)};
}

Range scene_extent(const Scene& scene, const Eigen::Vector3d& axis) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for_each_point(scene, [&](const Eigen::Vector3d& p) {
    range.low = std::min(range.low, axis.dot(p));
    range.high = std::max(range.high, axis.dot(p));
  });
  return range;
}

View turned_view(const Direction& up, const ViewOptions& options) {
  const Frame frame = frame_of(up);
  const double azimuth = options.azimuth_degrees * std::numbers::pi / 180;
  const double elevation = options.elevation_degrees * std::numbers::pi / 180;
  const Eigen::Vector3d level = std::sin(azimuth) * frame.u - std::cos(azimuth) * frame.v;
  View view;
  view.towards = std::cos(elevation) * level + std::sin(elevation) * frame.w;
  view.up = std::cos(elevation) * frame.w - std::sin(elevation) * level;
  view.right = view.up.cross(view.towards);
  view.centre = Eigen::Vector3d::Zero();
  view.width = options.width;
  view.height = options.height;
  return view;
}

View fit_view(const Scene& scene, const Direction& up, const ViewOptions& options) {
  View view = turned_view(up, options);
  const Frame axes{view.right, view.up, view.towards};
  Bounds bounds;
  for_each_point(scene, [&](const Eigen::Vector3d& p) { bounds.include(axes.to_local(p).array()); });
  if (!(bounds.low <= bounds.high).all()) throw UsageError("an empty scene cannot be shown");
  view.centre = axes.to_world(((bounds.low + bounds.high) / 2).matrix());
  const Eigen::Array3d extent = bounds.high - bounds.low;
  const double border = 2 * options.margin * std::min(options.width, options.height);
  const double scale = std::min((options.width - border) / extent[0], (options.height - border) / extent[1]);
  view.pixels_per_unit = options.pixels_per_unit.value_or(std::isfinite(scale) ? scale : 1);
  if (options.pixels_per_unit)
    view.centre += ((options.height - border) / view.pixels_per_unit - extent[1]) / 2 * view.up;
  return view;
}

Scene contact_marks(const std::vector<ContactRegion>& regions, EnvelopeSide side,
                    const Eigen::Vector3d& shift) {
  std::vector<const Points*> polygons;
  SceneLines outlines{{}, palette::contact, 3}, dots{{}, palette::contact, 7};
  for (const ContactRegion& region : regions)
    for (const ContactPolygon& piece : region.polygons) {
      const Points& points = side == EnvelopeSide::upper ? piece.upper_points : piece.lower_points;
      if (points.rows() == 0) continue;
      polygons.push_back(&points);
      Points loop(points.rows() + 1, 3);
      loop.topRows(points.rows()) = points.rowwise() + shift.transpose();
      loop.bottomRows(1) = loop.topRows(1);
      const double size = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
      if (size <= shift.norm()) dots.polylines.emplace_back(loop.topRows(1));
      outlines.polylines.push_back(std::move(loop));
    }
  Scene scene;
  if (polygons.empty()) return scene;
  const bool has_area = std::any_of(polygons.begin(), polygons.end(),
                                    [](const Points* polygon) { return polygon->rows() > 2; });
  if (has_area) scene.add({fans(polygons, shift), {palette::contact}, 1, Finish::plain});
  scene.add(std::move(outlines));
  scene.add(std::move(dots));
  return scene;
}

}  // namespace stackabilization
