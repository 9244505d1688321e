#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "stackabilization/structure/tolerances.h"
#include "structure/symmetry/symmetry_candidates.h"
#include "structure/symmetry/symmetry_refinement.h"
#include "structure/symmetry/symmetry_voting.h"

namespace stackabilization::detail {

namespace {

constexpr int max_order = 12;  // of rotations without reflections through their axis

class RotationSearch {
 public:
  RotationSearch(const SymmetrySurface& surface, const std::vector<FoundSymmetry>& reflections,
                 const SymmetryOptions& options)
      : surface_(surface), reflections_(reflections), options_(options) {}

  std::vector<FoundSymmetry> run() const {
    std::vector<FoundSymmetry> found;
    const auto add = [&](const Symmetry& rotation) {
      const Agreement agreement = verify(surface_, rotation, options_, Effort::dense);
      if (agreement.holds) found.push_back({rotation, agreement.residual, agreement.support});
    };
    for (const Symmetry& axis : common_axes()) add(axis);
    for (const Symmetry& axis : other_axes())
      if (const auto rotation = highest_rotation(axis)) add(*rotation);
    std::stable_sort(found.begin(), found.end(), [](const FoundSymmetry& a, const FoundSymmetry& b) {
      return a.symmetry.order > b.symmetry.order;
    });
    return found;
  }

 private:
  static bool contains(const std::vector<Symmetry>& axes, const Eigen::Vector3d& axis) {
    return std::any_of(axes.begin(), axes.end(), [&](const Symmetry& other) {
      return std::abs(other.axis.dot(axis)) > tolerance::parallel;
    });
  }

  /// The lines that two and more reflections have in common.
  std::vector<Symmetry> common_axes() const {
    std::vector<Symmetry> axes;
    for (std::size_t i = 0; i < reflections_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Eigen::Vector3d line = reflections_[i].symmetry.axis.cross(reflections_[j].symmetry.axis);
        if (line.norm() > nearly_across && !contains(axes, line.normalized()))
          axes.push_back(common_axis(line.normalized()));
      }
    return axes;
  }

  /// Returns the line nearest to the planes through it; its order is the number of these planes.
  Symmetry common_axis(const Eigen::Vector3d& line) const {
    Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
    Eigen::Vector3d offsets = Eigen::Vector3d::Zero();
    int count = 0;
    for (const FoundSymmetry& found : reflections_) {
      const Eigen::Vector3d& normal = found.symmetry.axis;
      if (std::abs(normal.dot(line)) > nearly_across) continue;
      normals += normal * normal.transpose();
      offsets += normal * normal.dot(found.symmetry.point);
      ++count;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normals);
    const Eigen::Matrix3d& basis = solver.eigenvectors();
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (int k = 1; k < 3; ++k) point += basis.col(k) * basis.col(k).dot(offsets) / solver.eigenvalues()(k);
    return {SymmetryKind::rotation, point, basis.col(0), count};
  }

  bool on_reflection(const Eigen::Vector3d& axis) const {
    return std::any_of(reflections_.begin(), reflections_.end(), [&](const FoundSymmetry& found) {
      return std::abs(found.symmetry.axis.dot(axis)) < nearly_across;
    });
  }

  /// Candidates in no reflection plane: an axis in one reflection plane lies in as many as its order.
  std::vector<Symmetry> other_axes() const {
    std::vector<Symmetry> axes;
    const auto add = [&](const Eigen::Vector3d& axis) {
      if (!contains(axes, axis) && is_principal(surface_, axis) && !on_reflection(axis))
        axes.push_back({SymmetryKind::rotation, Eigen::Vector3d::Zero(), axis, 2});
    };
    const Eigen::Matrix<double, 3, 6> candidates = axes_of(surface_);
    for (const Eigen::Vector3d axis : candidates.colwise()) add(axis);
    for (const Symmetry& axis : voted_axes(surface_)) add(axis.axis);
    return axes;
  }

  std::optional<Symmetry> plausible(Symmetry axis, int order) const {
    axis.order = order;
    axis = step_symmetry(surface_, axis, rough_reach, Effort::sparse);
    return verify(surface_, axis, loosen(options_), Effort::sparse).holds ? std::optional(axis)
                                                                          : std::nullopt;
  }

  std::optional<Symmetry> highest_rotation(const Symmetry& axis) const {
    // A power of a rotation is a rotation of prime order.
    const std::array primes{2, 3, 5, 7, 11};
    if (std::none_of(primes.begin(), primes.end(),
                     [&](int order) { return plausible(axis, order).has_value(); }))
      return {};
    for (int order = max_order; order >= 2; --order) {
      const std::optional<Symmetry> rough = plausible(axis, order);
      if (!rough) continue;
      const Symmetry fine = refine_symmetry(surface_, *rough, counterpart_reach(surface_, options_));
      if (verify(surface_, fine, options_, Effort::dense).holds && stands_out(fine) &&
          !on_reflection(fine.axis))
        return fine;
    }
    return {};
  }

  /// Returns whether the shape fits less well when rotated by a twelfth of a step more and less.
  bool stands_out(const Symmetry& rotation) const {
    const auto misfit = [&](double steps) {
      Eigen::Isometry3d map = Eigen::Isometry3d::Identity();
      map.rotate(Eigen::AngleAxisd(steps * 2 * std::numbers::pi / rotation.order, rotation.axis));
      map.translation() = rotation.point - map.linear() * rotation.point;
      return agreement(image_distances(surface_.index, surface_.medium.points, map), 1, options_).residual;
    };
    const double here = misfit(1);
    return here < misfit(1 - 1.0 / max_order) && here < misfit(1 + 1.0 / max_order);
  }

  const SymmetrySurface& surface_;
  const std::vector<FoundSymmetry>& reflections_;
  SymmetryOptions options_;
};

}  // namespace

std::vector<FoundSymmetry> find_rotations(const SymmetrySurface& surface,
                                          const std::vector<FoundSymmetry>& reflections,
                                          const SymmetryOptions& options) {
  return RotationSearch(surface, reflections, options).run();
}

}  // namespace stackabilization::detail
