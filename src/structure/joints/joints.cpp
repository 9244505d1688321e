#include "stackabilization/structure/joints.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/extract_parts.h"
#include "mesh/surface_moments.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "structure/joints/part_interfaces.h"
#include "structure/model/canonical_axes.h"
#include "structure/model/part_surface.h"

namespace stackabilization {

namespace {

using detail::PartSurface;

/// Share of a region, about its centre, that must lie in a third part for the joint to be omitted.
constexpr double hidden_share = 0.75;

/// Smallest ratio of width to length of a region without a longest direction.
constexpr double round_share = 0.9;

/// The same for the second moments of a shape across an axis.
constexpr double round_moment = 0.99;

void check(const JointOptions& options) {
  if (!(options.reach > 0) || !std::isfinite(options.reach))
    throw UsageError("the reach of joints must be positive");
  if (!(options.line_aspect >= 1)) throw UsageError("the aspect of line joints must be at least 1");
  if (!(options.min_line >= 0)) throw UsageError("the shortest line joint must not be negative");
  if (!(options.separate >= 0)) throw UsageError("the distance of separate joints must not be negative");
}

double size_of(const Shape& shape) {
  std::vector<Eigen::Vector3d> corners;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) corners.push_back(shape.corner(t, k));
  return detail::enclosing_diameter(corners);
}

class JointFinder {
 public:
  JointFinder(const Shape& shape, const std::vector<Part>& parts, const JointOptions& options)
      : options_(options),
        size_(size_of(shape)),
        moment_(detail::SurfaceMoments(shape, shape.corner(0, 0)).covariance()),
        surfaces_(parts.size()) {
    for (const Part& part : parts) is_cuboid_.push_back(std::holds_alternative<Cuboid>(part.primitive));
    const std::vector<Shape> pieces = extract_parts(shape);
    tbb::parallel_for(std::size_t{0}, parts.size(),
                      [&](std::size_t k) { surfaces_[k].emplace(pieces[k], parts[k]); });
  }

  /// Looks at `pairs` of parts.
  std::vector<Relation> run(const BoxPairs& pairs) const {
    std::vector<std::vector<Joint>> found(pairs.size());
    tbb::parallel_for(std::size_t{0}, pairs.size(),
                      [&](std::size_t k) { found[k] = joints_between(pairs[k].first, pairs[k].second); });
    std::vector<Joint> joints;
    for (const std::vector<Joint>& some : found) joints.insert(joints.end(), some.begin(), some.end());
    return without_hidden(joints);
  }

 private:
  struct Joint {
    Relation relation;
    detail::PrincipalExtents region;
  };

  std::vector<Joint> joints_between(int a, int b) const {
    const PartSurface &first = surface(a), &second = surface(b);
    const double smaller = std::min(first.size(), second.size());
    // Parts far smaller than the reach would otherwise meet all parts around them.
    const double reach = std::min(options_.reach * size_, options_.separate * smaller);
    std::vector<detail::PartInterface> spots =
        part_interfaces(first, second, {reach, options_.separate * smaller});
    if (const auto line = seam(spots, {a, b}, reach)) spots = {*line};
    std::vector<Joint> joints;
    for (const detail::PartInterface& spot : spots)
      for (Relation& joint : joints_at(spot, {a, b}, smaller))
        joints.push_back({std::move(joint), spot.region});
    std::sort(joints.begin(), joints.end(), [](const Joint& one, const Joint& other) {
      const Points &p = one.relation.points, &q = other.relation.points;
      return std::lexicographical_compare(p.data(), p.data() + p.size(), q.data(), q.data() + q.size());
    });
    return joints;
  }

