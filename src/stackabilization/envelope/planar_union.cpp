#include "stackabilization/envelope/planar_union.h"

#include <algorithm>
#include <boost/polygon/polygon.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "stackabilization/shape/disjoint_sets.h"
#include "stackabilization/shape/planar.h"

namespace stackabilization::detail {
namespace {

namespace bp = boost::polygon;

struct Bounds {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;

  void add(const Outline& outline) {
    for (const Eigen::Vector2d& p : outline) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
};

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

/// The outline on a grid of 2^30 cells across the longer side of the bounds, centred.
class Grid {
 public:
  explicit Grid(const Bounds& bounds) : centre_((bounds.low + bounds.high) / 2) {
    const double longer = (bounds.high - bounds.low).maxCoeff();
    scale_ = longer > 0 ? static_cast<double>(1 << 30) / longer : 1;
  }

  bp::polygon_data<int> polygon(const Outline& outline) const {
    std::vector<bp::point_data<int>> points;
    for (const Eigen::Vector2d& corner : outline) {
      const Eigen::Vector2d p = (corner - centre_) * scale_;
      points.emplace_back(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
    }
    bp::polygon_data<int> result;
    result.set(points.begin(), points.end());
    return result;
  }

  double cell_area() const { return 1 / (scale_ * scale_); }

 private:
  Eigen::Vector2d centre_;
  double scale_;
};

/// More outlines than these, which often lie many deep, are not united: that takes time quadratic in the
/// depth.
constexpr std::size_t most_united = 4096;

/// What of the line at height y lies in the convex outline: from, to.
std::optional<std::pair<double, double>> cut_at(const Outline& outline, double y) {
  double left = std::numeric_limits<double>::infinity(), right = -left;
  for (std::size_t c = 0; c < outline.size(); ++c) {
    const Eigen::Vector2d &a = outline[c], &b = outline[(c + 1) % outline.size()];
    if ((a.y() < y) == (b.y() < y)) continue;
    const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    left = std::min(left, x);
    right = std::max(right, x);
  }
  if (!(left < right)) return std::nullopt;
  return std::pair(left, right);
}

/// Length of the union of the intervals.
double covered_length(std::vector<std::pair<double, double>>& intervals) {
  std::sort(intervals.begin(), intervals.end());
  double length = 0, end = -std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : intervals) {
    length += std::max(0.0, to - std::max(from, end));
    end = std::max(end, to);
  }
  return length;
}

/// Area of the union by the midpoint rule: what of evenly spaced lines is covered.
double area_by_lines(const std::vector<Outline>& outlines, const Bounds& bounds) {
  constexpr int lines = 2048;
  const double step = (bounds.high.y() - bounds.low.y()) / lines;
  if (!(step > 0)) return 0;
  const auto line_at = [&](double y) {
    return std::clamp(static_cast<int>((y - bounds.low.y()) / step), 0, lines - 1);
  };
  std::vector<std::vector<std::pair<double, double>>> intervals(lines);
  for (const Outline& outline : outlines) {
    Bounds own;
    own.add(outline);
    const int last = line_at(own.high.y());
    for (int line = line_at(own.low.y()); line <= last; ++line)
      if (const auto cut = cut_at(outline, bounds.low.y() + (line + 0.5) * step))
        intervals[static_cast<std::size_t>(line)].push_back(*cut);
  }
  double length = 0;
  for (auto& line : intervals) length += covered_length(line);
  return length * step;
}

/// Which cells of a coarse bitmap the outlines touch. Cells that are only touched count as covered: that
/// closes cracks and small gaps between neighbouring outlines.
class CoverageBitmap {
 public:
  CoverageBitmap(const Bounds& bounds) : low_(bounds.low), covered_(side * side, 0) {
    const double longer = (bounds.high - bounds.low).maxCoeff();
    // One empty cell all around, so that the outside hangs together.
    cell_ = longer > 0 ? longer / (side - 2) : 1;
  }

  void add(const Outline& outline) {
    Bounds bounds;
    bounds.add(outline);
    const int last = row_of(bounds.high.y());
    for (int row = row_of(bounds.low.y()); row <= last; ++row) fill_row(outline, row);
  }

  /// Area of the largest set of free cells that does not reach the border.
  double largest_hole() {
    flood(0);
    std::size_t largest = 0;
    for (std::size_t cell = 0; cell < covered_.size(); ++cell)
      if (!covered_[cell]) largest = std::max(largest, flood(cell));
    return static_cast<double>(largest) * cell_ * cell_;
  }

 private:
  static constexpr int side = 256;

  int index_of(double offset) const { return 1 + std::clamp(static_cast<int>(offset / cell_), 0, side - 3); }
  int row_of(double y) const { return index_of(y - low_.y()); }

  /// Covers the cells of one row that the outline reaches within it.
  void fill_row(const Outline& outline, int row) {
    const double bottom = low_.y() + (row - 1) * cell_, top = bottom + cell_;
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (std::size_t c = 0; c < outline.size(); ++c) {
      const Eigen::Vector2d &a = outline[c], &b = outline[(c + 1) % outline.size()];
      for (const double y : {std::clamp(a.y(), bottom, top), std::clamp(b.y(), bottom, top)}) {
        if (std::max(a.y(), b.y()) < bottom || std::min(a.y(), b.y()) > top) continue;
        const double x = a.y() == b.y() ? a.x() : a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        left = std::min({left, x, a.y() == b.y() ? b.x() : x});
        right = std::max({right, x, a.y() == b.y() ? b.x() : x});
      }
    }
    if (left > right) return;
    for (int column = index_of(left - low_.x()); column <= index_of(right - low_.x()); ++column)
      covered_[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)] = 1;
  }

  /// Covers all free cells connected with `start` by sides; returns their number.
  std::size_t flood(std::size_t start) {
    std::vector<std::size_t> open{start};
    covered_[start] = 1;
    std::size_t count = 0;
    const auto visit = [&](std::size_t cell) {
      if (covered_[cell]) return;
      covered_[cell] = 1;
      open.push_back(cell);
    };
    while (!open.empty()) {
      const std::size_t cell = open.back(), column = cell % side, row = cell / side;
      open.pop_back();
      ++count;
      if (column > 0) visit(cell - 1);
      if (column + 1 < side) visit(cell + 1);
      if (row > 0) visit(cell - side);
      if (row + 1 < side) visit(cell + side);
    }
    return count;
  }

  Eigen::Vector2d low_;
  double cell_;
  std::vector<char> covered_;
};

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
  std::vector<Bounds> bounds(outlines.size());
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

double union_area(const std::vector<Outline>& outlines) {
  Bounds bounds;
  for (const Outline& outline : outlines) bounds.add(outline);
  if (outlines.size() > most_united) return area_by_lines(outlines, bounds);
  const Grid grid(bounds);
  bp::polygon_set_data<int> set;
  for (const Outline& outline : outlines) set.insert(grid.polygon(outline));
  std::vector<bp::polygon_with_holes_data<int>> united;
  set.get(united);
  double area = 0;
  for (const auto& polygon : united) area += static_cast<double>(bp::area(polygon)) * grid.cell_area();
  return area;
}

double largest_hole(const std::vector<Outline>& outlines) {
  Bounds bounds;
  for (const Outline& outline : outlines) bounds.add(outline);
  CoverageBitmap bitmap(bounds);
  for (const Outline& outline : outlines) bitmap.add(outline);
  return bitmap.largest_hole();
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
