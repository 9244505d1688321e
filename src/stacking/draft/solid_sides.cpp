#include "stacking/draft/solid_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/extract_parts.h"
#include "stackabilization/core/copies.h"
#include "stackabilization/mesh/closed_surface.h"

namespace stackabilization::detail {

SolidSides::SolidSides(const Shape& shape, double reach) : reach_(reach) {
  Copies closed;
  std::vector<Box> all_boxes;
  for (Shape& part : extract_parts(shape)) {
    const ClosedSurface surface = closed_surface(part);
    if (!surface.closed) continue;
    std::vector<Eigen::AlignedBox3d> boxes(surface.representatives.size());
    for (std::size_t t = 0; t < surface.component.size(); ++t)
      if (const std::int32_t component = surface.component[t]; component >= 0)
        for (int c = 0; c < 3; ++c)
          boxes[static_cast<std::size_t>(component)].extend(part.corner(static_cast<Eigen::Index>(t), c));
    for (const Eigen::AlignedBox3d& box : boxes)
      all_boxes.push_back(
          {{box.min().x(), box.min().y(), box.min().z()}, {box.max().x(), box.max().y(), box.max().z()}});
    PlacedCopy copy;
    copy.name = std::to_string(closed.shapes.size());
    copy.shape = closed.shapes.size();
    closed.placed.push_back(std::move(copy));
    closed.shapes.push_back(std::move(part));
  }
  if (closed.shapes.empty()) return;
  boxes_ = decltype(boxes_)(all_boxes);
  solid_ = as_one_shape(closed);
  locator_ = std::make_unique<SolidLocator>(solid_);
}

bool SolidSides::both(const Piece& piece, const Eigen::Vector3d& normal) const {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : piece) centre += corner / static_cast<double>(piece.size());
  return both(centre, normal) && std::all_of(piece.begin(), piece.end(), [&](const Eigen::Vector3d& corner) {
           return both(Eigen::Vector3d((centre + corner) / 2), normal);
         });
}

bool SolidSides::both(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
  // It takes two components, the boxes of which are soon asked.
  const Eigen::Vector3d low = point.array() - reach_, high = point.array() + reach_;
  const Box near({low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()});
  auto met = boxes_.qbegin(boost::geometry::index::intersects(near));
  if (met == boxes_.qend() || ++met == boxes_.qend()) return false;
  return contains(point + reach_ * normal) && contains(point - reach_ * normal);
}

bool SolidSides::contains(const Eigen::Vector3d& point) const {
  return locator_ && locator_->locate({point.x(), point.y(), point.z()}).place != PointPlace::outside;
}

}  // namespace stackabilization::detail