  /// Replaces several regions in a row along the side of a cuboid by the line joint of the cuboid with the
  /// other part, such as a rail on two pegs. The other part must be present between the regions; a bar
  /// between two arms is not.
  std::optional<detail::PartInterface> seam(const std::vector<detail::PartInterface>& spots,
                                            const std::array<int, 2>& parts, double reach) const {
    const int bar = surface(parts[0]).size() < surface(parts[1]).size() ? 0 : 1;
    if (spots.size() < 2 || !is_cuboid_[static_cast<std::size_t>(parts[static_cast<std::size_t>(bar)])])
      return std::nullopt;
    detail::PartInterface all = spots[0];
    Points corners = spots[0].region.hull;
    for (std::size_t k = 1; k < spots.size(); ++k) {
      const Eigen::Index old = corners.rows();
      corners.conservativeResize(old + spots[k].region.hull.rows(), 3);
      corners.bottomRows(spots[k].region.hull.rows()) = spots[k].region.hull;
      all.gap = std::min(all.gap, spots[k].gap);
    }
    all.region = detail::principal_extents(corners, tolerance::relative * size_);
    if (!is_line(all.region, surface(parts[static_cast<std::size_t>(bar)]).size())) return std::nullopt;
    const PartSurface& other = surface(parts[static_cast<std::size_t>(1 - bar)]);
    constexpr int steps = 16;
    for (int k = 0; k <= steps; ++k) {
      const double place = all.region.ranges(0, 0) + all.region.length(0) * k / steps;
      const Eigen::Vector3d point = all.region.centre + place * all.region.axes.col(0);
      if (!other.contains(point) && other.distance(point) > reach) return std::nullopt;
    }
    return all;
  }

  bool is_line(const detail::PrincipalExtents& region, double smaller) const {
    return region.length(0) >= options_.line_aspect * region.length(1) && region.length(0) > 0 &&
           region.length(0) >= options_.min_line * smaller;
  }

  const PartSurface& surface(int part) const { return *surfaces_[static_cast<std::size_t>(part)]; }

  /// Removes the joints that a third part hides. Two bars that end in one leg overlap there, but both are
  /// joined to the leg: the overlap of the bars is smaller than the overlap of each of them with the leg, and
  /// lies inside the leg.
  std::vector<Relation> without_hidden(const std::vector<Joint>& joints) const {
    // Largest overlap of each part with the parts that it is joined to.
    std::vector<std::map<int, double>> shares(surfaces_.size());
    for (const auto& [relation, region] : joints)
      for (const std::size_t side : {0U, 1U}) {
        double& most = shares[static_cast<std::size_t>(relation.parts[side])][relation.parts[1 - side]];
        most = std::max(most, region.deviations.norm());
      }
    std::vector<char> hidden(joints.size(), 0);
    tbb::parallel_for(std::size_t{0}, joints.size(), [&](std::size_t k) {
      const Relation& relation = joints[k].relation;
      const detail::PrincipalExtents& region = joints[k].region;
      const std::map<int, double>*few = &shares[static_cast<std::size_t>(relation.parts[0])],
                          *many = &shares[static_cast<std::size_t>(relation.parts[1])];
      if (many->size() < few->size()) std::swap(few, many);
      const double here = region.deviations.norm();
      hidden[k] = std::any_of(few->begin(), few->end(), [&](const auto& third) {
        const auto other = many->find(third.first);
        return third.second > here && other != many->end() && other->second > here &&
               holds(surface(third.first), region);
      });
    });
    std::vector<Relation> kept;
    for (std::size_t k = 0; k < joints.size(); ++k)
      if (!hidden[k]) kept.push_back(joints[k].relation);
    return kept;
  }

  static bool holds(const PartSurface& surface, const detail::PrincipalExtents& region) {
    for (const auto& row : region.hull.rowwise())
      if (!surface.contains(region.centre + hidden_share * (row.transpose() - region.centre))) return false;
    return surface.contains(region.centre);
  }

  std::vector<Relation> joints_at(const detail::PartInterface& spot, const std::array<int, 2>& parts,
                                  double smaller) const {
    const detail::PrincipalExtents& region = spot.region;
    const Eigen::Vector3d along = region.axes.col(0);
    if (is_line(region, smaller)) {
      Points ends(2, 3);
      for (int k = 0; k < 2; ++k) ends.row(k) = (region.centre + region.ranges(0, k) * along).transpose();
      return {relation(RelationType::line_joint, parts, ends, spot.gap)};
    }
    if (is_shared(region.centre, parts))
      return {relation(RelationType::point_joint, parts, region.centre.transpose(), spot.gap)};
    std::vector<Relation> joints;
    for (const Eigen::RowVector3d& point : extremes(region))
      joints.push_back(relation(RelationType::point_joint, parts, point, spot.gap));
    return joints;
  }

