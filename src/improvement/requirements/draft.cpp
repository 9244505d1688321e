#include "improvement/requirements/draft.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/bounding_diagonal.h"
#include "mesh/surface_moments.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

/// A triangle at a point where copies touch.
struct Touched {
  double draft = 0;     ///< angle between r and the triangle, radians
  bool inside = false;  ///< whether the point is clear of the triangle's edges
};

/// Measures the draft angle at contact polygons.
class DraftAngles {
 public:
  DraftAngles(const Shape& shape, const Direction& direction)
      : shape_(shape), up_(direction.unit()), reach_(tolerance::relative * bounding_diagonal(shape)) {}

  /// Returns the draft angle at a contact polygon, radians. Nothing if a triangle has no area.
  std::optional<double> draft(const ContactPolygon& polygon) const;

 private:
  std::optional<Touched> touched(Eigen::Index triangle, const Eigen::Vector3d& point) const;

  const Shape& shape_;
  Eigen::Vector3d up_;
  double reach_;
};

std::optional<Touched> DraftAngles::touched(Eigen::Index triangle, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d normal = detail::unit_normal(shape_, triangle);
  if (!(normal.norm() > 0)) return std::nullopt;
  Touched result{std::atan2(std::abs(normal.dot(up_)), normal.cross(up_).norm()), true};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d from = shape_.corner(triangle, k);
    const Eigen::Vector3d edge = (shape_.corner(triangle, (k + 1) % 3) - from).normalized();
    result.inside &= normal.dot(edge.cross(point - from)) > reach_;
  }
  return result;
}

std::optional<double> DraftAngles::draft(const ContactPolygon& polygon) const {
  // The copies touch where f is largest over the polygon.
  const Eigen::VectorXd f = (polygon.upper_points - polygon.lower_points) * up_;
  const double touching = f.maxCoeff() - reach_;
  Eigen::Vector3d below = Eigen::Vector3d::Zero(), above = Eigen::Vector3d::Zero();
  int count = 0;
  for (Eigen::Index k = 0; k < f.size(); ++k) {
    if (f(k) < touching) continue;
    below += polygon.upper_points.row(k).transpose();
    above += polygon.lower_points.row(k).transpose();
    ++count;
  }
  const auto upper = touched(polygon.upper_triangle, below / count);
  const auto lower = touched(polygon.lower_triangle, above / count);
  if (!upper || !lower) return std::nullopt;
  if (upper->inside != lower->inside) return upper->inside ? upper->draft : lower->draft;
  return upper->inside ? std::min(upper->draft, lower->draft) : std::max(upper->draft, lower->draft);
}

}  // namespace

double contact_draft_degrees(const Shape& shape, const std::vector<ContactRegion>& regions,
                             const Direction& direction) {
  if (regions.empty()) return 90;
  const DraftAngles gauge(shape, direction);
  double least = std::numbers::pi / 2;
  for (const ContactRegion& region : regions)
    for (const ContactPolygon& polygon : region.polygons)
      least = std::min(least, gauge.draft(polygon).value_or(least));
  return least * 180 / std::numbers::pi;
}

}  // namespace stackabilization
