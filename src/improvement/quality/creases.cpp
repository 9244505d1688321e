#include "improvement/quality/creases.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/angles.h"
#include "core/index.h"
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

/// Returns the parts that use each vertex of a welded mesh, ascending.
std::vector<std::vector<std::int32_t>> parts_of_vertices(const Shape& rest, const WeldedMesh& welded) {
  std::vector<std::vector<std::int32_t>> parts(static_cast<std::size_t>(welded.points.rows()));
  for (Eigen::Index t = 0; t < welded.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      std::vector<std::int32_t>& own = parts[at(welded.triangles(t, k))];
      const std::int32_t part = rest.triangle_part[static_cast<std::size_t>(t)];
      if (const auto place = std::lower_bound(own.begin(), own.end(), part);
          place == own.end() || *place != part)
        own.insert(place, part);
    }
  return parts;
}

/// Returns the angle by which two parts turn against each other, radians: no unit vector of the one leaves
/// its direction in the other by more.
double turn_between(const AffineMap& a, const AffineMap& b) {
  return std::atan(Eigen::JacobiSVD<Eigen::Matrix3d>(a.linear - b.linear).singularValues()(0));
}

Eigen::Vector3d vertex(const Shape& shape, std::int32_t row) {
  return shape.vertices.row(row).transpose();
}

}  // namespace

Creases::Creases(const Shape& rest, const WeldedMesh& welded, double diagonal) {
  if (!(diagonal > 0)) return;
  const EdgeTable table(welded.triangles);
  const std::vector<std::vector<std::int32_t>> parts = parts_of_vertices(rest, welded);
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
    edge.joined = rest.triangle_part[at(edge.left)];
    const std::int32_t own = edge.joined;
    for (const std::int32_t t : {edge.left, edge.right})
      for (int k = 0; k < 3; ++k)
        for (const std::int32_t part : parts[at(welded.triangles(t, k))])
          if (edge.joined == own && part != own) edge.joined = part;
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

QualityValue Creases::measure(const Shape& now, const std::vector<AffineMap>& maps) const {
  QualityValue result{QualityMeasure::creases, 0};
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(static_cast<std::size_t>(now.triangle_count()));
  for (Eigen::Index t = 0; t < now.triangle_count(); ++t) normals.push_back(unit_normal(now, t));
  std::map<std::pair<std::int32_t, std::int32_t>, double> turns;
  const auto turn_at = [&](std::int32_t part, std::int32_t joined) {
    const auto [found, is_new] = turns.try_emplace(std::minmax({part, joined}), 0);
    if (is_new) found->second = turn_between(maps[at(part)], maps[at(joined)]);
    return found->second;
  };
  std::map<int, double> of_part;
  for (const SmoothEdge& edge : edges_) {
    const Eigen::Vector3d &left = normals[at(edge.left)], &right = normals[at(edge.right)];
    if ((edge.flipped ? -left.dot(right) : left.dot(right)) >= edge.still) continue;
    const std::int32_t part = now.triangle_part[at(edge.left)];
    double change = std::abs(fold(edge, now, left, right) - edge.fold);
    if (edge.joined != part) change -= turn_at(part, edge.joined);
    const double share = (change - tolerance::quality::slight_crease) /
                         (tolerance::quality::full_crease - tolerance::quality::slight_crease);
    if (share > 0) of_part[part] += std::min(share, 1.0) * edge.length;
  }
  double most = 0;
  for (const auto& [part, length] : of_part) {
    result.value += length;
    if (length > most) most = length, result.part = part;
  }
  return result;
}

}  // namespace stackabilization::detail
