#define BOOST_ALLOW_DEPRECATED_HEADERS  // of which Boost.Geometry 1.74 itself includes one
#include "structure/symmetry/part_match.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <cmath>
#include <utility>

#include "core/extract_parts.h"
#include "core/index.h"
#include "mesh/surface_moments.h"

namespace stackabilization::detail {

namespace {

constexpr int whole_samples = 500, part_samples = 250;
constexpr double size_tolerances = 10, absolute_size_tolerances = 0.1;
/// Least share of an image that lies on one part, and how near, in tolerances.
constexpr double majority = 0.9, exact_tolerances = 0.1;

double area_of(const Shape& shape) {
  double area = 0;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) area += detail::area_vector(shape, t).norm();
  return area;
}

/// Root mean square widths along the principal axes, ascending, model units.
Eigen::Vector3d widths(const SymmetrySurface& surface) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(surface.spread, Eigen::EigenvaluesOnly);
  return surface.diagonal * solver.eigenvalues().cwiseMax(0).cwiseSqrt();
}

/// Sides of the minimal box, ascending, model units.
Eigen::Vector3d sides(const SymmetrySurface& surface) {
  Eigen::Vector3d sides = 2 * surface.diagonal * surface.box.half_extents;
  std::sort(sides.begin(), sides.end());
  return sides;
}

using Place = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;

Place place_of(const Eigen::Vector3d& p) {
  return Place(p.x(), p.y(), p.z());
}

}  // namespace

/// Centroids of the parts with area, to be found by place.
struct PartSurfaces::Centroids {
  using Entry = std::pair<Place, int>;
  boost::geometry::index::rtree<Entry, boost::geometry::index::rstar<16>> tree;
};

PartSurfaces::PartSurfaces(const Shape& shape, const SymmetryOptions& options)
    : options_(options),
      whole_(symmetry_surface(shape, whole_samples)),
      part_of_(shape.triangle_part),
      parts_(shape.part_names.size()),
      widths_(parts_.size()),
      sides_(parts_.size()) {
  const std::vector<Shape> parts = extract_parts(shape);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    if (!(area_of(parts[k]) > 0)) return;
    parts_[k].emplace(symmetry_surface(parts[k], part_samples));
    widths_[k] = widths(*parts_[k]);
    sides_[k] = sides(*parts_[k]);
  });
  std::vector<Centroids::Entry> entries;
  for (std::size_t k = 0; k < parts_.size(); ++k)
    if (parts_[k]) entries.emplace_back(place_of(parts_[k]->centroid), static_cast<int>(k));
  centroids_ = std::make_unique<const Centroids>(Centroids{{entries.begin(), entries.end()}});
  unit_ = whole_.scale * whole_.diagonal;
  diagonal_ = Eigen::Vector3d(range_along(shape, Eigen::Vector3d::UnitX()).length(),
                              range_along(shape, Eigen::Vector3d::UnitY()).length(),
                              range_along(shape, Eigen::Vector3d::UnitZ()).length())
                  .norm();
}

PartSurfaces::~PartSurfaces() = default;

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

bool PartSurfaces::same_size(int a, int b) const {
  const auto same = [&](const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
    for (int k = 0; k < 3; ++k) {
      const double allowed = options_.tolerance * std::max(size_tolerances * std::max(one(k), other(k)),
                                                           absolute_size_tolerances * unit_);
      if (std::abs(one(k) - other(k)) > allowed) return false;
    }
    return true;
  };
  const auto one = static_cast<std::size_t>(a), other = static_cast<std::size_t>(b);
  return same(widths_[one], widths_[other]) || same(sides_[one], sides_[other]);
}

bool PartSurfaces::is_near(const Eigen::Vector3d& centroid, int b, double tolerance) const {
  return (centroid - part(b)->centroid).norm() <= tolerance * unit_;
}

std::vector<int> PartSurfaces::near_image(int a, const Symmetry& symmetry, double slack) const {
  const SymmetrySurface* from = part(a);
  if (!from) return {};
  const Eigen::Vector3d image = isometry_of(symmetry) * from->centroid;
  const double tolerance = slack * options_.tolerance;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(tolerance * unit_);
  std::vector<int> found;
  centroids_->tree.query(boost::geometry::index::intersects(boost::geometry::model::box<Place>(
                             place_of(image - reach), place_of(image + reach))),
                         boost::make_function_output_iterator([&](const Centroids::Entry& entry) {
                           if (same_size(a, entry.second) && is_near(image, entry.second, tolerance))
                             found.push_back(entry.second);
                         }));
  std::sort(found.begin(), found.end());
  if (found.size() > max_matches) found.resize(max_matches);
  return found;
}

std::optional<double> PartSurfaces::match(int a, int b, const Symmetry& symmetry, double slack) const {
  const SymmetrySurface *from = part(a), *to = part(b);
  if (!from || !to) return {};
  const Eigen::Isometry3d map = isometry_of(symmetry);
  SymmetryOptions options = options_;
  options.tolerance *= slack;
  if (!is_near(map * from->centroid, b, options.tolerance) || !same_size(a, b)) return {};
  std::vector<double> both = distances(*from, *to, map);
  for (const double distance : distances(*to, *from, map.inverse())) both.push_back(distance);
  const Agreement found = agreement(std::move(both), std::max(from->diagonal, to->diagonal) / unit_, options);
  if (!found.holds) return {};
  return found.residual * unit_ / diagonal_;
}

std::optional<PartSurfaces::Image> PartSurfaces::image_of(int a, const Symmetry& symmetry) const {
  const SymmetrySurface* from = part(a);
  if (!from) return {};
  const Eigen::Isometry3d map = isometry_of(symmetry);
  std::vector<double> distances;
  std::vector<Eigen::Index> on(parts_.size(), 0);
  for (const auto row : from->dense.points.rowwise()) {
    const Eigen::Vector3d place = map * (from->centroid + from->diagonal * row.transpose());
    const SurfacePoint nearest = whole_.index.nearest((place - whole_.centroid) / whole_.diagonal);
    distances.push_back(nearest.distance * whole_.diagonal / unit_);
    if (distances.back() <= exact_tolerances * options_.tolerance) ++on[at(part_of_[at(nearest.triangle)])];
  }
  const auto most = std::max_element(on.begin(), on.end());
  if (static_cast<double>(*most) < majority * static_cast<double>(distances.size())) return {};
  const Agreement found = agreement(std::move(distances), from->diagonal / unit_, options_);
  if (!found.holds) return {};
  return Image{static_cast<int>(most - on.begin()), found.residual * unit_ / diagonal_};
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
