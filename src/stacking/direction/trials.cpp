#include "stacking/direction/trials.h"

#include <Eigen/Geometry>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stacking/direction/candidates.h"

namespace stackabilization::detail {

namespace {

/// Directions in a plane that belong to a candidate: the intersection with the plane orthogonal to the
/// candidate, and the direction nearest to the candidate.
std::vector<Eigen::Vector3d> lines_in_plane(const Eigen::Vector3d& plane_normal,
                                            const Eigen::Vector3d& candidate) {
  const Eigen::Vector3d normal = plane_normal.normalized(), unit = candidate.normalized();
  const Eigen::Vector3d across = normal.cross(unit);
  if (across.norm() <= tolerance::relative) return {};
  return {across.normalized(), across.cross(normal).normalized()};
}

}  // namespace

std::vector<DirectionTrial> even_trials(const StackabilitySolver& solver, const SearchOptions& options,
                                        const DirectionRegion& region, double spacing) {
  CandidateDirections candidates = candidate_directions(solver);
  candidates.main.insert(candidates.main.begin(), options.candidates.begin(), options.candidates.end());
  const Eigen::Vector3d none = options.plane_normal.value_or(Eigen::Vector3d::Zero());
  std::vector<DirectionTrial> trials;
  const auto add = [&](const Eigen::Vector3d& direction, const Eigen::Vector3d& circle_normal) {
    if (const auto member = region.member(direction)) trials.push_back({*member, circle_normal});
  };
  if (options.cone) add(options.cone->axis, none);
  for (const auto* directions : {&candidates.main, &candidates.others})
    for (const Eigen::Vector3d& direction : *directions) add(direction, none);
  if (options.plane_normal)
    for (const auto* directions : {&candidates.main, &candidates.others})
      for (const Eigen::Vector3d& direction : *directions)
        for (const Eigen::Vector3d& line : lines_in_plane(*options.plane_normal, direction)) add(line, none);
  for (const Eigen::Vector3d& direction : region.samples(spacing)) trials.push_back({direction, none});
  if (!options.plane_normal)
    for (const Eigen::Vector3d& normal : candidates.main)
      for (const Eigen::Vector3d& direction : half_circle(normal, spacing / 2)) add(direction, normal);
  if (trials.empty()) throw UsageError("the cone and the plane of directions have no direction in common");
  return trials;
}

}  // namespace stackabilization::detail
