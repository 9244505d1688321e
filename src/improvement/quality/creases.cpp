#include "improvement/quality/creases.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/angles.h"
#include "mesh/edge_table.h"
#include "mesh/surface_moments.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Returns whether a triangle is so flat over a side of this length that its plane says nothing of the
/// surface.
bool is_needle(double area, double length, double diagonal) {
  const double height = 2 * area / length;
  return !(height > tolerance::quality::needle * diagonal) ||
         (height < tolerance::quality::sliver * diagonal && height < tolerance::quality::slender * length);
}

Eigen::Vector3d vertex(const Shape& shape, std::int32_t row) {
  return shape.vertices.row(row).transpose();
}

}  // namespace

Creases::Creases(const Shape& rest, const WeldedMesh& welded, double diagonal) {
  if (!(diagonal > 0)) return;
  const EdgeTable table(welded.triangles);
  for (std::size_t e = 0; e < table.size(); ++e) {
    const auto sides = table[e];
    if (sides.size() != 2) continue;
    SmoothEdge edge{};
    edge.left = sides[0].triangle;
    edge.right = sides[1].triangle;
    edge.corner = rest.triangles(edge.right, (sides[1].corner + 2) % 3);
    edge.on_edge = rest.triangles(edge.right, sides[1].corner);
    edge.flipped = sides[0].forward == sides[1].forward;
    const double length = (welded.points.row(sides[0].high) - welded.points.row(sides[0].low)).norm();
    const double smaller =
        std::min(area_vector(rest, edge.left).norm(), area_vector(rest, edge.right).norm());
    if (is_needle(smaller, length, diagonal)) continue;
    edge.fold = fold(edge, rest, unit_normal(rest, edge.left), unit_normal(rest, edge.right));
    if (std::abs(edge.fold) >= tolerance::quality::smooth_fold) continue;
    edge.length = length / diagonal;
    edge.still = std::cos(std::max(0.0, tolerance::quality::slight_crease - std::abs(edge.fold)));
    edges_.push_back(edge);
  }
}

double Creases::fold(const SmoothEdge& edge, const Shape& shape, const Eigen::Vector3d& left,
                     const Eigen::Vector3d& right) {
  const double angle = angle_between(left, edge.flipped ? Eigen::Vector3d(-right) : right);
  const bool concave = left.dot(vertex(shape, edge.corner) - vertex(shape, edge.on_edge)) > 0;
  return concave ? -angle : angle;
}

QualityValue Creases::measure(const Shape& now) const {
  QualityValue result{QualityMeasure::creases, 0};
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(static_cast<std::size_t>(now.triangle_count()));
  for (Eigen::Index t = 0; t < now.triangle_count(); ++t) normals.push_back(unit_normal(now, t));
  std::map<int, double> of_part;
  for (const SmoothEdge& edge : edges_) {
    const Eigen::Vector3d &left = normals[static_cast<std::size_t>(edge.left)],
                          &right = normals[static_cast<std::size_t>(edge.right)];
    if ((edge.flipped ? -left.dot(right) : left.dot(right)) >= edge.still) continue;
    const double change = std::abs(fold(edge, now, left, right) - edge.fold);
    const double share = (change - tolerance::quality::slight_crease) /
                         (tolerance::quality::full_crease - tolerance::quality::slight_crease);
    if (share > 0)
      of_part[now.triangle_part[static_cast<std::size_t>(edge.left)]] += std::min(share, 1.0) * edge.length;
  }
  double most = 0;
  for (const auto& [part, length] : of_part) {
    result.value += length;
    if (length > most) most = length, result.part = part;
  }
  return result;
}

}  // namespace stackabilization::detail
