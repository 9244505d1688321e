#include "improvement/quality/centre_line.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "core/angles.h"
#include "deformation/model/straight_curve.h"
#include "stackabilization/improvement/tolerances.h"
#include "structure/model/nearest_box.h"

namespace stackabilization::detail {

namespace {

/// Number of stations of a straight and of a curved line, and the fewest pieces of a station. Curved lines
/// show waves, which take more.
constexpr int straight_stations = 12, curved_stations = 24;
constexpr std::size_t pieces_per_station = 6;
/// Least number of stations between seams that tell the change of a part by themselves.
constexpr std::size_t min_own_stations = 4;
/// Largest share by which balancing reduces the weight of a piece.
constexpr double max_fall = 0.9;
/// Share of the length within which corners belong to an end.
constexpr double end_share = 0.02;

/// Curve along which a part is elongated.
struct PartCurve {
  Points points;
  bool closed = false;
  bool straight = false;

  double length() const {
    double sum = 0;
    for (Eigen::Index k = 1; k < points.rows(); ++k) sum += (points.row(k) - points.row(k - 1)).norm();
    return closed ? sum + (points.row(0) - points.row(points.rows() - 1)).norm() : sum;
  }
};

std::optional<PartCurve> curve_of(const Primitive& primitive) {
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive)) {
    const Eigen::VectorXd lengths = section_arc_lengths(*cylinder);
    if (lengths(lengths.size() - 1) < cylinder->radii.mean()) return std::nullopt;
    return PartCurve{cylinder->centres, cylinder->closed, detail::is_straight(*cylinder)};
  }
  const OrientedBox box = nearest_box(std::get<Cuboid>(primitive));
  Eigen::Index longest = 0;
  const double length = box.half_extents.maxCoeff(&longest);
  const double width = std::max(box.half_extents((longest + 1) % 3), box.half_extents((longest + 2) % 3));
  if (length < tolerance::quality::elongated * width) return std::nullopt;
  PartCurve curve{Points(2, 3), false, true};
  const Eigen::Vector3d half = length * box.axes.col(longest);
  curve.points << (box.centre - half).transpose(), (box.centre + half).transpose();
  return curve;
}

/// Returns the arc length from the first point to the point of the curve nearest to `p`, over the length.
double position_on(const PartCurve& curve, const Eigen::Vector3d& p) {
  double nearest = std::numeric_limits<double>::infinity(), position = 0, length = 0;
  const Eigen::Index segments = curve.points.rows() - (curve.closed ? 0 : 1);
  for (Eigen::Index k = 0; k < segments; ++k) {
    const Eigen::Vector3d from = curve.points.row(k).transpose(),
                          side = curve.points.row((k + 1) % curve.points.rows()).transpose() - from;
    const double t = std::clamp((p - from).dot(side) / side.squaredNorm(), 0.0, 1.0);
    const double distance = (from + t * side - p).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      position = length + t * side.norm();
    }
    length += side.norm();
  }
  return position / length;
}

/// Returns the point of the curve at an arc length over the whole length, 0 to 1, and the direction there.
std::pair<Eigen::Vector3d, Eigen::Vector3d> place_on(const PartCurve& curve, double position) {
  double left = position * curve.length();
  const Eigen::Index segments = curve.points.rows() - (curve.closed ? 0 : 1);
  for (Eigen::Index k = 0;; ++k) {
    const Eigen::Vector3d from = curve.points.row(k).transpose(),
                          side = curve.points.row((k + 1) % curve.points.rows()).transpose() - from;
    const double length = side.norm();
    if (left <= length || k + 1 == segments)
      return {from + std::min(left, length) * side.stableNormalized(), side.stableNormalized()};
    left -= length;
  }
}

/// Returns the largest distance of a point from the line through the first and the last one.
double distance_from_chord(const Points& points) {
  const Eigen::RowVector3d chord = (points.row(points.rows() - 1) - points.row(0)).stableNormalized();
  const Points offsets = points.rowwise() - points.row(0);
  return (offsets - (offsets * chord.transpose()) * chord).rowwise().norm().maxCoeff();
}

/// Returns the places of points along the way from the first to the last one, 0 to 1.
Eigen::VectorXd shares_of_line(const Points& points) {
  const Eigen::RowVector3d chord = points.row(points.rows() - 1) - points.row(0);
  return (points.rowwise() - points.row(0)) * chord.transpose() / chord.squaredNorm();
}

