#include "deformation/controllers/straightness.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <utility>

#include "deformation/controllers/reduced_basis.h"
#include "deformation/model/skinning.h"
#include "deformation/model/straight_curve.h"

namespace stackabilization::detail {

namespace {

/// Length of the end zones, which hardly stretch, as a fraction of the length of the curve, and their stretch
/// relative to that of the middle.
constexpr double end_zone = 0.06;
constexpr double end_stretch = 0.05;

Eigen::Vector3d centre(const GeneralizedCylinder& cylinder, Eigen::Index i) {
  return cylinder.centres.row(i).transpose();
}

/// Returns the positions of the sections along the chord, 0 at the first section, 1 at the last.
Eigen::VectorXd shares_of_chord(const GeneralizedCylinder& cylinder) {
  return places_along_chord(cylinder) / chord_of(cylinder).norm();
}

/// Returns the arc length up to `s` of a curve of length 1 with the end zones shortened.
double stretchable_length(double s) {
  const double in_start = std::min(s, end_zone), in_end = std::max(s - (1 - end_zone), 0.0);
  return end_stretch * (in_start + in_end) + (s - in_start - in_end);
}

/// Computes n x 2 functions 1 and x over the given positions, of mean square 1 and orthogonal.
Eigen::MatrixXd linear_functions(const Eigen::VectorXd& places) {
  Eigen::MatrixXd functions = Eigen::MatrixXd::Ones(places.size(), 2);
  const Eigen::VectorXd centred = places.array() - places.mean();
  functions.col(1) = centred / std::sqrt(centred.squaredNorm() / static_cast<double>(places.size()));
  return functions;
}

}  // namespace

Eigen::MatrixXd slide_functions(const GeneralizedCylinder& rest) {
  const Eigen::Index inner = rest.centres.rows() - 2;
  Eigen::VectorXd s = section_arc_lengths(rest);
  const double length = s(s.size() - 1);
  for (double& place : s) place = stretchable_length(place / length) / stretchable_length(1);
  Eigen::MatrixXd bridge(inner, inner);
  for (Eigen::Index i = 0; i < inner; ++i)
    for (Eigen::Index j = 0; j < inner; ++j)
      bridge(i, j) = 4 * std::min(s(i + 1), s(j + 1)) * (1 - std::max(s(i + 1), s(j + 1)));
  Eigen::MatrixXd functions = Eigen::MatrixXd::Zero(inner + 2, inner);
  if (inner == 0) return functions;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(bridge);
  functions.middleRows(1, inner) =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  return functions;
}

StraightCorrections::StraightCorrections(GeneralizedCylinder start, const Eigen::MatrixXd& slides,
                                         double strain, StraightHandle handle)
    : start_(std::move(start)),
      slides_(slides),
      strain_(strain),
      handle_(handle),
      from_(0),
      to_(static_cast<int>(start_.centres.rows()) - 1),
      profile_(shares_of_chord(start_)) {
  if (handle_.section) (2 * *handle_.section > to_ ? to_ : from_) = *handle_.section;
  const Eigen::Vector3d along = (centre(start_, to_) - centre(start_, from_)).normalized();
  const Points from_anchor = start_.centres.rowwise() - start_.centres.row(from_);
  offsets_ = from_anchor - (from_anchor * along) * along.transpose();
}

Eigen::Index StraightCorrections::piece_at(double place) const {
  Eigen::Index piece = 0;
  while (piece + 2 < profile_.size() && place > profile_(piece + 1)) ++piece;
  return piece;
}

double StraightCorrections::slope(Eigen::Index piece) const {
  return (start_.radii(piece + 1) - start_.radii(piece)) / (profile_(piece + 1) - profile_(piece));
}

double StraightCorrections::radius_at(double place) const {
  const Eigen::Index piece = piece_at(place);
  return start_.radii(piece) + slope(piece) * (place - profile_(piece));
}

double StraightCorrections::slope_at(double place) const {
  const Eigen::Index piece = piece_at(place);
  const bool at_section = place == profile_(piece + 1) && piece + 2 < profile_.size();
  return at_section ? (slope(piece) + slope(piece + 1)) / 2 : slope(piece);
}

Eigen::MatrixXd StraightCorrections::columns(const GeneralizedCylinder& now) const {
  const Eigen::Index n = now.centres.rows(), slides = slides_.cols();
  const Eigen::Vector3d chord = chord_of(now), along = chord.normalized();
  const Eigen::VectorXd places = shares_of_chord(now);
  const Eigen::MatrixXd linear = linear_functions(places);
  // Equal strains have equal costs, as for cuboids: a disc must not grow thin, nor a slender leg thick.
  const double size_ratio = 2 * now.radii.mean() / chord.norm();
  const double flatness = std::min(1.0, 1 / size_ratio), slenderness = std::min(1.0, size_ratio);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(4 * n, 6 + slides + 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    columns.block<3, 3>(3 * i, 0) = linear(i, 0) * Eigen::Matrix3d::Identity();
    columns.block<3, 3>(3 * i, 3) = flatness * linear(i, 1) * Eigen::Matrix3d::Identity();
    columns.block(3 * i, 6, 3, slides) = sliding_scale * along * slides_.row(i);
    columns.block(3 * n + i, 6, 1, slides) =
        sliding_scale * slope_at(places(i)) / chord.norm() * slides_.row(i);
  }
  columns.bottomRightCorner(n, 2) = slenderness * radius_scale * linear;
  columns.rightCols(columns.cols() - 3) *= strain_;
  return columns;
}

GeneralizedCylinder StraightCorrections::retract(GeneralizedCylinder now) const {
  const Eigen::Vector3d before = centre(start_, to_) - centre(start_, from_);
  const Eigen::RowVector3d anchor = now.centres.row(from_);
  const Eigen::Vector3d along = (centre(now, to_) - anchor.transpose()).normalized();
  const Eigen::Matrix3d turn = smallest_rotation(before.normalized(), along).toRotationMatrix();
  const Eigen::VectorXd places = (now.centres.rowwise() - anchor) * along;
  for (Eigen::Index i = 0; i < places.size(); ++i)
    if (i != from_ && i != to_)
      now.centres.row(i) = anchor + places(i) * along.transpose() + offsets_.row(i) * turn.transpose();

  const Eigen::VectorXd shares = shares_of_chord(now);
  const Eigen::VectorXd profile = shares.unaryExpr([&](double share) { return radius_at(share); });
  const Eigen::MatrixXd linear = linear_functions(shares);
  const double count = static_cast<double>(shares.size());
  const Eigen::VectorXd change = linear * (linear.transpose() * (now.radii - profile)) / count;
  now.radii = profile + change;
  if (handle_.radius) now.radii.array() += start_.radii(*handle_.radius) - now.radii(*handle_.radius);
  return now;
}

}  // namespace stackabilization::detail
