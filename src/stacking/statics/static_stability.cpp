#include "stackabilization/stacking/static_stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "core/angles.h"
#include "mesh/affine_span.h"
#include "mesh/planar.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/stacking/tolerances.h"
#include "stacking/statics/contact_forces.h"
#include "stacking/statics/contact_holds.h"
#include "stacking/statics/copy_joint.h"
#include "stacking/statics/mass_centre.h"

namespace stackabilization {

namespace {

/// The first coefficient of friction that is tried.
constexpr double first_friction = 0.01;
/// More friction than there is.
constexpr double max_friction = 1000;

/// Convex hull of the support of a copy, in a frame that is upright: counter-clockwise corners, one or two
/// when it is a point or a line.
using Support = std::vector<Eigen::Vector3d>;

class StaticStabilityTest {
 public:
  StaticStabilityTest(const Shape& shape, const Direction& direction, const StaticStabilityOptions& options)
      : shape_(shape),
        direction_(direction),
        options_(options),
        frame_(frame_of(options.up ? Direction(*options.up) : direction)) {
    for (const Eigen::Vector3d& axis : {frame_.u, frame_.v, frame_.w})
      negligible_ = std::hypot(negligible_, range_along(shape, axis).length());
    negligible_ *= tolerance::relative;
  }

  StaticStability run() const;
  double needed_friction() const;

 private:
  using Regions = std::vector<ContactRegion>;

  detail::CopyJoint joint() const {
    return detail::copy_joint(shape_, direction_, options_.semantics, options_.band);
  }
  std::vector<detail::Hold> holds_of(const detail::CopyJoint& joint) const;
  std::set<int> extreme_copies() const;
  /// Returns the way from each copy to the next, in the upright frame.
  Eigen::Vector3d step_of(const detail::CopyJoint& joint) const {
    return joint.lift * frame_.to_local(direction_.unit());
  }
  Eigen::Vector3d mass_above(int copy, const Eigen::Vector3d& centre, const detail::CopyJoint& joint) const;
  Support support_of(const std::vector<Eigen::Vector3d>& points) const;
  Support ground() const;
  Support support_of(const Regions& regions) const;
  double tilt(const Support& support, const Eigen::Vector3d& mass) const;

