#include "stackabilization/structure/symmetry_detection.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "stackabilization/shape/tolerances.h"
#include "stackabilization/structure/symmetry_refinement.h"
#include "stackabilization/structure/symmetry_verification.h"
#include "stackabilization/structure/symmetry_voting.h"

namespace stackabilization {

namespace {

using detail::Effort;
using detail::SymmetrySurface;

constexpr int dense_samples = 1200;
constexpr double rough_reach = 0.1;  // of candidates, own frame
constexpr double same_normal = 0.999, same_offset = 0.02;
constexpr double nearly_across = 0.05;  // cosine
constexpr double off_principal = 0.05;  // of the trace of the second moments
constexpr double shadow_cosine = 0.85, shadow_factor = 10;
constexpr std::size_t most_reflections = 64;
constexpr int highest_order = 12;

bool same_plane(const Symmetry& a, const Symmetry& b) {
  const double cosine = a.axis.dot(b.axis);
  const double offset = a.axis.dot(a.point) - std::copysign(1.0, cosine) * b.axis.dot(b.point);
  return std::abs(cosine) > same_normal && std::abs(offset) < same_offset;
}

class Detection {
 public:
  Detection(const Shape& shape, const SymmetryOptions& options)
      : surface_(detail::symmetry_surface(shape, dense_samples)), options_(options) {}

  std::vector<FoundSymmetry> run() {
    revolutions_ = detail::revolutions(surface_, options_, detail::Roundness::faceted);
    // A body of revolution is symmetric in every plane through its axis; those are left out.
    for (const Symmetry& axis : revolutions_)
      try_reflection({SymmetryKind::reflection, axis.point, axis.axis, 2});
    if (revolutions_.empty()) {
      find_reflections();
      drop_shadows();
      complete_reflections();
      drop_shadows();
    }
    sort_reflections();
    std::vector<FoundSymmetry> rotations;
    if (revolutions_.empty()) rotations = find_rotations();

    std::vector<FoundSymmetry> found = std::move(reflections_);
    found.insert(found.end(), rotations.begin(), rotations.end());
    for (const Symmetry& axis : revolutions_) found.push_back(measured(axis));
    for (FoundSymmetry& each : found) {
      each.symmetry = detail::to_model(surface_, each.symmetry);
      Eigen::Index largest;
      each.symmetry.axis.cwiseAbs().maxCoeff(&largest);
      if (each.symmetry.axis(largest) < 0) each.symmetry.axis *= -1;
    }
    return found;
  }

 private:
  FoundSymmetry measured(const Symmetry& symmetry) const {
    const detail::Agreement agreement = detail::verify(surface_, symmetry, options_, Effort::dense);
    return {symmetry, agreement.residual, agreement.support};
  }

  /// Normals and axes of symmetries are principal axes of the second moments.
  bool principal(const Eigen::Vector3d& axis) const {
    const Eigen::Vector3d image = surface_.spread * axis;
    return (image - axis * axis.dot(image)).norm() <= off_principal * surface_.spread.trace();
  }

  void find_reflections() {
    const Eigen::Matrix3d moments =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(surface_.spread).eigenvectors();
    for (const Eigen::Matrix3d& axes : {surface_.box.axes, moments})
      for (int k = 0; k < 3; ++k)
        try_reflection({SymmetryKind::reflection, Eigen::Vector3d::Zero(), axes.col(k), 2});
    for (const Symmetry& plane : detail::voted_reflections(surface_, options_)) try_reflection(plane);
  }

