#include "improvement/contacts/contact_handles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "deformation/model/straight_curve.h"
#include "stackabilization/structure/tolerances.h"

namespace stackabilization::detail {

namespace {

/// A contact is near a corner of a face if both of its face coordinates in [-1, 1] are at least this far from
/// 0.
constexpr double near_corner = 0.5;
/// A cuboid is a plate if it is thinner than this fraction of its other sides.
constexpr double plate_thickness = 0.25;
/// A bent part leans if it rises by at least this fraction of its size.
constexpr double min_rise = 0.25;

Eigen::Vector3d mean(const Points& points) {
  return points.colwise().mean().transpose();
}

Points rows(const Points& from, const std::array<int, 4>& which) {
  Points result(4, 3);
  for (int k = 0; k < 4; ++k) result.row(k) = from.row(which[static_cast<std::size_t>(k)]);
  return result;
}

ContactHandle face_of(const Cuboid& cuboid, int part, int face) {
  ContactHandle result;
  result.handle = {HandleKind::face, part, face};
  result.points = rows(cuboid.corners, cuboid_face(face));
  result.centre = mean(result.points);
  const Eigen::Vector3d a = (result.points.row(2) - result.points.row(0)).transpose(),
                        b = (result.points.row(3) - result.points.row(1)).transpose();
  result.normal = a.cross(b).normalized();
  return result;
}

ContactHandle section_of(const GeneralizedCylinder& cylinder, int part, int section) {
  ContactHandle result;
  result.handle = {HandleKind::section, part, section};
  result.centre = cylinder.centres.row(section).transpose();
  result.points = cylinder.centres.row(section);
  result.radius = cylinder.radii(section);
  result.normal = section_tangents(cylinder).row(section).transpose();
  return result;
}

int nearest_row(const Points& points, const Eigen::Vector3d& to) {
  Eigen::Index row = 0;
  (points.rowwise() - to.transpose()).rowwise().squaredNorm().minCoeff(&row);
  return static_cast<int>(row);
}

/// Coordinates along the axes of a cuboid, with the faces at -1 and 1. Exact for boxes.
struct CuboidFrame {
  Eigen::Vector3d centre;
  Eigen::Matrix3d halves;  ///< columns: from the centre to the centres of the positive faces

