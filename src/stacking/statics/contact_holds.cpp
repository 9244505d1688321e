#include "stacking/statics/contact_holds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/bounding_diagonal.h"
#include "envelope/contacts/contact_normals.h"
#include "mesh/planar.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

/// A plane in which copies touch: parts, normal and distance from the origin, rounded.
using PlaneKey = std::array<double, 6>;

/// Returns the corners of the convex hull of points in a plane.
std::vector<Eigen::Vector3d> hull_corners(const std::vector<Eigen::Vector3d>& points,
                                          const Eigen::Vector3d& normal, double resolution) {
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  Eigen::Matrix2Xd seen(2, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    seen.col(static_cast<Eigen::Index>(k)) << u.dot(points[k]), v.dot(points[k]);
  std::vector<Eigen::Vector3d> corners;
  for (const int corner : convex_polygon(seen, resolution))
    corners.push_back(points[static_cast<std::size_t>(corner)]);
  return corners;
}

}  // namespace

std::vector<ContactHold> contact_holds(const Shape& shape, const Direction& direction,
                                       const std::vector<ContactRegion>& regions) {
  struct Plane {
    ContactHold first;
    std::vector<Eigen::Vector3d> points;
  };
  const ContactNormals normals(shape, direction);
  const double same_point = tolerance::relative * bounding_diagonal(shape);
  std::map<PlaneKey, Plane> planes;
  for (const ContactRegion& region : regions) {
    for (const ContactPolygon& polygon : region.polygons) {
      const auto normal = normals.normal(polygon);
      if (!normal) continue;
      for (Eigen::Index k = 0; k < polygon.upper_points.rows(); ++k) {
        const Eigen::Vector3d point = polygon.upper_points.row(k).transpose();
        PlaneKey key = {static_cast<double>(region.upper_part), static_cast<double>(region.lower_part),
                        std::round(normal->dot(point) / same_point)};
        for (int axis = 0; axis < 3; ++axis)
          key[static_cast<std::size_t>(axis) + 3] = std::round((*normal)(axis) / tolerance::relative);
        Plane& plane = planes[key];
        if (plane.points.empty()) plane.first = {{point, *normal}, region.upper_part, region.lower_part};
        plane.points.push_back(point);
      }
    }
  }
  std::vector<ContactHold> holds;
  for (const auto& [key, plane] : planes) {
    ContactHold hold = plane.first;
    for (const Eigen::Vector3d& corner : hull_corners(plane.points, hold.hold.normal, same_point)) {
      hold.hold.point = corner;
      holds.push_back(hold);
    }
  }
  return holds;
}

std::vector<ContactHold> spread_out(const std::vector<ContactHold>& contacts, std::size_t count) {
  if (contacts.size() <= count) return contacts;
  Eigen::AlignedBox3d box;
  for (const ContactHold& contact : contacts) box.extend(contact.hold.point);
  const double diagonal = box.diagonal().norm(), unit = diagonal > 0 ? diagonal : 1;
  std::vector<double> distances(contacts.size(), std::numeric_limits<double>::infinity());
  std::vector<ContactHold> chosen;
  std::size_t next = 0;
  while (chosen.size() < count) {
    chosen.push_back(contacts[next]);
    const Hold& last = chosen.back().hold;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const Hold& hold = contacts[k].hold;
      distances[k] = std::min(distances[k], ((hold.point - last.point) / unit).squaredNorm() +
                                                (hold.normal - last.normal).squaredNorm());
    }
    next = static_cast<std::size_t>(std::max_element(distances.begin(), distances.end()) - distances.begin());
  }
  return chosen;
}

std::vector<Hold> holds_in(const Frame& frame, const std::vector<ContactHold>& contacts) {
  std::vector<Hold> holds;
  holds.reserve(contacts.size());
  for (const ContactHold& contact : contacts)
    holds.push_back({frame.to_local(contact.hold.point), frame.to_local(contact.hold.normal)});
  return holds;
}

}  // namespace stackabilization::detail
