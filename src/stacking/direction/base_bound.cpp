#include "stacking/direction/base_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "mesh/planar.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2;

/// A corner of the projection, with the heights of the hull's points that are seen there.
struct Corner {
  Eigen::Vector2d at;
  double low, high;
};

/// Two outermost points: their difference across r, and along r where it is least.
struct OutermostPair {
  Eigen::Vector2d across;
  double along;

  double width(const Eigen::Vector2d& unit) const { return across.dot(unit); }
  /// What the width along a vector across r loses at most when r turns by the angle.
  double loss(double angle) const { return std::sin(angle) * along + (1 - std::cos(angle)) * across.norm(); }
};

std::vector<Corner> corners_of(const HullSupport& hull, const Frame& frame, double resolution) {
  const Eigen::Index count = hull.points().rows();
  Eigen::Matrix2Xd seen(2, count);
  Eigen::VectorXd heights(count);
  const Eigen::Vector3d centre = hull.points().colwise().mean().transpose();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d local = frame.to_local(hull.points().row(i).transpose() - centre);
    seen.col(i) = local.head<2>();
    heights[i] = local.z();
  }
  std::vector<Corner> corners;
  for (const int index : convex_polygon(seen, resolution)) {
    Corner corner{seen.col(index), heights[index], heights[index]};
    for (Eigen::Index i = 0; i < count; ++i) {
      if ((seen.col(i) - corner.at).cwiseAbs().maxCoeff() > resolution) continue;
      corner.low = std::min(corner.low, heights[i]);
      corner.high = std::max(corner.high, heights[i]);
    }
    corners.push_back(corner);
  }
  return corners;
}

OutermostPair outermost_along(const std::vector<Corner>& corners, const Eigen::Vector2d& unit) {
  const auto before = [&](const Corner& a, const Corner& b) { return a.at.dot(unit) < b.at.dot(unit); };
  const auto [last, first] = std::minmax_element(corners.begin(), corners.end(), before);
  return {first->at - last->at, std::max({0.0, first->low - last->high, last->low - first->high})};
}

/// The turns at which an outermost point changes: those of the polygon's sides, modulo a quarter turn, with
/// both ends of the quarter turn.
std::vector<double> changes(const std::vector<Corner>& corners) {
  std::vector<double> turns = {0, quarter_turn};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d side = corners[(i + 1) % corners.size()].at - corners[i].at;
    const double turn = std::fmod(std::atan2(side.y(), side.x()) + 4 * quarter_turn, quarter_turn);
    turns.push_back(turn);
  }
  std::sort(turns.begin(), turns.end());
  return turns;
}

Eigen::Vector2d unit_at(double turn) {
  return {std::cos(turn), std::sin(turn)};
}

}  // namespace

double min_base(const HullSupport& hull, const Direction& direction, double angle) {
  const double size = hull.points().cwiseAbs().maxCoeff(), resolution = tolerance::rounding * size;
  const std::vector<Corner> corners = corners_of(hull, frame_of(direction), resolution);
  if (corners.size() < 3) return 0;
  const std::vector<double> turns = changes(corners);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const double begin = turns[i], end = turns[i + 1], half = (end - begin) / 2;
    const OutermostPair first = outermost_along(corners, unit_at(begin + half)),
                        second = outermost_along(corners, unit_at(begin + half + quarter_turn));
    double product = std::numeric_limits<double>::infinity(), first_width = 0, second_width = 0;
    for (const double turn : {begin, end}) {
      const double a = first.width(unit_at(turn)), b = second.width(unit_at(turn + quarter_turn));
      product = std::min(product, a * b);
      first_width = std::max(first_width, a);
      second_width = std::max(second_width, b);
    }
    // The vector that is a share c of the way along the turn of r loses c of the loss, the other one sqrt(1 -
    // c^2). Widths are largest within the interval, by no more than 1 / cos(half).
    const double loss =
        std::hypot(first.loss(angle) * second_width, second.loss(angle) * first_width) / std::cos(half);
    least = std::min(least, product - loss);
  }
  const double rounding = 16 * resolution * corners.size() * size;
  return std::max(0.0, least - rounding);
}

}  // namespace stackabilization::detail