  explicit CuboidFrame(const Cuboid& cuboid) : centre(mean(cuboid.corners)) {
    for (int axis = 0; axis < 3; ++axis)
      halves.col(axis) = (mean(rows(cuboid.corners, cuboid_face(2 * axis + 1))) -
                          mean(rows(cuboid.corners, cuboid_face(2 * axis)))) /
                         2;
  }
  Eigen::Vector3d local(const Eigen::Vector3d& p) const {
    Eigen::Vector3d q;
    for (int axis = 0; axis < 3; ++axis)
      q(axis) = (p - centre).dot(halves.col(axis)) / halves.col(axis).squaredNorm();
    return q;
  }
  bool is_plate(int axis) const {
    const double thickness = halves.col(axis).norm();
    return thickness <
           plate_thickness * std::min(halves.col((axis + 1) % 3).norm(), halves.col((axis + 2) % 3).norm());
  }
  double distance_to_face(const Eigen::Vector3d& p, int face) const {
    Eigen::Vector3d on_face = local(p).cwiseMax(-1).cwiseMin(1);
    on_face(face / 2) = face % 2 == 0 ? -1 : 1;
    return (centre + halves * on_face - p).norm();
  }
};

void add_cuboid_handles(std::vector<ContactHandle>& handles, const Cuboid& cuboid, const ContactSide& side,
                        const ContactFrame& frame, EditFamily family) {
  const CuboidFrame box(cuboid);
  std::array<double, 6> distances{};
  for (int face = 0; face < 6; ++face)
    distances[static_cast<std::size_t>(face)] = box.distance_to_face(side.centre, face);
  const auto nearest =
      static_cast<int>(std::min_element(distances.begin(), distances.end()) - distances.begin());
  handles.push_back(face_of(cuboid, side.part, nearest));

  const Eigen::Vector3d at = box.local(side.centre);
  const int across = nearest / 2;
  if (family != EditFamily::paper && box.is_plate(across)) {
    handles.back().of_plate = true;
    for (const int axis : {(across + 1) % 3, (across + 2) % 3}) {
      handles.push_back(
          face_of(cuboid, side.part, 2 * axis + (at(axis) >= -tolerance::same_symmetry ? 1 : 0)));
      handles.back().role = ContactHandle::Role::end;
      handles.back().of_plate = true;
    }
    return;
  }
  if (std::abs(at((across + 1) % 3)) >= near_corner && std::abs(at((across + 2) % 3)) >= near_corner) {
    ContactHandle corner;
    const int row = nearest_row(cuboid.corners, side.centre);
    corner.handle = {HandleKind::corner, side.part, row};
    corner.points = cuboid.corners.row(row);
    corner.centre = corner.points.row(0).transpose();
    handles.push_back(corner);
  }
  if (family == EditFamily::paper) return;
  Eigen::Index upright = 0;
  (frame.w.transpose() * box.halves.colwise().normalized()).cwiseAbs().maxCoeff(&upright);
  for (const int face : {2 * static_cast<int>(upright), 2 * static_cast<int>(upright) + 1}) {
    if (face == nearest) continue;
    handles.push_back(face_of(cuboid, side.part, face));
    handles.back().role = ContactHandle::Role::end;
  }
}

/// Returns an end section whose edits have Falloff::linear: the end leans or widens, and straight lines stay
/// straight.
ContactHandle end_of(const GeneralizedCylinder& cylinder, int part, int section) {
  ContactHandle end = section_of(cylinder, part, section);
  end.falloff = Falloff::linear;
  return end;
}

/// Returns how far control points of a primitive are from their middle, at most, model units.
double reach_of(const Primitive& primitive) {
  const Points points = control_points(primitive);
  return (points.rowwise() - mean(points).transpose()).rowwise().norm().maxCoeff();
}

/// Returns whether a part has joints with larger ones in the half that is farther along `axis`, at rest:
/// a smaller one, as a rung between two legs, follows.
bool is_held(const Structure& rest, int part, const Eigen::Vector3d& axis) {
  const auto primitive = [&](int row) -> const Primitive& {
    return rest.parts[static_cast<std::size_t>(row)].primitive;
  };
  const Eigen::VectorXd heights = control_points(primitive(part)) * axis;
  const double middle = (heights.minCoeff() + heights.maxCoeff()) / 2, reach = reach_of(primitive(part));
  return std::any_of(rest.relations.begin(), rest.relations.end(), [&](const Relation& relation) {
    if (!relation.is_joint() || (relation.parts[0] != part && relation.parts[1] != part)) return false;
    const int other = relation.parts[0] == part ? relation.parts[1] : relation.parts[0];
    return (relation.points * axis).maxCoeff() > middle && reach_of(primitive(other)) >= reach;
  });
}

/// Returns the handle of a part that leans as a whole, with its end near the contact: a frame of bent tube.
/// None for a part that lies flat, or is held at that end (see `is_held`).
std::optional<ContactHandle> leaning_whole(const Structure& rest, const GeneralizedCylinder& cylinder,
                                           const ContactSide& side, const ContactFrame& frame) {
  const int nearest = nearest_row(cylinder.centres, side.centre);
  const Eigen::VectorXd heights = cylinder.centres * frame.w;
  const Range range{heights.minCoeff(), heights.maxCoeff()};
  const Points around = cylinder.centres.rowwise() - cylinder.centres.row(nearest);
  if (!(range.length() >= min_rise * around.rowwise().norm().maxCoeff())) return std::nullopt;
  const double share = (heights(nearest) - range.low) / range.length();
  const Eigen::Vector3d axis = share < 0.5 ? Eigen::Vector3d(-frame.w) : frame.w;
  if (is_held(rest, side.part, axis)) return std::nullopt;
  ContactHandle lean = section_of(cylinder, side.part, nearest);
  lean.handle = {HandleKind::part, side.part, 0};
  lean.role = ContactHandle::Role::whole;
  lean.lean_axis = axis;
  lean.lean_share = std::max(share, 1 - share);
  return lean;
}

/// `is_round_body`: see `round_body`. Its nearer end also moves along w where no other section may.
void add_cylinder_handles(std::vector<ContactHandle>& handles, const GeneralizedCylinder& cylinder,
                          bool is_round_body, const ContactSide& side, const ContactEditOptions& options) {
  int nearest = nearest_row(cylinder.centres, side.centre);
  const int last = static_cast<int>(cylinder.centres.rows()) - 1;
  const bool ring = side.region.type == ContactType::ring;
  const bool straight = ring ? has_straight_wall(cylinder) : is_straight(cylinder);
  const bool free = options.bends || cylinder.closed || !straight;
  if (options.family == EditFamily::paper || cylinder.closed) {
    handles.push_back(free ? section_of(cylinder, side.part, nearest)
                           : end_of(cylinder, side.part, 2 * nearest <= last ? 0 : last));
    return;
  }
  const bool at_end = nearest == 0 || nearest == last;
  if (free && (ring || options.bends || !at_end)) handles.push_back(section_of(cylinder, side.part, nearest));
  if (is_round_body && options.family == EditFamily::smooth) nearest = 2 * nearest <= last ? 0 : last;
  for (const int end : {0, last}) {
    handles.push_back(end_of(cylinder, side.part, end));
    handles.back().role = end == nearest ? ContactHandle::Role::nearest : ContactHandle::Role::end;
  }
  std::stable_sort(handles.begin(), handles.end(),
                   [](const ContactHandle& a, const ContactHandle& b) { return a.role < b.role; });
}

/// Returns where the contact lies on the shape at rest. Models that do not edit primitives know their handles
/// at rest only.
Eigen::Vector3d centre_at_rest(const ContactSituation& situation, const ContactSide& side) {
  const Shape &now = situation.design.shape, &rest = situation.rest.shape;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (const ContactPolygon& polygon : side.region.polygons) {
    const std::int32_t triangle = side.of_lower_copy ? polygon.upper_triangle : polygon.lower_triangle;
    for (int k = 0; k < 3; ++k) shift += rest.corner(triangle, k) - now.corner(triangle, k);
  }
  return side.centre + shift / std::max(1.0, 3.0 * static_cast<double>(side.region.polygons.size()));
}

/// Returns the nearest point, wire and slice.
std::vector<ContactHandle> surface_handles(const ContactSituation& situation, const ContactSide& side) {
  const Eigen::Vector3d target = centre_at_rest(situation, side);
  std::vector<ContactHandle> result;
  for (const HandleKind kind : {HandleKind::point, HandleKind::wire, HandleKind::section}) {
    double least = std::numeric_limits<double>::infinity();
    ContactHandle best;
    for (std::size_t h = 0; h < situation.handles.size(); ++h) {
      const Handle& handle = situation.handles[h];
      if (handle.kind != kind || (kind != HandleKind::point && h >= situation.centres.size())) continue;
      const Eigen::Vector3d centre =
          kind == HandleKind::point
              ? Eigen::Vector3d(situation.rest.shape.vertices.row(handle.index).transpose())
              : situation.centres[h];
      const double distance = (centre - target).norm();
      if (!(distance < least)) continue;
      least = distance;
      best.handle = handle;
    }
    if (!std::isfinite(least)) continue;
    best.centre = side.centre;
    best.points = side.centre.transpose();
    result.push_back(best);
  }
  return result;
}

/// Returns the larger of the widths of a primitive along u and along v, model units.
double width_of(const Primitive& primitive, const ContactFrame& frame) {
  const Points points = control_points(primitive);
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive);
  double width = 0;
  for (const Eigen::Vector3d& axis : {frame.u, frame.v}) {
    const Eigen::VectorXd places = points * axis;
    width = std::max(width, places.maxCoeff() - places.minCoeff());
  }
  return width + (cylinder ? 2 * cylinder->radii.maxCoeff() : 0);
}

}  // namespace

