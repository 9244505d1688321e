#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "mesh/moments.h"
#include "support/catch.h"
#include "support/point_sets.h"
#include "support/solids.h"

namespace stackabilization::moments_test {

using namespace detail;
using std::numbers::pi;

namespace {

/// Integral of x^i y^j z^k over a surface in closed form.
using Integral = std::function<double(int, int, int)>;

/// Visits all exponents in the order of Moments::monomials: by degree, then falling in x, then in y.
template <typename Visit>
void each_monomial(const Visit& visit) {
  std::size_t row = 0;
  for (int degree = 0; degree <= 4; ++degree)
    for (int i = degree; i >= 0; --i)
      for (int j = degree - i; j >= 0; --j) visit(row++, i, j, degree - i - j);
}

Moments moments_of(const Shape& shape) {
  Moments sum;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const Eigen::Vector3d a = shape.corner(t, 0), b = shape.corner(t, 1), c = shape.corner(t, 2);
    sum += triangle_moments({a, b, c}, (b - a).cross(c - a).normalized());
  }
  return sum;
}

Moments moments_of(const Integral& integral, const Eigen::Matrix3d& normals) {
  Moments moments;
  each_monomial([&](std::size_t row, int i, int j, int k) { moments.monomials[row] = integral(i, j, k); });
  moments.normals = normals;
  return moments;
}

void check_monomials(const Moments& moments, const Integral& integral) {
  each_monomial([&](std::size_t row, int i, int j, int k) {
    INFO("x^" << i << " y^" << j << " z^" << k);
    CHECK(moments.monomials[row] == Approx(integral(i, j, k)).epsilon(1e-12).margin(1e-13));
  });
}

double factorial(int n) {
  return std::tgamma(n + 1.0);
}

/// Integral of t^n from low to high.
double power_integral(int n, double low, double high) {
  return (std::pow(high, n + 1) - std::pow(low, n + 1)) / (n + 1);
}

/// Integral of the monomial with these exponents over the unit circle (two) or the unit sphere (three).
double round_integral(std::initializer_list<int> exponents) {
  double product = 2, sum = 0;
  for (const int e : exponents) {
    if (e % 2 != 0) return 0;
    product *= std::tgamma((e + 1) / 2.0);
    sum += (e + 1) / 2.0;
  }
  return product / std::tgamma(sum);
}

Moments sphere(double radius) {
  return moments_of(
      [=](int i, int j, int k) {
        return std::pow(radius, i + j + k + 2) * round_integral({i, j, k});
      },
      4 * pi * radius * radius / 3 * Eigen::Matrix3d::Identity());
}

/// Without caps, around the z axis.
Moments cylinder(double radius, double low, double high) {
  const double half_area = pi * radius * (high - low);
  return moments_of(
      [=](int i, int j, int k) {
        return std::pow(radius, i + j + 1) * round_integral({i, j}) * power_integral(k, low, high);
      },
      Eigen::Vector3d(half_area, half_area, 0).asDiagonal());
}

Shape moved(Shape shape, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& shift) {
  shape.vertices = point_sets::moved(shape.vertices, rotation, shift);
  return shape;
}

}  // namespace

TEST_CASE("monomials over a triangle on the axes are products of factorials") {
  // x = a u, y = b v, z = c w with barycentric u, v, w.
  const Eigen::Vector3d size(0.75, -0.5, 1.25);
  const std::array<Eigen::Vector3d, 3> corners = {
      Eigen::Vector3d(size.x(), 0, 0), Eigen::Vector3d(0, size.y(), 0), Eigen::Vector3d(0, 0, size.z())};
  const Eigen::Vector3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double area = across.norm() / 2;
  const Moments moments = triangle_moments(corners, across.normalized());
  check_monomials(moments, [&](int i, int j, int k) {
    return std::pow(size.x(), i) * std::pow(size.y(), j) * std::pow(size.z(), k) * 2 * area * factorial(i) *
           factorial(j) * factorial(k) / factorial(i + j + k + 2);
  });
  CHECK(moments.area() == Approx(area).epsilon(1e-14));
  CHECK(moments.normals.isApprox(across * across.transpose() / (4 * area), 1e-14));
}

TEST_CASE("monomials over a box are sums of products over its faces") {
  const Eigen::Vector3d low(-0.5, 0.25, -1), high(1, 0.75, 0.125);
  const Moments moments = moments_of(solids::box(low, high));
  const Integral closed_form = [&](int i, int j, int k) {
    const std::array<int, 3> exponent = {i, j, k};
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto integral = [&](std::size_t other) {
        const auto row = static_cast<Eigen::Index>(other % 3);
        return power_integral(exponent[other % 3], low(row), high(row));
      };
      const auto row = static_cast<Eigen::Index>(axis);
      sum += (std::pow(low(row), exponent[axis]) + std::pow(high(row), exponent[axis])) * integral(axis + 1) *
             integral(axis + 2);
    }
    return sum;
  };
  check_monomials(moments, closed_form);
  CHECK((moments.first() - Eigen::Vector3d(closed_form(1, 0, 0), closed_form(0, 1, 0), closed_form(0, 0, 1)))
            .norm() < 1e-13);
  const Eigen::Matrix3d second = moments.second();
  CHECK(second(0, 1) == Approx(closed_form(1, 1, 0)).epsilon(1e-12));
  CHECK(second(1, 2) == Approx(closed_form(0, 1, 1)).epsilon(1e-12));
  CHECK(second(2, 2) == Approx(closed_form(0, 0, 2)).epsilon(1e-12));
  CHECK(second.isApprox(second.transpose(), 1e-15));
}