/// Returns how a line turns at its inner points, at all points of a loop, one per row: rotation vectors,
/// radians, as components across the line in a frame that is carried along it without twist [Bishop 1975].
Eigen::MatrixX2d turns(const Points& line, bool closed) {
  const Eigen::Index n = line.rows(), first = closed ? 0 : 1;
  const auto direction = [&](Eigen::Index k) -> Eigen::Vector3d {
    return (line.row((k + 1) % n) - line.row(k)).transpose().stableNormalized();
  };
  Eigen::MatrixX2d result(closed ? n : n - 2, 2);
  Eigen::Vector3d before = direction(closed ? n - 1 : 0), across = before.unitOrthogonal();
  for (Eigen::Index k = 0; k < result.rows(); ++k) {
    const Eigen::Vector3d after = direction(first + k);
    const Eigen::Vector3d turn = angle_between(before, after) * before.cross(after).stableNormalized();
    result.row(k) << turn.dot(across), turn.dot(before.cross(across));
    across = Eigen::Quaterniond::FromTwoVectors(before, after) * across;
    before = after;
  }
  return result;
}

/// Returns the largest difference of the turns of two lines at a point and at two consecutive ones together,
/// radians, after the rotation about the line that makes the turns most alike.
double largest_turn(const Eigen::MatrixX2d& turns, const Eigen::MatrixX2d& of_image) {
  const double along = (turns.array() * of_image.array()).sum(),
               across = of_image.col(0).dot(turns.col(1)) - of_image.col(1).dot(turns.col(0));
  const Eigen::Rotation2Dd rotation(std::atan2(across, along));
  const Eigen::MatrixX2d change = turns - of_image * rotation.toRotationMatrix().transpose();
  double largest = 0;
  for (Eigen::Index k = 0; k < change.rows(); ++k) {
    largest = std::max(largest, change.row(k).norm());
    if (k > 0) largest = std::max(largest, (change.row(k) + change.row(k - 1)).norm());
  }
  return largest;
}

}  // namespace

std::optional<CentreLine> CentreLine::of(const Primitive& primitive, const Shape& rest,
                                         const std::vector<std::int32_t>& triangles, std::size_t max_pieces) {
  const std::optional<PartCurve> curve = curve_of(primitive);
  if (!curve || !(curve->length() > 0)) return std::nullopt;
  CentreLine line;
  line.closed_ = curve->closed;
  line.straight_ = curve->straight;
  const int station_count = line.straight_ ? straight_stations : curved_stations;
  line.marks_ = pieces_of(rest, triangles, curve->length() / station_count, max_pieces);
  const Points marks = line.marks_.on(rest);
  const int last = line.closed_ ? station_count : station_count - 1;
  line.stations_.resize(static_cast<std::size_t>(station_count));
  for (Eigen::Index mark = 0; mark < marks.rows(); ++mark) {
    const double position = position_on(*curve, marks.row(mark).transpose()) * last;
    const double area = line.marks_.areas[static_cast<std::size_t>(mark)];
    const int low = std::min(static_cast<int>(position), last - 1);
    const double share = position - low;
    if (share < 1) line.stations_[static_cast<std::size_t>(low)].push_back({mark, area * (1 - share)});
    if (share > 0)
      line.stations_[static_cast<std::size_t>((low + 1) % station_count)].push_back({mark, area * share});
  }
  const bool sparse = std::any_of(line.stations_.begin(), line.stations_.end(), [](const auto& station) {
    double area = 0;
    for (const Share& share : station) area += share.weight;
    return station.size() < pieces_per_station || !(area > 0);
  });
  if (sparse) return std::nullopt;
  for (int k = 0; k < station_count; ++k) {
    const auto [place, along] = place_on(*curve, static_cast<double>(k) / last);
    line.balance(line.stations_[static_cast<std::size_t>(k)], marks, place, along);
  }
  line.rest_ = line.centres(marks);
  for (int k = 1; k < station_count; ++k) line.length_ += (line.rest_.row(k) - line.rest_.row(k - 1)).norm();
  if (!(line.length_ > 0)) return std::nullopt;
  line.sections_ = line.sections(marks, line.rest_);
  line.find_own_stations(rest, triangles, marks);
  if (!line.straight_) return line;
  line.deviation_ =
      distance_from_chord(line.rest_) / (line.rest_.row(station_count - 1) - line.rest_.row(0)).norm();
  line.shares_ = shares_of_line(line.rest_);
  for (int k = 1; k < station_count; ++k)
    if (!(line.shares_(k) > line.shares_(k - 1))) return std::nullopt;
  const Eigen::RowVector3d chord = line.rest_.row(station_count - 1) - line.rest_.row(0);
  const auto share_of = [&](std::int32_t vertex) {
    return (rest.vertices.row(vertex) - line.rest_.row(0)).dot(chord) / chord.squaredNorm();
  };
  std::set<std::int32_t> vertices;
  for (const std::int32_t t : triangles)
    for (int k = 0; k < 3; ++k) vertices.insert(rest.triangles(t, k));
  auto& [low, high] = line.end_shares_;
  for (const std::int32_t vertex : vertices) {
    low = std::min(low, share_of(vertex));
    high = std::max(high, share_of(vertex));
  }
  for (const std::int32_t vertex : vertices) {
    if (share_of(vertex) <= low + end_share) line.end_corners_[0].push_back(vertex);
    if (share_of(vertex) >= high - end_share) line.end_corners_[1].push_back(vertex);
  }
  return line;
}

