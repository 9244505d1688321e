#include "deformation/model/vertex_constraints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/barycentric.h"
#include "mesh/surface_index.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

/// Returns the corners of the triangle whose barycentric weight at the point exceeds tolerance::relative.
std::vector<std::int32_t> containing_corners(const Shape& shape, const SurfacePoint& at) {
  const Eigen::Vector3d weights = detail::barycentric_weights(shape, at.triangle, at.point);
  std::vector<std::int32_t> rows;
  for (int k = 0; k < 3; ++k)
    if (!(weights(k) <= tolerance::relative)) rows.push_back(shape.triangles(at.triangle, k));
  return rows;
}

struct Box {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;

  void add(const Eigen::Vector3d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

Box box_of(const Triangles& triangles, const Points& vertices) {
  Box box;
  for (const std::int32_t v : triangles.reshaped<Eigen::RowMajor>()) box.add(vertices.row(v).transpose());
  return box;
}

/// Data that the checks of one call share.
class Check {
 public:
  Check(const Shape& rest, const DeformationConstraints& constraints, const std::vector<std::int32_t>& fixed)
      : rest_(rest), constraints_(constraints), fixed_(fixed), box_(box_of(rest.triangles, rest.vertices)) {
    diagonal_ = (box_.high - box_.low).norm();
    rounding_ =
        tolerance::rounding * std::max(box_.low.cwiseAbs().maxCoeff(), box_.high.cwiseAbs().maxCoeff());
  }

  std::optional<Refusal> finite(const Points& vertices) const {
    for (const std::int32_t v : rest_.triangles.reshaped<Eigen::RowMajor>())
      if (!(vertices.row(v).cwiseAbs().maxCoeff() <= tolerance::max_coordinate))
        return Refusal{.cause = RefusalCause::vertex_range, .index = v};
    return {};
  }

  /// Resets fixed vertices to their positions at rest. Refuses when one of them has moved by more than
  /// rounding.
  std::optional<Refusal> fixed_stay(Points& vertices) const {
    for (const std::int32_t v : fixed_) {
      const double moved = (vertices.row(v) - rest_.vertices.row(v)).norm();
      if (!(moved <= 8 * rounding_)) return refusal(RefusalCause::fixed_vertex, moved, v);
      vertices.row(v) = rest_.vertices.row(v);
    }
    return {};
  }

  std::optional<Refusal> keep_extent(Points& vertices) const;
  std::optional<Refusal> box_stays(const Points& vertices) const;

 private:
  Refusal refusal(RefusalCause cause, double by, int index = -1) const {
    return {.cause = cause, .index = index, .amount = diagonal_ > 0 ? by / diagonal_ : 0};
  }

  /// Returns the heights of vertices above the lowest corner of the box at rest, along the unit vector `up`.
  Eigen::VectorXd heights(const Points& vertices, const Eigen::Vector3d& up) const {
    return (vertices.rowwise() - box_.low.transpose()) * up;
  }
  Range range(const Eigen::VectorXd& heights) const {
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const std::int32_t v : rest_.triangles.reshaped<Eigen::RowMajor>())
      range = {std::min(range.low, heights(v)), std::max(range.high, heights(v))};
    return range;
  }

  const Shape& rest_;
  const DeformationConstraints& constraints_;
  const std::vector<std::int32_t>& fixed_;
  Box box_;
  double diagonal_ = 0, rounding_ = 0;
};

/// Displacement along an axis as a function of the height along it: `low` at the lower end, `high` at the
/// upper end, linear in between. With fixed vertices, it is zero between their heights and linear from there
/// to the ends.
struct Stretch {
  Range from;
  std::optional<Range> still;
  double low, high;

