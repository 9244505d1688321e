#include "structure/model/part_surface.h"

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

#include "mesh/edge_table.h"
#include "mesh/point_index.h"
#include "mesh/segment_triangle.h"
#include "mesh/surface_moments.h"
#include "mesh/triangle_tree.h"
#include "stackabilization/core/errors.h"
#include "structure/model/nearest_box.h"

namespace stackabilization::detail {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;

/// Largest fit error of a primitive that decides inside tests for an open surface, fraction of the diagonal
/// of the part.
constexpr double good_fit = 0.02;

bool holds(const OrientedBox& box, const Eigen::Vector3d& point) {
  return ((box.axes.transpose() * (point - box.centre)).cwiseAbs() - box.half_extents).maxCoeff() <= 0;
}

bool holds(const GeneralizedCylinder& cylinder, const Eigen::Vector3d& point) {
  const Eigen::Index n = cylinder.centres.rows();
  for (Eigen::Index i = 0; i < n - (cylinder.closed ? 0 : 1); ++i) {
    const Eigen::Vector3d from = cylinder.centres.row(i).transpose();
    const Eigen::Vector3d piece = cylinder.centres.row((i + 1) % n).transpose() - from;
    const double s = (point - from).dot(piece) / piece.squaredNorm();
    if (s < 0 || s > 1) continue;
    const double radius = (1 - s) * cylinder.radii(i) + s * cylinder.radii((i + 1) % n);
    if ((point - from - s * piece).norm() <= radius) return true;
  }
  return false;
}

std::function<bool(const Eigen::Vector3d&)> interior_of(const Part& part) {
  if (const auto* cuboid = std::get_if<Cuboid>(&part.primitive)) {
    if (part.fit.cuboid_error > good_fit) return {};
    return [box = nearest_box(*cuboid)](const Eigen::Vector3d& point) { return holds(box, point); };
  }
  if (part.fit.cylinder_error.value_or(1) > good_fit) return {};
  return [cylinder = std::get<GeneralizedCylinder>(part.primitive)](const Eigen::Vector3d& point) {
    return holds(cylinder, point);
  };
}

}  // namespace

struct PartSurface::Tree : TriangleTree<Kernel> {
  using TriangleTree::TriangleTree;
};

PartSurface::PartSurface(const Shape& surface, const Part& part) : in_primitive_(interior_of(part)) {
  PointIndex index;
  std::vector<std::int32_t> rows;
  for (std::int32_t t = 0; t < surface.triangle_count(); ++t) {
    const Eigen::Vector3d a = surface.corner(t, 0), b = surface.corner(t, 1), c = surface.corner(t, 2);
    if (!detail::has_area(surface, t)) continue;
    triangles_.push_back({index.insert(a), index.insert(b), index.insert(c)});
    rows.push_back(t);
  }
  points_ = index.points();
  if (points_.empty()) throw InputError("part '" + part.name + "' has no triangle of positive area");
  lowest_ = highest_ = points_[0];
  for (const Eigen::Vector3d& p : points_) {
    lowest_ = lowest_.cwiseMin(p);
    highest_ = highest_.cwiseMax(p);
  }
  collect_edges();
  size_ = enclosing_diameter(points_);
  if (!is_closed_) return;
  tree_ = std::make_unique<const Tree>(surface, std::move(rows));
}

PartSurface::PartSurface(PartSurface&&) noexcept = default;
PartSurface::~PartSurface() = default;

void PartSurface::collect_edges() {
  const Eigen::Map<const Triangles> rows(triangles_.front().data(),
                                         static_cast<Eigen::Index>(triangles_.size()), 3);
  const EdgeTable table(rows);
  for (std::size_t e = 0; e < table.size(); ++e) {
    Edge& edge = edges_.emplace_back(Edge{{table[e].front().low, table[e].front().high}, {}});
    for (const TriangleSide& side : table[e]) edge.triangles.push_back(side.triangle);
    if (edge.triangles.size() % 2 != 0) is_closed_ = false;
  }
}

bool PartSurface::contains(const Eigen::Vector3d& point) const {
  if (!tree_) return in_primitive_ && in_primitive_(point);
  // A direction that is unlikely to be parallel to edges or faces of a model.
  const std::array<Eigen::Vector3d, 3> directions = {Eigen::Vector3d(0.5423, 0.3178, 0.7778),
                                                     Eigen::Vector3d(-0.6771, 0.6139, 0.4056),
                                                     Eigen::Vector3d(0.1913, -0.8472, -0.4957)};
  int odd = 0;
  for (const Eigen::Vector3d& direction : directions) odd += tree_->count_hits(point, direction) % 2 != 0;
  return odd >= 2;
}

double PartSurface::distance(const Eigen::Vector3d& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangles_) {
    const auto corner = [&](int row) { return points_[static_cast<std::size_t>(row)]; };
    least = std::min(least, (nearest_on_triangle(point, {corner(a), corner(b), corner(c)}) - point).norm());
  }
  return least;
}

double enclosing_diameter(const std::vector<Eigen::Vector3d>& points) {
  using Traits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>;
  std::vector<Kernel::Point_3> centred;
  for (const Eigen::Vector3d& p : points) centred.push_back(to_cgal<Kernel>(p - points[0]));
  CGAL::Min_sphere_of_spheres_d<Traits> ball(centred.begin(), centred.end());
  return 2 * ball.radius();
}

}  // namespace stackabilization::detail
