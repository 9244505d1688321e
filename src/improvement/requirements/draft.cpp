#include "improvement/requirements/draft.h"

#include <algorithm>
#include <numbers>

#include "core/angles.h"
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
        least = std::min(least, detail::angle_to_surface(*normal, up));
  return least * 180 / std::numbers::pi;
}

}  // namespace stackabilization
