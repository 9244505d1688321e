#include "mesh/moments.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "mesh/surface_moments.h"

namespace stackabilization::detail {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

struct Exponents {
  int x, y, z;
};

/// Exponents of the monomials in their order, and back.
struct MonomialOrder {
  std::array<Exponents, 35> exponents{};
  int row[5][5][5] = {};

  constexpr MonomialOrder() {
    int next = 0;
    for (int degree = 0; degree <= 4; ++degree)
      for (int x = degree; x >= 0; --x)
        for (int y = degree - x; y >= 0; --y) {
          exponents[static_cast<std::size_t>(next)] = {x, y, degree - x - y};
          row[x][y][degree - x - y] = next++;
        }
  }
};
constexpr MonomialOrder order;

/// Monomial that is the product of the given axes, such as (0, 0, 2) for x x z.
template <typename... Axes>
double moment(const Moments& m, Axes... axes) {
  int exponent[3] = {0, 0, 0};
  (++exponent[axes], ...);
  return m.monomials[static_cast<std::size_t>(order.row[exponent[0]][exponent[1]][exponent[2]])];
}

/// Integral of x |x|^2.
Eigen::Vector3d cubic(const Moments& m) {
  Eigen::Vector3d sum;
  for (int i = 0; i < 3; ++i) sum(i) = moment(m, i, 0, 0) + moment(m, i, 1, 1) + moment(m, i, 2, 2);
  return sum;
}

/// Integral of x x^T |x|^2.
Eigen::Matrix3d quartic(const Moments& m) {
  Eigen::Matrix3d sum;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      sum(i, j) = moment(m, i, j, 0, 0) + moment(m, i, j, 1, 1) + moment(m, i, j, 2, 2);
  return sum;
}

/// Integral of x (d . x)^2.
Eigen::Vector3d cubic_along(const Moments& m, const Eigen::Vector3d& d) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) sum(i) += d(j) * d(k) * moment(m, i, j, k);
  return sum;
}

/// Integral of (d . x)^4.
double quartic_along(const Moments& m, const Eigen::Vector3d& d) {
  constexpr double factorial[5] = {1, 1, 2, 6, 24};
  double sum = 0;
  for (int x = 0; x <= 4; ++x)
    for (int y = 0; x + y <= 4; ++y) {
      const int z = 4 - x - y;
      sum += factorial[4] / (factorial[x] * factorial[y] * factorial[z]) * std::pow(d.x(), x) *
             std::pow(d.y(), y) * std::pow(d.z(), z) *
             m.monomials[static_cast<std::size_t>(order.row[x][y][z])];
    }
  return sum;
}

/// Fits a circle (2 dimensions) or a sphere (3 dimensions) from the integrals of p p^T, p, p |p|^2, |p|^2 and
/// |p|^4: the minimum of the integral of (|p|^2 + g . p + c)^2.
template <int Dimension>
struct RoundFit {
  Eigen::Matrix<double, Dimension, Dimension> second;
  Eigen::Matrix<double, Dimension, 1> first, cubic;
  double area, quartic;

  double error() const {
    Eigen::Matrix<double, Dimension + 1, Dimension + 1> normal;
    normal << second, first, first.transpose(), area;
    Eigen::Matrix<double, Dimension + 1, 1> right;
    right << cubic, second.trace();
    const Eigen::FullPivLU<Eigen::Matrix<double, Dimension + 1, Dimension + 1>> solver(normal);
    if (solver.rank() <= Dimension) return none;
    const Eigen::Matrix<double, Dimension + 1, 1> solution = solver.solve(-right);
    const double squared_radius = solution.template head<Dimension>().squaredNorm() / 4 - solution(Dimension);
    if (!(squared_radius > 0)) return none;
    return std::max(0.0, quartic + right.dot(solution)) / (4 * squared_radius);
  }
};

}  // namespace

Moments& Moments::operator+=(const Moments& other) {
  for (std::size_t k = 0; k < monomials.size(); ++k) monomials[k] += other.monomials[k];
  normals += other.normals;
  return *this;
}

Eigen::Vector3d Moments::first() const {
  return {moment(*this, 0), moment(*this, 1), moment(*this, 2)};
}

Eigen::Matrix3d Moments::second() const {
  Eigen::Matrix3d sum;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum(i, j) = moment(*this, i, j);
  return sum;
}

Moments triangle_moments(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal) {
  // Six points, exact up to degree four (Strang and Fix 1973).
  constexpr double weight[2] = {0.223381589678011, 0.109951743655322};
  constexpr double near_edge = 0.091576213509771;
  constexpr double place[2] = {0.445948490915965, near_edge};
  Moments moments;
  const double area = area_vector(corners[0], corners[1], corners[2]).norm();
  for (int ring = 0; ring < 2; ++ring)
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d p =
          (1 - 2 * place[ring]) * corners[k] + place[ring] * (corners[(k + 1) % 3] + corners[(k + 2) % 3]);
      double power[3][5];
      for (int axis = 0; axis < 3; ++axis) {
        power[axis][0] = 1;
        for (int e = 1; e < 5; ++e) power[axis][e] = power[axis][e - 1] * p(axis);
      }
      for (std::size_t i = 0; i < moments.monomials.size(); ++i) {
        const Exponents e = order.exponents[i];
        moments.monomials[i] += area * weight[ring] * power[0][e.x] * power[1][e.y] * power[2][e.z];
      }
    }
  moments.normals = area * normal * normal.transpose();
  return moments;
}

double plane_error(const Moments& m) {
  if (!(m.area() > 0)) return 0;
  const Eigen::Vector3d centre = m.first() / m.area();
  const Eigen::Matrix3d spread = m.second() - m.area() * centre * centre.transpose();
  return std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>()
                           .computeDirect(spread, Eigen::EigenvaluesOnly)
                           .eigenvalues()(0));
}

double sphere_error(const Moments& m) {
  return RoundFit<3>{m.second(), m.first(), cubic(m), m.area(), quartic(m).trace()}.error();
}

double cylinder_error(const Moments& m) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> normals(m.normals);
  const Eigen::Vector3d axis = normals.eigenvectors().col(0);
  Eigen::Matrix<double, 2, 3> across;
  across << normals.eigenvectors().col(1).transpose(), normals.eigenvectors().col(2).transpose();
  const Eigen::Matrix3d fourth = quartic(m);
  return RoundFit<2>{across * m.second() * across.transpose(), across * m.first(),
                     across * (cubic(m) - cubic_along(m, axis)), m.area(),
                     fourth.trace() - 2 * axis.dot(fourth * axis) + quartic_along(m, axis)}
      .error();
}

}  // namespace stackabilization::detail
