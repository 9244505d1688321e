#include "structure/symmetry/symmetry_verification.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "stackabilization/core/errors.h"

namespace stackabilization::detail {

namespace {

/// Distances up to this many tolerances count as a counterpart.
constexpr double counterpart = 3;
constexpr double depth_per_missing_share = 0.4;
/// Shares: noise has outliers.
constexpr double outlying_samples = 0.005;
constexpr double outlying_corners = 0.02;
constexpr double rough_allowance = 1.5;

/// Largest deviation of detail, fraction of the diagonal.
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
  result.holds = result.residual <= options.tolerance && result.support >= options.support &&
                 std::sqrt(outer / count) <= options.tolerance &&
                 distances[quantile(distances.size(), outlying_samples)] <=
                     std::max(deepest_detail(options) * diagonal, options.tolerance);
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

SymmetryOptions loosen(const SymmetryOptions& options) {
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
