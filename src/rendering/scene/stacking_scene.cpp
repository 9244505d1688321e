#include "stackabilization/rendering/stacking_scene.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "rendering/scene/envelope_sheet.h"

namespace stackabilization {
namespace {

constexpr double of_height = 0.004, of_breadth = 0.001;

/// Distance of marks from the surface: large enough to be visible, too small to be noticed.
Eigen::Vector3d mark_lift(const Shape& shape, const Direction& direction) {
  const Frame frame = frame_of(direction);
  const double breadth = std::max(range_along(shape, frame.u).length(), range_along(shape, frame.v).length());
  return std::max(of_height * range_along(shape, frame.w).length(), of_breadth * breadth) * frame.w;
}

Shape moved(const Shape& shape, const Eigen::Vector3d& shift) {
  return transformed(shape, Eigen::Matrix3d::Identity(), shift);
}

/// Range of all samples along r.
Range heights(const HeightField& field) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int i = 0; i < field.window.columns; ++i)
    for (int j = 0; j < field.window.rows; ++j)
      if (field.covered(i, j)) {
        range.low = std::min(range.low, field.lower(i, j));
        range.high = std::max(range.high, field.upper(i, j));
      }
  return range;
}

/// Lines from the contacts on the lower copy to their counterparts on the upper copy.
SceneLines links_of(const std::vector<ContactRegion>& contacts, const Eigen::Vector3d& lift) {
  constexpr std::size_t max_links = 8;
  SceneLines links{{}, palette::faint, 1};
  for (std::size_t k = 0; k < std::min(max_links, contacts.size()); ++k) {
    if (contacts[k].type == ContactType::ring) continue;  // the centre of a ring is not on the surface
    Points link(2, 3);
    link.row(0) = contacts[k].upper_centre.transpose();
    link.row(1) = (contacts[k].lower_centre + lift).transpose();
    links.polylines.push_back(std::move(link));
  }
  return links;
}

}  // namespace

Scene touching_scene(const SceneMesh& mesh, const std::vector<ContactRegion>& contacts,
                     const Direction& direction) {
  const Eigen::Vector3d lift = mark_lift(mesh.shape, direction);
  Scene scene;
  scene.add(mesh);
  scene.add(contact_marks(contacts, EnvelopeSide::upper, lift));
  scene.add(contact_marks(contacts, EnvelopeSide::lower, -lift));
  return scene;
}

std::vector<Shape> copies_of(const Shape& shape, const Eigen::Vector3d& step, int copies) {
  std::vector<Shape> result;
  for (int k = 0; k < copies; ++k) result.push_back(moved(shape, k * step));
  return result;
}

Scene stack_scene(const std::vector<Shape>& copies, const Colour& colour) {
  constexpr double paler = 0.5;
  Scene scene;
  for (std::size_t k = 0; k < copies.size(); ++k)
    scene.add({copies[k], {k % 2 == 0 ? colour : mix(colour, palette::white, paler)}});
  return scene;
}

Scene envelope_scene(const Shape& shape, const std::vector<ContactRegion>& contacts,
                     const HeightField& field) {
  constexpr double air_of_height = 0.1, air_of_breadth = 0.25;
  const Shape upper = envelope_sheet(shape, field, EnvelopeSide::upper);
  const Shape lower = envelope_sheet(shape, field, EnvelopeSide::lower);
  Scene scene;
  if (upper.triangle_count() == 0 || lower.triangle_count() == 0) return scene;
  const Eigen::Vector3d& up = field.frame.w;
  const double breadth = std::max(field.window.columns, field.window.rows) * field.window.pixel_size;
  // Wide shapes need more distance, because the view from above lays them over each other.
  const Eigen::Vector3d apart =
      (heights(field).length() + air_of_height * range_along(shape, up).length() + air_of_breadth * breadth) *
      up;
  const Eigen::Vector3d lift = mark_lift(shape, Direction(up));
  scene.add({upper, {palette::upper}, 1, Finish::smooth});
  scene.add({moved(lower, apart), {palette::lower}, 1, Finish::smooth});
  scene.add(contact_marks(contacts, EnvelopeSide::upper, lift));
  scene.add(contact_marks(contacts, EnvelopeSide::lower, apart + lift));
  SceneLines links = links_of(contacts, apart);
  if (!links.polylines.empty()) scene.add(std::move(links));
  return scene;
}

}  // namespace stackabilization
