#include "structure/segmentation/volume_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "stackabilization/structure/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// Largest |cosine| of the angle between the axis and a normal on the side of a solid of revolution.
constexpr double side_cosine = 0.7;

/// Largest share of the chords of a piece that run into a neighbouring part, such as from a table top down a
/// leg.
constexpr double deepest_share = 0.1;

class VolumeFit {
 public:
  VolumeFit(const std::vector<Chord>& chords, const std::vector<std::int32_t>& members) {
    for (const std::int32_t m : members) chords_.push_back(&chords[static_cast<std::size_t>(m)]);
  }

  double run() const {
    double best = none;
    for (const Eigen::Matrix3d& frame : frames()) {
      best = std::min(best, cuboid(frame));
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Matrix3d turned =
            (Eigen::Matrix3d() << frame.col((axis + 1) % 3), frame.col((axis + 2) % 3), frame.col(axis))
                .finished();
        best = std::min({best, revolution(turned), ring(turned)});
      }
    }
    return best;
  }

 private:
  std::vector<Eigen::Matrix3d> frames() const;
  double cuboid(const Eigen::Matrix3d& frame) const;
  double revolution(const Eigen::Matrix3d& frame) const;
  double ring(const Eigen::Matrix3d& frame) const;
  Eigen::Matrix3d dominant_frame() const;

  /// Returns the range of the piece along an axis: its surface and the solid behind all but the deepest
  /// chords on each side.
  Range span(const Eigen::Vector3d& axis) const;

  std::vector<const Chord*> chords_;
};

/// Right-handed frame whose first axis is `first` and second as near to `second` as can be.
Eigen::Matrix3d frame_along(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  Eigen::Matrix3d frame;
  frame.col(0) = first;
  frame.col(1) = (second - first * first.dot(second)).normalized();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

/// Candidate axes: the principal axes of the normals (the normals are orthogonal to the axis of a cylinder,
/// and parallel to the axes of a box), the principal axes of the solid, and for cubes the normals of the two
/// largest perpendicular faces.
std::vector<Eigen::Matrix3d> VolumeFit::frames() const {
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero(), spread = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double area = 0;
  for (const Chord* c : chords_) {
    area += c->area;
    centre += c->area / 2 * (c->start + c->end);
  }
  centre /= area;
  for (const Chord* c : chords_) {
    normals += c->area * c->normal * c->normal.transpose();
    for (const Eigen::Vector3d& p : {c->start, c->end})
      spread += c->area * (p - centre) * (p - centre).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of_normals(normals), of_spread(spread);
  return {of_normals.eigenvectors(), of_spread.eigenvectors(), dominant_frame()};
}

Eigen::Matrix3d VolumeFit::dominant_frame() const {
  constexpr double across = 0.3;  // cosine
  const auto support = [&](const Eigen::Vector3d& n) {
    double sum = 0;
    for (const Chord* c : chords_) sum += std::abs(n.dot(c->normal)) >= tolerance::same_face ? c->area : 0;
    return sum;
  };
  // Few directions are enough: large faces have many chords.
  const std::size_t step = std::max<std::size_t>(1, chords_.size() / 24);
  Eigen::Vector3d first = chords_[0]->normal;
  double most = -1;
  for (std::size_t k = 0; k < chords_.size(); k += step)
    if (const double s = support(chords_[k]->normal); s > most) most = s, first = chords_[k]->normal;
  Eigen::Vector3d second = first.unitOrthogonal();
  most = -1;
  for (std::size_t k = 0; k < chords_.size(); k += step) {
    if (std::abs(chords_[k]->normal.dot(first)) > across) continue;
    if (const double s = support(chords_[k]->normal); s > most) most = s, second = chords_[k]->normal;
  }
  return frame_along(first, second);
}

Range VolumeFit::span(const Eigen::Vector3d& axis) const {
  Range range{none, -none};
  std::vector<double> ends;
  for (const Chord* c : chords_) {
    const double start = axis.dot(c->start);
    range = {std::min(range.low, start), std::max(range.high, start)};
    ends.push_back(axis.dot(c->end));
  }
  const auto spared = static_cast<std::ptrdiff_t>(deepest_share * static_cast<double>(ends.size()));
  const auto low = ends.begin() + spared, high = ends.end() - 1 - spared;
  std::nth_element(ends.begin(), low, ends.end());
  range.low = std::min(range.low, *low);
  std::nth_element(low, high, ends.end());
  range.high = std::max(range.high, *high);
  return range;
}

double VolumeFit::cuboid(const Eigen::Matrix3d& frame) const {
  Eigen::Array3d low, high;
  for (int k = 0; k < 3; ++k) {
    const Range range = span(frame.col(k));
    low(k) = range.low;
    high(k) = range.high;
  }
  double sum = 0;
  for (const Chord* c : chords_) {
    const Eigen::Vector3d p = frame.transpose() * c->start, n = frame.transpose() * c->normal;
    double before = none, behind = none;  // length of the box along the chord, outward and inward
    for (int k = 0; k < 3; ++k) {
      if (n(k) == 0) continue;
      const double up = (high(k) - p(k)) / std::abs(n(k)), down = (p(k) - low(k)) / std::abs(n(k));
      before = std::min(before, n(k) > 0 ? up : down);
      behind = std::min(behind, n(k) > 0 ? down : up);
    }
    const double empty = c->exposure * before + c->end_exposure * std::max(0.0, behind - c->inner_length);
    sum += c->area * empty * empty;
  }
  return sum;
}

/// Centre of the least-squares circle (Kasa) through points of the plane, and its squared radius.
struct Circle {
  Eigen::Vector2d centre;
  double squared_radius;
};
Circle circle_through(const std::vector<Eigen::Vector2d>& points, const std::vector<double>& weights) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double total = 0;
  for (std::size_t k = 0; k < points.size(); ++k) mean += weights[k] * points[k], total += weights[k];
  mean /= total;
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  Eigen::Vector2d third = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Eigen::Vector2d p = points[k] - mean;
    second += weights[k] * p * p.transpose();
    third += weights[k] * p * p.squaredNorm();
  }
  const Eigen::FullPivLU<Eigen::Matrix2d> solver(second);
  if (solver.rank() < 2) return {mean, none};
  const Eigen::Vector2d centre = solver.solve(third) / 2;
  return {mean + centre, centre.squaredNorm() + second.trace() / total};
}

