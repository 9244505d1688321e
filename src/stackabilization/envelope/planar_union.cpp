#include "stackabilization/envelope/planar_union.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "stackabilization/envelope/outline_bounds.h"
#include "stackabilization/shape/disjoint_sets.h"
#include "stackabilization/shape/planar.h"

namespace stackabilization::detail {
namespace {

/// Distance between two convex outlines along the best separating axis among their sides: 0 when they
/// overlap, never more than the true distance.
double separating_distance(const Outline& a, const Outline& b) {
  double best = 0;
  const auto try_axis = [&](const Eigen::Vector2d& axis) {
    const auto range = [&axis](const Outline& outline) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Eigen::Vector2d& p : outline) {
        low = std::min(low, axis.dot(p));
        high = std::max(high, axis.dot(p));
      }
      return std::pair(low, high);
    };
    const auto [a_low, a_high] = range(a);
    const auto [b_low, b_high] = range(b);
    best = std::max({best, b_low - a_high, a_low - b_high});
  };
  for (const Outline* outline : {&a, &b})
    for (std::size_t p = 0; p < outline->size(); ++p) {
      const Eigen::Vector2d side = (*outline)[(p + 1) % outline->size()] - (*outline)[p];
      const double length = side.norm();
      if (!(length > 0)) continue;
      try_axis(Eigen::Vector2d(-side.y(), side.x()) / length);
      try_axis(side / length);
    }
  try_axis(Eigen::Vector2d::UnitX());
  try_axis(Eigen::Vector2d::UnitY());
  return best;
}

}  // namespace

double outline_area(const Outline& outline) {
  double twice = 0;
  for (std::size_t p = 2; p < outline.size(); ++p)
    twice += cross(outline[p - 1] - outline[0], outline[p] - outline[0]);
  return std::abs(twice) / 2;
}

Eigen::VectorXd outline_centroid(const Outline& outline) {
  const auto count = static_cast<Eigen::Index>(outline.size());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(count);
  double total = 0;
  for (Eigen::Index p = 2; p < count; ++p) {
    const double area = std::abs(cross(outline[p - 1] - outline[0], outline[p] - outline[0]));
    for (const Eigen::Index corner : {Eigen::Index{0}, p - 1, p}) weights[corner] += area / 3;
    total += area;
  }
  if (!(total > 0)) return Eigen::VectorXd::Constant(count, 1.0 / static_cast<double>(count));
  return weights / total;
}

std::vector<std::vector<std::size_t>> connected_outlines(const std::vector<Outline>& outlines, double reach) {
  std::vector<OutlineBounds> bounds(outlines.size());
  std::vector<std::size_t> order(outlines.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t o = 0; o < outlines.size(); ++o) bounds[o].add(outlines[o]);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return bounds[a].low.x() != bounds[b].low.x() ? bounds[a].low.x() < bounds[b].low.x() : a < b;
  });
  DisjointSets components(outlines.size());
  std::vector<std::size_t> active;
  for (const std::size_t o : order) {
    std::erase_if(active,
                  [&](std::size_t other) { return bounds[other].high.x() + reach < bounds[o].low.x(); });
    for (const std::size_t other : active) {
      if (bounds[other].high.y() + reach < bounds[o].low.y() ||
          bounds[o].high.y() + reach < bounds[other].low.y())
        continue;
      if (components.root(o) == components.root(other)) continue;
      if (separating_distance(outlines[o], outlines[other]) <= reach) components.join(o, other);
    }
    active.push_back(o);
  }
  std::vector<std::vector<std::size_t>> result;
  std::vector<std::size_t> place(outlines.size());
  for (std::size_t o = 0; o < outlines.size(); ++o) {
    const std::size_t root = components.root(o);
    if (root == o) {
      place[o] = result.size();
      result.emplace_back();
    }
    result[place[root]].push_back(o);
  }
  return result;
}

Elongation elongation_of(const std::vector<Outline>& outlines) {
  Eigen::Index count = 0;
  for (const Outline& outline : outlines) count += static_cast<Eigen::Index>(outline.size());
  Eigen::Matrix2Xd points(2, count);
  Eigen::Index column = 0;
  for (const Outline& outline : outlines)
    for (const Eigen::Vector2d& p : outline) points.col(column++) = p;
  const std::vector<int> corners = convex_polygon(points, 0);
  Eigen::Matrix2Xd polygon(2, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t c = 0; c < corners.size(); ++c)
    polygon.col(static_cast<Eigen::Index>(c)) = points.col(corners[c]);
  const PlanarRectangle rectangle = minimal_rectangle(polygon);
  Elongation result{rectangle.size.x(), rectangle.size.y(), rectangle.axis};
  if (result.length < result.width) {
    std::swap(result.length, result.width);
    result.axis = Eigen::Vector2d(-result.axis.y(), result.axis.x());
  }
  return result;
}

}  // namespace stackabilization::detail
