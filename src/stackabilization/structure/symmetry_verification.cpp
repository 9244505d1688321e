#include "stackabilization/structure/symmetry_verification.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "stackabilization/shape/errors.h"
#include "stackabilization/structure/symmetry_refinement.h"

namespace stackabilization::detail {

namespace {

constexpr int sparse_samples = 150, medium_samples = 500, most_corners = 300;
/// Distances up to this many tolerances count as a counterpart.
constexpr double counterpart = 3;
/// Deviation of a body of revolution from its turned self, in tolerances of its radius.
constexpr double facet_allowance = 1.5;
constexpr double depth_per_missing_share = 0.4;
constexpr double outlying_samples = 0.005, outlying_corners = 0.02;  // shares: noise has outliers
constexpr double rough_allowance = 1.5;
constexpr double without_detail = 0.98;  // support
constexpr double inertia_allowance = 0.15;
constexpr double slender_extents = 3;
constexpr double clear_gain = 1.1;
constexpr double same_direction = 0.99;  // cosine

/// Area, its first and second moments.
struct Moments {
  double area = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
};

Moments moments_of(const Shape& shape, const Eigen::Vector3d& origin) {
  Moments moments;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const Eigen::Vector3d a = shape.corner(t, 0) - origin, b = shape.corner(t, 1) - origin,
                          c = shape.corner(t, 2) - origin, sum = a + b + c;
    const double area = (b - a).cross(c - a).norm() / 2;
    moments.area += area;
    moments.centroid += area * sum / 3;
    moments.spread +=
        area / 12 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  if (moments.area > 0) {
    moments.centroid /= moments.area;
    moments.spread = moments.spread / moments.area - moments.centroid * moments.centroid.transpose();
  }
  return moments;
}

struct OwnFrame {
  Shape shape;
  Eigen::Vector3d centroid;
  double diagonal;
  OrientedBox box;
  Moments moments;
};

OwnFrame own_frame(const Shape& shape) {
  OwnFrame frame{shape, {}, 0, minimal_oriented_box(HullSupport(shape)), {}};
  frame.diagonal = 2 * frame.box.half_extents.norm();
  const Eigen::Vector3d centre = frame.box.centre;
  frame.shape.vertices = (shape.vertices.rowwise() - centre.transpose()) / frame.diagonal;
  frame.moments = moments_of(frame.shape, Eigen::Vector3d::Zero());
  const Eigen::Vector3d offset = frame.moments.centroid;
  frame.shape.vertices.rowwise() -= offset.transpose();
  frame.centroid = centre + frame.diagonal * offset;
  frame.box.centre = -offset;
  frame.box.half_extents /= frame.diagonal;
  return frame;
}

Points used_corners(const Shape& shape) {
  std::vector<char> used(static_cast<std::size_t>(shape.vertex_count()), 0);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) used[static_cast<std::size_t>(shape.triangles(t, corner))] = 1;
  std::vector<Eigen::Index> rows;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) rows.push_back(static_cast<Eigen::Index>(v));
  const std::size_t count = std::min<std::size_t>(rows.size(), most_corners);
  Points corners(static_cast<Eigen::Index>(count), 3);
  for (std::size_t k = 0; k < count; ++k)
    corners.row(static_cast<Eigen::Index>(k)) = shape.vertices.row(rows[k * rows.size() / count]);
  return corners;
}

Points unit_normals(const Shape& shape) {
  Points normals(shape.triangle_count(), 3);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const Eigen::Vector3d normal =
        (shape.corner(t, 1) - shape.corner(t, 0)).cross(shape.corner(t, 2) - shape.corner(t, 0));
    normals.row(t) = normal.stableNormalized().transpose();
  }
  return normals;
}

double middle(Eigen::Vector3d values) {
  std::sort(values.begin(), values.end());
  return values(1);
}

}  // namespace

SymmetrySurface symmetry_surface(const Shape& shape, int samples) {
  const OwnFrame frame = own_frame(shape);
  return {.centroid = frame.centroid,
          .diagonal = frame.diagonal,
          .box = frame.box,
          .spread = frame.moments.spread,
          .area = frame.moments.area * frame.diagonal * frame.diagonal,
          .scale = std::min(1.0, slender_extents * 2 * middle(frame.box.half_extents)),
          .index = SurfaceIndex(frame.shape),
          .normals = unit_normals(frame.shape),
          .dense = surface_samples(frame.shape, samples),
          .medium = surface_samples(frame.shape, medium_samples),
          .sparse = surface_samples(frame.shape, sparse_samples),
          .corners = used_corners(frame.shape)};
}

Symmetry to_model(const SymmetrySurface& surface, const Symmetry& own) {
  Symmetry model = own;
  model.point = surface.centroid + surface.diagonal * own.point;
  return model;
}

Symmetry to_own(const SymmetrySurface& surface, const Symmetry& model) {
  Symmetry own = model;
  own.point = (model.point - surface.centroid) / surface.diagonal;
  own.point = foot(own);
  return own;
}

Eigen::Vector3d foot(const Symmetry& symmetry) {
  const Eigen::Vector3d along = symmetry.axis * symmetry.axis.dot(symmetry.point);
  return symmetry.kind == SymmetryKind::reflection ? along : Eigen::Vector3d(symmetry.point - along);
}

