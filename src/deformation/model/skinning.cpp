#include "deformation/model/skinning.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stackabilization {

namespace {

/// Least radius of the inside of a hollow body, fraction of the one that scaling would give.
constexpr double min_hollow = 0.5;

Eigen::Vector3d row(const Points& points, Eigen::Index i) {
  return points.row(i).transpose();
}

/// Returns the tangent of section i alone, equal to that of section_tangents.
Eigen::Vector3d tangent(const GeneralizedCylinder& cylinder, int i) {
  const int n = static_cast<int>(cylinder.centres.rows());
  const int before = cylinder.closed ? (i + n - 1) % n : std::max(i - 1, 0);
  const int after = cylinder.closed ? (i + 1) % n : std::min(i + 1, n - 1);
  const Eigen::Vector3d chord = row(cylinder.centres, after) - row(cylinder.centres, before);
  if (chord.norm() > 0) return chord.normalized();
  return (row(cylinder.centres, after) - row(cylinder.centres, i)).normalized();
}

/// Returns the root in [0, 1] of the parabola through (0, first) and (1, last) with leading coefficient
/// `square`. Precondition: first >= 0 >= last.
double falling_root(double first, double last, double square) {
  const double linear = last - first - square;
  const double root = std::sqrt(std::max(linear * linear - 4 * square * first, 0.0));
  const double denominator = root - linear;
  return denominator > 0 ? std::clamp(2 * first / denominator, 0.0, 1.0) : 0;
}

}  // namespace

DualQuaternion dual_quaternion(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation) {
  const Eigen::Quaterniond half(0, translation.x() / 2, translation.y() / 2, translation.z() / 2);
  return {rotation, half * rotation};
}

Eigen::Vector3d blended(const DualQuaternion& a, const DualQuaternion& b, double fraction,
                        const Eigen::Vector3d& point) {
  const double to = a.real.dot(b.real) < 0 ? -fraction : fraction, from = 1 - fraction;
  const Eigen::Vector4d sum = from * a.real.coeffs() + to * b.real.coeffs();
  const double length = sum.norm();
  const Eigen::Vector4d real = sum / length, dual = (from * a.dual.coeffs() + to * b.dual.coeffs()) / length;
  const Eigen::Vector3d v = real.head<3>(), d = dual.head<3>();
  const double w = real(3), dw = dual(3);
  const Eigen::Vector3d turned = point + 2 * v.cross(v.cross(point) + w * point);
  return turned + 2 * (w * d - dw * v + v.cross(d));
}

Eigen::Quaterniond smallest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const double w = 1 + from.dot(to);
  const Eigen::Vector3d axis = from.cross(to);
  const Eigen::Quaterniond rotation(w, axis.x(), axis.y(), axis.z());
  if (rotation.norm() > 0) return rotation.normalized();
  const Eigen::Vector3d across = from.unitOrthogonal();
  return {0, across.x(), across.y(), across.z()};
}

CurveAtRest::CurveAtRest(GeneralizedCylinder cylinder)
    : cylinder_(std::move(cylinder)),
      tangents_(section_tangents(cylinder_)),
      origin_(cylinder_.centres.colwise().mean().transpose()) {}

int CurveAtRest::pieces() const {
  return static_cast<int>(cylinder_.centres.rows()) - (cylinder_.closed ? 0 : 1);
}

CurveBinding CurveAtRest::bound(int piece, double fraction, const Eigen::Vector3d& point) const {
  const int next = (piece + 1) % static_cast<int>(cylinder_.centres.rows());
  const Eigen::Vector3d a = row(cylinder_.centres, piece), b = row(cylinder_.centres, next);
  const Eigen::Vector3d axis = a + fraction * (b - a), offset = point - axis;
  CurveBinding binding{piece, next, fraction, axis - origin_, offset, Eigen::Vector3d::Zero()};
  const bool at_start = !cylinder_.closed && piece == 0 && fraction == 0;
  const bool at_end = !cylinder_.closed && piece == pieces() - 1 && fraction == 1;
  if (at_start || at_end) {
    const Eigen::Vector3d t = row(tangents_, at_start ? piece : next);
    binding.axial = t.dot(offset) * t;
    binding.radial = offset - binding.axial;
  }
  return binding;
}

