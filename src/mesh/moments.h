#pragma once

#include <Eigen/Core>
#include <array>

namespace stackabilization::detail {

/// Surface integrals of all monomials x^i y^j z^k up to degree four, and of the products of normals. They
/// suffice to compute the least-squares plane, sphere and cylinder of a union of surfaces in constant time.
struct Moments {
  /// Integrals of the monomials.
  std::array<double, 35> monomials{};
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();  ///< integral of n n^T

  Moments& operator+=(const Moments& other);
  double area() const { return monomials[0]; }
  /// Returns the integral of p.
  Eigen::Vector3d first() const;
  /// Returns the integral of p p^T.
  Eigen::Matrix3d second() const;
};

/// Computes the moments of a triangle with unit normal `normal`, exact up to rounding. Coordinates in [-1, 1]
/// give the best accuracy.
Moments triangle_moments(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal);

/// Computes the integral of the squared distance to the best plane (Attene et al. 2006, section 3). Exact up
/// to rounding.
double plane_error(const Moments& moments);
/// Computes the same for the best sphere, fitted algebraically (Kasa): the algebraic residual divided by the
/// squared length of its gradient. Infinite when there is none.
double sphere_error(const Moments& moments);
/// Computes the same for the best cylinder. Its axis is the eigenvector of the smallest eigenvalue of
/// `normals`. Infinite when there is none.
double cylinder_error(const Moments& moments);

}  // namespace stackabilization::detail