  /// With two reflections their images in each other are symmetries as well.
  void complete_reflections() {
    for (std::size_t i = 0; i < reflections_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (const auto& [mirror, plane] : {std::pair(i, j), std::pair(j, i)}) {
          const Eigen::Isometry3d map = isometry_of(reflections_[mirror].symmetry);
          Symmetry image = reflections_[plane].symmetry;
          image.point = map * image.point;
          image.axis = map.linear() * image.axis;
          try_reflection(image);
        }
  }

  /// Facets and flutes make planes between true ones fit nearly, too. A plane goes when one at a small angle
  /// is far better.
  void drop_shadows() {
    const auto shadow = [&](const FoundSymmetry& found) {
      return std::any_of(reflections_.begin(), reflections_.end(), [&](const FoundSymmetry& other) {
        return std::abs(other.symmetry.axis.dot(found.symmetry.axis)) > shadow_cosine &&
               found.residual > std::max(shadow_factor * other.residual, options_.tolerance / shadow_factor);
      });
    };
    std::vector<FoundSymmetry> kept;
    for (const FoundSymmetry& found : reflections_)
      if (!shadow(found)) kept.push_back(found);
    reflections_ = std::move(kept);
  }

  void try_reflection(const Symmetry& candidate) {
    if (reflections_.size() >= most_reflections || !principal(candidate.axis)) return;
    if (known(candidate)) return;
    const Symmetry rough = detail::refined(surface_, candidate, rough_reach, Effort::sparse);
    if (known(rough)) return;
    tried_.push_back(rough);
    if (!detail::verify(surface_, rough, detail::loosened(options_), Effort::sparse).holds) return;
    const double reach = 3 * options_.tolerance * surface_.scale;
    const Symmetry fine = detail::refined(surface_, rough, reach, Effort::dense);
    const detail::Agreement agreement = detail::verify(surface_, fine, options_, Effort::dense);
    if (!agreement.holds) return;
    for (const FoundSymmetry& other : reflections_)
      if (same_plane(other.symmetry, fine)) return;
    reflections_.push_back({fine, agreement.residual, agreement.support});
  }

  bool known(const Symmetry& plane) const {
    const auto same = [&](const Symmetry& other) { return same_plane(plane, other); };
    return std::any_of(tried_.begin(), tried_.end(), same) ||
           std::any_of(reflections_.begin(), reflections_.end(),
                       [&](const FoundSymmetry& other) { return same(other.symmetry); });
  }

  /// Those across an axis of the box first, longest extent first; then the others, best first.
  void sort_reflections() {
    const auto key = [&](const FoundSymmetry& found) {
      double extent = 0;
      for (int k = 0; k < 3; ++k)
        if (std::abs(surface_.box.axes.col(k).dot(found.symmetry.axis)) > same_normal)
          extent = surface_.box.half_extents(k);
      // Below rounding residuals are equal.
      const double residual = std::floor(found.residual / tolerance::relative);
      return std::pair(-extent, extent > 0 ? 0 : residual);
    };
    std::stable_sort(reflections_.begin(), reflections_.end(),
                     [&](const FoundSymmetry& a, const FoundSymmetry& b) { return key(a) < key(b); });
  }

  std::vector<FoundSymmetry> find_rotations() {
    std::vector<FoundSymmetry> rotations;
    const auto add = [&](const Symmetry& rotation) {
      const FoundSymmetry found = measured(rotation);
      if (detail::verify(surface_, rotation, options_, Effort::dense).holds) rotations.push_back(found);
    };
    const std::vector<Symmetry> axes = common_axes();
    for (const Symmetry& axis : axes) add(axis);
    for (const Symmetry& axis : axis_candidates()) {
      if (const auto rotation = highest_rotation(axis)) add(*rotation);
    }
    std::stable_sort(rotations.begin(), rotations.end(), [](const FoundSymmetry& a, const FoundSymmetry& b) {
      return a.symmetry.order > b.symmetry.order;
    });
    return rotations;
  }

  /// About the line that n reflections have in common the shape turns into itself n times.
  std::vector<Symmetry> common_axes() const {
    std::vector<Symmetry> axes;
    for (std::size_t i = 0; i < reflections_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Eigen::Vector3d line =
            reflections_[i].symmetry.axis.cross(reflections_[j].symmetry.axis).normalized();
        if (std::any_of(axes.begin(), axes.end(),
                        [&](const Symmetry& axis) { return std::abs(axis.axis.dot(line)) > same_normal; }))
          continue;
        axes.push_back(common_axis(line));
      }
    return axes;
  }

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
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (int k = 1; k < 3; ++k)
      point +=
          solver.eigenvectors().col(k) * solver.eigenvectors().col(k).dot(offsets) / solver.eigenvalues()(k);
    return {SymmetryKind::rotation, point, solver.eigenvectors().col(0), count};
  }

