#include "mesh/planar.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace stackabilization {

namespace {

/// A point with its column. Sorted by coordinates: points in one place by column.
struct Place {
  Eigen::Vector2d point;
  int column;

  bool operator<(const Place& other) const {
    return std::tie(point.x(), point.y(), column) < std::tie(other.point.x(), other.point.y(), other.column);
  }
};

/// Appends `place` to a chain with left turns only; the first `fixed` entries stay.
void extend_chain(const Place& place, std::size_t fixed, std::vector<Place>& chain) {
  while (chain.size() > fixed) {
    const Eigen::Vector2d before = chain[chain.size() - 2].point;
    if (cross(chain.back().point - before, place.point - before) > 0) break;
    chain.pop_back();
  }
  chain.push_back(place);
}

/// Returns the columns of the corners that are not closer than `resolution` to their predecessors.
std::vector<int> distinct_columns(const std::vector<Place>& corners, double resolution) {
  const auto close = [&](const Place& a, const Place& b) { return (a.point - b.point).norm() <= resolution; };
  std::vector<Place> kept = {corners.front()};
  for (const Place& corner : corners)
    if (!close(corner, kept.back())) kept.push_back(corner);
  while (kept.size() > 1 && close(kept.back(), kept.front())) kept.pop_back();
  std::vector<int> columns;
  columns.reserve(kept.size());
  for (const Place& corner : kept) columns.push_back(corner.column);
  return columns;
}

}  // namespace

std::vector<int> convex_polygon(const Eigen::Matrix2Xd& points, double resolution) {
  std::vector<Place> places;
  places.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) places.push_back({points.col(i), static_cast<int>(i)});
  std::sort(places.begin(), places.end());
  std::vector<Place> chain;
  chain.reserve(places.size() + 1);
  for (const Place& place : places) extend_chain(place, 1, chain);
  const std::size_t lower = chain.size();
  for (auto place = places.rbegin() + 1; place != places.rend(); ++place) extend_chain(*place, lower, chain);
  if (chain.size() > 1) chain.pop_back();
  return distinct_columns(chain, resolution);
}

namespace {

/// Advances a caliper to the corner from which the next side no longer advances along `along`. Indices of
/// corners continue beyond the last corner, so that the four calipers never overtake each other.
class Caliper {
 public:
  explicit Caliper(const Eigen::Matrix2Xd& polygon) : polygon_(polygon), sides_(2, polygon.cols()) {
    const Eigen::Index last = polygon.cols() - 1;
    sides_.leftCols(last) = polygon.rightCols(last) - polygon.leftCols(last);
    sides_.col(last) = polygon.col(0) - polygon.col(last);
  }

  Eigen::Vector2d corner(Eigen::Index k) const { return polygon_.col(wrapped(k)); }
  /// From corner k to the next one.
  Eigen::Vector2d side(Eigen::Index k) const { return sides_.col(wrapped(k)); }
  Eigen::Index advance(Eigen::Index k, const Eigen::Vector2d& along) const {
    while (side(k).dot(along) > 0) ++k;
    return k;
  }

 private:
  Eigen::Index wrapped(Eigen::Index k) const {
    while (k >= polygon_.cols()) k -= polygon_.cols();
    return k;
  }

  const Eigen::Matrix2Xd& polygon_;
  Eigen::Matrix2Xd sides_;
};

/// The rectangle with that axis.
PlanarRectangle rectangle_along(const Eigen::Vector2d& axis, const Eigen::Matrix2Xd& polygon) {
  const Eigen::Vector2d across(-axis.y(), axis.x());
  const Eigen::RowVectorXd x = axis.transpose() * polygon, y = across.transpose() * polygon;
  const Eigen::Vector2d low(x.minCoeff(), y.minCoeff()), high(x.maxCoeff(), y.maxCoeff());
  const Eigen::Vector2d middle = (low + high) / 2;
  return {axis * middle.x() + across * middle.y(), axis, high - low};
}

}  // namespace

// The direction of a very short side is mostly rounding: calipers then find less than the true area, never
// more. So they only choose which sides to measure.
PlanarRectangle minimal_rectangle(const Eigen::Matrix2Xd& polygon) {
  PlanarRectangle best;
  best.centre = polygon.col(0);
  if (polygon.cols() == 1) return best;
  const Caliper caliper(polygon);
  double least = std::numeric_limits<double>::infinity();
  Eigen::Index right = 0, top = 0, left = 0;
  for (Eigen::Index side = 0; side < polygon.cols(); ++side) {
    const Eigen::Vector2d base = caliper.corner(side);
    const Eigen::Vector2d axis = caliper.side(side).normalized();
    const Eigen::Vector2d across(-axis.y(), axis.x());
    right = caliper.advance(std::max(right, side + 1), axis);
    top = caliper.advance(std::max(top, right), across);
    left = caliper.advance(std::max(left, top), -axis);
    const double length = (caliper.corner(right) - caliper.corner(left)).dot(axis);
    const double height = (caliper.corner(top) - base).dot(across);
    if (length * height >= least) continue;
    const PlanarRectangle measured = rectangle_along(axis, polygon);
    if (measured.area() >= least) continue;
    least = measured.area();
    best = measured;
  }
  return best;
}

}  // namespace stackabilization
