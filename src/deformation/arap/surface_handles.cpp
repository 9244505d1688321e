#include "deformation/arap/surface_handles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/tolerances.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization::detail {

namespace {

void validate(const SurfaceModelOptions& options) {
  if (!(std::isfinite(options.handle_radius) && options.handle_radius >= 0))
    throw UsageError("the radius of point handles needs a finite number that is not negative");
  if (!(options.influence >= 0))
    throw UsageError("the influence of handles needs a number that is not negative");
  if (!(std::isfinite(options.reach) && options.reach >= 0))
    throw UsageError("the reach between shells needs a finite number that is not negative");
  if (options.sections < 1) throw UsageError("a surface needs one section at least");
  if (options.axis && !(options.axis->allFinite() && options.axis->norm() > 0))
    throw UsageError("the main axis needs finite coordinates that are not all zero");
  if (options.rigidity.iterations < 1) throw UsageError("a surface needs one iteration at least");
  if (!(std::isfinite(options.rigidity.rotation_smoothness) && options.rigidity.rotation_smoothness >= 0))
    throw UsageError("the smoothness of rotations needs a finite number that is not negative");
}

Eigen::Vector3d main_axis(const Shape& shape) {
  const OrientedBox box = minimal_oriented_box(HullSupport(shape));
  Eigen::Vector3i order(0, 1, 2);  // of the sides, shortest first
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return box.half_extents(a) < box.half_extents(b); });
  const auto alike = [&](int a, int b) {
    return box.half_extents(order(b)) * 19 <= box.half_extents(order(a)) * 20;
  };
  const int along = alike(1, 2) && !alike(0, 1) ? order(0) : order(2);
  Eigen::Vector3d axis = box.axes.col(along);
  Eigen::Index main;
  axis.cwiseAbs().maxCoeff(&main);
  return axis(main) < 0 ? Eigen::Vector3d(-axis) : axis;
}

/// Returns the welded vertices of each slice. A ring on the border of two slices goes to the upper one as a
/// whole.
std::vector<std::vector<std::int32_t>> slices(const Points& points, const Eigen::Vector3d& axis, int count) {
  const Eigen::VectorXd heights = (points.rowwise() - points.row(0)) * axis;
  const double low = heights.minCoeff(), length = heights.maxCoeff() - low;
  std::vector<std::vector<std::int32_t>> slices(static_cast<std::size_t>(count));
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    const double at = length > 0 ? (heights(p) - low) / length * count + tolerance::slice_slack : 0;
    slices[static_cast<std::size_t>(std::min<double>(std::floor(at), count - 1))].push_back(
        static_cast<std::int32_t>(p));
  }
  return slices;
}

template <class Sets>
const std::vector<std::int32_t>& entry(const Sets& sets, int index, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= sets.size() ||
      sets[static_cast<std::size_t>(index)].empty())
    throw UsageError(std::string("the surface has no ") + what + ' ' + std::to_string(index) +
                     " to take hold of");
  return sets[static_cast<std::size_t>(index)];
}

}  // namespace

SurfaceHandles::SurfaceHandles(const Shape& shape, const WeldedMesh& places,
                               const SurfaceModelOptions& options)
    : parts_(static_cast<std::size_t>(shape.part_count())),
      place_of_vertex_(places.of_vertex),
      vertex_of_place_(places.first_vertex),
      points_(places.points),
      areas_(Eigen::VectorXd::Zero(places.points.rows())) {
  validate(options);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    std::vector<std::int32_t>& part =
        parts_[static_cast<std::size_t>(shape.triangle_part[static_cast<std::size_t>(t)])];
    for (int k = 0; k < 3; ++k) {
      areas_(places.triangles(t, k)) += places.area(t) / 3;
      part.push_back(places.triangles(t, k));
    }
  }
  for (std::vector<std::int32_t>& part : parts_) {
    std::sort(part.begin(), part.end());
    part.erase(std::unique(part.begin(), part.end()), part.end());
  }
  axis_ = options.axis ? options.axis->normalized() : main_axis(shape);
  sections_ = slices(points_, axis_, options.sections);
  radius_ = options.handle_radius * (points_.colwise().maxCoeff() - points_.colwise().minCoeff()).norm();
}

std::vector<Handle> SurfaceHandles::all() const {
  std::vector<Handle> handles{{HandleKind::shape, 0, 0}};
  for (std::size_t k = 0; k < parts_.size(); ++k)
    if (!parts_[k].empty()) handles.push_back({HandleKind::part, static_cast<int>(k), 0});
  for (std::size_t k = 0; k < sections_.size(); ++k)
    if (!sections_[k].empty()) handles.push_back({HandleKind::section, 0, static_cast<int>(k)});
  for (const std::int32_t vertex : vertex_of_place_) handles.push_back({HandleKind::point, 0, vertex});
  return handles;
}

HeldSurface SurfaceHandles::weighted(std::vector<std::int32_t> places) const {
  Eigen::VectorXd weights = areas_(places);
  if (!(weights.sum() > 0)) weights.setOnes();
  weights /= weights.sum();
  return {std::move(places), std::move(weights)};
}

HeldSurface SurfaceHandles::around(int vertex) const {
  if (vertex < 0 || static_cast<std::size_t>(vertex) >= place_of_vertex_.size() ||
      place_of_vertex_[static_cast<std::size_t>(vertex)] < 0)
    throw UsageError("the surface has no vertex " + std::to_string(vertex) + " to take hold of");
  const std::int32_t centre = place_of_vertex_[static_cast<std::size_t>(vertex)];
  const Eigen::VectorXd distances = (points_.rowwise() - points_.row(centre)).rowwise().norm();
  HeldSurface held;
  for (std::int32_t p = 0; p < points_.rows(); ++p)
    if (distances(p) <= radius_) held.places.push_back(p);
  held.weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(held.places.size()));
  held.weights(std::lower_bound(held.places.begin(), held.places.end(), centre) - held.places.begin()) = 1;
  return held;
}

HeldSurface SurfaceHandles::held(const Handle& handle) const {
  switch (handle.kind) {
    case HandleKind::part:
      return weighted(entry(parts_, handle.part, "part"));
    case HandleKind::section:
      return weighted(entry(sections_, handle.index, "section"));
    case HandleKind::point:
      return around(handle.index);
    case HandleKind::shape: {
      std::vector<std::int32_t> all(vertex_of_place_.size());
      std::iota(all.begin(), all.end(), 0);
      return weighted(std::move(all));
    }
    case HandleKind::face:
    case HandleKind::corner:
    case HandleKind::wire:
      break;
  }
  throw UsageError("a surface can be held by parts, sections, points and as a whole only");
}

}  // namespace stackabilization::detail
