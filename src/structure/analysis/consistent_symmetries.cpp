#include "structure/analysis/consistent_symmetries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/structure/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr double angle_tolerance = tolerance::same_symmetry;

bool is_symmetry(const Relation& relation) {
  return relation.type == RelationType::symmetry || relation.type == RelationType::self_symmetry;
}

/// The different symmetries of a structure, global ones first, each corrected against those before it.
class SymmetrySet {
 public:
  explicit SymmetrySet(Structure& structure) : structure_(structure), orbits_(structure.parts.size()) {
    for (const Relation& relation : structure.relations)
      if (relation.type == RelationType::symmetry)
        orbits_.join(static_cast<std::size_t>(relation.parts[0]),
                     static_cast<std::size_t>(relation.parts[1]));
    for (Symmetry& symmetry : structure.symmetries) {
      symmetry.axis.normalize();
      add(symmetry);
    }
    for (std::size_t r = 0; r < structure.relations.size(); ++r)
      if (is_symmetry(structure.relations[r])) collect(r);
  }

  void correct() {
    std::vector<std::vector<std::size_t>> earlier_on(structure_.parts.size());  // members per orbit
    for (std::size_t i = 0; i < members_.size(); ++i) {
      align_with_file(members_[i].symmetry.axis);
      const std::vector<std::size_t> earlier = meeting(i, earlier_on);
      correct_direction(i, earlier);
      correct_place(i, earlier);
      for (const std::size_t orbit : members_[i].orbits) earlier_on[orbit].push_back(i);
    }
  }

  void write_back() const {
    for (std::size_t k = 0; k < structure_.symmetries.size(); ++k)
      structure_.symmetries[k] = members_[k].symmetry;
    for (std::size_t r = 0; r < member_of_.size(); ++r)
      if (member_of_[r]) structure_.relations[r].symmetry = members_[*member_of_[r]].symmetry;
  }

 private:
  struct Member {
    Symmetry symmetry;
    Eigen::Isometry3d isometry;    ///< before it is corrected
    std::set<std::size_t> orbits;  ///< of the parts it relates
  };

  /// Unit vectors of one cell, or of neighbouring ones, are candidates for being nearly parallel.
  using Cell = std::array<int, 3>;
  static constexpr double cell_width = 0.25;  // more than the chord of tolerance::parallel

  static Cell cell_of(const Eigen::Vector3d& axis) {
    Cell cell{};
    for (int k = 0; k < 3; ++k)
      cell[static_cast<std::size_t>(k)] = static_cast<int>(std::floor(axis(k) / cell_width));
    return cell;
  }

  void add(const Symmetry& symmetry) {
    by_axis_[cell_of(symmetry.axis)].push_back(members_.size());
    members_.push_back({symmetry, isometry_of(symmetry), {}});
  }

