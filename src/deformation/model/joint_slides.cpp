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
/// Nor is a joint at the end of a slender member when it is more than so many half widths of the member from
/// it, as a stretcher a hand above the feet.
constexpr double half_widths_from_end = 3;

/// Returns the fraction of the way from the middle of a member beyond which a joint is at its end.
double end_of(double half_length, double half_width) {
  return std::max(end_of_member, 1 - half_widths_from_end * half_width / half_length);
}

/// A part is flush with the side of a plate where its joint is at most so many halves of its thickness from
/// it.
constexpr double flush = 1.05;

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

constexpr std::array<bool, 3> every_way = {true, true, true}, no_way = {false, false, false};

/// How a joint point slides on a carrier.
struct Slide {
  std::array<bool, 3> ways = no_way;  ///< see Relation::sliding
  int freedom = 0;   ///< 2 along all ways of the carrier, 1 along an edge of it, 0 not at all
  double place = 1;  ///< farthest along the ways: 0 in the middle of the carrier, 1 at its rim
};

Slide slide_within(double place, double limit) {
  if (!(place < limit)) return {};
  return {every_way, 2, place};
}

/// What is joined to a carrier.
struct Joined {
  double half = 0;  ///< of its thickness: of its thinnest side, or the mean radius
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< unit direction of a line joint; 0 of a point joint
};

double half_thickness(const Primitive& part) {
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&part)) return cylinder->radii.mean();
  return nearest_box(std::get<Cuboid>(part)).half_extents.minCoeff();
}

/// Returns along which of the ways a point slides: where its place, 1 at the side of the box, is within the
/// limit, and the part that is joined there is not flush with the side, across a line joint. Where a point on
/// a plate does not slide along both ways, it is at an edge, and slides along the edge if it is not at a
/// corner: within the thickness of the plate from the other edge too.
Slide slide_along(const std::array<bool, 3>& ways, const OrientedBox& box, const Eigen::Vector3d& point,
                  const Joined& joined, double limit) {
  const Eigen::Array3d place =
      (box.axes.transpose() * (point - box.centre)).array() / box.half_extents.array();
  const Eigen::Array3d to_side = (1 - place.abs()) * box.half_extents.array();
  const double thickness = 2 * box.half_extents.minCoeff();
  const auto is_away = [&](int axis) {
    const bool lies_along = std::abs(box.axes.col(axis).dot(joined.along)) > std::sqrt(0.5);
    return std::abs(place(axis)) < limit && (lies_along || to_side(axis) > flush * joined.half);
  };
  bool everywhere = true;
  for (int axis = 0; axis < 3; ++axis) everywhere = everywhere && (!ways[at(axis)] || is_away(axis));
  Slide slide{no_way, 0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    if (!ways[at(axis)] || !is_away(axis) || !(everywhere || to_side(axis) > thickness)) continue;
    slide.ways[at(axis)] = true;
    slide.freedom = everywhere ? 2 : 1;
    slide.place = std::max(slide.place, std::abs(place(axis)));
  }
  return slide;
}

/// Returns how a point slides on a carrier: not where it is at the rim of a plate, near the end of a member
/// or the border of a wall, or flush.
Slide slide_on(const Primitive& carrier, const Eigen::Vector3d& point, const Joined& joined) {
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&carrier)) {
    if (is_member(*cylinder) || is_vessel(*cylinder)) {
      const double half_length = chord_of(*cylinder).norm() / 2;
      return slide_within(distance_from_middle(*cylinder, point) / half_length,
                          end_of(half_length, cylinder->radii.maxCoeff()));
    }
    if (!is_disc(*cylinder)) return {};
    const double reach = cylinder->radii.maxCoeff();
    const double distance = distance_from_axis(*cylinder, point);
    return slide_within(reach - distance > flush * joined.half ? distance / reach : 1, rim);
  }
  const Cuboid& cuboid = std::get<Cuboid>(carrier);
  const OrientedBox box = nearest_box(cuboid);
  const std::array<bool, 3> ways = sliding_ways(cuboid, point);
  if (is_hollow(cuboid)) {
    const int wall = wall_at(cuboid, point), axis = wall / 2;
    const double outwards = (wall % 2 == 0 ? -1 : 1) * box.axes.col(axis).dot(point - box.centre);
    if (outwards < (cuboid.inner_sides(axis, wall % 2) - wall_margin) * box.half_extents(axis)) return {};
    return slide_along(ways, box, point, joined, end_of_member);
  }
  if (std::count(ways.begin(), ways.end(), true) != 1) return slide_along(ways, box, point, joined, rim);
  Eigen::Vector3d halves = box.half_extents;
  std::sort(halves.data(), halves.data() + 3);
  return slide_along(ways, box, point, joined, end_of(halves(2), halves(1)));
}

