#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "stackabilization/core/direction.h"
#include "structure/fitting/cylinder_sections.h"
#include "structure/model/canonical_axes.h"

namespace stackabilization::detail {

namespace {

constexpr int samples_of_surface = 2048;  ///< of the surface, to find middle and radii by
constexpr int rounds = 6;                 ///< of moving the curve to the middle
constexpr int smoothing = 2;              ///< passes over the skeleton, and over how far the curve moves
constexpr int min_samples = 8;            ///< that tell where the middle of a section is
constexpr double end_wall =
    0.7;  ///< |cosine| of curve and normal from which on a sample lies on an end, not around

Eigen::Index piece_count(const Curve& curve) {
  return curve.points.rows() - (curve.closed ? 0 : 1);
}

Eigen::RowVector3d piece(const Curve& curve, Eigen::Index i) {
  return curve.points.row((i + 1) % curve.points.rows()) - curve.points.row(i);
}

/// n points at even arc lengths, ends kept.
Curve resampled(const Curve& curve, int n) {
  std::vector<double> reached{0};
  for (Eigen::Index i = 0; i < piece_count(curve); ++i)
    reached.push_back(reached.back() + piece(curve, i).norm());
  Curve even{Points(n, 3), curve.closed};
  const int pieces = curve.closed ? n : n - 1;
  for (int k = 0; k < n; ++k) {
    const double wanted = reached.back() * k / pieces;
    const auto after = std::upper_bound(reached.begin() + 1, reached.end() - 1, wanted);
    const auto i = static_cast<std::size_t>(after - reached.begin()) - 1;
    const double length = reached[i + 1] - reached[i];
    const double t = length > 0 ? std::clamp((wanted - reached[i]) / length, 0.0, 1.0) : 0;
    even.points.row(k) =
        curve.points.row(static_cast<Eigen::Index>(i)) + t * piece(curve, static_cast<Eigen::Index>(i));
  }
  return even;
}

/// Orients a loop counter-clockwise about its upward normal, with its start on the side of the file's axes.
/// Returns other curves unchanged.
Curve ordered(const Curve& curve) {
  if (!curve.closed) return curve;
  const Eigen::Index n = curve.points.rows();
  const Eigen::RowVector3d centre = curve.points.colwise().mean();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < n; ++i)
    normal += (curve.points.row(i) - centre).cross(curve.points.row((i + 1) % n) - centre).transpose();
  if (!(normal.norm() > 0)) return curve;
  const bool clockwise = canonical_sense(normal) != normal;
  const Eigen::RowVector3d start = orthogonal_axis(normal.normalized()).transpose();
  Eigen::Index first = 0;
  ((curve.points.rowwise() - centre).rowwise().normalized() * start.transpose()).maxCoeff(&first);
  Curve turned = curve;
  for (Eigen::Index i = 0; i < n; ++i)
    turned.points.row(i) = curve.points.row((first + (clockwise ? n - i : i)) % n);
  return turned;
}

/// Each row moved halfway to the middle of its neighbours, ends kept.
Points smoothed(const Points& rows, bool closed) {
  Points smooth = rows;
  const Eigen::Index n = rows.rows();
  for (Eigen::Index i = closed ? 0 : 1; i < (closed ? n : n - 1); ++i)
    smooth.row(i) = rows.row(i) / 2 + (rows.row((i + n - 1) % n) + rows.row((i + 1) % n)) / 4;
  return smooth;
}

/// Projection of a surface point onto a curve.
struct Foot {
  double at;        ///< sections from the first: 2.5 is halfway between the third and the fourth
  double distance;  ///< from the curve
  double overhang;  ///< along the curve past the nearer end of its piece; negative between the ends
};

Foot foot_of(const Curve& curve, const Eigen::RowVector3d& point) {
  Foot best{0, std::numeric_limits<double>::infinity(), 0};
  for (Eigen::Index i = 0; i < piece_count(curve); ++i) {
    const Eigen::RowVector3d step = piece(curve, i), from = point - curve.points.row(i);
    const double free = step.dot(from) / step.squaredNorm(), t = std::clamp(free, 0.0, 1.0);
    const double distance = (from - t * step).norm();
    if (distance >= best.distance) continue;
    best = {static_cast<double>(i) + t, distance, (std::abs(free - 0.5) - 0.5) * step.norm()};
  }
  return best;
}

/// Surface points around one section, with their weights and their distances from the curve.
struct Ring {
  std::vector<Eigen::RowVector3d> points;
  std::vector<double> weights, distances;
};

class Fit {
 public:
  Fit(const FitSurface& part, const Curve& curve, int sections)
      : samples_(surface_samples(part.shape, samples_of_surface)),
        curve_(resampled(ordered(curve), sections)) {
    for (int pass = 0; pass < smoothing; ++pass) curve_.points = smoothed(curve_.points, curve_.closed);
  }

  /// Smooths the moves, not the positions: smoothing a bent curve would pull it inwards, off the middle.
  void refine() {
    assign();
    Points moves(curve_.points.rows(), 3);
    for (Eigen::Index i = 0; i < moves.rows(); ++i) moves.row(i) = offset(i);
    for (int pass = 0; pass < smoothing; ++pass) moves = smoothed(moves, curve_.closed);
    if (!curve_.closed) extend();
    curve_.points += moves;
    curve_ = resampled(curve_, static_cast<int>(moves.rows()));
  }

  /// Returns whether the curve is finite and neighbouring sections have different positions.
  bool usable() const {
    for (Eigen::Index i = 0; i < piece_count(curve_); ++i)
      if (!(piece(curve_, i).norm() > 0)) return false;
    return curve_.points.allFinite();
  }

