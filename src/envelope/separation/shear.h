#pragma once

#include <Eigen/Core>
#include <cfloat>
#include <cmath>
#include <limits>

#include "stackabilization/core/direction.h"

namespace stackabilization::detail {

/// Half a unit in the last place of 1: the relative error of one rounded operation.
inline constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

#ifdef __FAST_MATH__
#error \
    "The error bounds of the filters and the exact differences need IEEE arithmetic: compile without -ffast-math."
#endif
static_assert(FLT_EVAL_METHOD == 0,
              "The filters need doubles that are rounded after every operation, as with SSE2.");

/// An unevaluated sum high + low of two doubles with |low| <= ulp(high) / 2: lexicographic order is numeric
/// order. The difference of two doubles is exactly representable, which lets equal heights tie exactly.
struct DoubleDouble {
  double high = 0, low = 0;

  friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high < b.high || (a.high == b.high && a.low <= b.low);
  }
};

/// Computes a - b exactly (Knuth's two-sum).
inline DoubleDouble exact_difference(double a, double b) {
  const double high = a - b;
  const double virtual_b = a - high;
  const double virtual_a = high + virtual_b;
  return {high, (a - virtual_a) + (virtual_b - b)};
}

/// A linear projection along r onto two of the file's axes. Instead of rotating the shape (which rounds), the
/// axis k on which |r| is largest serves as height: H(p) = sign(r_k) p_k is exact in the input, points on a
/// common line along r have equal (x, y) = (p_i - H r_i / |r_k|, p_j - H r_j / |r_k|), and a vertical
/// distance dH is dH / |r_k| in units of r.
struct Shear {
  int i, j, k;
  double sign;    ///< of r_k
  double sx, sy;  ///< r_i / |r_k|, r_j / |r_k|, rounded; |sx|, |sy| <= 1
  Eigen::Vector3d r;

  explicit Shear(const Direction& direction) : r(direction.vector()) {
    r.cwiseAbs().maxCoeff(&k);
    i = (k + 1) % 3;
    j = (k + 2) % 3;
    sign = r[k] > 0 ? 1 : -1;
    sx = r[i] / std::abs(r[k]);
    sy = r[j] / std::abs(r[k]);
  }

  double height(const double* p) const { return sign * p[k]; }
  double x(const double* p) const { return p[i] - height(p) * sx; }
  double y(const double* p) const { return p[j] - height(p) * sy; }

  /// Bounds on |computed - exact| of x and y for points with |coordinates| <= magnitude; zero where no
  /// rounding occurs. sx carries one rounding, the product and the difference one each, of numbers up to
  /// magnitude, magnitude and 2 magnitude: 4 unit roundoffs and a margin.
  double x_error(double magnitude) const { return r[i] == 0 ? 0 : 6 * unit_roundoff * magnitude; }
  double y_error(double magnitude) const { return r[j] == 0 ? 0 : 6 * unit_roundoff * magnitude; }
};

}  // namespace stackabilization::detail
