#include "deformation/controllers/row_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "core/index.h"
#include "stackabilization/structure/part_rows.h"

namespace stackabilization::detail {

namespace {

/// Returns points of each part of a row, one below the other, that correspond to those of the others.
std::vector<Points> corresponding_points(const Structure& rest, const PartRow& row) {
  std::vector<Points> all;
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < row.parts.size(); ++k) {
    const Primitive& primitive = rest.parts[at(row.parts[k])].primitive;
    const std::vector<int>& order = row.control_points[k];
    const Points controls = control_points(primitive);
    const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive);
    std::vector<int> chosen;
    if (cylinder) {
      const int n = static_cast<int>(controls.rows());
      chosen = cylinder->closed ? std::vector<int>{0, n / 3, 2 * n / 3} : std::vector<int>{0, n - 1};
      if (n > 2 && !cylinder->closed) chosen.push_back(n / 2);
    } else {
      chosen = {0, 1, 2, 4};
    }
    Points points(static_cast<Eigen::Index>(chosen.size() + (cylinder ? 2 : 0)), 3);
    Eigen::Index filled = 0;
    for (const int i : chosen) points.row(filled++) = controls.row(order[at(i)]);
    if (cylinder) {
      const Points tangents = section_tangents(*cylinder);
      for (const std::size_t end : {0u, 1u}) {
        const int section = order[at(chosen[end])];
        const Eigen::Vector3d tangent = tangents.row(section).transpose();
        if (across.isZero()) across = tangent.unitOrthogonal();
        const Eigen::Vector3d out = across - across.dot(tangent) * tangent;
        points.row(filled++) =
            controls.row(section) + cylinder->radii(section) * out.normalized().transpose();
      }
    }
    all.push_back(std::move(points));
  }
  return all;
}

}  // namespace

std::vector<RowPoint> row_points(const Rig& rig) {
  std::vector<RowPoint> found;
  std::set<std::vector<int>> known;  // rows by the classes of their parts: images of each other have the same
  for (const PartRow& row : find_part_rows(rig.rest)) {
    std::vector<int> classes;
    for (const int part : row.parts) classes.push_back(rig.space.class_of(part));
    const std::vector<int> reversed(classes.rbegin(), classes.rend());
    if (!known.insert(std::min(classes, reversed)).second) continue;
    // The other half of a row that is its own image is the same.
    const std::size_t middles = classes == reversed ? (row.parts.size() - 1) / 2 : row.parts.size() - 2;
    const std::vector<Points> points = corresponding_points(rig.rest, row);
    for (std::size_t k = 0; k < middles; ++k)
      for (Eigen::Index i = 0; i < points[k].rows(); ++i) {
        RowPoint point;
        for (std::size_t j = 0; j < 3; ++j) {
          point.parts[j] = row.parts[k + j];
          point.bindings[j] = rig.primitive_bindings[at(point.parts[j])].bind(
              Eigen::Vector3d(points[k + j].row(i).transpose()));
        }
        point.at_rest = (points[k].row(i) - 2 * points[k + 1].row(i) + points[k + 2].row(i)).transpose();
        found.push_back(std::move(point));
      }
  }
  return found;
}

Eigen::Vector3d unevenness(const Rig& rig, const RowPoint& point, const std::vector<Primitive>& now) {
  Eigen::Vector3d sum = -point.at_rest;
  for (std::size_t j = 0; j < 3; ++j)
    sum += RowPoint::weights[j] *
           rig.primitive_bindings[at(point.parts[j])].position_of(point.bindings[j], now[at(point.parts[j])]);
  return sum;
}

}  // namespace stackabilization::detail