  Relation relation(RelationType type, const std::array<int, 2>& parts, const Points& points,
                    double gap) const {
    Relation joint;
    joint.type = type;
    joint.parts.assign(parts.begin(), parts.end());
    joint.points = points;
    joint.residual = gap / size_;
    return joint;
  }

  /// Returns whether one of the parts is at the centre of a region. In the middle of a ring, such as a rim on
  /// a cup, neither part is.
  bool is_shared(const Eigen::Vector3d& point, const std::array<int, 2>& parts) const {
    return std::all_of(parts.begin(), parts.end(), [&](int part) {
      return surface(part).contains(point) ||
             surface(part).distance(point) <= options_.separate * surface(part).size();
    });
  }

  /// Returns the extreme points of a region on four sides of its centre, along its two longest axes. When its
  /// length equals its width, the axes of the shape define the four sides.
  std::vector<Eigen::RowVector3d> extremes(const detail::PrincipalExtents& region) const {
    const Eigen::Vector3d normal = region.axes.col(2);
    const bool is_round = region.deviations(1) > round_share * region.deviations(0);
    const Eigen::Vector3d u = is_round ? axis_across(normal) : Eigen::Vector3d(region.axes.col(0));
    std::vector<Eigen::RowVector3d> points;
    for (const Eigen::Vector3d& side : {u, Eigen::Vector3d(normal.cross(u))})
      for (const double sign : {-1.0, 1.0}) {
        const double out =
            sign * (sign * side.transpose() * (region.hull.transpose().colwise() - region.centre)).maxCoeff();
        points.emplace_back((region.centre + out * side).transpose());
      }
    return points;
  }

  /// Direction across `normal` in which the shape is longest; for a round shape the nearest axis of the file.
  Eigen::Vector3d axis_across(const Eigen::Vector3d& normal) const {
    Eigen::Matrix<double, 3, 2> plane;
    plane.col(0) = detail::orthogonal_axis(normal);
    plane.col(1) = normal.cross(plane.col(0));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(plane.transpose() * moment_ * plane);
    if (solver.eigenvalues()(0) > round_moment * solver.eigenvalues()(1)) return plane.col(0);
    return plane * solver.eigenvectors().col(1);
  }

  JointOptions options_;
  double size_;
  Eigen::Matrix3d moment_;  ///< of the shape
  std::vector<std::optional<PartSurface>> surfaces_;
  std::vector<bool> is_cuboid_;  ///< per part
};

}  // namespace

BoxPairs near_parts(const Shape& shape, const JointOptions& options) {
  check(options);
  std::vector<Eigen::AlignedBox3d> boxes(shape.part_names.size());
  std::vector<std::size_t> triangles(boxes.size(), 0);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const Eigen::Vector3d a = shape.corner(t, 0), b = shape.corner(t, 1), c = shape.corner(t, 2);
    if (!detail::has_area(shape, t)) continue;
    const auto part = static_cast<std::size_t>(shape.triangle_part[static_cast<std::size_t>(t)]);
    for (const Eigen::Vector3d& p : {a, b, c}) boxes[part].extend(p);
    ++triangles[part];
  }
  auto pairs = near_boxes(boxes, options.reach * size_of(shape), options.max_pairs);
  if (!pairs)
    throw InputError(
        "more than " + std::to_string(options.max_pairs) +
        " pairs of its parts come near each other, by their boxes: joints are looked for between "
        "at most so many");
  std::size_t in_pairs = 0;
  for (const auto& [a, b] : *pairs)
    in_pairs += triangles[static_cast<std::size_t>(a)] + triangles[static_cast<std::size_t>(b)];
  if (in_pairs > options.max_pair_triangles)
    throw InputError("the " + std::to_string(pairs->size()) +
                     " pairs of its parts that come near each other have " + std::to_string(in_pairs) +
                     " triangles, counted pair by pair: joints are looked for between at most " +
                     std::to_string(options.max_pair_triangles));
  return std::move(*pairs);
}

std::vector<Relation> find_joints(const Shape& shape, const std::vector<Part>& parts,
                                  const JointOptions& options) {
  if (parts.size() != shape.part_names.size())
    throw UsageError("joints need one primitive for each part of the shape");
  const BoxPairs pairs = near_parts(shape, options);
  return JointFinder(shape, parts, options).run(pairs);
}

}  // namespace stackabilization
