#include "envelope/separation/triangle_pair.h"

#include <algorithm>

namespace stackabilization::detail {
namespace {

/// Far above what the few products of one bound can lose by underflow, far below all that counts in a shape
/// (tolerance::min_shape_size).
constexpr double underflow = std::numeric_limits<double>::min();

/// A computed number and a bound on its error. Comparisons that involve NaN fall on the undecided side.
struct Approximate {
  double value, error;

  bool is_zero() const { return value == 0 && error == 0; }
  bool certainly_positive() const { return value > error; }
  bool certainly_negative() const { return value < -error; }
  bool certainly_not_negative() const { return value >= error; }
  bool certainly_not_positive() const { return value <= -error; }
};

/// Bound on the error of p * q for factors that carry a few roundings each: relative, plus what underflow may
/// hide; zero only if a factor is zero, whose products are exact.
inline double product_error(double p, double q) {
  return p == 0 || q == 0 ? 0 : 6 * unit_roundoff * std::abs(p * q) + underflow;
}

/// Twice the signed area of the projected points p, q, s: (q - p) x (s - p), with a bound on all rounding
/// since the input. Each product carries the rounding of two differences and its own, and the last difference
/// one more: 4 unit roundoffs. Each difference of coordinates is off by two input errors, which gives 2 for
/// either factor and 8 for their product. What is above that covers second order terms and the rounding of
/// the bound itself.
inline Approximate orientation(double px, double py, double qx, double qy, double sx, double sy,
                               const Projection& projection) {
  const double ax = qx - px, ay = qy - py, bx = sx - px, by = sy - py;
  const double rounding = product_error(ax, by) + product_error(ay, bx);
  const double input = 2.5 * (projection.x_error * (std::abs(by) + std::abs(ay)) +
                              projection.y_error * (std::abs(ax) + std::abs(bx))) +
                       12 * projection.x_error * projection.y_error;
  return {ax * by - ay * bx, rounding + input};
}

/// For each corner of one triangle, the corner of another one that is the same point; -1 where there is none.
using Shared = std::array<int, 3>;

Shared shared_corners(const ProjectedTriangle& of, const ProjectedTriangle& with) {
  Shared shared{-1, -1, -1};
  for (int v = 0; v < 3; ++v)
    for (int w = 0; w < 3; ++w)
      if (of.h[v] == with.h[w] && of.source->corners[v] == with.source->corners[w]) shared[v] = w;
  return shared;
}

/// side[e][v]: on which side of edge e of `base` corner v of `other` lies; positive inside.
using Sides = std::array<std::array<Approximate, 3>, 3>;

/// Separating-edge test: do two triangles have common columns, as far as the filter can tell?
class Overlap {
 public:
  explicit Overlap(const Projection& projection) : projection_(projection) {}

  /// Computes the sides of the edges of `base`, until one of them separates the two. `shared`: the corners of
  /// `other` that are corners of `base`; an end of an edge is exactly on its line.
  Sides sides(const ProjectedTriangle& base, const ProjectedTriangle& other, const Shared& shared) {
    const double sign = base.area < 0 ? -1 : 1;
    Sides result;
    for (int e = 0; e < 3 && !excluded_; ++e) {
      const int p = (e + 1) % 3, q = (e + 2) % 3;
      for (int v = 0; v < 3; ++v) {
        if (shared[v] == p || shared[v] == q) {
          result[e][v] = {0, 0};
          continue;
        }
        result[e][v] =
            orientation(base.x[p], base.y[p], base.x[q], base.y[q], other.x[v], other.y[v], projection_);
        result[e][v].value *= sign;
      }
      take(result[e]);
    }
    return result;
  }

  bool excluded() const { return excluded_; }
  bool certain() const { return certain_; }

