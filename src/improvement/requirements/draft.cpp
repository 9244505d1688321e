#include "improvement/requirements/draft.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "envelope/contacts/contact_normals.h"

namespace stackabilization {

double contact_draft_degrees(const Shape& shape, const std::vector<ContactRegion>& regions,
                             const Direction& direction) {
  const detail::ContactNormals normals(shape, direction);
  const Eigen::Vector3d up = direction.unit();
  double least = std::numbers::pi / 2;
  for (const ContactRegion& region : regions)
    for (const ContactPolygon& polygon : region.polygons)
      if (const auto normal = normals.normal(polygon))
        least = std::min(least, std::atan2(normal->dot(up), normal->cross(up).norm()));
  return least * 180 / std::numbers::pi;
}

}  // namespace stackabilization
