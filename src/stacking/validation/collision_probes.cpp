#include "stackabilization/stacking/collision_probes.h"

#include <algorithm>

#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/exact_triangles.h"

namespace stackabilization {

namespace {

double width_across(const Shape& shape, const Direction& direction) {
  const Frame frame = frame_of(direction);
  return std::max(range_along(shape, frame.u).length(), range_along(shape, frame.v).length());
}

bool has_area(const Shape& shape, Eigen::Index t) {
  return !are_collinear(shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2));
}

}  // namespace

std::string to_string(ProbePlace place) {
  switch (place) {
    case ProbePlace::above:
      return "above";
    case ProbePlace::at:
      return "at";
    case ProbePlace::below:
      break;
  }
  return "below";
}

std::vector<CollisionProbe> collision_probes(const Shape& shape, const Direction& direction,
                                             const Separation& f_max, const CollisionProbeOptions& options) {
  if (!(options.margin > 0)) throw UsageError("the margin of collision tests must be positive");
  if (!f_max.blocked) return {};
  const double extent = range_along(shape, direction.unit()).length();
  const double size = extent > 0 ? extent : width_across(shape, direction);
  const Rational margin(options.margin * size / direction.length());
  const ContactSemantics semantics = options.semantics;
  std::vector<CollisionProbe> probes = {{ProbePlace::above, semantics, f_max.value + margin, false}};
  if (semantics == ContactSemantics::solid) {
    probes.push_back({ProbePlace::at, semantics, f_max.value, false});
    probes.push_back({ProbePlace::below, semantics, f_max.value - margin, true});
  } else if (has_area(shape, f_max.witness.lower_triangle) && has_area(shape, f_max.witness.upper_triangle)) {
    probes.push_back({ProbePlace::at, semantics, f_max.value, true});
  }
  return probes;
}

bool collides(const CollisionTester& tester, const Direction& direction, const CollisionProbe& probe) {
  return probe.semantics == ContactSemantics::solid ? tester.interiors_overlap(direction, probe.lift)
                                                    : tester.closed_contact(direction, probe.lift);
}

}  // namespace stackabilization
