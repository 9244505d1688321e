#include "envelope/separation/exact_pair.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

#include "core/rational_number.h"

namespace stackabilization::detail {
namespace {

/// Exponent e such that value * 2^-e is an integer, for the smallest bit of a double; large for zero.
int lowest_exponent(double value) {
  if (value == 0) return std::numeric_limits<int>::max();
  int exponent = 0;
  std::frexp(value, &exponent);
  return exponent - 53;
}

mpz_class scaled_integer(double value, int exponent) {
  if (value == 0) return 0;
  int own = 0;
  const mpz_class significand(std::ldexp(std::frexp(value, &own), 53));
  return significand << static_cast<mp_bitcnt_t>(own - 53 - exponent);
}

/// Two triangles seen along r in integers: x = p_i |r_k| - H r_i and likewise y, heights H, all scaled by
/// powers of two.
struct IntegerTriangle {
  std::array<mpz_class, 3> x, y, h;
};

/// Projects triangles along r, in integers that have one scale for all of them.
class IntegerProjection {
 public:
  IntegerProjection(std::initializer_list<const TreeTriangle*> triangles, const Shear& shear)
      : shear_(shear) {
    constexpr int none = std::numeric_limits<int>::max();
    int r_exponent = none;
    point_exponent_ = none;
    for (const TreeTriangle* triangle : triangles)
      for (const auto& corner : triangle->corners)
        for (const double coordinate : corner)
          point_exponent_ = std::min(point_exponent_, lowest_exponent(coordinate));
    if (point_exponent_ == none) point_exponent_ = 0;
    for (int axis = 0; axis < 3; ++axis) r_exponent = std::min(r_exponent, lowest_exponent(shear.r[axis]));
    rk_ = scaled_integer(std::abs(shear.r[shear.k]), r_exponent);
    ri_ = scaled_integer(shear.r[shear.i], r_exponent);
    rj_ = scaled_integer(shear.r[shear.j], r_exponent);
  }

  IntegerTriangle operator()(const TreeTriangle& source) const {
    IntegerTriangle result;
    for (int c = 0; c < 3; ++c) {
      const auto& corner = source.corners[c];
      result.h[c] = scaled_integer(shear_.sign * corner[shear_.k], point_exponent_);
      result.x[c] = scaled_integer(corner[shear_.i], point_exponent_) * rk_ - result.h[c] * ri_;
      result.y[c] = scaled_integer(corner[shear_.j], point_exponent_) * rk_ - result.h[c] * rj_;
    }
    return result;
  }

  /// Heights are integers times two to this power.
  int point_exponent() const { return point_exponent_; }

 private:
  const Shear& shear_;
  int point_exponent_;
  mpz_class ri_, rj_, rk_;
};

mpz_class orientation(const IntegerTriangle& a, int p, int q, const IntegerTriangle& b, int s) {
  return (a.x[q] - a.x[p]) * (b.y[s] - a.y[p]) - (a.y[q] - a.y[p]) * (b.x[s] - a.x[p]);
}

/// A point of a triangle: weights / denominator over the corners.
struct Weights {
  std::array<mpz_class, 3> corner;
  mpz_class denominator;

  friend bool operator==(const Weights& a, const Weights& b) {
    for (std::size_t i = 0; i < 3; ++i)
      if (a.corner[i] * b.denominator != b.corner[i] * a.denominator) return false;
    return true;
  }
};

struct Candidate {
  Weights upper, lower;

  friend bool operator==(const Candidate&, const Candidate&) = default;
};

/// Whether candidates that only equal the best one are kept.
enum class Ties { dropped, kept };

Weights at_corner(int v) {
  Weights weights{{0, 0, 0}, 1};
  weights.corner[v] = 1;
  return weights;
}

/// The point (1 - t) from + t to with t = numerator / denominator, denominator != 0.
Weights on_edge(int from, int to, const mpz_class& numerator, const mpz_class& denominator) {
  Weights weights{{0, 0, 0}, denominator};
  weights.corner[from] = denominator - numerator;
  weights.corner[to] = numerator;
  return weights;
}

class ExactPair {
 public:
  ExactPair(const TreeTriangle& upper, const TreeTriangle& lower, const Shear& shear,
            Ties ties = Ties::dropped)
      : upper_source_(upper), lower_source_(lower), shear_(shear), keep_ties_(ties == Ties::kept) {
    const IntegerProjection projection({&upper, &lower}, shear);
    point_exponent_ = projection.point_exponent();
    upper_ = projection(upper);
    lower_ = projection(lower);
    compute_sides(upper_, lower_, of_upper_edges_, upper_area_);
    compute_sides(lower_, upper_, of_lower_edges_, lower_area_);
  }