TEST_CASE("moments do not depend on how a surface is cut") {
  point_sets::Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d a = random.vector(1), b = random.vector(1), c = random.vector(1);
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    const double u = random.uniform(0, 1), v = random.uniform(0, 1 - u);
    const Eigen::Vector3d middle = a + u * (b - a) + v * (c - a);
    Moments pieces = triangle_moments({a, b, middle}, normal);
    pieces += triangle_moments({b, c, middle}, normal);
    pieces += triangle_moments({c, a, middle}, normal);
    const Moments whole = triangle_moments({a, b, c}, normal);
    check_monomials(pieces, [&](int i, int j, int k) {
      double value = 0;
      each_monomial([&](std::size_t row, int x, int y, int z) {
        if (x == i && y == j && z == k) value = whole.monomials[row];
      });
      return value;
    });
    CHECK(pieces.normals.isApprox(whole.normals, 1e-12));
  }
}

TEST_CASE("a triangle without area has no moments") {
  const Eigen::Vector3d a(1, 2, 3), b(2, 4, 6);
  const Moments moments = triangle_moments({a, b, (a + b) / 2}, Eigen::Vector3d::UnitX());
  check_monomials(moments, [](int, int, int) { return 0; });
  CHECK(plane_error(moments) == 0);
  CHECK(plane_error(Moments{}) == 0);
}

TEST_CASE("the plane error of a box is the least second moment of its surface") {
  // Along an edge of length e with sides f and g: 2 f g e^2 / 4 on the two faces across, (2 e f + 2 e g) e^2
  // / 12 on the others.
  const Eigen::Vector3d size(1, 0.5, 0.25);
  double expected = std::numeric_limits<double>::infinity();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double e = size(axis), f = size((axis + 1) % 3), g = size((axis + 2) % 3);
    expected = std::min(expected, e * e * (f * g / 2 + e * (f + g) / 6));
  }
  point_sets::Random random(7);
  for (int trial = 0; trial < 10; ++trial) {
    const Shape box = moved(solids::box(size), random.rotation(), random.vector(0.5));
    CHECK(plane_error(moments_of(box)) == Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("a sphere fits itself, and two about one centre by the difference of their squared radii") {
  for (const double radius : {0.25, 1.0}) {
    CHECK(sphere_error(sphere(radius)) == Approx(0).margin(1e-12));
    CHECK(plane_error(sphere(radius)) == Approx(4 * pi / 3 * std::pow(radius, 4)).epsilon(1e-12));
  }
  const double r = 0.8, s = 0.5, outer = 4 * pi * r * r, inner = 4 * pi * s * s;
  Moments both = sphere(r);
  both += sphere(s);
  const double variance = outer * inner / (outer + inner) * std::pow(r * r - s * s, 2);
  const double squared_radius = (outer * r * r + inner * s * s) / (outer + inner);
  CHECK(sphere_error(both) == Approx(variance / (4 * squared_radius)).epsilon(1e-10));
}

TEST_CASE("a cylinder fits itself, and two about one axis by the difference of their squared radii") {
  CHECK(cylinder_error(cylinder(0.5, -0.75, 0.25)) == Approx(0).margin(1e-12));
  CHECK(sphere_error(cylinder(0.5, -0.75, 0.25)) > 1e-3);
  const double r = 0.7, s = 0.4, height = 1, outer = 2 * pi * r * height, inner = 2 * pi * s * height;
  Moments both = cylinder(r, -0.25, 0.75);
  both += cylinder(s, -0.25, 0.75);
  const double variance = outer * inner / (outer + inner) * std::pow(r * r - s * s, 2);
  const double squared_radius = (outer * r * r + inner * s * s) / (outer + inner);
  CHECK(cylinder_error(both) == Approx(variance / (4 * squared_radius)).epsilon(1e-10));
}

TEST_CASE("errors of fits do not depend on the pose, and grow with the fourth power of the size") {
  const Shape body = solids::frustum_shell({0.3, 0.4, 0.25, 0.35, 0.8, 0.05, 24});
  const Moments at_rest = moments_of(body);
  point_sets::Random random(11);
  for (int trial = 0; trial < 10; ++trial) {
    const double size = random.uniform(0.5, 1);
    Shape other = moved(body, random.rotation(), random.vector(0.3));
    other.vertices *= size;
    const Moments moments = moments_of(other);
    const double factor = std::pow(size, 4);
    CHECK(plane_error(moments) == Approx(factor * plane_error(at_rest)).epsilon(1e-8));
    CHECK(sphere_error(moments) == Approx(factor * sphere_error(at_rest)).epsilon(1e-7));
    CHECK(cylinder_error(moments) == Approx(factor * cylinder_error(at_rest)).epsilon(1e-7));
  }
}

TEST_CASE("a flat piece has no sphere and no cylinder") {
  const std::array<Eigen::Vector3d, 3> corners = {Eigen::Vector3d(0, 0, 0.5), Eigen::Vector3d(1, 0, 0.5),
                                                  Eigen::Vector3d(0, 1, 0.5)};
  const Moments flat = triangle_moments(corners, Eigen::Vector3d::UnitZ());
  CHECK(plane_error(flat) == Approx(0).margin(1e-15));
  CHECK(sphere_error(flat) == std::numeric_limits<double>::infinity());
  CHECK(cylinder_error(flat) == std::numeric_limits<double>::infinity());
}

}  // namespace stackabilization::moments_test