void CentreLine::balance(std::vector<Share>& station, const Points& marks, const Eigen::Vector3d& place,
                         const Eigen::Vector3d& along) {
  const Eigen::Vector3d u = along.unitOrthogonal(), v = along.cross(u);
  std::vector<Eigen::Vector2d> across;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const Share& share : station) {
    const Eigen::Vector3d offset = marks.row(share.mark).transpose() - place;
    across.emplace_back(u.dot(offset), v.dot(offset));
    sum += share.weight * across.back();
    moments += share.weight * across.back() * across.back().transpose();
  }
  const Eigen::LDLT<Eigen::Matrix2d> solver(moments);
  const Eigen::Vector2d slope = solver.solve(-sum);
  if (solver.info() != Eigen::Success || !slope.allFinite()) return;
  double fall = 0;
  for (const Eigen::Vector2d& offset : across) fall = std::max(fall, -slope.dot(offset));
  const double share = fall > max_fall ? max_fall / fall : 1;
  for (std::size_t i = 0; i < across.size(); ++i) station[i].weight *= 1 + share * slope.dot(across[i]);
}

void CentreLine::find_own_stations(const Shape& rest, const std::vector<std::int32_t>& triangles,
                                   const Points& marks) {
  const std::int32_t part = rest.triangle_part[static_cast<std::size_t>(triangles.front())];
  std::vector<char> of_others(static_cast<std::size_t>(rest.vertex_count()), 0);
  for (Eigen::Index t = 0; t < rest.triangle_count(); ++t)
    if (rest.triangle_part[static_cast<std::size_t>(t)] != part)
      for (int k = 0; k < 3; ++k) of_others[static_cast<std::size_t>(rest.triangles(t, k))] = 1;
  std::set<std::int32_t> seam;
  for (const std::int32_t t : triangles)
    for (int k = 0; k < 3; ++k)
      if (const std::int32_t v = rest.triangles(t, k); of_others[static_cast<std::size_t>(v)]) seam.insert(v);
  const double reach = radius();
  std::vector<char> at_seam(static_cast<std::size_t>(marks.rows()), 0);
  for (Eigen::Index mark = 0; mark < marks.rows(); ++mark)
    at_seam[static_cast<std::size_t>(mark)] = std::any_of(seam.begin(), seam.end(), [&](std::int32_t vertex) {
      return (rest.vertices.row(vertex) - marks.row(mark)).squaredNorm() < reach * reach;
    });
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    double near = 0, far = 0;
    for (const Share& share : stations_[k])
      (at_seam[static_cast<std::size_t>(share.mark)] ? near : far) += share.weight;
    if (far > near) own_stations_.push_back(static_cast<Eigen::Index>(k));
  }
  if (own_stations_.size() >= min_own_stations) return;
  own_stations_.clear();
  for (std::size_t k = 0; k < stations_.size(); ++k) own_stations_.push_back(static_cast<Eigen::Index>(k));
}

std::array<Eigen::Vector3d, 2> CentreLine::ends_on(const Shape& shape, const Points& centres) const {
  const Eigen::RowVector3d from = centres.row(0),
                           along = (centres.row(centres.rows() - 1) - from).stableNormalized();
  std::array<Eigen::Vector3d, 2> ends;
  for (std::size_t end = 0; end < 2; ++end) {
    const Eigen::RowVector3d corner = shape.vertices(end_corners_[end], Eigen::all).colwise().mean();
    ends[end] = (from + (corner - from).dot(along) * along).transpose();
  }
  return ends;
}

Eigen::Vector3d CentreLine::direction() const {
  return (rest_.row(rest_.rows() - 1) - rest_.row(0)).transpose().stableNormalized();
}

double CentreLine::radius() const {
  double sum = 0;
  for (const Section& section : sections_) sum += section.radius;
  return sum / static_cast<double>(sections_.size());
}

Points CentreLine::centres(const Points& marks) const {
  Points result(static_cast<Eigen::Index>(stations_.size()), 3);
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    double weight = 0;
    for (const Share& share : stations_[k]) {
      sum += share.weight * marks.row(share.mark);
      weight += share.weight;
    }
    result.row(static_cast<Eigen::Index>(k)) = sum / weight;
  }
  return result;
}

