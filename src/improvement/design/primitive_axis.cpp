#include "improvement/design/primitive_axis.h"

#include <algorithm>
#include <limits>

#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

struct Segment {
  Eigen::Vector3d start, along;

  Eigen::Vector3d at(double t) const { return start + t * along; }
};

Segment segment(const Points& curve, Eigen::Index i) {
  return {curve.row(i).transpose(), (curve.row(i + 1) - curve.row(i)).transpose()};
}

double distance(const Eigen::Vector3d& point, const Segment& segment) {
  const double squared_length = segment.along.squaredNorm();
  const double t = squared_length > 0 ? (point - segment.start).dot(segment.along) / squared_length : 0;
  return (point - segment.at(std::clamp(t, 0.0, 1.0))).norm();
}

/// The least distance is attained at an end of a segment, or at the closest points of the two lines if these
/// lie inside both segments. Every candidate is the distance of two points of the segments. So parallel
/// lines, whose closest points depend on rounding, do no harm.
double distance(const Segment& p, const Segment& q) {
  double least =
      std::min({distance(p.start, q), distance(p.at(1), q), distance(q.start, p), distance(q.at(1), p)});
  const Eigen::Vector3d between = p.start - q.start;
  const double pp = p.along.squaredNorm(), qq = q.along.squaredNorm(), pq = p.along.dot(q.along);
  const double p_between = p.along.dot(between), q_between = q.along.dot(between);
  const double determinant = pp * qq - pq * pq;
  if (determinant > 0) {
    const double s = (pq * q_between - qq * p_between) / determinant;
    const double t = (pp * q_between - pq * p_between) / determinant;
    if (s > 0 && s < 1 && t > 0 && t < 1) least = std::min(least, (p.at(s) - q.at(t)).norm());
  }
  return least;
}

Eigen::RowVector3d face_centre(const Cuboid& cuboid, int face) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const int corner : cuboid_face(face)) sum += cuboid.corners.row(corner);
  return sum / 4;
}

}  // namespace

int axis_of(const Primitive& primitive) {
  const auto* cuboid = std::get_if<Cuboid>(&primitive);
  if (cuboid == nullptr) return 0;
  const auto length = [&](int axis) {
    return (face_centre(*cuboid, 2 * axis + 1) - face_centre(*cuboid, 2 * axis)).norm();
  };
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (length(axis) > length(longest) * (1 + tolerance::relative)) longest = axis;
  return longest;
}

Points axis_curve(const Primitive& primitive, int axis) {
  if (const auto* cuboid = std::get_if<Cuboid>(&primitive)) {
    Points ends(2, 3);
    ends << face_centre(*cuboid, 2 * axis), face_centre(*cuboid, 2 * axis + 1);
    return ends;
  }
  const auto& cylinder = std::get<GeneralizedCylinder>(primitive);
  Points curve = cylinder.centres;
  if (cylinder.closed) {
    curve.conservativeResize(curve.rows() + 1, 3);
    curve.row(curve.rows() - 1) = curve.row(0);
  }
  return curve;
}

double curve_distance(const Points& a, const Points& b) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i + 1 < a.rows(); ++i) {
    const Segment p = segment(a, i);
    for (Eigen::Index j = 0; j + 1 < b.rows(); ++j) {
      const Segment q = segment(b, j);
      const double middles = (p.at(0.5) - q.at(0.5)).norm();
      const double reach = (p.along.norm() + q.along.norm()) / 2;
      if (middles - reach < least) least = std::min(least, distance(p, q));
    }
  }
  return least;
}

}  // namespace stackabilization::detail
