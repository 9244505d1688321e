#include "mesh/planar.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace stackabilization {

namespace {

/// Appends `index` to a chain with left turns only; the first `fixed` entries stay.
void extend_chain(const Eigen::Matrix2Xd& points, int index, std::size_t fixed, std::vector<int>& chain) {
  while (chain.size() > fixed) {
    const Eigen::Vector2d before = points.col(chain[chain.size() - 2]);
    if (cross(points.col(chain.back()) - before, points.col(index) - before) > 0) break;
    chain.pop_back();
  }
  chain.push_back(index);
}

void drop_close_corners(const Eigen::Matrix2Xd& points, double resolution, std::vector<int>& corners) {
  std::vector<int> kept = {corners.front()};
  const auto close = [&](int a, int b) { return (points.col(a) - points.col(b)).norm() <= resolution; };
  for (const int corner : corners)
    if (!close(corner, kept.back())) kept.push_back(corner);
  while (kept.size() > 1 && close(kept.back(), kept.front())) kept.pop_back();
  corners = std::move(kept);
}

}  // namespace

std::vector<int> convex_polygon(const Eigen::Matrix2Xd& points, double resolution) {
  std::vector<int> order(static_cast<std::size_t>(points.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    if (points(0, a) != points(0, b)) return points(0, a) < points(0, b);
    if (points(1, a) != points(1, b)) return points(1, a) < points(1, b);
    return a < b;
  });
  std::vector<int> chain;
  chain.reserve(order.size() + 1);
  for (const int index : order) extend_chain(points, index, 1, chain);
  const std::size_t lower = chain.size();
  for (auto index = order.rbegin() + 1; index != order.rend(); ++index)
    extend_chain(points, *index, lower, chain);
  if (chain.size() > 1) chain.pop_back();
  drop_close_corners(points, resolution, chain);
  return chain;
}

namespace {

/// Advances a caliper to the corner from which the next side no longer advances along `along`. Indices of
/// corners continue beyond the last corner, so that the four calipers never overtake each other.
class Caliper {
 public:
  explicit Caliper(const Eigen::Matrix2Xd& polygon) : polygon_(polygon) {}

  Eigen::Vector2d corner(Eigen::Index k) const {
    while (k >= polygon_.cols()) k -= polygon_.cols();
    return polygon_.col(k);
  }
  Eigen::Index advance(Eigen::Index k, const Eigen::Vector2d& along) const {
    while ((corner(k + 1) - corner(k)).dot(along) > 0) ++k;
    return k;
  }

 private:
  const Eigen::Matrix2Xd& polygon_;
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
    const Eigen::Vector2d axis = (caliper.corner(side + 1) - base).normalized();
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
