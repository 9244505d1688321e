#include "deformation/model/joint_slides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/index.h"
#include "deformation/model/hollow_box.h"
#include "deformation/model/straight_curve.h"
#include "stackabilization/deformation/tolerances.h"
#include "structure/model/nearest_box.h"

namespace stackabilization::detail {

namespace {

/// Ratio of length to width of a member, and of width to thickness of a plate, at least.
constexpr double slender = 3;
/// Ratio of length to radius between those of discs, below 1, and those of members, from 6 on.
constexpr double disc_to_member = 2.5;
/// Least ratio of length to radius of a vessel.
constexpr double deep = 1.5;
/// Ratio of length to radius between those of dishes, below 1, and those of vessels.
constexpr double dish_to_vessel = 1.22;
/// A joint is at the rim of a plate, or at the end of a member or a wall, beyond this fraction of the way
/// from the centre. What belongs at an end, such as a castor under an arm of a base, leaves the end bare when
/// it slides.
constexpr double rim = 0.97, end_of_member = 0.85;

/// How far within the inner side of a wall a joint may be, fraction of half the extent of the box.
constexpr double wall_margin = 0.01;

/// Returns the outward unit normal of a face of a cuboid.
Eigen::Vector3d normal_of(const Cuboid& cuboid, int face) {
  const std::array<int, 4> ring = cuboid_face(face);
  const Eigen::Vector3d a = (cuboid.corners.row(ring[2]) - cuboid.corners.row(ring[0])).transpose(),
                        b = (cuboid.corners.row(ring[3]) - cuboid.corners.row(ring[1])).transpose();
  return a.cross(b).stableNormalized();
}

/// Returns the face of a hollow box whose wall is nearest to a point. Precondition: it has walls.
int wall_at(const Cuboid& box, const Eigen::Vector3d& point) {
  int nearest = -1;
  double least = 0;
  for (int face = 0; face < 6; ++face) {
    if (box.inner_sides(face / 2, face % 2) == 1) continue;
    const Eigen::Vector3d corner = box.corners.row(cuboid_face(face)[0]).transpose();
    const double distance = std::abs(normal_of(box, face).dot(point - corner));
    if (nearest >= 0 && !(distance < least)) continue;
    nearest = face;
    least = distance;
  }
  return nearest;
}

/// Returns the middle of a face of a cuboid.
Eigen::Vector3d middle_of(const Cuboid& cuboid, int face) {
  const std::array<int, 4> ring = cuboid_face(face);
  return cuboid.corners(ring, Eigen::all).colwise().mean().transpose();
}

/// Returns the mean edges of a cuboid along its three axes, one per column.
Eigen::Matrix3d mean_edges(const Cuboid& cuboid) {
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis)
      edges.col(axis) += ((corner >> axis & 1) != 0 ? 0.25 : -0.25) * cuboid.corners.row(corner).transpose();
  return edges;
}

/// Returns the axes of a cuboid with these edges along which joints may slide: one of a member, two of a
/// plate, else none.
std::vector<int> sliding_axes(const Eigen::Matrix3d& edges) {
  const Eigen::Vector3d lengths = edges.colwise().norm();
  std::vector<int> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return lengths(a) > lengths(b); });
  const double longest = lengths(order[0]), middle = lengths(order[1]), shortest = lengths(order[2]);
  if (longest >= slender * middle) return {order[0]};
  if (middle >= slender * shortest) return {order[0], order[1]};
  return {};
}

/// Returns whether a cylinder is a straight member, such as a round leg: at least `slender` times as long as
/// wide.
bool is_member(const GeneralizedCylinder& cylinder) {
  return is_straight(cylinder) && chord_of(cylinder).norm() >= slender * 2 * cylinder.radii.maxCoeff();
}

bool is_disc(const GeneralizedCylinder& cylinder) {
  return !cylinder.closed && chord_of(cylinder).norm() < cylinder.radii.mean();
}