namespace {

/// How far detail may stand out, fraction of the diagonal.
double deepest_detail(const SymmetryOptions& options) {
  return std::max(depth_per_missing_share * (1 - options.support), counterpart * options.tolerance);
}

/// Index of the sorted value that all but a share of `count` values do not exceed.
std::size_t quantile(std::size_t count, double share) {
  return count - 1 - static_cast<std::size_t>(share * static_cast<double>(count));
}

}  // namespace

Agreement agreement(std::vector<double> distances, double diagonal, const SymmetryOptions& options) {
  std::sort(distances.begin(), distances.end());
  const auto count = static_cast<double>(distances.size());
  const auto supported = static_cast<std::size_t>(std::ceil(options.support * count));
  const double reach = counterpart * options.tolerance;
  double inner = 0, outer = 0;
  for (std::size_t k = 0; k < supported; ++k) inner += distances[k] * distances[k];
  const auto first_outer = std::upper_bound(distances.begin(), distances.end(), reach);
  for (auto d = first_outer; d != distances.end(); ++d) outer += *d * *d;
  Agreement result;
  result.residual = std::sqrt(inner / std::max<double>(1, static_cast<double>(supported)));
  result.support = static_cast<double>(first_outer - distances.begin()) / count;
  result.holds =
      result.residual <= options.tolerance && result.support >= options.support &&
      std::sqrt(outer / count) <= options.tolerance &&
      distances[quantile(distances.size(), outlying_samples)] <= deepest_detail(options) * diagonal;
  return result;
}

std::vector<double> image_distances(const SurfaceIndex& index, const Points& points,
                                    const Eigen::Affine3d& map) {
  std::vector<double> distances(static_cast<std::size_t>(points.rows()));
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, points.rows(), 64), [&](const auto& range) {
    for (Eigen::Index k = range.begin(); k < range.end(); ++k)
      distances[static_cast<std::size_t>(k)] = index.nearest(map * points.row(k).transpose()).distance;
  });
  return distances;
}

Agreement verify(const SymmetrySurface& surface, const Symmetry& symmetry, const SymmetryOptions& options,
                 Effort effort) {
  const Points& points = effort == Effort::dense ? surface.dense.points : surface.sparse.points;
  const Eigen::Isometry3d map = isometry_of(symmetry);
  std::vector<double> distances = image_distances(surface.index, points, map);
  if (symmetry.kind == SymmetryKind::rotation && symmetry.order > 2)
    for (const double distance : image_distances(surface.index, points, map.inverse()))
      distances.push_back(distance);
  for (double& distance : distances) distance /= surface.scale;
  Agreement result = agreement(std::move(distances), 1 / surface.scale, options);
  result.residual *= surface.scale;
  if (effort == Effort::dense && result.holds) {
    // Thin members have few samples, but corners.
    std::vector<double> at_corners = image_distances(surface.index, surface.corners, map);
    std::sort(at_corners.begin(), at_corners.end());
    result.holds = at_corners[quantile(at_corners.size(), outlying_corners)] <= deepest_detail(options);
  }
  return result;
}

namespace {

/// Do the moments about two directions across `axis` agree?
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

/// Half steps of regular polygons: a prism of n sides differs most from itself turned by pi / n.
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

}  // namespace

namespace {

/// The axis of revolution near the direction through the centroid.
std::optional<Symmetry> revolution_about(const SymmetrySurface& surface, const Eigen::Vector3d& direction,
                                         const SymmetryOptions& options, Roundness roundness) {
  const Symmetry start{SymmetryKind::revolution, Eigen::Vector3d::Zero(), direction.normalized(), 2};
  if (!balanced(surface.spread, start.axis)) return {};
  if (!verify(surface, start, loosened(options), Effort::sparse).holds) return {};
  const Symmetry better = refined(surface, start, counterpart_reach(surface, options));
  // The moments know the axis exactly when nothing is missing, also of prisms with an odd number of sides.
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
  const Eigen::Matrix3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(surface.spread).eigenvectors();
  std::vector<Symmetry> found;
  for (const Eigen::Matrix3d& axes : {principal, surface.box.axes})
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = axes.col(k);
      const bool known = std::any_of(found.begin(), found.end(), [&](const Symmetry& other) {
        return std::abs(other.axis.dot(axis)) > same_direction;
      });
      if (known || found.size() == 3) continue;
      if (const auto revolution = revolution_about(surface, axis, options, roundness))
        found.push_back(*revolution);
    }
  return found;
}

SymmetryOptions loosened(const SymmetryOptions& options) {
  return {rough_allowance * options.tolerance, std::max(0.0, 1 - rough_allowance * (1 - options.support))};
}

double counterpart_reach(const SymmetrySurface& surface, const SymmetryOptions& options) {
  return counterpart * options.tolerance * surface.scale;
}

void validate(const SymmetryOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 1))
    throw UsageError("the tolerance of symmetries must lie between 0 and 1");
  if (!(options.support > 0 && options.support <= 1))
    throw UsageError("the support of symmetries must lie above 0 and not above 1");
}

}  // namespace stackabilization::detail