  const Shape& shape_;
  const Direction& direction_;
  const StaticStabilityOptions& options_;
  Frame frame_;
  double negligible_ = 0;  ///< lengths below are 0
};

Support StaticStabilityTest::support_of(const std::vector<Eigen::Vector3d>& points) const {
  Points seen(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k)
    seen.row(static_cast<Eigen::Index>(k)) << points[k].x(), points[k].y(), 0;
  const AffineSpan span = affine_span(seen, negligible_);
  if (span.dimension < 2) {  // only what lies at the ends carries
    const Eigen::VectorXd along = seen * span.axis;
    Eigen::Index low = 0, high = 0;
    along.minCoeff(&low);
    along.maxCoeff(&high);
    if (span.dimension == 0) return {points[0]};
    return {points[static_cast<std::size_t>(low)], points[static_cast<std::size_t>(high)]};
  }
  Support support;
  for (const int corner : convex_polygon(seen.leftCols<2>().transpose(), negligible_))
    support.push_back(points[static_cast<std::size_t>(corner)]);
  return support;
}

Support StaticStabilityTest::ground() const {
  const Range heights = range_along(shape_, frame_.w);
  const double highest = heights.low + options_.band * heights.length();
  std::vector<Eigen::Vector3d> points;
  for (Eigen::Index t = 0; t < shape_.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d point = frame_.to_local(shape_.corner(t, k));
      if (point.z() <= highest) points.push_back(point);
    }
  return support_of(points);
}

/// Support of the copy above, in the coordinates of the copy below.
Support StaticStabilityTest::support_of(const Regions& regions) const {
  std::vector<Eigen::Vector3d> points;
  for (const ContactRegion& region : regions)
    for (const ContactPolygon& polygon : region.polygons)
      for (Eigen::Index k = 0; k < polygon.upper_points.rows(); ++k)
        points.push_back(frame_.to_local(polygon.upper_points.row(k).transpose()));
  return support_of(points);
}

/// Returns the tipping angle of a mass over the border of its support, radians.
double StaticStabilityTest::tilt(const Support& support, const Eigen::Vector3d& mass) const {
  const bool has_area = support.size() > 2;
  double least = std::numbers::pi / 2;
  for (std::size_t k = 0; k < support.size(); ++k) {
    const Eigen::Vector3d &from = support[k], &to = support[(k + 1) % support.size()];
    const Eigen::Vector2d side = (to - from).head<2>(), offset = (mass - from).head<2>();
    double along = side.norm() > 0 ? offset.dot(side) / side.squaredNorm() : 0;
    if (!has_area) along = std::clamp(along, 0.0, 1.0);
    const double distance = has_area ? cross(side, offset) / side.norm() : -(offset - along * side).norm();
    const double height = mass.z() - (from.z() + along * (to - from).z());
    least =
        std::min(least, std::abs(distance) <= negligible_ ? 0 : std::atan2(distance, std::max(height, 0.0)));
  }
  return least;
}

std::vector<detail::Hold> StaticStabilityTest::holds_of(const detail::CopyJoint& joint) const {
  return detail::holds_in(frame_, detail::spread_out(detail::contact_holds(shape_, direction_, joint.regions),
                                                     detail::hold_count));
}

/// Returns the copies that are first to topple or slide. Copies 1 ... n-1 have the same support, with fewer
/// copies above them upwards: the extreme tilts are those of the first and the last, since what holds for two
/// centres of mass holds between them.
std::set<int> StaticStabilityTest::extreme_copies() const {
  return {1, options_.copies - 1};
}

/// Returns the centre of mass of a copy and those above it, in the coordinates of the copy below.
Eigen::Vector3d StaticStabilityTest::mass_above(int copy, const Eigen::Vector3d& centre,
                                                const detail::CopyJoint& joint) const {
  return centre + (1.0 + options_.copies - copy) / 2 * step_of(joint);
}

StaticStability StaticStabilityTest::run() const {
  const detail::MassCentre mass = detail::mass_centre(shape_);
  StaticStability result;
  result.centre_of_mass = mass.centre;
  result.of_solid = mass.of_solid;
  const Eigen::Vector3d centre = frame_.to_local(mass.centre);
  double least = 0;
  if (options_.copies == 1) {
    least = tilt(ground(), centre);
  } else {
    const detail::CopyJoint joint = this->joint();
    least = tilt(ground(), centre + (options_.copies - 1.0) / 2 * step_of(joint));
    const Support support = support_of(joint.regions);
    const std::vector<detail::Hold> holds = options_.friction ? holds_of(joint) : std::vector<detail::Hold>();
    for (const int copy : extreme_copies()) {
      const Eigen::Vector3d above = mass_above(copy, centre, joint);
      const double over_contacts =
          options_.friction ? std::atan(detail::ContactForces(holds, *options_.friction, above).tilt_margin())
                            : tilt(support, above);
      if (over_contacts >= least) continue;
      least = over_contacts;
      result.weakest_copy = copy;
    }
  }
  result.tipping_degrees = least * 180 / std::numbers::pi;
  result.stands = least > 0;
  return result;
}

double StaticStabilityTest::needed_friction() const {
  if (options_.copies == 1) return 0;
  const Eigen::Vector3d centre = frame_.to_local(detail::mass_centre(shape_).centre);
  const detail::CopyJoint joint = this->joint();
  const std::vector<detail::Hold> holds = holds_of(joint);
  const auto held = [&](double friction) {
    const std::set<int> copies = extreme_copies();
    return std::all_of(copies.begin(), copies.end(), [&](int copy) {
      return detail::ContactForces(holds, friction, mass_above(copy, centre, joint)).balance();
    });
  };
  if (held(tolerance::friction)) return 0;
  double low = tolerance::friction, high = first_friction;
  while (!held(high)) {
    low = high;
    high *= 2;
    if (high > max_friction) return std::numeric_limits<double>::infinity();
  }
  while (high - low > tolerance::needed_friction * high) {
    const double middle = (low + high) / 2;
    (held(middle) ? high : low) = middle;
  }
  return high;
}

/// Throws UsageError for options out of range, InputError for a shape that is none.
void check(const Shape& shape, const Direction& direction, const StaticStabilityOptions& options) {
  if (options.copies < 1) throw UsageError("a stack needs at least one copy");
  detail::check_statics(options.band, options.friction, options.up, direction);
  validate(shape);
}

}  // namespace

std::optional<Eigen::Vector3d> up_of_stack(const Direction& direction) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (detail::angle_between(direction.vector(), up) > tolerance::max_stack_lean) return std::nullopt;
  return up;
}

StaticStability static_stability(const Shape& shape, const Direction& direction,
                                 const StaticStabilityOptions& options) {
  check(shape, direction, options);
  return StaticStabilityTest(shape, direction, options).run();
}

double needed_friction(const Shape& shape, const Direction& direction,
                       const StaticStabilityOptions& options) {
  check(shape, direction, options);
  return StaticStabilityTest(shape, direction, options).needed_friction();
}

}  // namespace stackabilization
