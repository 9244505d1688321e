#include "stackabilization/structure/primitive.h"

#include <cmath>
#include <numbers>
#include <type_traits>

#include "mesh/surface_moments.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

/// Tangents, arc lengths and frusta all walk the pieces of the curve: piece i runs from section i to the next
/// one.
Eigen::Index piece_count(const GeneralizedCylinder& cylinder) {
  return cylinder.centres.rows() - (cylinder.closed ? 0 : 1);
}

Eigen::Vector3d piece(const GeneralizedCylinder& cylinder, Eigen::Index i) {
  const Eigen::Index n = cylinder.centres.rows();
  return (cylinder.centres.row((i + 1) % n) - cylinder.centres.row(i % n)).transpose();
}

double volume_of(const GeneralizedCylinder& cylinder) {
  double sum = 0;
  for (Eigen::Index i = 0; i < piece_count(cylinder); ++i) {
    const double a = cylinder.radii(i), b = cylinder.radii((i + 1) % cylinder.radii.size());
    sum += piece(cylinder, i).norm() * (a * a + a * b + b * b);
  }
  return std::numbers::pi / 3 * sum;
}

double volume_of(const Cuboid& cuboid) {
  const Eigen::Vector3d origin = cuboid.corners.colwise().mean();
  double twofold = 0;
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> ring = cuboid_face(face);
    for (int k = 0; k < 4; ++k) {
      const auto corner = [&](int i) -> Eigen::Vector3d {
        return cuboid.corners.row(ring[static_cast<std::size_t>((k + i) % 4)]).transpose() - origin;
      };
      // The four triangles of three successive corners cover the face twice, once per diagonal.
      twofold += detail::signed_volume(corner(0), corner(1), corner(2));
    }
  }
  return twofold / 2;
}

void check(bool holds, const std::string& name, const std::string& what) {
  if (!holds) throw InputError("the primitive of part '" + name + "' " + what);
}

void validate_one(const Cuboid& cuboid, const std::string& name) {
  check(cuboid.corners.allFinite(), name, "has a corner that is not finite");
  const double longest =
      (cuboid.corners.colwise().maxCoeff() - cuboid.corners.colwise().minCoeff()).maxCoeff();
  const double rounding = tolerance::product_rounding * std::pow(longest, 3);
  check(std::abs(volume_of(cuboid)) > rounding, name, "has no volume");
  check(cuboid.inner_sides.minCoeff() > 0 && cuboid.inner_sides.maxCoeff() <= 1, name,
        "has walls that do not begin between its centre and its faces");
}

void validate_one(const GeneralizedCylinder& cylinder, const std::string& name) {
  const Eigen::Index n = cylinder.centres.rows();
  check(n >= (cylinder.closed ? 3 : 2), name, "has too few cross-sections");
  check(cylinder.radii.size() == n, name, "needs one radius per cross-section");
  check(cylinder.centres.allFinite() && cylinder.radii.allFinite(), name, "has a number that is not finite");
  check(cylinder.radii.minCoeff() > 0, name, "has a radius that is not positive");
  check(cylinder.inner_radii.size() == 0 ||
            (cylinder.inner_radii.size() == n && cylinder.inner_radii.allFinite() &&
             cylinder.inner_radii.minCoeff() >= 0),
        name, "has inner radii that are not one per cross-section, from 0 on");
  for (Eigen::Index i = 0; i < piece_count(cylinder); ++i)
    check(piece(cylinder, i).norm() > 0, name, "has two neighbouring cross-sections at one place");
  check(cylinder.rotation.coeffs().allFinite() && cylinder.rotation.norm() > 0, name, "has no rotation");
}

}  // namespace

Cuboid cuboid_of(const OrientedBox& box) {
  Cuboid cuboid;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d sign((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    cuboid.corners.row(k) = (box.centre + box.axes * sign.cwiseProduct(box.half_extents)).transpose();
  }
  return cuboid;
}

std::array<int, 4> cuboid_face(int face) {
  const int a = face / 2, b = (a + 1) % 3, c = (a + 2) % 3;
  const int base = (face % 2) << a;
  if (face % 2 == 1) return {base, base | 1 << b, base | 1 << b | 1 << c, base | 1 << c};
  return {base, base | 1 << c, base | 1 << b | 1 << c, base | 1 << b};
}

Points section_tangents(const GeneralizedCylinder& cylinder) {
  const Eigen::Index n = cylinder.centres.rows();
  Points tangents(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool first = i == 0 && !cylinder.closed, last = i == n - 1 && !cylinder.closed;
    const Eigen::Index before = first ? i : (i + n - 1) % n, after = last ? i : (i + 1) % n;
    const Eigen::RowVector3d chord = cylinder.centres.row(after) - cylinder.centres.row(before);
    // At a hairpin turn the chord vanishes; the piece after the turn replaces it.
    tangents.row(i) = chord.norm() > 0 ? chord.normalized() : piece(cylinder, i).transpose().normalized();
  }
  return tangents;
}

Eigen::VectorXd section_arc_lengths(const GeneralizedCylinder& cylinder) {
  Eigen::VectorXd lengths(piece_count(cylinder) + 1);
  lengths(0) = 0;
  for (Eigen::Index i = 0; i < piece_count(cylinder); ++i)
    lengths(i + 1) = lengths(i) + piece(cylinder, i).norm();
  return lengths;
}

Points control_points(const Primitive& primitive) {
  if (const auto* cuboid = std::get_if<Cuboid>(&primitive)) return cuboid->corners;
  return std::get<GeneralizedCylinder>(primitive).centres;
}

double volume(const Primitive& primitive) {
  return std::visit([](const auto& one) { return volume_of(one); }, primitive);
}

void validate(const Primitive& primitive, const std::string& name) {
  std::visit([&](const auto& one) { validate_one(one, name); }, primitive);
}

}  // namespace stackabilization
