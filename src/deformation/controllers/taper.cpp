#include "deformation/controllers/taper.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "deformation/model/straight_curve.h"
#include "stackabilization/core/direction.h"
#include "stackabilization/deformation/tolerances.h"
#include "stackabilization/structure/tolerances.h"

namespace stackabilization::detail {

namespace {

/// A section lies across the axis if the cosine of its tangent to the axis is at least this.
constexpr double across = 0.7;

/// The numbers from the least to the largest of those that were added.
struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void extend(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double length() const { return high - low; }
};

/// The map of a taper.
class TaperMap {
 public:
  TaperMap(const std::vector<Primitive>& now, const Taper& taper, const Structure& rest)
      : factor_(taper.factor), axis_(taper.axis.normalized()) {
    if (taper.along) {
      directions_ = {taper.along->normalized()};
    } else {
      const Frame frame = frame_of(Direction(taper.axis));
      directions_ = {frame.u, frame.v};
    }
    std::vector<Interval> widths(directions_.size());
    for (const Primitive& primitive : now) {
      const Points points = control_points(primitive);
      const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive);
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const Eigen::Vector3d point = points.row(i).transpose();
        heights_.extend(axis_.dot(point));
        const double radius = cylinder ? cylinder->radii(i) : 0;
        for (std::size_t k = 0; k < directions_.size(); ++k)
          for (const double side : {-radius, radius}) widths[k].extend(directions_[k].dot(point) + side);
      }
    }
    centre_ = shape_centre(now);
    for (std::size_t k = 0; k < directions_.size(); ++k)
      centre_ += ((widths[k].low + widths[k].high) / 2 - directions_[k].dot(centre_)) * directions_[k];
    settle(now, rest);
    for (const Interval& width : widths) thin_.push_back(tolerance::thin_in_taper * width.length());
  }

  const Eigen::Vector3d& axis() const { return axis_; }
  const std::vector<Eigen::Vector3d>& directions() const { return directions_; }

  /// Returns whether something of this width along a direction keeps it.
  bool keeps(std::size_t direction, double width) const { return width < thin_[direction]; }

  /// Returns the relative growth of the widths at the height of a point.
  double growth(const Eigen::Vector3d& point) const {
    if (!(heights_.length() > 0)) return 0;
    return (factor_ - 1) * (axis_.dot(point) - heights_.low) / heights_.length();
  }

  /// Returns the displacement of a point along one direction.
  Eigen::Vector3d move(const Eigen::Vector3d& point, std::size_t direction) const {
    return growth(point) * directions_[direction].dot(point - centre_) * directions_[direction];
  }
  Eigen::Vector3d move(const Eigen::Vector3d& point) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < directions_.size(); ++k) sum += move(point, k);
    return sum;
  }

 private:
  /// Moves the centre to the mirror planes and rotation axes along the axis.
  void settle(const std::vector<Primitive>& now, const Structure& rest) {
    Eigen::Matrix3d free = Eigen::Matrix3d::Identity() - axis_ * axis_.transpose();
    for (const Symmetry& symmetry : rest.symmetries) settle_on(symmetry, free);
    std::vector<std::pair<double, const Symmetry*>> own;
    for (const Relation& relation : rest.relations)
      if (relation.type == RelationType::self_symmetry)
        own.emplace_back(-width_of(now[static_cast<std::size_t>(relation.parts.front())]),
                         &relation.symmetry);
    std::stable_sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [width, symmetry] : own) settle_on(*symmetry, free);
  }

  /// `free`: projector onto the directions in which the centre may still move.
  void settle_on(const Symmetry& symmetry, Eigen::Matrix3d& free) {
    const Eigen::Vector3d normal = symmetry.axis.normalized(), offset = symmetry.point - centre_;
    if (symmetry.kind == SymmetryKind::reflection) {
      if ((free * normal).norm() < tolerance::parallel) return;
      centre_ += offset.dot(normal) * normal;
      free -= free * normal * normal.transpose() * free;
    } else if (std::abs(normal.dot(axis_)) >= tolerance::parallel) {
      centre_ += free * offset;
      free.setZero();
    }
  }

  static double width_of(const Primitive& primitive) {
    const Points points = control_points(primitive);
    const double reach = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
    const auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive);
    return cylinder ? std::max(reach, 2 * cylinder->radii.maxCoeff()) : reach;
  }

  double factor_;
  Eigen::Vector3d axis_, centre_;
  std::vector<Eigen::Vector3d> directions_;
  Interval heights_;
  std::vector<double> thin_;  ///< per direction, the width below which widths are kept
};