  std::optional<GeneralizedCylinder> sections() {
    assign();
    const Eigen::Index n = curve_.points.rows();
    GeneralizedCylinder cylinder{
        .centres = curve_.points, .radii = Eigen::VectorXd::Zero(n), .closed = curve_.closed};
    for (Eigen::Index i = 0; i < n; ++i) {
      const Ring& ring = rings_[static_cast<std::size_t>(i)];
      double sum = 0, weight = 0;
      for (std::size_t k = 0; k < ring.points.size(); ++k) {
        sum += ring.weights[k] * ring.distances[k];
        weight += ring.weights[k];
      }
      cylinder.radii(i) = weight > 0 ? sum / weight : i > 0 ? cylinder.radii(i - 1) : 0;
    }
    const double largest = cylinder.radii.maxCoeff();
    if (!(largest > 0)) return std::nullopt;
    cylinder.radii = cylinder.radii.cwiseMax(min_relative_radius * largest);
    return cylinder;
  }

 private:
  /// Distributes the samples to the two sections next to their projections.
  void assign() {
    const Eigen::Index n = curve_.points.rows();
    rings_.assign(static_cast<std::size_t>(n), {});
    beyond_first_ = -piece(curve_, 0).norm() / 2;
    beyond_last_ = -piece(curve_, piece_count(curve_) - 1).norm() / 2;
    const double last = static_cast<double>(n - 1);
    for (Eigen::Index k = 0; k < samples_.points.rows(); ++k) {
      const Eigen::RowVector3d point = samples_.points.row(k);
      const Foot foot = foot_of(curve_, point);
      if (!curve_.closed && foot.at < 0.5) beyond_first_ = std::max(beyond_first_, foot.overhang);
      if (!curve_.closed && foot.at > last - 0.5) beyond_last_ = std::max(beyond_last_, foot.overhang);
      if (!curve_.closed && (foot.at <= 0 || foot.at >= last)) continue;
      const double below = std::floor(foot.at), share = foot.at - below;
      const auto first = std::min(static_cast<Eigen::Index>(below), piece_count(curve_) - 1);
      if (std::abs(piece(curve_, first).normalized().dot(samples_.normals.row(k))) > end_wall) continue;
      for (const int side : {0, 1}) {
        Ring& ring = rings_[static_cast<std::size_t>((static_cast<Eigen::Index>(below) + side) % n)];
        ring.points.push_back(point);
        ring.weights.push_back(side == 0 ? 1 - share : share);
        ring.distances.push_back(foot.distance);
      }
    }
  }

  /// Extends the curve to the ends of the part, or shortens it to them.
  void extend() {
    const Eigen::Index last = curve_.points.rows() - 1;
    const Eigen::RowVector3d first_step = piece(curve_, 0).normalized(),
                             last_step = piece(curve_, last - 1).normalized();
    curve_.points.row(0) -= beyond_first_ * first_step;
    curve_.points.row(last) += beyond_last_ * last_step;
  }

  /// Returns the vector from a section to the centre of the least-squares circle through its points (Kasa
  /// 1976), at most one radius long.
  Eigen::RowVector3d offset(Eigen::Index i) const {
    const Ring& ring = rings_[static_cast<std::size_t>(i)];
    const auto count = static_cast<Eigen::Index>(ring.points.size());
    if (count < min_samples) return Eigen::RowVector3d::Zero();
    const Frame frame = frame_of(Direction(tangent(i).transpose()));
    double radius = 0;
    for (const double distance : ring.distances) radius += distance / static_cast<double>(count);
    if (!(radius > 0)) return Eigen::RowVector3d::Zero();
    Eigen::MatrixX3d rows(count, 3);
    Eigen::VectorXd right(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const Eigen::Vector2d place =
          frame.to_local((ring.points[at] - curve_.points.row(i)).transpose()).head<2>() / radius;
      const double weight = std::sqrt(ring.weights[at]);
      rows.row(k) << weight * place.x(), weight * place.y(), weight;
      right(k) = weight * place.squaredNorm() / 2;
    }
    const Eigen::Vector3d solution = rows.completeOrthogonalDecomposition().solve(right);
    Eigen::Vector2d centre = solution.head<2>();
    if (!centre.allFinite()) return Eigen::RowVector3d::Zero();
    if (centre.norm() > 1) centre.normalize();
    return radius * (frame.u * centre.x() + frame.v * centre.y()).transpose();
  }

  Eigen::RowVector3d tangent(Eigen::Index i) const {
    const Eigen::Index n = curve_.points.rows();
    if (!curve_.closed && i == 0) return piece(curve_, 0);
    if (!curve_.closed && i == n - 1) return piece(curve_, n - 2);
    const Eigen::RowVector3d chord = curve_.points.row((i + 1) % n) - curve_.points.row((i + n - 1) % n);
    return chord.norm() > 0 ? chord : piece(curve_, i);
  }

  SurfaceSamples samples_;
  Curve curve_;
  std::vector<Ring> rings_;
  double beyond_first_ = 0,
         beyond_last_ = 0;  ///< how far the part goes on past the ends; negative: ends before
};

}  // namespace

std::optional<GeneralizedCylinder> curved_cylinder(const FitSurface& part, const Curve& curve, int sections) {
  Fit fit(part, curve, sections);
  for (int round = 0; round < rounds && fit.usable(); ++round) fit.refine();
  return fit.usable() ? fit.sections() : std::nullopt;
}

}  // namespace stackabilization::detail
