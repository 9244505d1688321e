#include "improvement/explanation/part_nouns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "core/index.h"

namespace stackabilization::detail {

namespace {

/// Cosine of the angle to the vertical within which the axis of a body is upright.
constexpr double upright_axis = 0.9;
/// Least share of the surface in the body.
constexpr double body_share = 0.5;
/// Height from which on a part is off the ground, fraction of that of the object.
constexpr double off_ground = 0.02;
/// Least number of legs of an object: one or two uprights are a post, or the sides of a shelf.
constexpr std::size_t min_legs = 3;

/// Returns the body of the object; -1: none.
int body_of(const StructuredShape& rest, const std::vector<PartAtRest>& parts, const ObjectFrame& frame) {
  double total = 0;
  for (const PartAtRest& part : parts) total += part.area;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto* cylinder = std::get_if<GeneralizedCylinder>(&rest.structure.parts[p].primitive);
    if (!cylinder || cylinder->closed || parts.size() == 1 || !(parts[p].area >= body_share * total))
      continue;
    const Eigen::Vector3d chord =
        (cylinder->centres.bottomRows<1>() - cylinder->centres.topRows<1>()).transpose();
    const bool upright = std::abs(chord.stableNormalized().dot(frame.up)) >= upright_axis;
    if (upright && form_noun(parts[p], frame) == "part") return static_cast<int>(p);
  }
  return -1;
}

/// Returns whether a part is joined to `body` alone, at two places or more.
bool hangs_on(int part, int body, const Structure& structure) {
  int joints = 0;
  for (const Relation& relation : structure.relations) {
    if (!relation.is_joint() || (relation.parts[0] != part && relation.parts[1] != part)) continue;
    const int other = relation.parts[0] == part ? relation.parts[1] : relation.parts[0];
    if (other != body) return false;
    joints += static_cast<int>(relation.points.rows());
  }
  return joints >= 2;
}

/// Returns whether all of a part is above the ground.
bool is_off_ground(const StructuredShape& rest, const PartAtRest& part, const ObjectFrame& frame) {
  const double ground = frame.ground + off_ground * frame.height;
  return std::all_of(part.triangles.begin(), part.triangles.end(), [&](std::int32_t t) {
    return rest.shape.corner(t, 0).dot(frame.up) >= ground &&
           rest.shape.corner(t, 1).dot(frame.up) >= ground && rest.shape.corner(t, 2).dot(frame.up) >= ground;
  });
}

/// Returns whether the body passes through a part as through a ring.
bool goes_around(const StructuredShape& rest, const PartAtRest& part, const ObjectFrame& frame, int body) {
  const auto& cylinder = std::get<GeneralizedCylinder>(rest.structure.parts[at(body)].primitive);
  const Eigen::Vector3d centre = cylinder.centres.colwise().mean().transpose();
  const Eigen::Vector3d u = frame.up.unitOrthogonal(), v = frame.up.cross(u);
  Eigen::AlignedBox2d box;
  for (const std::int32_t t : part.triangles)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d corner = rest.shape.corner(t, k) - centre;
      box.extend(Eigen::Vector2d(corner.dot(u), corner.dot(v)));
    }
  return (box.min().array() < 0).all() && (box.max().array() > 0).all();
}

}  // namespace

std::vector<std::string> part_nouns(const StructuredShape& rest, const std::vector<PartAtRest>& parts,
                                    const ObjectFrame& frame) {
  const int body = body_of(rest, parts, frame);
  std::vector<std::string> nouns;
  std::vector<std::size_t> legs;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto part = static_cast<int>(p);
    const bool handle = body >= 0 && part != body && hangs_on(part, body, rest.structure) &&
                        is_off_ground(rest, parts[p], frame) && !goes_around(rest, parts[p], frame, body);
    nouns.push_back(part == body ? "body" : handle ? "handle" : form_noun(parts[p], frame));
    if (nouns.back() == "upright" && !is_off_ground(rest, parts[p], frame)) legs.push_back(p);
  }
  if (legs.size() >= min_legs)
    for (const std::size_t leg : legs) nouns[leg] = "leg";
  return nouns;
}

}  // namespace stackabilization::detail