 private:
  void take(const std::array<Approximate, 3>& edge) {
    const bool solid = projection_.semantics == ContactSemantics::solid;
    bool all_outside = true, some_inside = false;
    for (const Approximate& side : edge) {
      all_outside = all_outside && (solid ? side.certainly_not_positive() : side.certainly_negative());
      some_inside = some_inside || (solid ? side.certainly_positive() : side.certainly_not_negative());
    }
    excluded_ = excluded_ || all_outside;
    certain_ = certain_ && some_inside;
  }

  const Projection& projection_;
  bool excluded_ = false;
  bool certain_ = true;
};

/// Collects bounds on a maximum from the vertices of the common region.
class MaximumBounds {
 public:
  explicit MaximumBounds(double low_limit, double high_limit)
      : low_limit_(low_limit), high_limit_(high_limit) {}

  void take_exact(double value) {
    high_ = std::max(high_, value);
    low_ = std::max(low_, value);
  }

  void take(double value, double error, bool certain) {
    error += underflow;
    double low = value - error, high = value + error;
    if (!(low >= low_limit_)) low = low_limit_;
    if (!(high <= high_limit_)) high = high_limit_;
    high_ = std::max(high_, high);
    if (certain) low_ = std::max(low_, low);
  }

  double low() const { return low_; }
  double high() const { return high_; }

 private:
  double low_limit_, high_limit_;
  double low_ = -infinity, high_ = -infinity;
};

/// Corners of `point` inside `base`: height of the corner minus height of the plane of `base` (times `sign`),
/// as a barycentric combination of corner height differences. A term carries the roundings of its difference,
/// its product and two sums; a weight those of two sums. A quotient of w (1 + a) and v (1 + b) is off by less
/// than (|a| + |b|) w / (v (1 - |b|)).
void take_corners(const ProjectedTriangle& point, const ProjectedTriangle& base, const Shared& shared,
                  const Sides& sides, double sign, MaximumBounds& bounds) {
  for (int v = 0; v < 3; ++v) {
    if (shared[v] >= 0) {
      bounds.take_exact(0);
      continue;
    }
    bool possible = true, certain = true;
    double weighted = 0, weighted_error = 0, weight = 0, weight_error = 0;
    for (int e = 0; e < 3; ++e) {
      const Approximate& side = sides[e][v];
      possible = possible && !side.certainly_negative();
      certain = certain && side.certainly_not_negative();
      const double difference = point.h[v] - base.h[e];
      weighted += side.value * difference;
      weighted_error +=
          (side.error + 5 * unit_roundoff * std::abs(side.value)) * std::abs(difference) + underflow;
      weight += side.value;
      weight_error += side.error + 3 * unit_roundoff * std::abs(side.value);
    }
    if (!possible) continue;
    const double safe_weight = weight - weight_error;
    const double value = weighted / weight;
    const double error = safe_weight > 0
                             ? 1.5 * (weighted_error + std::abs(value) * weight_error) / safe_weight +
                                   4 * unit_roundoff * std::abs(value)
                             : infinity;
    bounds.take(sign * value, error, certain);
  }
}

/// Position of the zero along an edge whose ends lie at signed distances p and q from a line: p / (p - q),
/// known to twice the relative error of p - q where that is below a half. An end on the line is a corner of
/// the common region, not a crossing.
struct Crossing {
  double parameter = 0, error = infinity;
  bool possible = false, certain = false;