/// Returns whether a hollow cylinder is at least `ratio` times as long as its mean radius.
bool is_deep(const GeneralizedCylinder& cylinder, double ratio) {
  return cylinder.inner_radii.size() > 0 && chord_of(cylinder).norm() >= ratio * cylinder.radii.mean();
}

/// Returns whether a cylinder is a straight vessel, such as a cup, no dish.
bool is_vessel(const GeneralizedCylinder& cylinder) {
  return is_straight(cylinder) && is_deep(cylinder, deep);
}

/// Returns whether a carrier was a vessel at rest, not a dish: edits change proportions less than that.
bool was_vessel(const GeneralizedCylinder& carrier) {
  return is_deep(carrier, dish_to_vessel);
}

/// Returns the direction in which the side of a straight cylinder runs at a point, unit, towards the last
/// section.
Eigen::Vector3d generator_at(const GeneralizedCylinder& cylinder, const Eigen::Vector3d& point) {
  const Eigen::Vector3d axis = chord_of(cylinder).stableNormalized(),
                        offset = point - cylinder.centres.row(0).transpose();
  const Eigen::VectorXd places = places_along_chord(cylinder);
  const double place = offset.dot(axis);
  Eigen::Index section = 0;
  while (section + 2 < places.size() && places(section + 1) <= place) ++section;
  const double length = places(section + 1) - places(section);
  if (!(length > 0)) return axis;
  const double slope = (cylinder.radii(section + 1) - cylinder.radii(section)) / length;
  return (axis + slope * (offset - place * axis).stableNormalized()).stableNormalized();
}

/// Returns whether a carrier was a member at rest, not a disc: edits change proportions less than that.
bool was_member(const GeneralizedCylinder& carrier) {
  return chord_of(carrier).norm() > disc_to_member * carrier.radii.mean();
}

/// Returns the distance of a point from the middle of a member along it, model units.
double distance_from_middle(const GeneralizedCylinder& member, const Eigen::Vector3d& point) {
  const Eigen::Vector3d middle =
      (member.centres.row(0) + member.centres.row(member.centres.rows() - 1)).transpose() / 2;
  return std::abs((point - middle).dot(chord_of(member).stableNormalized()));
}

/// Returns the distance of a point from the axis of a disc, model units.
double distance_from_axis(const GeneralizedCylinder& disc, const Eigen::Vector3d& point) {
  const Eigen::Vector3d axis = chord_of(disc).stableNormalized(),
                        offset = point - disc.centres.row(0).transpose();
  return (offset - offset.dot(axis) * axis).norm();
}

/// Returns a place that is nearer to the centre than the limit.
std::optional<double> place_within(double place, double limit) {
  return place < limit ? std::optional(place) : std::nullopt;
}

/// Returns how far from the middle of a wall of a hollow box the farthest joint point is, 1 at its border.
/// Nothing if they are at different walls, or not within one.
std::optional<double> sliding_place_on_wall(const Cuboid& hollow, const OrientedBox& box,
                                            const Points& points) {
  const int wall = wall_at(hollow, points.row(0).transpose());
  double farthest = 0;
  for (const auto point : points.rowwise()) {
    if (wall_at(hollow, point.transpose()) != wall) return std::nullopt;
    const Eigen::Array3d place =
        (box.axes.transpose() * (point.transpose() - box.centre)).array() / box.half_extents.array();
    if (place(wall / 2) * (wall % 2 == 0 ? -1 : 1) < hollow.inner_sides(wall / 2, wall % 2) - wall_margin)
      return std::nullopt;
    for (int axis = 0; axis < 3; ++axis)
      if (axis != wall / 2) farthest = std::max(farthest, std::abs(place(axis)));
  }
  return place_within(farthest, end_of_member);
}