  double operator()(double height) const {
    const double h = std::clamp(height, from.low, from.high);
    if (!still) return low + (high - low) * ((h - from.low) / from.length());
    if (h < still->low) return low * ((still->low - h) / (still->low - from.low));
    if (h > still->high) return high * ((h - still->high) / (from.high - still->high));
    return 0;
  }
};

std::optional<Refusal> Check::keep_extent(Points& vertices) const {
  const Eigen::Vector3d up = constraints_.keep_extent->unit();
  const Range before = range(heights(rest_.vertices, up));
  const Eigen::VectorXd height = heights(vertices, up);
  const Range now = range(height);
  const double change = now.length() - before.length();
  if (std::abs(change) <= rounding_) return {};
  if (now.length() == 0) return refusal(RefusalCause::flat_extent, -change);

  // Candidates are the intervals of the old length from "lowest point stays" to "highest point stays". Choose
  // the one nearest to the interval at rest.
  const auto [least, most] = std::minmax({now.low, now.low + change});
  Range then{std::clamp(before.low, least, most), 0};
  std::optional<Range> still;
  if (!fixed_.empty()) {
    const Eigen::VectorXd fixed_heights = height(fixed_);
    still = Range{fixed_heights.minCoeff(), fixed_heights.maxCoeff()};
    if (now.low == still->low)
      then.low = now.low;
    else if (now.high == still->high)
      then.low = now.low + change;
  }
  then.high = then.low + before.length();
  if (still && (now.low < still->low ? then.low >= still->low : then.low != now.low))
    return refusal(RefusalCause::fixed_low, std::abs(change));
  if (still &&
      (now.high > still->high ? then.high <= still->high : std::abs(then.high - now.high) > rounding_))
    return refusal(RefusalCause::fixed_high, std::abs(change));

  const Stretch stretch{now, still, then.low - now.low, then.high - now.high};
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) vertices.row(v) += stretch(height(v)) * up.transpose();
  return {};
}

std::optional<Refusal> Check::box_stays(const Points& vertices) const {
  const Box now = box_of(rest_.triangles, vertices);
  const Eigen::Vector3d before = box_.high - box_.low;
  const Eigen::Vector3d change = (now.high - now.low - before).cwiseAbs();
  for (int k = 0; k < 3; ++k)
    if (!(change(k) <= *constraints_.box_tolerance * before(k) + 8 * rounding_))
      return refusal(RefusalCause::box_side, change(k), k);
  return {};
}

}  // namespace

std::vector<std::int32_t> fixed_vertices(const Shape& rest, const DeformationConstraints& constraints) {
  validate(constraints, rest);
  std::vector<std::int32_t> rows;
  for (const int part : constraints.fixed_parts) {
    for (Eigen::Index t = 0; t < rest.triangle_count(); ++t)
      if (rest.triangle_part[static_cast<std::size_t>(t)] == part)
        for (int k = 0; k < 3; ++k) rows.push_back(rest.triangles(t, k));
  }
  if (!constraints.fixed_points.empty()) {
    const SurfaceIndex surface(rest);
    for (const Eigen::Vector3d& point : constraints.fixed_points)
      for (const std::int32_t v : containing_corners(rest, surface.nearest(point))) rows.push_back(v);
  }
  if (rows.empty()) return rows;
  const std::vector<std::int32_t> place = detail::weld(rest).of_vertex;
  std::vector<bool> is_fixed(place.size());
  for (const std::int32_t v : rows)
    is_fixed[static_cast<std::size_t>(place[static_cast<std::size_t>(v)])] = true;
  rows.clear();
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] >= 0 && is_fixed[static_cast<std::size_t>(place[v])])
      rows.push_back(static_cast<std::int32_t>(v));
  return rows;
}

MovedVertices constrain(const Shape& rest, Points vertices, const DeformationConstraints& constraints,
                        const std::vector<std::int32_t>& fixed) {
  validate(constraints, rest);
  const Check check(rest, constraints, fixed);
  std::optional<Refusal> refusal = check.finite(vertices);
  if (!refusal) refusal = check.fixed_stay(vertices);
  if (!refusal && constraints.keep_extent) refusal = check.keep_extent(vertices);
  if (!refusal) refusal = check.finite(vertices);
  if (!refusal && constraints.box_tolerance) refusal = check.box_stays(vertices);
  if (refusal) return {std::move(refusal), rest.vertices};
  return {{}, std::move(vertices)};
}

}  // namespace stackabilization