  Crossing(const Approximate& p, const Approximate& q) {
    const bool same_side = (p.certainly_positive() && q.certainly_positive()) ||
                           (p.certainly_negative() && q.certainly_negative());
    possible = !same_side && !p.is_zero() && !q.is_zero();
    if (!possible) return;
    const bool opposite = (p.certainly_not_negative() && q.certainly_not_positive()) ||
                          (p.certainly_not_positive() && q.certainly_not_negative());
    const double distance = std::abs(p.value - q.value), distance_error = p.error + q.error;
    if (!(distance > 2 * distance_error)) return;
    certain = opposite;
    parameter = p.value / (p.value - q.value);
    error = 4 * distance_error / distance + 4 * unit_roundoff;
  }
};

void take_edges(const ProjectedTriangle& upper, const ProjectedTriangle& lower, const Sides& of_upper_edges,
                const Sides& of_lower_edges, MaximumBounds& bounds) {
  for (int e = 0; e < 3; ++e) {
    const int a = (e + 1) % 3, b = (e + 2) % 3;
    for (int f = 0; f < 3; ++f) {
      const int c = (f + 1) % 3, d = (f + 2) % 3;
      const Crossing along_upper(of_lower_edges[f][a], of_lower_edges[f][b]);
      if (!along_upper.possible) continue;
      const Crossing along_lower(of_upper_edges[e][c], of_upper_edges[e][d]);
      if (!along_lower.possible) continue;
      const double base = upper.h[a] - lower.h[c];
      const double rise = upper.h[b] - upper.h[a], fall = lower.h[d] - lower.h[c];
      const double value = base + along_upper.parameter * rise - along_lower.parameter * fall;
      const double error = along_upper.error * std::abs(rise) + along_lower.error * std::abs(fall) +
                           6 * unit_roundoff * (std::abs(base) + std::abs(rise) + std::abs(fall));
      bounds.take(value, error, along_upper.certain && along_lower.certain);
    }
  }
}

}  // namespace

ProjectedTriangle::ProjectedTriangle(const TreeTriangle& triangle, const Projection& projection)
    : source(&triangle) {
  for (int c = 0; c < 3; ++c) {
    const double* p = triangle.corners[c].data();
    h[c] = projection.shear.height(p);
    x[c] = projection.shear.x(p);
    y[c] = projection.shear.y(p);
  }
  x_low = std::min({x[0], x[1], x[2]}) - projection.x_error;
  x_high = std::max({x[0], x[1], x[2]}) + projection.x_error;
  y_low = std::min({y[0], y[1], y[2]}) - projection.y_error;
  y_high = std::max({y[0], y[1], y[2]}) + projection.y_error;
  h_low = std::min({h[0], h[1], h[2]});
  h_high = std::max({h[0], h[1], h[2]});
  const Approximate signed_area = orientation(x[0], y[0], x[1], y[1], x[2], y[2], projection);
  area = signed_area.value;
  area_error = signed_area.error;
}

PairBounds bound_pair(const ProjectedTriangle& upper, const ProjectedTriangle& lower,
                      const Projection& projection, const DoubleDouble& floor) {
  PairBounds result;
  if (upper.x_low > lower.x_high || lower.x_low > upper.x_high || upper.y_low > lower.y_high ||
      lower.y_low > upper.y_high)
    return result;
  const DoubleDouble highest = exact_difference(upper.h_high, lower.h_low);
  if (highest <= floor) return result;
  if (upper.possibly_edge_on() || lower.possibly_edge_on()) {
    const bool degenerate =
        (upper.area == 0 && upper.area_error == 0) || (lower.area == 0 && lower.area_error == 0);
    if (!(degenerate && projection.semantics == ContactSemantics::solid)) result.high = highest;
    return result;
  }
  const Shared upper_shared = shared_corners(upper, lower), lower_shared = shared_corners(lower, upper);
  Overlap overlap(projection);
  const Sides of_upper_edges = overlap.sides(upper, lower, lower_shared);
  if (overlap.excluded()) return result;
  const Sides of_lower_edges = overlap.sides(lower, upper, upper_shared);
  if (overlap.excluded()) return result;

  const DoubleDouble lowest = exact_difference(upper.h_low, lower.h_high);
  MaximumBounds bounds(lowest.high, highest.high);
  take_corners(upper, lower, upper_shared, of_lower_edges, 1, bounds);
  take_corners(lower, upper, lower_shared, of_upper_edges, -1, bounds);
  take_edges(upper, lower, of_upper_edges, of_lower_edges, bounds);
  if (bounds.high() < highest.high)
    result.high = {bounds.high(), 0};
  else
    result.high = highest;
  if (overlap.certain()) result.low = bounds.low() > lowest.high ? DoubleDouble{bounds.low(), 0} : lowest;
  return result;
}

}  // namespace stackabilization::detail
