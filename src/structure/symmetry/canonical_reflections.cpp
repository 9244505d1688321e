#include "structure/symmetry/canonical_reflections.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stackabilization/structure/tolerances.h"
#include "structure/symmetry/symmetry_candidates.h"

namespace stackabilization::detail {

namespace {

constexpr double weight_of_whole = 0.5;   // against the share of the area of each part
constexpr double max_angle_error = 0.05;  // radians
constexpr int max_order_of_boxes = 12;

bool along_box(const OrientedBox& box, const Eigen::Vector3d& axis) {
  return (box.axes.transpose() * axis).cwiseAbs().maxCoeff() > tolerance::aligned;
}

/// The orthonormal normals nearest to the given ones.
void orthogonalize(std::vector<Symmetry>& planes) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> normals(3, static_cast<Eigen::Index>(planes.size()));
  for (std::size_t k = 0; k < planes.size(); ++k) normals.col(static_cast<Eigen::Index>(k)) = planes[k].axis;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(normals, Eigen::ComputeThinU | Eigen::ComputeThinV);
  normals = svd.matrixU() * svd.matrixV().transpose();
  for (std::size_t k = 0; k < planes.size(); ++k) planes[k].axis = normals.col(static_cast<Eigen::Index>(k));
}

/// The multiple of pi / n, n as small as possible, that is nearest to `angle`; `angle` itself when none is
/// near.
double rational_angle(double angle) {
  for (int order = 2; order <= max_order_of_boxes; ++order) {
    const double step = std::numbers::pi / order, multiple = std::round(angle / step) * step;
    if (std::abs(multiple - angle) < max_angle_error) return multiple;
  }
  return angle;
}

}  // namespace

std::vector<Symmetry> canonical_reflections(const SymmetrySurface& whole,
                                            const std::vector<const SymmetrySurface*>& parts,
                                            const std::vector<Symmetry>& candidates) {
  double area = 0;
  for (const SymmetrySurface* part : parts) area += part->area;
  struct Ranked {
    Symmetry plane;
    double weight;
  };
  std::vector<Ranked> ranked;
  for (const Symmetry& plane : candidates) {
    double weight = along_box(whole.box, plane.axis) ? weight_of_whole : 0;
    for (const SymmetrySurface* part : parts)
      if (along_box(part->box, plane.axis)) weight += part->area / area;
    ranked.push_back({plane, weight});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Ranked& a, const Ranked& b) { return a.weight > b.weight; });

  std::vector<Symmetry> chosen;
  for (const Ranked& each : ranked)
    if (std::all_of(chosen.begin(), chosen.end(), [&](const Symmetry& other) {
          return std::abs(other.axis.dot(each.plane.axis)) < nearly_across;
        }))
      chosen.push_back(to_model(whole, to_own(whole, each.plane)));  // its point next to the centroid
  if (chosen.size() > 1) orthogonalize(chosen);
  return chosen;
}

std::vector<Symmetry> planes_through(const Symmetry& axis) {
  Eigen::Index across_most;
  axis.axis.cwiseAbs().minCoeff(&across_most);
  const Eigen::Vector3d side = Eigen::Vector3d::Unit(across_most);
  const Eigen::Vector3d u = (side - axis.axis * axis.axis.dot(side)).normalized();
  return {{SymmetryKind::reflection, axis.point, u, 2},
          {SymmetryKind::reflection, axis.point, axis.axis.cross(u).normalized(), 2}};
}

Symmetry fitted_to(const std::vector<Symmetry>& chosen, const Symmetry& plane) {
  Symmetry result = plane;
  std::vector<const Symmetry*> oblique;
  for (const Symmetry& other : chosen) {
    const double cosine = other.axis.dot(result.axis);
    if (std::abs(cosine) < nearly_across)
      result.axis = (result.axis - cosine * other.axis).normalized();
    else
      oblique.push_back(&other);
  }
  if (oblique.empty()) return result;
  const Symmetry& first = *oblique.front();
  const Eigen::Vector3d line = first.axis.cross(result.axis).normalized();
  const double angle = std::acos(std::clamp(first.axis.dot(result.axis), -1.0, 1.0));
  result.axis = Eigen::AngleAxisd(rational_angle(angle), line) * first.axis;
  for (const Symmetry* other : oblique)
    result.point -= other->axis * other->axis.dot(result.point - other->point);
  return result;
}

}  // namespace stackabilization::detail
