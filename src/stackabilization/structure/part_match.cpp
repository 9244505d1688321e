#include "stackabilization/structure/part_match.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace stackabilization::detail {

namespace {

constexpr int whole_samples = 500, part_samples = 250;
constexpr double size_tolerances = 10, absolute_size_tolerances = 0.1;

double area_of(const Shape& shape) {
  double area = 0;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    area +=
        (shape.corner(t, 1) - shape.corner(t, 0)).cross(shape.corner(t, 2) - shape.corner(t, 0)).norm() / 2;
  return area;
}

/// Root mean square widths along the principal axes, ascending, model units.
Eigen::Vector3d widths(const SymmetrySurface& surface) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(surface.spread, Eigen::EigenvaluesOnly);
  return surface.diagonal * solver.eigenvalues().cwiseMax(0).cwiseSqrt();
}

}  // namespace

PartSurfaces::PartSurfaces(const Shape& shape, const SymmetryOptions& options)
    : options_(options), whole_(symmetry_surface(shape, whole_samples)) {
  for (Eigen::Index p = 0; p < shape.part_count(); ++p) {
    const Shape part = extract_part(shape, p);
    parts_.emplace_back();
    if (area_of(part) > 0) parts_.back().emplace(symmetry_surface(part, part_samples));
  }
  unit_ = whole_.scale * whole_.diagonal;
  diagonal_ = Eigen::Vector3d(range_along(shape, Eigen::Vector3d::UnitX()).length(),
                              range_along(shape, Eigen::Vector3d::UnitY()).length(),
                              range_along(shape, Eigen::Vector3d::UnitZ()).length())
                  .norm();
}

const SymmetrySurface* PartSurfaces::part(int index) const {
  const std::optional<SymmetrySurface>& part = parts_[static_cast<std::size_t>(index)];
  return part ? &*part : nullptr;
}

std::vector<const SymmetrySurface*> PartSurfaces::with_area() const {
  std::vector<const SymmetrySurface*> result;
  for (const std::optional<SymmetrySurface>& part : parts_)
    if (part) result.push_back(&*part);
  return result;
}

std::optional<double> PartSurfaces::match(int a, int b, const Symmetry& symmetry) const {
  const SymmetrySurface *from = part(a), *to = part(b);
  if (!from || !to) return {};
  const Eigen::Isometry3d map = isometry_of(symmetry);
  if ((map * from->centroid - to->centroid).norm() > options_.tolerance * unit_) return {};
  const Eigen::Vector3d widths_a = widths(*from), widths_b = widths(*to);
  for (int k = 0; k < 3; ++k) {
    const double allowed = options_.tolerance * std::max(size_tolerances * std::max(widths_a(k), widths_b(k)),
                                                         absolute_size_tolerances * unit_);
    if (std::abs(widths_a(k) - widths_b(k)) > allowed) return {};
  }
  std::vector<double> both = distances(*from, *to, map);
  for (const double distance : distances(*to, *from, map.inverse())) both.push_back(distance);
  const Agreement found =
      agreement(std::move(both), std::max(from->diagonal, to->diagonal) / unit_, options_);
  if (!found.holds) return {};
  return found.residual * unit_ / diagonal_;
}

std::vector<double> PartSurfaces::distances(const SymmetrySurface& from, const SymmetrySurface& to,
                                            const Eigen::Isometry3d& map) const {
  Eigen::Affine3d chain = Eigen::Affine3d::Identity();
  chain.linear() = map.linear() * from.diagonal / to.diagonal;
  chain.translation() = (map * from.centroid - to.centroid) / to.diagonal;
  std::vector<double> result = image_distances(to.index, from.dense.points, chain);
  for (double& distance : result) distance *= to.diagonal / unit_;
  return result;
}

}  // namespace stackabilization::detail