/// Returns the changes of the corners. Corners of one end, or of one face, move as its middle does where it
/// is thin.
Points changes(const Cuboid& cuboid, const TaperMap& map) {
  const auto edge = [&](int axis) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (int corner = 0; corner < 8; ++corner)
      sum += ((corner >> axis & 1) != 0 ? 1 : -1) * cuboid.corners.row(corner);
    return Eigen::Vector3d(sum.transpose());
  };
  int upright = 0;
  double most = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const double cosine = std::abs(edge(axis).stableNormalized().dot(map.axis()));
    if (cosine > most) most = cosine, upright = axis;
  }
  Points result = Points::Zero(8, 3);
  for (const int end : {0, 1})
    for (std::size_t k = 0; k < map.directions().size(); ++k) {
      Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
      Interval width;
      for (int corner = 0; corner < 8; ++corner)
        if ((corner >> upright & 1) == end) {
          middle += cuboid.corners.row(corner) / 4;
          width.extend(cuboid.corners.row(corner).dot(map.directions()[k]));
        }
      for (int corner = 0; corner < 8; ++corner)
        if ((corner >> upright & 1) == end)
          result.row(corner) +=
              map.move(map.keeps(k, width.length()) ? Eigen::Vector3d(middle.transpose())
                                                    : Eigen::Vector3d(cuboid.corners.row(corner).transpose()),
                       k)
                  .transpose();
    }
  return result;
}

Points changes(const GeneralizedCylinder& cylinder, const TaperMap& map) {
  const Eigen::Index last = cylinder.centres.rows() - 1;
  Points result(last + 1, 3);
  for (Eigen::Index i = 0; i <= last; ++i)
    result.row(i) = map.move(cylinder.centres.row(i).transpose()).transpose();
  if (!is_straight(cylinder)) return result;
  const Eigen::VectorXd places = places_along_chord(cylinder);
  for (Eigen::Index i = 1; i < last; ++i)
    result.row(i) = result.row(0) + places(i) / places(last) * (result.row(last) - result.row(0));
  return result;
}

/// Returns the changes of the radii: those of sections across the axis, unless they are thin.
Eigen::VectorXd radius_changes(const GeneralizedCylinder& cylinder, const TaperMap& map) {
  const Points tangents = section_tangents(cylinder);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(cylinder.radii.size());
  const double widest = 2 * cylinder.radii.maxCoeff();
  for (std::size_t k = 0; k < map.directions().size(); ++k)
    if (map.keeps(k, widest)) return result;
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    if (std::abs(tangents.row(i).dot(map.axis())) < across) continue;
    const double growth = map.growth(cylinder.centres.row(i).transpose());
    const double factor = map.directions().size() > 1 ? 1 + growth : std::sqrt(1 + growth);
    result(i) = (factor - 1) * cylinder.radii(i);
  }
  return result;
}

void set_changes(PartEdit& edit, const Points& moves, const Eigen::VectorXd& radii) {
  const Eigen::Index count = 3 * moves.rows() + radii.size();
  edit.changes.resize(count);
  for (Eigen::Index i = 0; i < moves.rows(); ++i) edit.changes.segment<3>(3 * i) = moves.row(i).transpose();
  edit.changes.tail(radii.size()) = radii;
  for (int value = 0; value < count; ++value) edit.values.push_back(value);
}

}  // namespace

std::vector<PartEdit> tapered(const std::vector<Primitive>& now, const Taper& taper, const Structure& rest) {
  const TaperMap map(now, taper, rest);
  std::vector<PartEdit> edits(now.size());
  for (std::size_t part = 0; part < now.size(); ++part) {
    edits[part].part = static_cast<int>(part);
    if (const auto* cuboid = std::get_if<Cuboid>(&now[part])) {
      set_changes(edits[part], changes(*cuboid, map), {});
    } else {
      const auto& cylinder = std::get<GeneralizedCylinder>(now[part]);
      set_changes(edits[part], changes(cylinder, map), radius_changes(cylinder, map));
    }
  }
  return edits;
}

}  // namespace stackabilization::detail
