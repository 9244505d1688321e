#include "envelope/contacts/planar_union.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/disjoint_sets.h"
#include "envelope/contacts/outline_bounds.h"
#include "mesh/planar.h"

namespace stackabilization::detail {
namespace {

/// Distance between two convex outlines along the best separating axis among their sides: 0 when they
/// overlap, never more than the true distance.
double separating_distance(const ConvexPolygon& a, const ConvexPolygon& b) {
  double best = 0;
  const auto try_axis = [&](const Eigen::Vector2d& axis) {
    const auto range = [&axis](const ConvexPolygon& outline) {
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
  for (const ConvexPolygon* outline : {&a, &b})
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

ConvexPolygon outline_of(const Points& points, const Frame& frame) {
  ConvexPolygon outline;
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    const Eigen::Vector3d local = frame.to_local(points.row(p).transpose());
    outline.push_back({local.x(), local.y()});
  }
  return outline;
}

ConvexPolygon outline_of(const Shape& shape, std::int32_t triangle, const Frame& frame) {
  Points corners(3, 3);
  for (int c = 0; c < 3; ++c) corners.row(c) = shape.corner(triangle, c);
  return outline_of(corners, frame);
}

double signed_area(const ConvexPolygon& outline) {
  double twice = 0;
  for (std::size_t p = 2; p < outline.size(); ++p)
    twice += cross(outline[p - 1] - outline[0], outline[p] - outline[0]);
  return twice / 2;
}

double outline_area(const ConvexPolygon& outline) {
  return std::abs(signed_area(outline));
}

bool contains(const ConvexPolygon& outer, const ConvexPolygon& inner) {
  const double area = signed_area(outer);
  for (std::size_t p = 0; p < outer.size(); ++p) {
    const Eigen::Vector2d &a = outer[p], side = outer[(p + 1) % outer.size()] - a;
    for (const Eigen::Vector2d& corner : inner)
      if (area * cross(side, corner - a) < 0) return false;
  }
  return area != 0;
}

Eigen::VectorXd outline_centroid(const ConvexPolygon& outline) {
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

namespace {

/// Sweep over outlines in the order of their left ends. Per component, it keeps the outlines that the sweep
/// may still meet. One touching outline suffices, so deeply nested outlines cost no more than outlines side
/// by side.
class OutlineSweep {
 public:
  OutlineSweep(const std::vector<ConvexPolygon>& outlines, double reach)
      : outlines_(outlines), reach_(reach), bounds_(outlines.size()), components_(outlines.size()) {
    for (std::size_t o = 0; o < outlines.size(); ++o) bounds_[o].add(outlines[o]);
  }

  DisjointSets run() {
    std::vector<std::size_t> order(outlines_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return bounds_[a].low.x() != bounds_[b].low.x() ? bounds_[a].low.x() < bounds_[b].low.x() : a < b;
    });
    for (const std::size_t o : order) take(o);
    return std::move(components_);
  }

 private:
  using Members = std::vector<std::size_t>;

  void take(std::size_t o) {
    Members own{o};
    for (std::size_t k = 0; k < active_.size();) {
      const bool touching = touches(o, active_[k]);
      if (touching) {
        components_.join(o, active_[k].front());
        if (own.size() < active_[k].size()) own.swap(active_[k]);
        own.insert(own.end(), active_[k].begin(), active_[k].end());
      }
      if (touching || active_[k].empty()) {
        active_[k] = std::move(active_.back());
        active_.pop_back();
      } else {
        ++k;
      }
    }
    active_.push_back(std::move(own));
  }

  /// Returns whether one of the members touches `o`. Drops members that end before `o` begins.
  bool touches(std::size_t o, Members& members) const {
    for (std::size_t m = members.size(); m-- > 0;) {
      const OutlineBounds& other = bounds_[members[m]];
      if (other.high.x() + reach_ < bounds_[o].low.x()) {
        members[m] = members.back();
        members.pop_back();
        continue;
      }
      if (other.high.y() + reach_ < bounds_[o].low.y() || bounds_[o].high.y() + reach_ < other.low.y())
        continue;
      if (separating_distance(outlines_[o], outlines_[members[m]]) <= reach_) return true;
    }
    return false;
  }

  const std::vector<ConvexPolygon>& outlines_;
  double reach_;
  std::vector<OutlineBounds> bounds_;
  DisjointSets components_;
  std::vector<Members> active_;  ///< per component
};

}  // namespace

std::vector<std::vector<std::size_t>> connected_outlines(const std::vector<ConvexPolygon>& outlines,
                                                         double reach) {
  DisjointSets components = OutlineSweep(outlines, reach).run();
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

Elongation elongation_of(const std::vector<ConvexPolygon>& outlines) {
  Eigen::Index count = 0;
  for (const ConvexPolygon& outline : outlines) count += static_cast<Eigen::Index>(outline.size());
  Eigen::Matrix2Xd points(2, count);
  Eigen::Index column = 0;
  for (const ConvexPolygon& outline : outlines)
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