std::vector<CentreLine::Section> CentreLine::sections(const Points& marks, const Points& centres) const {
  std::vector<Section> result;
  const auto station_count = static_cast<int>(stations_.size());
  for (int k = 0; k < station_count; ++k) {
    const int before = closed_ ? (k + station_count - 1) % station_count : std::max(k - 1, 0);
    const int after = closed_ ? (k + 1) % station_count : std::min(k + 1, station_count - 1);
    const Eigen::Vector3d along = (centres.row(after) - centres.row(before)).transpose().stableNormalized();
    double sum = 0, weight = 0;
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const Share& share : stations_[static_cast<std::size_t>(k)]) {
      Eigen::Vector3d across = (marks.row(share.mark) - centres.row(k)).transpose();
      across -= across.dot(along) * along;
      sum += share.weight * across.norm();
      moments += share.weight * across * across.transpose();
      weight += share.weight;
    }
    // The smallest eigenvalue belongs to the line itself.
    const Eigen::Vector3d squares =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments, Eigen::EigenvaluesOnly).eigenvalues();
    result.push_back({sum / weight, squares(2) > 0 ? std::sqrt(std::max(squares(1), 0.0) / squares(2)) : 1});
  }
  return result;
}

double CentreLine::radius_at_rest(double share) const {
  Eigen::Index low = 0;
  while (low + 2 < shares_.size() && share > shares_(low + 1)) ++low;
  const double part = std::clamp((share - shares_(low)) / (shares_(low + 1) - shares_(low)), 0.0, 1.0);
  const auto row = static_cast<std::size_t>(low);
  return (1 - part) * sections_[row].radius + part * sections_[row + 1].radius;
}

CentreLineChange CentreLine::change(const Shape& now, const AffineMap& affine) const {
  CentreLineChange result;
  const auto station_count = static_cast<int>(stations_.size());
  const Points marks = marks_.on(now);
  const Points centres = this->centres(marks);
  const std::vector<Section> sections = this->sections(marks, centres);
  // A straight part may slide within itself, as under a joint that moves along it: what counts is the radius
  // at a place.
  Eigen::VectorXd ratios(station_count), places = Eigen::VectorXd::LinSpaced(station_count, -1, 1);
  if (straight_) {
    const Eigen::RowVector3d chord = centres.row(station_count - 1) - centres.row(0);
    const double squared = chord.squaredNorm();
    if (!(squared > 0)) return {1, 0, 1, 1, 0, 0, {0, 0}, ends_on(now, centres), direction()};
    result.ends = ends_on(now, centres);
    result.direction = chord.transpose().stableNormalized();
    result.straightness = std::max(0.0, distance_from_chord(centres) / std::sqrt(squared) - deviation_);
    result.length = std::sqrt(squared) / (rest_.row(station_count - 1) - rest_.row(0)).norm();
    places = shares_of_line(centres);
    for (int k = 0; k < station_count; ++k)
      ratios(k) = sections[static_cast<std::size_t>(k)].radius / radius_at_rest(places(k));
    result.width = ratios(own_stations_).minCoeff();
  } else {
    Points image(station_count, 3);
    for (int k = 0; k < station_count; ++k) image.row(k) = affine(rest_.row(k).transpose()).transpose();
    result.bending = largest_turn(turns(centres, closed_), turns(image, closed_)) * 180 / std::numbers::pi;
    for (int k = 0; k < station_count; ++k)
      ratios(k) =
          sections[static_cast<std::size_t>(k)].radius / sections_[static_cast<std::size_t>(k)].radius;
  }
  for (const Eigen::Index station : own_stations_)
    if (const auto k = static_cast<std::size_t>(station); sections_[k].roundness >= tolerance::quality::round)
      result.section = std::max(result.section, sections_[k].roundness - sections[k].roundness);
  // The best affine function of the place; for a loop, the mean.
  const auto count = static_cast<Eigen::Index>(own_stations_.size());
  Eigen::MatrixXd functions = Eigen::MatrixXd::Ones(count, closed_ ? 1 : 2);
  if (!closed_) functions.col(1) = places(own_stations_);
  const Eigen::VectorXd own = ratios(own_stations_), function = functions.colPivHouseholderQr().solve(own);
  result.profile = (own - functions * function).cwiseAbs().maxCoeff() / own.mean();
  if (straight_)
    for (std::size_t end = 0; end < 2; ++end)
      result.end_widths[end] = function(0) + function(1) * end_shares_[end];
  return result;
}

}  // namespace stackabilization::detail
