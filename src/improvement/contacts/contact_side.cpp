#include "improvement/contacts/contact_side.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stackabilization/mesh/boxes.h"
#include "stackabilization/structure/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Two directions are the same if their cosine is at least this.
constexpr double one_way = 0.998;
/// A move is outwards if its cosine to the radial direction is above this.
constexpr double clearly = 0.1;

/// Returns the normal of the first mirror plane that contains `w`, of the whole shape or of its parts.
std::optional<Eigen::Vector3d> mirror_normal(const Structure& structure, const Eigen::Vector3d& w) {
  std::vector<Symmetry> symmetries = structure.symmetries;
  for (const Relation& relation : structure.relations)
    if (relation.type == RelationType::symmetry || relation.type == RelationType::self_symmetry)
      symmetries.push_back(relation.symmetry);
  for (const Symmetry& one : symmetries)
    if (one.kind == SymmetryKind::reflection && std::abs(one.axis.dot(w)) <= tolerance::same_symmetry)
      return one.axis;
  return std::nullopt;
}

/// Returns the interval that the polygons of a side cover along `axis`.
Range range_of(const ContactSide& side, const Eigen::Vector3d& axis) {
  const double middle = side.centre.dot(axis);
  Range range{middle, middle};
  for (const ContactPolygon& polygon : side.region.polygons) {
    const Eigen::VectorXd heights = (side.of_lower_copy ? polygon.upper_points : polygon.lower_points) * axis;
    range = {std::min(range.low, heights.minCoeff()), std::max(range.high, heights.maxCoeff())};
  }
  return range;
}

}  // namespace

ContactFrame contact_frame(const ContactSituation& situation, double band) {
  ContactFrame frame;
  frame.w = situation.direction.unit();
  const Shape& shape = situation.design.shape;
  if (const auto normal = mirror_normal(situation.rest.structure, frame.w)) {
    frame.u = (*normal - normal->dot(frame.w) * frame.w).normalized();
  } else {
    const OrientedBox box = HullSupport(shape).box_along(situation.direction);
    Eigen::Index along = 0;
    (frame.w.transpose() * box.axes).cwiseAbs().maxCoeff(&along);
    frame.u = box.axes.col((along + 1) % 3);
  }
  frame.v = frame.w.cross(frame.u);
  frame.height = range_along(shape, frame.w);
  frame.band = band * frame.height.length();
  frame.centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& axis : {frame.u, frame.v, frame.w}) {
    const Range range = range_along(shape, axis);
    frame.centre += (range.low + range.high) / 2 * axis;
  }
  return frame;
}

std::vector<ContactSide> contact_sides(const ContactSituation& situation, int row,
                                       const ContactFrame& frame) {
  const ContactRegion& region = situation.regions[static_cast<std::size_t>(row)];
  std::vector<ContactSide> sides = {
      {region, row, true, region.upper_part, region.lower_part, region.upper_centre},
      {region, row, false, region.lower_part, region.upper_part, region.lower_centre}};
  for (ContactSide& side : sides) side.on_end = frame.on_end(range_of(side, frame.w));
  return sides;
}

std::vector<ContactWay> ways_out(const ContactSide& side, const ContactFrame& frame, double near) {
  Eigen::Vector3d radial = side.centre - frame.centre;
  radial -= radial.dot(frame.w) * frame.w;
  const bool off_axis = radial.norm() > near;
  if (off_axis) radial.normalize();
  std::vector<Eigen::Vector3d> axes = {frame.u, frame.v};
  if (side.region.type == ContactType::line)
    axes = {frame.w.cross(side.region.long_axis).normalized()};
  else if (off_axis && std::max(std::abs(radial.dot(frame.u)), std::abs(radial.dot(frame.v))) < one_way)
    axes.insert(axes.begin(), radial);
  std::vector<ContactWay> ways;
  for (const Eigen::Vector3d& axis : axes)
    for (const double sign : {1.0, -1.0}) {
      const double outwards = off_axis ? sign * axis.dot(radial) : 0;
      ways.push_back({sign * axis, outwards > clearly    ? EditEffect::outwards
                                   : outwards < -clearly ? EditEffect::inwards
                                                         : EditEffect::sideways});
    }
  return ways;
}

}  // namespace stackabilization::detail
