#include "stackabilization/stacking/static_stability.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/affine_span.h"
#include "mesh/planar.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/envelope/contacts.h"
#include "stacking/stacks/mass_centre.h"

namespace stackabilization {

namespace {

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

 private:
  Support support_of(const std::vector<Eigen::Vector3d>& points) const;
  Support ground() const;
  Support contacts(const SeparationTree& tree, const Separation& separation) const;
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
Support StaticStabilityTest::contacts(const SeparationTree& tree, const Separation& separation) const {
  const ContactOptions options{.semantics = options_.semantics, .band = options_.band};
  std::vector<Eigen::Vector3d> points;
  for (const ContactRegion& region : contact_regions({shape_, tree, direction_, separation}, options).regions)
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
    const SeparationTree tree(shape_);
    const Separation separation =
        stackabilization::separation(tree, tree, direction_, {options_.semantics, std::nullopt});
    if (!separation.blocked)
      throw InputError("copies of the shape pass each other along the direction, so none rests on another");
    const Eigen::Vector3d step = separation.length * frame_.to_local(direction_.unit());
    least = tilt(ground(), centre + (options_.copies - 1.0) / 2 * step);
    const Support support = contacts(tree, separation);
    // Copies 1 ... n-1 have the same support, with fewer copies above them upwards: the extreme tilts are
    // those of the first and the last.
    for (const int copy : {1, options_.copies - 1}) {
      const double over_contacts = tilt(support, centre + (1.0 + options_.copies - copy) / 2 * step);
      if (over_contacts < least) {
        least = over_contacts;
        result.weakest_copy = copy;
      }
    }
  }
  result.tipping_degrees = least * 180 / std::numbers::pi;
  result.stands = least > 0;
  return result;
}

}  // namespace

StaticStability static_stability(const Shape& shape, const Direction& direction,
                                 const StaticStabilityOptions& options) {
  if (options.copies < 1) throw UsageError("a stack needs at least one copy");
  if (!(options.band > 0 && options.band < 1))
    throw UsageError("the band of points that carry must lie between 0 and 1");
  if (options.up && !(options.up->dot(direction.vector()) > 0))
    throw UsageError("a stack that stands goes upwards: its direction must not point down or sideways");
  validate(shape);
  return StaticStabilityTest(shape, direction, options).run();
}

}  // namespace stackabilization
