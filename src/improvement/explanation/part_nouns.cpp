#include "improvement/explanation/part_nouns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "core/index.h"

namespace stackabilization::detail {

namespace {

/// Cosine of the angle to the vertical within which the axis of a body is upright.
constexpr double upright_axis = 0.9;
/// Least share of the surface in the body.
constexpr double body_share = 0.5;
/// Least height of a handle above the ground, fraction of that of the object.
constexpr double off_ground = 0.02;

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

/// Returns whether all of a part is above the ground, and the body does not pass through it as through a
/// ring.
bool sticks_out(const StructuredShape& rest, const PartAtRest& part, const ObjectFrame& frame, int body) {
  const auto& cylinder = std::get<GeneralizedCylinder>(rest.structure.parts[at(body)].primitive);
  const Eigen::Vector3d centre = cylinder.centres.colwise().mean().transpose();
  const Eigen::Vector3d u = frame.up.unitOrthogonal(), v = frame.up.cross(u);
  double lowest = std::numeric_limits<double>::infinity();
  Eigen::Vector2d low(lowest, lowest), high(-lowest, -lowest);
  for (const std::int32_t t : part.triangles)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d corner = rest.shape.corner(t, k);
      lowest = std::min(lowest, corner.dot(frame.up));
      const Eigen::Vector2d place((corner - centre).dot(u), (corner - centre).dot(v));
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
  const bool around = (low.array() < 0).all() && (high.array() > 0).all();
  return lowest >= frame.ground + off_ground * frame.height && !around;
}

}  // namespace

std::vector<std::string> part_nouns(const StructuredShape& rest, const std::vector<PartAtRest>& parts,
                                    const ObjectFrame& frame) {
  const int body = body_of(rest, parts, frame);
  std::vector<std::string> nouns;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto part = static_cast<int>(p);
    const bool handle = body >= 0 && part != body && hangs_on(part, body, rest.structure) &&
                        sticks_out(rest, parts[p], frame, body);
    nouns.push_back(part == body ? "body" : handle ? "handle" : form_noun(parts[p], frame));
  }
  return nouns;
}

}  // namespace stackabilization::detail