  /// False when there are no common columns.
  bool maximise(ContactSemantics semantics) {
    if (semantics == ContactSemantics::solid && !interiors_meet()) return false;
    take_corners_inside();
    for (int e = 0; e < 3; ++e)
      for (int f = 0; f < 3; ++f) take_edges(e, f);
    return best_.has_value();
  }

  /// Precondition for this and `points`: `maximise` returned true.
  Rational value() const {
    mpq_class value(best_numerator_, best_denominator_);
    value.canonicalize();
    if (point_exponent_ >= 0) {
      value <<= static_cast<mp_bitcnt_t>(point_exponent_);
    } else {
      value >>= static_cast<mp_bitcnt_t>(-point_exponent_);
    }
    value /= mpq_class(std::abs(shear_.r[shear_.k]));
    return Rational(Rational::Number{value});
  }

  ExactPoints points() const { return points(*best_); }

  /// Of the best candidate and of all that equal it.
  std::vector<ExactPoints> all_points() const {
    std::vector<ExactPoints> all = {points()};
    for (std::size_t i = 0; i < ties_.size(); ++i)
      if (ties_[i] != *best_ && std::find(ties_.begin(), ties_.begin() + i, ties_[i]) == ties_.begin() + i)
        all.push_back(points(ties_[i]));
    return all;
  }

 private:
  using IntegerSides = std::array<std::array<mpz_class, 3>, 3>;

  static void compute_sides(const IntegerTriangle& base, const IntegerTriangle& other, IntegerSides& sides,
                            mpz_class& area) {
    area = orientation(base, 0, 1, base, 2);
    const int sign = sgn(area) < 0 ? -1 : 1;
    for (int e = 0; e < 3; ++e)
      for (int v = 0; v < 3; ++v) sides[e][v] = sign * orientation(base, (e + 1) % 3, (e + 2) % 3, other, v);
    area = abs(area);
  }

  static bool separates(const std::array<mpz_class, 3>& edge) {
    return sgn(edge[0]) <= 0 && sgn(edge[1]) <= 0 && sgn(edge[2]) <= 0;
  }

  /// Two triangles with area have disjoint interiors exactly if a line along an edge separates them.
  bool interiors_meet() const {
    if (sgn(upper_area_) == 0 || sgn(lower_area_) == 0) return false;
    return std::none_of(of_upper_edges_.begin(), of_upper_edges_.end(), separates) &&
           std::none_of(of_lower_edges_.begin(), of_lower_edges_.end(), separates);
  }

  static mpz_class height_numerator(const Weights& weights, const IntegerTriangle& triangle) {
    return weights.corner[0] * triangle.h[0] + weights.corner[1] * triangle.h[1] +
           weights.corner[2] * triangle.h[2];
  }

  /// Fractions are compared by cross multiplication: reducing each to lowest terms would cost more than all
  /// else.
  void take(Weights upper, Weights lower) {
    mpz_class numerator = height_numerator(upper, upper_) * lower.denominator;
    numerator -= height_numerator(lower, lower_) * upper.denominator;
    mpz_class denominator = upper.denominator * lower.denominator;
    if (sgn(denominator) < 0) {
      numerator = -numerator;
      denominator = -denominator;
    }
    if (best_) {
      const int order = cmp(numerator * best_denominator_, best_numerator_ * denominator);
      if (order == 0 && keep_ties_) ties_.push_back({std::move(upper), std::move(lower)});
      if (order <= 0) return;
    }
    ties_.clear();
    best_numerator_ = std::move(numerator);
    best_denominator_ = std::move(denominator);
    best_ = Candidate{std::move(upper), std::move(lower)};
  }

  static bool inside(const IntegerSides& sides, int v) {
    return sgn(sides[0][v]) >= 0 && sgn(sides[1][v]) >= 0 && sgn(sides[2][v]) >= 0;
  }

  void take_corners_inside() {
    for (int v = 0; v < 3; ++v) {
      if (sgn(lower_area_) != 0 && inside(of_lower_edges_, v))
        take(at_corner(v),
             {{of_lower_edges_[0][v], of_lower_edges_[1][v], of_lower_edges_[2][v]}, lower_area_});
      if (sgn(upper_area_) != 0 && inside(of_upper_edges_, v))
        take({{of_upper_edges_[0][v], of_upper_edges_[1][v], of_upper_edges_[2][v]}, upper_area_},
             at_corner(v));
    }
  }