  bool on_reflection(const Eigen::Vector3d& axis) const {
    return std::any_of(reflections_.begin(), reflections_.end(), [&](const FoundSymmetry& found) {
      return std::abs(found.symmetry.axis.dot(axis)) < nearly_across;
    });
  }

  std::vector<Symmetry> axis_candidates() const {
    const Eigen::Matrix3d moments =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(surface_.spread).eigenvectors();
    std::vector<Symmetry> axes;
    const auto add = [&](const Eigen::Vector3d& axis) {
      const bool known = std::any_of(axes.begin(), axes.end(), [&](const Symmetry& other) {
        return std::abs(other.axis.dot(axis)) > 1 - nearly_across / 2;
      });
      if (!known && principal(axis) && !on_reflection(axis))
        axes.push_back({SymmetryKind::rotation, Eigen::Vector3d::Zero(), axis, 2});
    };
    for (const Eigen::Matrix3d& basis : {surface_.box.axes, moments})
      for (int k = 0; k < 3; ++k) add(basis.col(k));
    for (const Symmetry& axis : detail::voted_axes(surface_)) add(axis.axis);
    return axes;
  }

  /// The rotation of the highest order about (nearly) this axis, if any.
  std::optional<Symmetry> highest_rotation(Symmetry axis) const {
    const auto plausible = [&](int order) {
      axis.order = order;
      const Symmetry rough = detail::refined(surface_, axis, rough_reach, Effort::sparse);
      return detail::verify(surface_, rough, detail::loosened(options_), Effort::sparse).holds
                 ? std::optional(rough)
                 : std::nullopt;
    };
    // A power of it is a rotation of prime order.
    const std::array primes{2, 3, 5, 7, 11};
    if (std::none_of(primes.begin(), primes.end(), plausible)) return {};
    for (int order = highest_order; order >= 2; --order) {
      const std::optional<Symmetry> rough = plausible(order);
      if (!rough) continue;
      const double reach = 3 * options_.tolerance * surface_.scale;
      const Symmetry fine = detail::refined(surface_, *rough, reach, Effort::dense);
      if (detail::verify(surface_, fine, options_, Effort::dense).holds && stands_out(fine) &&
          !on_reflection(fine.axis))
        return fine;
    }
    return {};
  }

  /// Turned a twelfth of a step further or less far, does the shape fit less well?
  bool stands_out(const Symmetry& rotation) const {
    const auto misfit = [&](double steps) {
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(steps * 2 * std::numbers::pi / rotation.order, rotation.axis).toRotationMatrix();
      Eigen::Isometry3d map = Eigen::Isometry3d::Identity();
      map.linear() = turn;
      map.translation() = rotation.point - turn * rotation.point;
      return detail::agreement(detail::image_distances(surface_.index, surface_.medium.points, map), 1,
                               options_)
          .residual;
    };
    const double here = misfit(1);
    return here < misfit(1 - 1.0 / highest_order) && here < misfit(1 + 1.0 / highest_order);
  }

  SymmetrySurface surface_;
  SymmetryOptions options_;
  std::vector<Symmetry> revolutions_;
  std::vector<FoundSymmetry> reflections_;
  std::vector<Symmetry> tried_;  ///< refined candidates, good or bad
};

}  // namespace

std::vector<FoundSymmetry> find_symmetries(const Shape& shape, const SymmetryOptions& options) {
  validate(shape);
  detail::validate(options);
  return Detection(shape, options).run();
}

}  // namespace stackabilization