/// Returns how far from the centre of the carrier the farthest joint point is, 1 at its rim or end. Nothing
/// if the joint cannot slide on it.
std::optional<double> sliding_place_on(const Primitive& carrier, const Points& points) {
  double farthest = 0;
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&carrier)) {
    const bool member = is_member(*cylinder) || is_vessel(*cylinder);
    if (!member && !is_disc(*cylinder)) return std::nullopt;
    const double reach = member ? chord_of(*cylinder).norm() / 2 : cylinder->radii.maxCoeff();
    for (const auto point : points.rowwise()) {
      const double distance = member ? distance_from_middle(*cylinder, point.transpose())
                                     : distance_from_axis(*cylinder, point.transpose());
      farthest = std::max(farthest, distance / reach);
    }
    return place_within(farthest, member ? end_of_member : rim);
  }
  const Cuboid& cuboid = std::get<Cuboid>(carrier);
  const OrientedBox box = nearest_box(cuboid);
  if (is_hollow(cuboid)) return sliding_place_on_wall(cuboid, box, points);
  const std::vector<int> axes = sliding_axes(mean_edges(cuboid));
  if (axes.empty()) return std::nullopt;
  for (const auto point : points.rowwise())
    for (const int axis : axes)
      farthest = std::max(farthest, std::abs((point.transpose() - box.centre).dot(box.axes.col(axis))) /
                                        box.half_extents(axis));
  return place_within(farthest, axes.size() == 1 ? end_of_member : rim);
}

}  // namespace

void let_joints_yield(Structure& structure) {
  for (Relation& relation : structure.relations) {
    if (!relation.is_joint()) continue;
    relation.slack = tolerance::joint_slack * structure.diagonal;
    double nearest = 1;
    for (const int part : relation.parts) {
      const auto place = sliding_place_on(structure.parts[at(part)].primitive, relation.points);
      if (!place || !(*place < nearest)) continue;
      nearest = *place;
      relation.carrier = part;
    }
  }
}

double distance_beyond(const Primitive& carrier, const Eigen::Vector3d& point) {
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&carrier)) {
    const double beyond = was_vessel(*cylinder) || was_member(*cylinder)
                              ? distance_from_middle(*cylinder, point) - chord_of(*cylinder).norm() / 2
                              : distance_from_axis(*cylinder, point) - cylinder->radii.maxCoeff();
    return std::max(0.0, beyond);
  }
  const Cuboid& cuboid = std::get<Cuboid>(carrier);
  std::vector<int> axes = is_hollow(cuboid) ? std::vector<int>{0, 1, 2} : sliding_axes(mean_edges(cuboid));
  if (is_hollow(cuboid)) axes.erase(axes.begin() + wall_at(cuboid, point) / 2);
  double farthest = 0;
  for (const int axis : axes)
    for (const int face : {2 * axis, 2 * axis + 1})
      farthest = std::max(farthest, normal_of(cuboid, face).dot(point - middle_of(cuboid, face)));
  return farthest;
}

Eigen::Matrix3d held_directions(const Primitive& carrier, const Eigen::Vector3d& point) {
  const Eigen::Matrix3d all = Eigen::Matrix3d::Identity();
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&carrier)) {
    if (cylinder->closed) return all;
    if (was_vessel(*cylinder)) {
      const Eigen::Vector3d along = generator_at(*cylinder, point);
      return all - along * along.transpose();
    }
    const Eigen::Vector3d axis = chord_of(*cylinder).stableNormalized();
    const Eigen::Matrix3d along = axis * axis.transpose();
    return was_member(*cylinder) ? Eigen::Matrix3d(all - along) : along;
  }
  const Cuboid& cuboid = std::get<Cuboid>(carrier);
  if (is_hollow(cuboid)) {
    const Eigen::Vector3d normal = normal_of(cuboid, wall_at(cuboid, point));
    return normal * normal.transpose();
  }
  const Eigen::Matrix3d edges = mean_edges(cuboid);
  const std::vector<int> axes = sliding_axes(edges);
  if (axes.empty()) return all;
  if (axes.size() == 1) {
    const Eigen::Vector3d along = edges.col(axes[0]).stableNormalized();
    return all - along * along.transpose();
  }
  const Eigen::Vector3d normal = edges.col(axes[0]).cross(edges.col(axes[1])).stableNormalized();
  return normal * normal.transpose();
}

}  // namespace stackabilization::detail
