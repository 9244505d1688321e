#include "support/rational_oracle.h"

#include <array>
#include <vector>

namespace stackabilization {
namespace {

const Rational zero;

/// A point in the coordinates (x, y, t) with p = x e_i + y e_j + t r; r_k is not zero.
using Point = std::array<Rational, 3>;

Point shear(const Eigen::Vector3d& p, const Eigen::Vector3d& r) {
  const int k = r.z() != 0 ? 2 : r.y() != 0 ? 1 : 0;
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const Rational t = Rational(p[k]) / Rational(r[k]);
  return {Rational(p[i]) - t * Rational(r[i]), Rational(p[j]) - t * Rational(r[j]), t};
}

/// Of the triangle, in x and y; positive when counter-clockwise.
Rational twice_area(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::vector<Point> triangle(const Shape& shape, Eigen::Index t, const Eigen::Vector3d& r) {
  std::vector<Point> corners;
  for (int c = 0; c < 3; ++c) corners.push_back(shear(shape.corner(t, c), r));
  if (twice_area(corners[0], corners[1], corners[2]) < zero) std::swap(corners[1], corners[2]);
  return corners;
}

/// Sutherland-Hodgman: what of the polygon lies left of the line a b.
std::vector<Point> clip(const std::vector<Point>& polygon, const Point& a, const Point& b) {
  std::vector<Point> kept;
  for (std::size_t v = 0; v < polygon.size(); ++v) {
    const Point &p = polygon[v], &q = polygon[(v + 1) % polygon.size()];
    const Rational side_p = twice_area(a, b, p), side_q = twice_area(a, b, q);
    if (side_p >= zero) kept.push_back(p);
    if ((side_p > zero && side_q < zero) || (side_p < zero && side_q > zero)) {
      const Rational s = side_p / (side_p - side_q);
      Point crossing;
      for (int axis = 0; axis < 3; ++axis) crossing[axis] = p[axis] + s * (q[axis] - p[axis]);
      kept.push_back(crossing);
    }
  }
  return kept;
}

Rational area(const std::vector<Point>& polygon) {
  Rational sum;
  for (std::size_t v = 2; v < polygon.size(); ++v)
    sum = sum + twice_area(polygon[0], polygon[v - 1], polygon[v]);
  return sum;
}

Rational height_over(const std::vector<Point>& base, const Point& p) {
  const Rational whole = twice_area(base[0], base[1], base[2]);
  Rational sum;
  for (int c = 0; c < 3; ++c) sum = sum + twice_area(base[(c + 1) % 3], base[(c + 2) % 3], p) * base[c][2];
  return sum / whole;
}

}  // namespace

std::optional<Rational> oracle_pair(const Shape& below, Eigen::Index upper, const Shape& above,
                                    Eigen::Index lower, const Direction& direction) {
  const std::vector<Point> a = triangle(below, upper, direction.vector());
  const std::vector<Point> b = triangle(above, lower, direction.vector());
  if (area(a) == zero || area(b) == zero) return std::nullopt;
  std::vector<Point> common = a;
  for (int edge = 0; edge < 3 && !common.empty(); ++edge) common = clip(common, b[edge], b[(edge + 1) % 3]);
  if (common.size() < 3 || area(common) == zero) return std::nullopt;
  std::optional<Rational> best;
  for (const Point& p : common) {
    const Rational gap = p[2] - height_over(b, p);
    if (!best || *best < gap) best = gap;
  }
  return best;
}

std::optional<Rational> oracle_separation(const Shape& below, const Shape& above,
                                          const Direction& direction) {
  std::optional<Rational> best;
  for (Eigen::Index upper = 0; upper < below.triangle_count(); ++upper)
    for (Eigen::Index lower = 0; lower < above.triangle_count(); ++lower) {
      const std::optional<Rational> pair = oracle_pair(below, upper, above, lower, direction);
      if (pair && (!best || *best < *pair)) best = pair;
    }
  return best;
}

}  // namespace stackabilization