Points part_points(const Shape& shape, int part) {
  const auto& of = shape.triangle_part;
  Points points(3 * std::count(of.begin(), of.end(), part), 3);
  Eigen::Index row = 0;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    if (of[static_cast<std::size_t>(t)] != part) continue;
    for (int k = 0; k < 3; ++k) points.row(row++) = shape.vertices.row(shape.triangles(t, k));
  }
  return points;
}

Range ContactHandle::range(const Eigen::Vector3d& axis) const {
  const Eigen::VectorXd heights = points * axis;
  const double cosine = normal.dot(axis);
  const double reach = radius * std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return {heights.minCoeff() - reach, heights.maxCoeff() + reach};
}

std::vector<ContactHandle> contact_handles(const ContactSituation& situation, const ContactSide& side,
                                           const ContactFrame& frame, const ContactEditOptions& options) {
  if (!situation.capabilities.edits_primitives) return surface_handles(situation, side);
  std::vector<ContactHandle> handles;
  const Primitive& primitive = situation.design.primitives[static_cast<std::size_t>(side.part)];
  if (const auto* cuboid = std::get_if<Cuboid>(&primitive))
    add_cuboid_handles(handles, *cuboid, side, frame, options.family);
  else
    add_cylinder_handles(handles, std::get<GeneralizedCylinder>(primitive),
                         round_body(situation.design.primitives, frame) == side.part, side, options);
  if (options.family == EditFamily::paper) return handles;
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive);
  if (options.family == EditFamily::smooth && cylinder && !is_straight(*cylinder))
    if (auto lean = leaning_whole(situation.rest.structure, *cylinder, side, frame))
      handles.push_back(std::move(*lean));
  ContactHandle whole;
  whole.handle = {HandleKind::part, side.part, 0};
  whole.role = ContactHandle::Role::whole;
  whole.points = part_points(situation.design.shape, side.part);
  whole.centre = mean(control_points(primitive));
  handles.push_back(whole);
  return handles;
}

int round_body(const std::vector<Primitive>& primitives, const ContactFrame& frame) {
  const auto widest = std::max_element(
      primitives.begin(), primitives.end(),
      [&](const Primitive& a, const Primitive& b) { return width_of(a, frame) < width_of(b, frame); });
  if (widest == primitives.end()) return -1;
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&*widest);
  const bool round = cylinder && !cylinder->closed && is_straight(*cylinder) &&
                     std::abs(chord_of(*cylinder).normalized().dot(frame.w)) >= tolerance::parallel;
  return round ? static_cast<int>(widest - primitives.begin()) : -1;
}

std::vector<Edit> tapers(const ContactFrame& frame, const std::vector<Primitive>& primitives, double factor) {
  std::vector<std::optional<Eigen::Vector3d>> widths = {std::nullopt};
  if (round_body(primitives, frame) < 0) widths.insert(widths.end(), {frame.u, frame.v});
  std::vector<Edit> edits;
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(-frame.w), frame.w})
    for (const std::optional<Eigen::Vector3d>& along : widths)
      edits.push_back({{HandleKind::shape, 0, 0}, Taper{factor, axis, along}});
  return edits;
}

}  // namespace stackabilization::detail
