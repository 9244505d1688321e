#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "stackabilization/structure/tolerances.h"
#include "structure/symmetry/symmetry_candidates.h"
#include "structure/symmetry/symmetry_refinement.h"

namespace stackabilization::detail {

namespace {

/// Deviation of a body of revolution from its turned self, in tolerances of its radius.
constexpr double facet_allowance = 1.5;
constexpr double without_detail = 0.98;     // support
constexpr double inertia_allowance = 0.15;  // share
constexpr double clear_gain = 1.1;          // factor between residuals

/// Returns whether the moments about two directions orthogonal to `axis` agree.
bool balanced(const Eigen::Matrix3d& spread, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  const double uu = u.dot(spread * u), vv = v.dot(spread * v), uv = u.dot(spread * v);
  return std::hypot(uu - vv, 2 * uv) <= inertia_allowance * (uu + vv);
}

/// Mean squares over the medium samples, weighted by how far they face sideways.
struct Sideways {
  Eigen::VectorXd weights;
  double radius = 0;  ///< root mean square

  Sideways(const SurfaceSamples& samples, const Symmetry& axis) {
    const Points arms = samples.points.rowwise() - axis.point.transpose();
    const Eigen::ArrayXd along = arms * axis.axis;
    const Eigen::ArrayXd facing = samples.normals * axis.axis;
    weights = 1 - facing.square();
    if (weights.sum() > 0) weights /= weights.sum();
    radius = std::sqrt(weights.dot((arms.rowwise().squaredNorm().array() - along.square()).matrix()));
  }
};

/// Angles of half a step of regular polygons: a prism of n sides deviates most from itself when rotated by pi
/// / n.
constexpr int first_polygon = 3, last_polygon = 13;

bool turns_into_itself(const SymmetrySurface& surface, const Symmetry& axis, const SymmetryOptions& options,
                       Roundness roundness) {
  const SurfaceSamples& samples = surface.medium;
  const Sideways sideways(samples, axis);
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int polygon = first_polygon; polygon <= last_polygon; ++polygon) {
    const Symmetry turn{SymmetryKind::rotation, axis.point, axis.axis, 2 * polygon};
    std::vector<double> distances = image_distances(surface.index, samples.points, isometry_of(turn));
    const Eigen::Map<const Eigen::ArrayXd> all(distances.data(), samples.points.rows());
    const double close = counterpart_reach(surface, options);
    const double square = (all <= close).select(all.square(), 0).matrix().dot(sideways.weights);
    least = std::min(least, square);
    most = std::max(most, square);
    for (double& distance : distances) distance /= surface.scale;
    if (!agreement(std::move(distances), 1 / surface.scale, {options.tolerance, without_detail}).holds)
      return false;
  }
  return roundness == Roundness::tolerant ||
         std::sqrt(most - least) <= facet_allowance * options.tolerance * sideways.radius;
}

/// The axis of revolution near the direction through the centroid.
std::optional<Symmetry> revolution_about(const SymmetrySurface& surface, const Eigen::Vector3d& direction,
                                         const SymmetryOptions& options, Roundness roundness) {
  const Symmetry start{SymmetryKind::revolution, Eigen::Vector3d::Zero(), direction.normalized(), 2};
  if (!balanced(surface.spread, start.axis)) return {};
  if (!verify(surface, start, loosen(options), Effort::sparse).holds) return {};
  const Symmetry better = refine_symmetry(surface, start, counterpart_reach(surface, options));
  // The moments give the axis exactly when nothing is missing, also for prisms with an odd number of sides.
  const Agreement before = verify(surface, start, options, Effort::dense);
  const Agreement after = verify(surface, better, options, Effort::dense);
  const bool keep = before.holds && before.residual <= clear_gain * after.residual;
  if (!keep && !after.holds) return {};
  const Symmetry axis = keep ? start : better;
  if (!turns_into_itself(surface, axis, options, roundness)) return {};
  return axis;
}

}  // namespace

std::vector<Symmetry> revolutions(const SymmetrySurface& surface, const SymmetryOptions& options,
                                  Roundness roundness) {
  std::vector<Symmetry> found;
  const Eigen::Matrix<double, 3, 6> candidates = axes_of(surface);
  for (const Eigen::Vector3d axis : candidates.colwise()) {
    const bool known = std::any_of(found.begin(), found.end(), [&](const Symmetry& other) {
      return std::abs(other.axis.dot(axis)) > tolerance::parallel;
    });
    if (known || found.size() == 3) continue;
    if (const auto revolution = revolution_about(surface, axis, options, roundness))
      found.push_back(*revolution);
  }
  return found;
}

}  // namespace stackabilization::detail