/// How the points of a joint slide on a part.
struct JointSlide {
  std::vector<std::array<bool, 3>> points;
  int freedom = 0;      ///< of all points
  double farthest = 0;  ///< place of a point that slides
};

JointSlide joint_slide(const Primitive& carrier, const Primitive& other, const Points& points) {
  JointSlide joint;
  const Joined joined = {half_thickness(other),
                         (points.row(points.rows() - 1) - points.row(0)).transpose().stableNormalized()};
  for (const auto point : points.rowwise()) {
    const Slide slide = slide_on(carrier, point.transpose(), joined);
    joint.points.push_back(slide.ways);
    joint.freedom += slide.freedom;
    if (slide.freedom > 0) joint.farthest = std::max(joint.farthest, slide.place);
  }
  return joint;
}

}  // namespace

std::array<bool, 3> sliding_ways(const Primitive& carrier, const Eigen::Vector3d& point) {
  const auto* cuboid = std::get_if<Cuboid>(&carrier);
  if (!cuboid) return every_way;
  if (is_hollow(*cuboid)) {
    std::array<bool, 3> ways = every_way;
    ways[at(wall_at(*cuboid, point) / 2)] = false;
    return ways;
  }
  std::array<bool, 3> ways = no_way;
  for (const int axis : sliding_axes(mean_edges(*cuboid))) ways[at(axis)] = true;
  return ways;
}

void let_joints_yield(Structure& structure) {
  for (Relation& relation : structure.relations) {
    if (!relation.is_joint()) continue;
    relation.slack = tolerance::joint_slack * structure.diagonal;
    relation.carrier = -1;
    relation.sliding.clear();
    JointSlide freest;
    for (const int part : relation.parts) {
      const int other = relation.parts.front() + relation.parts.back() - part;
      JointSlide slide = joint_slide(structure.parts[at(part)].primitive,
                                     structure.parts[at(other)].primitive, relation.points);
      const bool freer =
          slide.freedom != freest.freedom ? slide.freedom > freest.freedom : slide.farthest < freest.farthest;
      if (!freer) continue;
      freest = std::move(slide);
      relation.carrier = part;
    }
    if (freest.freedom > 0) relation.sliding = std::move(freest.points);
  }
}

double distance_beyond(const Primitive& carrier, const Eigen::Vector3d& point,
                       const std::array<bool, 3>& ways) {
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&carrier)) {
    const double beyond = was_vessel(*cylinder) || was_member(*cylinder)
                              ? distance_from_middle(*cylinder, point) - chord_of(*cylinder).norm() / 2
                              : distance_from_axis(*cylinder, point) - cylinder->radii.maxCoeff();
    return std::max(0.0, beyond);
  }
  const Cuboid& cuboid = std::get<Cuboid>(carrier);
  double farthest = 0;
  for (int face = 0; face < 6; ++face)
    if (ways[at(face / 2)])
      farthest = std::max(farthest, normal_of(cuboid, face).dot(point - middle_of(cuboid, face)));
  return farthest;
}

Eigen::Matrix3d held_directions(const Primitive& carrier, const Eigen::Vector3d& point,
                                const std::array<bool, 3>& ways) {
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
  const Eigen::Matrix3d edges = mean_edges(cuboid);
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis)
    if (ways[at(axis)]) axes.push_back(axis);
  if (axes.size() == 1) {
    const Eigen::Vector3d along = edges.col(axes[0]).stableNormalized();
    return all - along * along.transpose();
  }
  if (axes.size() != 2) return all;
  const Eigen::Vector3d normal = is_hollow(cuboid)
                                     ? normal_of(cuboid, wall_at(cuboid, point))
                                     : edges.col(axes[0]).cross(edges.col(axes[1])).stableNormalized();
  return normal * normal.transpose();
}

}  // namespace stackabilization::detail
