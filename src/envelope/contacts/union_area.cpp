#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "envelope/contacts/outline_bounds.h"
#include "envelope/contacts/planar_union.h"

namespace stackabilization::detail {
namespace {

/// Largest number of outlines that are united, since the union takes quadratic time. More outlines often lie
/// above each other.
constexpr std::size_t max_united_outlines = 4096;

/// Returns the interval of the line at height y inside the convex outline.
std::optional<std::pair<double, double>> cut_at(const ConvexPolygon& outline, double y) {
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

/// Returns the first and the last line of the midpoint rule that meet an outline.
using LineRange = std::pair<int, int>;

std::vector<LineRange> line_ranges(const std::vector<ConvexPolygon>& outlines, const OutlineBounds& bounds,
                                   int lines) {
  const double step = (bounds.high.y() - bounds.low.y()) / lines;
  const auto line_at = [&](double y) {
    return std::clamp(static_cast<int>((y - bounds.low.y()) / step), 0, lines - 1);
  };
  std::vector<LineRange> ranges;
  for (const ConvexPolygon& outline : outlines) {
    OutlineBounds own;
    own.add(outline);
    ranges.emplace_back(line_at(own.low.y()), line_at(own.high.y()));
  }
  return ranges;
}

/// Returns the number of lines that max_cuts allows.
int line_count(const std::vector<ConvexPolygon>& outlines, const OutlineBounds& bounds) {
  constexpr int max_lines = 2048, min_lines = 16;
  constexpr std::int64_t max_cuts = std::int64_t{1} << 24;
  std::int64_t cuts = 0;
  for (const auto& [first, last] : line_ranges(outlines, bounds, max_lines)) cuts += last - first + 1;
  if (cuts <= max_cuts) return max_lines;
  return std::max(min_lines, static_cast<int>(max_lines * max_cuts / cuts));
}

/// Computes the area of the union by the midpoint rule: the covered lengths of evenly spaced lines.
double area_by_lines(const std::vector<ConvexPolygon>& outlines, const OutlineBounds& bounds) {
  if (!(bounds.high.y() > bounds.low.y())) return 0;
  const int lines = line_count(outlines, bounds);
  const double step = (bounds.high.y() - bounds.low.y()) / lines;
  const std::vector<LineRange> ranges = line_ranges(outlines, bounds, lines);
  std::vector<std::vector<std::size_t>> beginning(static_cast<std::size_t>(lines));
  for (std::size_t o = 0; o < outlines.size(); ++o)
    beginning[static_cast<std::size_t>(ranges[o].first)].push_back(o);
  std::vector<std::size_t> open;
  std::vector<std::pair<double, double>> covered;
  double length = 0;
  for (int line = 0; line < lines; ++line) {
    const std::vector<std::size_t>& more = beginning[static_cast<std::size_t>(line)];
    std::erase_if(open, [&](std::size_t o) { return ranges[o].second < line; });
    open.insert(open.end(), more.begin(), more.end());
    covered.clear();
    for (const std::size_t o : open)
      if (const auto cut = cut_at(outlines[o], bounds.low.y() + (line + 0.5) * step)) covered.push_back(*cut);
    length += covered_length(covered);
  }
  return length * step;
}

using GridCorner = Eigen::Matrix<std::int64_t, 2, 1>;

std::int64_t turn(const GridCorner& a, const GridCorner& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Corners of the convex hull, anticlockwise, without those amid an edge (Andrew's monotone chain).
std::vector<GridCorner> hull_of(std::vector<GridCorner> corners) {
  const auto before = [](const GridCorner& a, const GridCorner& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::sort(corners.begin(), corners.end(), before);
  std::vector<GridCorner> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t least = hull.size() + 1;
    for (const GridCorner& corner : corners) {
      while (hull.size() > least && turn(hull.back() - hull[hull.size() - 2], corner - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(corner);
    }
    hull.pop_back();
    std::reverse(corners.begin(), corners.end());
  }
  return hull;
}

/// Computes the area inside the border of the union: every edge without its portions covered by other
/// outlines. The grid makes the signs of cross products exact. Whether an edge or its twin is covered must
/// always be decided in the same way, because an open border has no area.
class UnionBorder {
 public:
  UnionBorder(const std::vector<ConvexPolygon>& outlines, const OutlineBounds& bounds) {
    const Eigen::Vector2d centre = (bounds.low + bounds.high) / 2;
    const double longer = (bounds.high - bounds.low).maxCoeff();
    scale_ = longer > 0 ? cells / longer : 1;
    for (const ConvexPolygon& outline : outlines) add(outline, centre);
  }

  double area() const {
    double twice = 0;
    std::vector<std::pair<double, double>> covered;
    for (std::size_t i = 0; i < polygons_.size(); ++i) {
      const std::vector<std::size_t> others = neighbours(i);
      const std::vector<GridCorner>& polygon = polygons_[i];
      for (std::size_t c = 0; c < polygon.size(); ++c) {
        const GridCorner &a = polygon[c], &b = polygon[(c + 1) % polygon.size()];
        covered.clear();
        for (const std::size_t j : others)
          if (const auto part = covered_part(a, b, polygons_[j], j < i)) covered.push_back(*part);
        twice += (1 - covered_length(covered)) * static_cast<double>(turn(a, b));
      }
    }
    return twice / 2 / (scale_ * scale_);
  }

 private:
  /// Across the longer side: differences of coordinates have 30 bits, cross products of these 61.
  static constexpr double cells = 1 << 30;

  /// The convex hull of the outline on the grid; nothing where that has no area.
  void add(const ConvexPolygon& outline, const Eigen::Vector2d& centre) {
    std::vector<GridCorner> corners;
    OutlineBounds bounds;
    for (const Eigen::Vector2d& corner : outline)
      corners.push_back(((corner - centre) * scale_).array().round().cast<std::int64_t>());
    corners = hull_of(std::move(corners));
    if (corners.size() < 3) return;
    ConvexPolygon hull;
    for (const GridCorner& corner : corners) hull.push_back(corner.cast<double>());
    bounds.add(hull);
    bounds_.push_back(bounds);
    polygons_.push_back(std::move(corners));
  }

  std::vector<std::size_t> neighbours(std::size_t i) const {
    std::vector<std::size_t> result;
    for (std::size_t j = 0; j < polygons_.size(); ++j)
      if (j != i && (bounds_[j].low.array() <= bounds_[i].high.array()).all() &&
          (bounds_[i].low.array() <= bounds_[j].high.array()).all())
        result.push_back(j);
    return result;
  }

  /// Returns the portion of the edge from `a` (0) to `b` (1) that lies inside. Of coincident edges in the
  /// same direction, the edge of the first outline stays. Coincident edges in opposite directions both stay:
  /// their areas cancel.
  static std::optional<std::pair<double, double>> covered_part(const GridCorner& a, const GridCorner& b,
                                                               const std::vector<GridCorner>& polygon,
                                                               bool earlier) {
    double from = 0, to = 1;
    for (std::size_t c = 0; c < polygon.size(); ++c) {
      const GridCorner &p = polygon[c], side = polygon[(c + 1) % polygon.size()] - p;
      const std::int64_t at_a = turn(side, a - p), at_b = turn(side, b - p);
      if (at_a == 0 && at_b == 0) {
        if (!earlier || side.dot(b - a) < 0) return std::nullopt;
      } else if (at_a <= 0 && at_b <= 0) {
        return std::nullopt;
      } else if (at_a < 0) {
        from = std::max(from, static_cast<double>(at_a) / static_cast<double>(at_a - at_b));
      } else if (at_b < 0) {
        to = std::min(to, static_cast<double>(at_a) / static_cast<double>(at_a - at_b));
      }
    }
    if (!(from < to)) return std::nullopt;
    return std::pair(from, to);
  }

  double scale_;
  std::vector<std::vector<GridCorner>> polygons_;
  std::vector<OutlineBounds> bounds_;
};

}  // namespace

double union_area(const std::vector<ConvexPolygon>& outlines) {
  OutlineBounds bounds;
  for (const ConvexPolygon& outline : outlines) bounds.add(outline);
  if (outlines.size() > max_united_outlines) return area_by_lines(outlines, bounds);
  return UnionBorder(outlines, bounds).area();
}

}  // namespace stackabilization::detail
