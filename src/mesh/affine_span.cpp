#include "mesh/affine_span.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point_at(const Points& points, Eigen::Index row) {
  return {points(row, 0), points(row, 1), points(row, 2)};
}

/// Returns at most four points, none of them in the flat that its predecessors span, by exact predicates.
class ExactSpan {
 public:
  explicit ExactSpan(const Points& points) : points_(points) {}

  int dimension() const { return static_cast<int>(size_) - 1; }
  void extend(Eigen::Index row) {
    if (enlarges(row)) basis_[size_++] = point_at(points_, row);
  }

 private:
  bool enlarges(Eigen::Index row) const {
    const Kernel::Point_3 p = point_at(points_, row);
    switch (size_) {
      case 0:
        return true;
      case 1:
        return p != basis_[0];
      case 2:
        return !CGAL::collinear(basis_[0], basis_[1], p);
      default:
        return size_ == 3 && !CGAL::coplanar(basis_[0], basis_[1], basis_[2], p);
    }
  }

  const Points& points_;
  std::array<Kernel::Point_3, 4> basis_;
  std::size_t size_ = 0;
};

/// Rows of points, each far from the span of its predecessors. In most cases the first four decide.
int exact_dimension(const Points& points, const std::array<Eigen::Index, 4>& far_rows) {
  ExactSpan span(points);
  for (const Eigen::Index row : far_rows) span.extend(row);
  for (Eigen::Index row = 0; row < points.rows() && span.dimension() < 3; ++row) span.extend(row);
  return span.dimension();
}

}  // namespace

int working_exponent(const Points& points) {
  const double largest = points.cwiseAbs().maxCoeff();
  if (largest == 0 || (largest >= tolerance::min_shape_size && largest <= tolerance::max_coordinate))
    return 0;
  int exponent = 0;
  std::frexp(largest, &exponent);
  return -exponent;
}

Points scaled_by_power(const Points& points, int exponent) {
  return points.unaryExpr([exponent](double x) { return std::ldexp(x, exponent); });
}

int affine_dimension(const Points& points) {
  return exact_dimension(points, {0, 0, 0, 0});
}

AffineSpan affine_span(const Points& points, double resolution) {
  if (const int exponent = working_exponent(points); exponent != 0) {
    AffineSpan span = affine_span(scaled_by_power(points, exponent), std::ldexp(resolution, exponent));
    span.origin = points.row(0).transpose();
    return span;
  }
  // Shorter ones have squares that underflow.
  const double negligible = std::max(resolution, std::ldexp(1.0, -500));
  AffineSpan span;
  std::array<Eigen::Index, 4> far_rows{};
  span.origin = points.row(0).transpose();
  const Points offsets = points.rowwise() - points.row(0);
  if (offsets.rowwise().norm().maxCoeff(&far_rows[1]) <= negligible) return span;
  span.axis = offsets.row(far_rows[1]).transpose().normalized();
  span.dimension = 1;
  const Points across = offsets - (offsets * span.axis) * span.axis.transpose();
  if (across.rowwise().norm().maxCoeff(&far_rows[2]) <= negligible) return span;
  const Eigen::Vector3d normal = span.axis.cross(across.row(far_rows[2]).transpose()).normalized();
  const double thickness = (offsets * normal).cwiseAbs().maxCoeff(&far_rows[3]);
  // A point that rounding lifts off a line or a plane still belongs to it.
  span.dimension = std::min(thickness <= negligible ? 2 : 3, exact_dimension(points, far_rows));
  if (normal.isZero(0)) span.dimension = 1;
  if (span.dimension > 1) span.normal = normal;
  return span;
}

}  // namespace stackabilization