CurveBinding CurveAtRest::bind(const Eigen::Vector3d& point) const {
  const int n = static_cast<int>(cylinder_.centres.rows());
  double nearest = std::numeric_limits<double>::infinity();
  int piece = 0;
  double fraction = 0;
  const auto consider = [&](int i, double u) {
    const Eigen::Vector3d a = row(cylinder_.centres, i), b = row(cylinder_.centres, (i + 1) % n);
    const double distance = (point - a - u * (b - a)).squaredNorm();
    if (distance < nearest) nearest = distance, piece = i, fraction = u;
  };
  const auto height = [&](int i) { return (point - row(cylinder_.centres, i)).dot(row(tangents_, i)); };
  for (int i = 0; i < pieces(); ++i) {
    const int next = (i + 1) % n;
    const double first = height(i), last = height(next);
    if (first < 0 || last > 0) continue;
    const Eigen::Vector3d along = row(cylinder_.centres, next) - row(cylinder_.centres, i);
    consider(i, falling_root(first, last, -along.dot(row(tangents_, next) - row(tangents_, i))));
  }
  if (!cylinder_.closed) {
    if (height(0) <= 0) consider(0, 0);
    if (height(n - 1) >= 0) consider(n - 2, 1);
  }
  // On a closed curve, rounding may make every plane miss the point: bind it to the nearest section then.
  if (nearest == std::numeric_limits<double>::infinity())
    for (int i = 0; i < pieces(); ++i) consider(i, 0);
  return bound(piece, fraction, point);
}

DualQuaternion CurveAtRest::motion(const GeneralizedCylinder& now, int i) const {
  const Eigen::Quaterniond whole = (now.rotation * cylinder_.rotation.inverse()).normalized();
  const Eigen::Quaterniond rotation = smallest_rotation(whole * row(tangents_, i), tangent(now, i)) * whole;
  return dual_quaternion(rotation,
                         row(now.centres, i) - origin_ - rotation * (row(cylinder_.centres, i) - origin_));
}

double CurveAtRest::radial_growth(const CurveBinding& binding, const GeneralizedCylinder& now) const {
  const auto between = [&](const Eigen::VectorXd& values) {
    return (1 - binding.fraction) * values(binding.from) + binding.fraction * values(binding.to);
  };
  const double rest = between(cylinder_.radii), growth = between(now.radii) / rest;
  const Eigen::VectorXd& inner_radii = cylinder_.inner_radii;
  if (inner_radii.size() == 0 || binding.radial.isZero(0)) return growth;
  // Between a solid section and one of the hollow body, points follow partly as in each of them.
  const double share = (inner_radii(binding.from) > 0 ? 1 - binding.fraction : 0) +
                       (inner_radii(binding.to) > 0 ? binding.fraction : 0);
  if (!(share > 0)) return growth;
  const double inner = between(inner_radii) / share, place = binding.radial.norm();
  const double change = between(now.radii) - rest;
  // A wall that is thicker than the new radius cannot keep its thickness.
  const double inner_change = std::max(change, (min_hollow * growth - 1) * inner);
  double moved = change;
  if (place <= inner)
    moved = inner_change * place / inner;
  else if (place < rest)
    moved = inner_change + (place - inner) / (rest - inner) * (change - inner_change);
  return growth + share * (1 + moved / place - growth);
}

Eigen::Vector3d CurveAtRest::position_of(const CurveBinding& binding, const GeneralizedCylinder& now,
                                         const DualQuaternion& from, const DualQuaternion& to) const {
  Eigen::Vector3d point = binding.axis + radial_growth(binding, now) * binding.radial;
  if (!binding.axial.isZero(0)) {
    const auto length = [&](const Points& centres) {
      return (centres.row(binding.to) - centres.row(binding.from)).norm();
    };
    point += length(now.centres) / length(cylinder_.centres) * binding.axial;
  }
  return origin_ + blended(from, to, binding.fraction, point);
}

}  // namespace stackabilization
