#include "stacking/place/place_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/planar.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/convex_hull.h"

namespace stackabilization::detail {
namespace {

std::vector<Eigen::Vector2d> flat_hull(const Shape& shape) {
  Points flat = shape.vertices;
  flat.col(2).setZero();
  const Points corners = triangulated_hull(flat).points;
  std::vector<Eigen::Vector2d> hull;
  for (Eigen::Index i = 0; i < corners.rows(); ++i) hull.push_back(corners.row(i).head<2>().transpose());
  return hull;
}

/// The part of the segment from p to q within the box, as parameters (Liang and Barsky); nothing if there is
/// none.
std::optional<std::pair<double, double>> clipped(const Eigen::Vector2d& p, const Eigen::Vector2d& q,
                                                 const PlanarBox& box) {
  double from = 0, to = 1;
  const auto cut = [&](double start, double rise, double limit) {  // start + t rise <= limit
    if (rise == 0) return start <= limit;
    const double t = (limit - start) / rise;
    (rise > 0 ? to : from) = rise > 0 ? std::min(to, t) : std::max(from, t);
    return from <= to;
  };
  const Eigen::Vector2d rise = q - p;
  if (!cut(p.x(), rise.x(), box.x_high) || !cut(-p.x(), -rise.x(), -box.x_low)) return std::nullopt;
  if (!cut(p.y(), rise.y(), box.y_high) || !cut(-p.y(), -rise.y(), -box.y_low)) return std::nullopt;
  return std::pair(from, to);
}

}  // namespace

PlaceRegion::PlaceRegion(const LocalShapes& shapes, const std::vector<Eigen::Vector2d>& polygon)
    : base_(shapes.base), hull_(flat_hull(shapes.shape)), polygon_(polygon) {
  for (const Eigen::Vector2d& point : hull_) radius_ = std::max(radius_, point.norm());
  if (polygon.empty()) return;
  if (polygon.size() < 3) throw UsageError("a region needs at least three corners");
  for (const Eigen::Vector2d& corner : polygon)
    if (!corner.allFinite()) throw UsageError("the corners of a region must be finite");
}

PlanarBox PlaceRegion::inside(double yaw) const {
  const double c = std::cos(yaw), s = std::sin(yaw);
  PlanarBox turned{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Eigen::Vector2d& point : hull_) {
    const double x = c * point.x() - s * point.y(), y = s * point.x() + c * point.y();
    turned = {std::min(turned.x_low, x), std::max(turned.x_high, x), std::min(turned.y_low, y),
              std::max(turned.y_high, y)};
  }
  const auto [x_low, x_high] = std::minmax({base_.low.x() - turned.x_low, base_.high.x() - turned.x_high});
  const auto [y_low, y_high] = std::minmax({base_.low.y() - turned.y_low, base_.high.y() - turned.y_high});
  return {x_low, x_high, y_low, y_high};
}

PlanarBox PlaceRegion::box(double yaw, double half_turn) const {
  if (!polygon_.empty()) {
    PlanarBox box{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                  std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Eigen::Vector2d& corner : polygon_)
      box = {std::min(box.x_low, corner.x()), std::max(box.x_high, corner.x()),
             std::min(box.y_low, corner.y()), std::max(box.y_high, corner.y())};
    return box;
  }
  const PlanarBox middle = inside(yaw);
  const double reach = radius_ * half_turn;
  return {middle.x_low - reach, middle.x_high + reach, middle.y_low - reach, middle.y_high + reach};
}

bool PlaceRegion::excludes(const PlaceCell& cell) const {
  if (!box(cell.yaw, cell.half_turn).meets(cell.box)) return true;
  return !polygon_.empty() && !polygon_point(cell.box);
}

std::optional<LocalPlace> PlaceRegion::place_in(const PlaceCell& cell) const {
  if (!polygon_.empty()) {
    const auto point = polygon_point(cell.box);
    return point ? std::optional(LocalPlace{point->x(), point->y(), cell.yaw}) : std::nullopt;
  }
  const PlanarBox allowed = inside(cell.yaw);
  if (!allowed.meets(cell.box)) return std::nullopt;
  const auto nearest = [](double low, double high, double allowed_low, double allowed_high) {
    return std::clamp(low / 2 + high / 2, std::max(low, allowed_low), std::min(high, allowed_high));
  };
  return LocalPlace{nearest(cell.box.x_low, cell.box.x_high, allowed.x_low, allowed.x_high),
                    nearest(cell.box.y_low, cell.box.y_high, allowed.y_low, allowed.y_high), cell.yaw};
}

bool PlaceRegion::polygon_contains(double x, double y) const {
  bool inside = false;
  const Eigen::Vector2d point(x, y);
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const Eigen::Vector2d &p = polygon_[i], &q = polygon_[(i + 1) % polygon_.size()];
    if (cross(q - p, point - p) == 0 && (point - p).dot(point - q) <= 0) return true;
    if ((p.y() > y) != (q.y() > y) && (cross(q - p, point - p) > 0) == (q.y() > p.y())) inside = !inside;
  }
  return inside;
}

std::optional<Eigen::Vector2d> PlaceRegion::polygon_point(const PlanarBox& box) const {
  const Eigen::Vector2d centre(box.x_low / 2 + box.x_high / 2, box.y_low / 2 + box.y_high / 2);
  if (polygon_contains(centre.x(), centre.y())) return centre;
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const Eigen::Vector2d &p = polygon_[i], &q = polygon_[(i + 1) % polygon_.size()];
    if (const auto part = clipped(p, q, box)) {
      Eigen::Vector2d point = p + (part->first / 2 + part->second / 2) * (q - p);
      point.x() = std::clamp(point.x(), box.x_low, box.x_high);
      point.y() = std::clamp(point.y(), box.y_low, box.y_high);
      return point;
    }
  }
  return std::nullopt;
}

}  // namespace stackabilization::detail
