#include "improvement/search/cone_search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/angles.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/bundle_ascent.h"
#include "stackabilization/stacking/direction_region.h"
#include "stackabilization/stacking/tolerances.h"
#include "stackabilization/structure/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Samples along half the opening of the cone.
constexpr double samples_per_half_angle = 4;

/// A climb ends at this fraction of the sample spacing. Candidates change with every edit, so a finer step
/// gains nothing.
constexpr double last_step = 0.01;

bool are_parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return on_one_line(a, b, tolerance::same_symmetry);
}

}  // namespace

DirectionFreedom freedom_of(const Structure& structure, const Direction& direction) {
  DirectionFreedom freedom;
  const Eigen::Vector3d r = direction.unit();
  for (const Symmetry& symmetry : structure.symmetries) {
    const Eigen::Vector3d axis = symmetry.axis.normalized();
    if (symmetry.kind != SymmetryKind::reflection) {
      freedom.fixed = freedom.fixed || are_parallel(axis, r);
      continue;
    }
    if (std::abs(axis.dot(r)) > tolerance::same_symmetry) continue;
    if (freedom.plane_normal && !are_parallel(axis, *freedom.plane_normal)) freedom.fixed = true;
    if (!freedom.plane_normal) freedom.plane_normal = (axis - axis.dot(r) * r).normalized();
  }
  return freedom;
}

bool ConeSearch::keeps_height(const Shape& shape, const Eigen::Vector3d& direction) const {
  if (!checker_.requirements().keep_height) return true;
  const Eigen::Vector3d unit = direction.normalized();
  const double at_rest = range_along(checker_.space().rest().shape, unit).length();
  return std::abs(range_along(shape, unit).length() - at_rest) <= tolerance::relative * at_rest;
}

std::optional<Stackability> ConeSearch::best_of(
    const std::vector<std::optional<Stackability>>& samples) const {
  std::optional<Stackability> best;
  for (const auto& sample : samples)
    if (sample && (!best || sample->value > best->value + tolerance::stackability)) best = sample;
  return best;
}

std::optional<Stackability> ConeSearch::better(const Shape& shape, const Stackability& now) const {
  const Direction direction(now.direction);
  const DirectionFreedom freedom = freedom_of(checker_.space().rest().structure, direction);
  if (!(cone_degrees_ > 0) || freedom.fixed) return std::nullopt;
  const double half_angle = cone_degrees_ * std::numbers::pi / 180;
  const DirectionRegion region(DirectionCone{direction.unit(), half_angle}, freedom.plane_normal);
  std::vector<Eigen::Vector3d> trials = region.samples(half_angle / samples_per_half_angle);
  std::erase_if(trials, [&](const Eigen::Vector3d& trial) { return !keeps_height(shape, trial); });
  if (trials.empty()) return std::nullopt;

  // Play only raises f_max and is slow to measure. So a solver without play may rule out directions.
  StackabilityOptions measure = checker_.requirements().measure;
  measure.play = 0;
  const StackabilitySolver solver(shape, measure);
  std::vector<std::optional<Stackability>> samples(trials.size());
  tbb::parallel_for(std::size_t{0}, trials.size(), [&](std::size_t k) {
    samples[k] = solver.measure_if_above(Direction(trials[k]), now.value + tolerance::stackability);
  });
  const auto start = best_of(samples);
  if (!start) return std::nullopt;
  const double step = half_angle / samples_per_half_angle;
  const LocalOptimum top = bundle_ascent(solver, region, *start, {step, last_step * step, {}});
  for (const Stackability& found : {top.at, *start}) {
    if (!keeps_height(shape, found.direction)) continue;
    const Stackability measured = checker_.measure(shape, Direction(found.direction));
    if (measured.value > now.value + tolerance::stackability) return measured;
  }
  return std::nullopt;
}

}  // namespace stackabilization::detail
