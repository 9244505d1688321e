#include "deformation/controllers/row_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "core/index.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/structure/part_rows.h"

namespace stackabilization::detail {

namespace {

using Triple = std::array<int, 3>;

/// Returns points of a part of a row that correspond to those of its other parts: corners of a box; of a
/// generalized cylinder three centres, and points of the surface at the first two in the direction `across`,
/// which is chosen where it is zero.
Points points_of(const Primitive& primitive, const std::vector<int>& order, Eigen::Vector3d& across) {
  const Points controls = control_points(primitive);
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive);
  if (!cylinder) return controls({order[0], order[1], order[2], order[4]}, Eigen::all);
  const int n = static_cast<int>(controls.rows());
  const Triple sections = cylinder->closed ? Triple{0, n / 3, 2 * n / 3} : Triple{0, n - 1, n / 2};
  const Points tangents = section_tangents(*cylinder);
  Points points(5, 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const int section = order[at(sections[k])];
    points.row(static_cast<Eigen::Index>(k)) = controls.row(section);
    if (k == 2) break;
    const Eigen::Vector3d tangent = tangents.row(section).transpose();
    if (across.isZero(0)) across = tangent.unitOrthogonal();
    points.row(static_cast<Eigen::Index>(k) + 3) =
        controls.row(section) +
        cylinder->radii(section) * (across - across.dot(tangent) * tangent).normalized().transpose();
  }
  return points;
}

/// Returns the linear parts of known symmetries that take a part onto another one of its class.
std::vector<Eigen::Matrix3d> maps_between(const ControlSpace& space, int from, int to) {
  std::vector<Eigen::Matrix3d> maps = {space.linear(to) * space.linear(from).transpose()};
  for (const ControlSpace::Stabiliser& own : space.stabilisers(space.class_of(from)))
    maps.push_back(space.linear(to) * own.linear * space.linear(from).transpose());
  return maps;
}

/// Returns whether a symmetry is known to take three parts onto three others, in their order.
bool is_image(const ControlSpace& space, const Triple& of, const Triple& image) {
  for (std::size_t k = 0; k < 3; ++k)
    if (space.class_of(of[k]) != space.class_of(image[k])) return false;
  const std::vector<Eigen::Matrix3d> first = maps_between(space, of[0], image[0]);
  return std::any_of(first.begin(), first.end(), [&](const Eigen::Matrix3d& map) {
    const auto takes = [&](std::size_t k) {
      const std::vector<Eigen::Matrix3d> others = maps_between(space, of[k], image[k]);
      return std::any_of(others.begin(), others.end(), [&](const Eigen::Matrix3d& other) {
        return (map - other).norm() <= tolerance::relative;
      });
    };
    return takes(1) && takes(2);
  });
}

}  // namespace

std::vector<RowPoint> row_points(const Rig& rig) {
  std::vector<RowPoint> found;
  std::vector<Triple> known;
  for (const PartRow& row : find_part_rows(rig.rest)) {
    Eigen::Vector3d across = Eigen::Vector3d::Zero();
    std::vector<Points> points;
    for (std::size_t k = 0; k < row.parts.size(); ++k)
      points.push_back(points_of(rig.rest.parts[at(row.parts[k])].primitive, row.control_points[k], across));
    for (std::size_t k = 0; k + 2 < row.parts.size(); ++k) {
      const Triple parts = {row.parts[k], row.parts[k + 1], row.parts[k + 2]},
                   back = {parts[2], parts[1], parts[0]};
      if (std::any_of(known.begin(), known.end(), [&](const Triple& one) {
            return is_image(rig.space, one, parts) || is_image(rig.space, one, back);
          }))
        continue;
      known.push_back(parts);
      // The third point makes the steps even at rest to the bit: then they are so in every pose and size.
      const std::array<Points, 3> at_rest = {points[k], points[k + 1], 2 * points[k + 1] - points[k]};
      for (Eigen::Index i = 0; i < points[k].rows(); ++i) {
        RowPoint point{parts, {}};
        for (std::size_t j = 0; j < 3; ++j)
          point.bindings[j] =
              rig.primitive_bindings[at(parts[j])].bind(Eigen::Vector3d(at_rest[j].row(i).transpose()));
        found.push_back(std::move(point));
      }
    }
  }
  return found;
}

}  // namespace stackabilization::detail