/// Squared radius a + b z + c z^2 between two heights.
struct Revolution {
  Eigen::Vector3d profile;
  double low, high;

  double squared_radius(double z) const { return profile(0) + z * (profile(1) + z * profile(2)); }
  double excess(const Eigen::Vector3d& p) const { return p.head<2>().squaredNorm() - squared_radius(p.z()); }

  /// Returns the length of the solid from `p` along the unit vector `d`, or the distance of `p` from the
  /// surface when `p` is outside.
  double exit(const Eigen::Vector3d& p, const Eigen::Vector3d& d) const {
    const double c = excess(p);
    if (c >= 0) return p.head<2>().norm() - std::sqrt(std::max(0.0, squared_radius(p.z())));
    const double a = d.head<2>().squaredNorm() - profile(2) * d.z() * d.z();
    const double b = 2 * p.head<2>().dot(d.head<2>()) - d.z() * (profile(1) + 2 * profile(2) * p.z());
    double length = d.z() > 0 ? (high - p.z()) / d.z() : d.z() < 0 ? (low - p.z()) / d.z() : none;
    const double discriminant = b * b - 4 * a * c;
    if (discriminant >= 0) {
      // The stable pair of roots of a t^2 + b t + c, c < 0.
      const double q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
      for (const double root : {a != 0 ? q / a : none, q != 0 ? c / q : none})
        if (root > 0) length = std::min(length, root);
    }
    return std::max(0.0, length);
  }
};

/// Returns the end of a chord through the wall of a vessel that lies on its outside.
const Eigen::Vector3d& outer_end(const Chord& chord) {
  return chord.exposure >= 0.5 ? chord.start : chord.end;
}

double VolumeFit::revolution(const Eigen::Matrix3d& frame) const {
  std::vector<Eigen::Vector2d> side;
  std::vector<double> weights;
  for (const Chord* c : chords_)
    if (std::abs(c->normal.dot(frame.col(2))) <= side_cosine) {
      side.push_back((frame.transpose() * outer_end(*c)).head<2>());
      weights.push_back(c->area);
    }
  if (side.size() < 3) return none;
  const Circle circle = circle_through(side, weights);
  if (!(circle.squared_radius < none)) return none;
  // Heights are from -half to half.
  const Range range = span(frame.col(2));
  const double half = (range.high - range.low) / 2;
  const Eigen::Vector3d origin(circle.centre.x(), circle.centre.y(), (range.low + range.high) / 2);
  const auto local = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return frame.transpose() * p - origin;
  };

  // Solved for multiples of `half`: the equations mix powers of it, and their rank must not depend on the
  // unit.
  Revolution solid{Eigen::Vector3d::Zero(), -half, half};
  const double unit = half > 0 ? half : 1;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Chord* c : chords_) {
    if (std::abs(c->normal.dot(frame.col(2))) > side_cosine) continue;
    const Eigen::Vector3d wall = local(outer_end(*c));
    const double z = wall.z() / unit;
    const Eigen::Vector3d row(1, z, z * z);
    normal += c->area * row * row.transpose();
    right += c->area * row * wall.head<2>().squaredNorm();
  }
  solid.profile = Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d>(normal).solve(right);
  solid.profile(1) /= unit;
  solid.profile(2) /= unit * unit;
  double sum = 0;
  for (const Chord* c : chords_) {
    const Eigen::Vector3d p = local(c->start), n = frame.transpose() * c->normal;
    const double before = solid.exit(p, n), behind = solid.excess(p) < 0 ? solid.exit(p, -n) : 0;
    const double empty = c->exposure * before + c->end_exposure * std::max(0.0, behind - c->inner_length);
    sum += c->area * empty * empty;
  }
  return sum;
}

double VolumeFit::ring(const Eigen::Matrix3d& frame) const {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> weights;
  double area = 0, height = 0;
  for (const Chord* c : chords_) {
    points.push_back((frame.transpose() * c->start).head<2>());
    weights.push_back(c->area);
    area += c->area;
    height += c->area * frame.col(2).dot(c->start);
  }
  const Circle circle = circle_through(points, weights);
  if (!(circle.squared_radius < none)) return none;
  const double ring_radius = std::sqrt(circle.squared_radius);
  height /= area;
  const auto off = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d q = frame.transpose() * p;
    return std::hypot((q.head<2>() - circle.centre).norm() - ring_radius, q.z() - height);
  };
  double tube = 0;
  for (const Chord* c : chords_) tube += c->area * off(c->start);
  tube /= area;
  if (tube >= ring_radius) return none;
  double sum = 0;
  for (const Chord* c : chords_) {
    const double d = off(c->start) - tube;
    const double empty = std::abs(d) + c->end_exposure * std::max(0.0, 2 * tube - c->inner_length);
    sum += c->area * empty * empty;
  }
  return sum;
}

}  // namespace

double volume_error(const std::vector<Chord>& chords, const std::vector<std::int32_t>& chord) {
  if (chord.empty()) return 0;
  return VolumeFit(chords, chord).run();
}

}  // namespace stackabilization::detail