  /// Members whose axes are parallel to `axis` within tolerance::parallel, and some more, ascending.
  std::vector<std::size_t> nearly_parallel(const Eigen::Vector3d& axis) const {
    std::vector<std::size_t> found;
    for (const double sign : {1.0, -1.0}) {
      const Cell middle = cell_of(sign * axis);
      for (int step = 0; step < 27; ++step) {
        const auto rows =
            by_axis_.find({middle[0] + step % 3 - 1, middle[1] + step / 3 % 3 - 1, middle[2] + step / 9 - 1});
        if (rows != by_axis_.end()) found.insert(found.end(), rows->second.begin(), rows->second.end());
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  void collect(std::size_t r) {
    Relation& relation = structure_.relations[r];
    relation.symmetry.axis.normalize();
    const auto part = static_cast<std::size_t>(relation.parts[0]);
    std::optional<std::size_t> best;
    double least = tolerance::same_symmetry * structure_.diagonal;
    const Eigen::Isometry3d isometry = isometry_of(relation.symmetry);
    const Eigen::Vector3d point = control_points(structure_.parts[part].primitive).row(0).transpose();
    const Eigen::Vector3d image = isometry * point;
    for (const std::size_t i : nearly_parallel(relation.symmetry.axis)) {
      const Symmetry& other = members_[i].symmetry;
      if (other.kind != relation.symmetry.kind || isometry_order(other) != isometry_order(relation.symmetry))
        continue;
      if (std::abs(other.axis.dot(relation.symmetry.axis)) < tolerance::parallel) continue;
      if ((image - members_[i].isometry * point).norm() > least) continue;  // the difference is no smaller
      const double miss = difference(relation.symmetry, other, structure_.parts[part].primitive);
      if (miss > least || (best && miss == least)) continue;
      least = miss;
      best = i;
    }
    if (!best) {
      best = members_.size();
      add(relation.symmetry);
    }
    members_[*best].orbits.insert(orbits_.root(part));
    member_of_.resize(structure_.relations.size());
    member_of_[r] = best;
  }

  static int isometry_order(const Symmetry& symmetry) {
    return symmetry.kind == SymmetryKind::rotation ? symmetry.order : 2;
  }

  /// The members before `i` that relate parts of one of its orbits, ascending.
  std::vector<std::size_t> meeting(std::size_t i,
                                   const std::vector<std::vector<std::size_t>>& earlier_on) const {
    std::set<std::size_t> found;
    for (const std::size_t orbit : members_[i].orbits)
      found.insert(earlier_on[orbit].begin(), earlier_on[orbit].end());
    return {found.begin(), found.end()};
  }

  /// Aligns an axis with the axes of the file. Objects are modelled along these axes, and a fit deviates
  /// slightly from them. Without the alignment no edit could preserve both the symmetry and the extent along
  /// a file axis.
  static void align_with_file(Eigen::Vector3d& axis) {
    for (double& component : axis)
      if (std::abs(component) < tolerance::file_axis) component = 0;
    axis.normalize();
  }

  /// Makes the axis perpendicular to the axes that it is nearly perpendicular to. The angle to the first of
  /// the other axes becomes the nearest simple angle.
  void correct_direction(std::size_t i, const std::vector<std::size_t>& earlier) {
    Eigen::Vector3d& axis = members_[i].symmetry.axis;
    std::vector<Eigen::Vector3d> across;
    std::optional<Eigen::Vector3d> oblique;
    for (const std::size_t j : earlier) {
      const Eigen::Vector3d& other = members_[j].symmetry.axis;
      if (std::abs(axis.dot(other)) > angle_tolerance) {
        if (!oblique) oblique = other;
        continue;
      }
      Eigen::Vector3d rest = other;
      for (const Eigen::Vector3d& taken : across) rest -= taken.dot(rest) * taken;
      if (rest.norm() > angle_tolerance) across.push_back(rest.normalized());
    }
    if (across.size() < 3)
      for (const Eigen::Vector3d& other : across) axis = (axis - other.dot(axis) * other).normalized();
    if (oblique && across.size() < 2) axis = at_simple_angle(axis, *oblique);
  }

  static Eigen::Vector3d at_simple_angle(const Eigen::Vector3d& axis, const Eigen::Vector3d& other) {
    const Eigen::Vector3d across = axis - other.dot(axis) * other;
    const double angle = std::atan2(across.norm(), other.dot(axis));
    for (int n = 1; n <= 8; ++n) {
      const double simple = std::round(angle * n / std::numbers::pi) * std::numbers::pi / n;
      if (std::abs(angle - simple) > angle_tolerance) continue;
      if (n == 1) return std::copysign(1.0, other.dot(axis)) * other;
      return std::cos(simple) * other + std::sin(simple) * across.normalized();
    }
    return axis;
  }

  /// Moves an axis of rotation exactly into a mirror plane, and a third plane exactly through a common line,
  /// when they are nearly there.
  void correct_place(std::size_t i, const std::vector<std::size_t>& earlier) {
    Symmetry& symmetry = members_[i].symmetry;
    const bool is_plane = symmetry.kind == SymmetryKind::reflection;
    std::optional<std::size_t> first;
    for (const std::size_t j : earlier) {
      const Symmetry& other = members_[j].symmetry;
      const bool other_is_plane = other.kind == SymmetryKind::reflection;
      if (!is_plane && other_is_plane && std::abs(symmetry.axis.dot(other.axis)) < angle_tolerance)
        shift_onto(symmetry.point, other);
      if (is_plane && !other_is_plane && std::abs(symmetry.axis.dot(other.axis)) < angle_tolerance)
        pass_through(symmetry, other.point);
      if (!is_plane || !other_is_plane) continue;
      if (first)
        share_line(symmetry, members_[*first].symmetry, other);
      else
        first = j;
    }
  }

  void shift_onto(Eigen::Vector3d& point, const Symmetry& plane) const {
    const double height = plane.axis.dot(point - plane.point);
    if (std::abs(height) <= tolerance::same_symmetry * structure_.diagonal) point -= height * plane.axis;
  }

  void pass_through(Symmetry& plane, const Eigen::Vector3d& point) const {
    const double height = plane.axis.dot(point - plane.point);
    if (std::abs(height) <= tolerance::same_symmetry * structure_.diagonal)
      plane.point += height * plane.axis;
  }

  void share_line(Symmetry& plane, const Symmetry& a, const Symmetry& b) const {
    const Eigen::Vector3d line = a.axis.cross(b.axis);
    if (line.norm() < angle_tolerance || std::abs(line.normalized().dot(plane.axis)) > tolerance::relative)
      return;
    Eigen::Matrix3d normals;
    normals << a.axis.transpose(), b.axis.transpose(), line.transpose();
    const Eigen::Vector3d heights(a.axis.dot(a.point), b.axis.dot(b.point), line.dot(plane.point));
    pass_through(plane, normals.inverse() * heights);
  }

  Structure& structure_;
  DisjointSets orbits_;
  std::vector<Member> members_;
  std::map<Cell, std::vector<std::size_t>> by_axis_;   ///< rows of the members
  std::vector<std::optional<std::size_t>> member_of_;  ///< per relation
};

}  // namespace

double difference(const Symmetry& a, const Symmetry& b, const Primitive& primitive) {
  const Eigen::Isometry3d to_a = isometry_of(a), to_b = isometry_of(b);
  const Points points = control_points(primitive);
  const Eigen::RowVector3d middle = points.colwise().mean();
  double most = 0;
  for (const auto& row : points.rowwise()) {
    const Eigen::Vector3d p = row.transpose();
    most = std::max(most, (to_a * p - to_b * p).norm());
  }
  return most +
         (to_a.linear() - to_b.linear()).norm() * (points.rowwise() - middle).rowwise().norm().maxCoeff();
}

void make_consistent(Structure& structure) {
  SymmetrySet symmetries(structure);
  symmetries.correct();
  symmetries.write_back();
}

}  // namespace stackabilization::detail
