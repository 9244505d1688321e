#pragma once

#include <Eigen/Core>
#include <array>

/// Not installed.
namespace stackabilization::detail {

/// Integrals over a piece of surface of all monomials x^i y^j z^k up to degree four, and of normals: enough
/// for the least-squares plane, sphere and cylinder of a union in constant time.
struct Moments {
  std::array<double, 35> monomials{};
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();  ///< integral of n n^T

  Moments& operator+=(const Moments& other);
  double area() const { return monomials[0]; }
  Eigen::Vector3d first() const;
  Eigen::Matrix3d second() const;
};

/// Of a triangle with unit normal `normal`; exact up to rounding. A good range of coordinates is [-1, 1].
Moments triangle_moments(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal);

/// Integrals of the squared distance to the best plane, sphere and cylinder (Attene et al. 2006, section 3):
/// infinite where there is none. The plane's is exact; of spheres and cylinders, fitted algebraically (Kasa),
/// it is the algebraic residual divided by the squared length of its gradient. The cylinder's axis is the
/// direction the normals avoid most.
double plane_error(const Moments& moments);
double sphere_error(const Moments& moments);
double cylinder_error(const Moments& moments);

}  // namespace stackabilization::detail