  /// Edge e of the upper and f of the lower triangle, as closed segments in projection.
  void take_edges(int e, int f) {
    const int a = (e + 1) % 3, b = (e + 2) % 3, c = (f + 1) % 3, d = (f + 2) % 3;
    const mpz_class& sa = of_lower_edges_[f][a];
    const mpz_class& sb = of_lower_edges_[f][b];
    const mpz_class& sc = of_upper_edges_[e][c];
    const mpz_class& sd = of_upper_edges_[e][d];
    if (sgn(sa) * sgn(sb) > 0 || sgn(sc) * sgn(sd) > 0) return;
    if (sa != sb && sc != sd) {
      take(on_edge(a, b, sa, sa - sb), on_edge(c, d, sc, sc - sd));
    } else if (sgn(sa) == 0 && sgn(sb) == 0 && sgn(sc) == 0 && sgn(sd) == 0) {
      take_collinear(a, b, c, d);
    }
  }

  /// Segments on one line (either may be a point): the common region ends at corners of one of them.
  void take_collinear(int a, int b, int c, int d) {
    for (const int v : {a, b})
      for (Weights& weights : locate(upper_, v, lower_, c, d)) take(at_corner(v), std::move(weights));
    for (const int v : {c, d})
      for (Weights& weights : locate(lower_, v, upper_, a, b)) take(std::move(weights), at_corner(v));
  }

  /// Points of segment p q over corner v of `from`: none, one, or both ends if the segment projects to a
  /// point.
  static std::vector<Weights> locate(const IntegerTriangle& from, int v, const IntegerTriangle& base, int p,
                                     int q) {
    const auto& along = base.x[p] != base.x[q] ? base.x : base.y;
    const auto& coordinate = base.x[p] != base.x[q] ? from.x : from.y;
    if (along[p] == along[q]) {
      if (from.x[v] != base.x[p] || from.y[v] != base.y[p]) return {};
      return {at_corner(p), at_corner(q)};
    }
    mpz_class numerator = coordinate[v] - along[p], denominator = along[q] - along[p];
    if (denominator < 0) {
      numerator = -numerator;
      denominator = -denominator;
    }
    if (sgn(numerator) < 0 || numerator > denominator) return {};
    return {on_edge(p, q, numerator, denominator)};
  }

  ExactPoints points(const Candidate& candidate) const {
    return {point(candidate.upper, upper_source_), point(candidate.lower, lower_source_)};
  }

  static Eigen::Vector3d point(const Weights& weights, const TreeTriangle& source) {
    Eigen::Vector3d result;
    for (int axis = 0; axis < 3; ++axis) {
      mpq_class sum = 0;
      for (int c = 0; c < 3; ++c) sum += mpq_class(source.corners[c][axis]) * weights.corner[c];
      sum /= weights.denominator;
      result[axis] = Rational(Rational::Number{sum}).to_double();
    }
    return result;
  }

  const TreeTriangle& upper_source_;
  const TreeTriangle& lower_source_;
  const Shear& shear_;
  bool keep_ties_;
  int point_exponent_ = 0;
  IntegerTriangle upper_, lower_;
  IntegerSides of_upper_edges_, of_lower_edges_;
  mpz_class upper_area_, lower_area_;
  std::optional<Candidate> best_;
  std::vector<Candidate> ties_;                  ///< others with the same height difference
  mpz_class best_numerator_, best_denominator_;  ///< height difference in scaled integers; denominator > 0
};

}  // namespace

std::optional<Rational> exact_maximum(const TreeTriangle& upper, const TreeTriangle& lower,
                                      const Shear& shear, ContactSemantics semantics) {
  ExactPair pair(upper, lower, shear);
  if (!pair.maximise(semantics)) return std::nullopt;
  return pair.value();
}

std::optional<ExactMaximum> exact_maximum_with_points(const TreeTriangle& upper, const TreeTriangle& lower,
                                                      const Shear& shear, ContactSemantics semantics) {
  ExactPair pair(upper, lower, shear, Ties::kept);
  if (!pair.maximise(semantics)) return std::nullopt;
  return ExactMaximum{pair.value(), pair.all_points()};
}

bool is_edge_on(const TreeTriangle& triangle, const Shear& shear) {
  const IntegerTriangle seen = IntegerProjection({&triangle}, shear)(triangle);
  return sgn(orientation(seen, 0, 1, seen, 2)) == 0;
}

ExactPoints exact_points(const TreeTriangle& upper, const TreeTriangle& lower, const Shear& shear,
                         ContactSemantics semantics) {
  ExactPair pair(upper, lower, shear);
  pair.maximise(semantics);
  return pair.points();
}

}  // namespace stackabilization::detail
