#include "structure/model/part_surface.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "mesh/point_index.h"
#include "mesh/segment_triangle.h"
#include "stackabilization/core/errors.h"
#include "structure/model/nearest_box.h"

namespace stackabilization::detail {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangle = Kernel::Triangle_3;
using TrianglePrimitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;

Kernel::Point_3 to_cgal(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// Fit error, fraction of the part's diagonal, up to which a primitive tells what is inside an open surface.
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

struct PartSurface::Tree {
  std::vector<Triangle> triangles;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, TrianglePrimitive>> tree;
};

PartSurface::PartSurface(const Shape& surface, const Part& part) : in_primitive_(interior_of(part)) {
  PointIndex index;
  for (Eigen::Index t = 0; t < surface.triangle_count(); ++t) {
    const Eigen::Vector3d a = surface.corner(t, 0), b = surface.corner(t, 1), c = surface.corner(t, 2);
    if (!((b - a).cross(c - a).squaredNorm() > 0)) continue;
    triangles_.push_back({index.insert(a), index.insert(b), index.insert(c)});
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
  auto tree = std::make_unique<Tree>();
  for (const std::array<int, 3>& t : triangles_)
    tree->triangles.emplace_back(to_cgal(points_[static_cast<std::size_t>(t[0])]),
                                 to_cgal(points_[static_cast<std::size_t>(t[1])]),
                                 to_cgal(points_[static_cast<std::size_t>(t[2])]));
  tree->tree.insert(tree->triangles.cbegin(), tree->triangles.cend());
  tree->tree.build();
  tree_ = std::move(tree);
}

PartSurface::PartSurface(PartSurface&&) noexcept = default;
PartSurface::~PartSurface() = default;

void PartSurface::collect_edges() {
  std::map<std::pair<int, int>, std::vector<int>> triangles_of;
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      triangles_of[std::minmax(triangles_[t][k], triangles_[t][(k + 1) % 3])].push_back(static_cast<int>(t));
  for (auto& [ends, triangles] : triangles_of) {
    if (triangles.size() % 2 != 0) is_closed_ = false;
    edges_.push_back({{ends.first, ends.second}, std::move(triangles)});
  }
}

bool PartSurface::contains(const Eigen::Vector3d& point) const {
  if (!tree_) return in_primitive_ && in_primitive_(point);
  // No direction in which models have edges or faces.
  const std::array<Kernel::Vector_3, 3> directions = {Kernel::Vector_3(0.5423, 0.3178, 0.7778),
                                                      Kernel::Vector_3(-0.6771, 0.6139, 0.4056),
                                                      Kernel::Vector_3(0.1913, -0.8472, -0.4957)};
  int odd = 0;
  for (const Kernel::Vector_3& direction : directions)
    odd += tree_->tree.number_of_intersected_primitives(Kernel::Ray_3(to_cgal(point), direction)) % 2 != 0;
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
  for (const Eigen::Vector3d& p : points) centred.push_back(to_cgal(p - points[0]));
  CGAL::Min_sphere_of_spheres_d<Traits> ball(centred.begin(), centred.end());
  return 2 * ball.radius();
}

}  // namespace stackabilization::detail
