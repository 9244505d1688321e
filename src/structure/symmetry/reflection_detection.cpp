#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "stackabilization/core/tolerances.h"
#include "stackabilization/structure/tolerances.h"
#include "structure/symmetry/symmetry_candidates.h"
#include "structure/symmetry/symmetry_refinement.h"
#include "structure/symmetry/symmetry_voting.h"

namespace stackabilization::detail {

namespace {

constexpr double same_offset = 0.02;
constexpr double off_principal = 0.05;  // of the trace of the second moments
constexpr double shadow_cosine = 0.85, shadow_factor = 10;
constexpr std::size_t max_reflections = 64;

bool same_plane(const Symmetry& a, const Symmetry& b) {
  const double cosine = a.axis.dot(b.axis);
  const double offset = a.axis.dot(a.point) - std::copysign(1.0, cosine) * b.axis.dot(b.point);
  return std::abs(cosine) > tolerance::aligned && std::abs(offset) < same_offset;
}

Symmetry roughly(const SymmetrySurface& surface, const Symmetry& candidate) {
  return step_symmetry(surface, candidate, rough_reach, Effort::sparse);
}

std::optional<FoundSymmetry> finely(const SymmetrySurface& surface, const Symmetry& rough,
                                    const SymmetryOptions& options) {
  if (!verify(surface, rough, loosen(options), Effort::sparse).holds) return {};
  const double reach = counterpart_reach(surface, options);
  const Symmetry near = step_symmetry(surface, rough, reach, Effort::dense);
  if (!verify(surface, near, options, Effort::dense).holds) return {};
  const Symmetry fine = refine_symmetry(surface, near, reach);
  const Agreement found = verify(surface, fine, options, Effort::dense);
  if (!found.holds) return {};
  return FoundSymmetry{fine, found.residual, found.support};
}

class ReflectionSearch {
 public:
  ReflectionSearch(const SymmetrySurface& surface, const SymmetryOptions& options)
      : surface_(surface), options_(options) {}

  std::vector<FoundSymmetry> run() {
    const Eigen::Matrix<double, 3, 6> candidates = axes_of(surface_);
    for (const Eigen::Vector3d axis : candidates.colwise())
      consider({SymmetryKind::reflection, Eigen::Vector3d::Zero(), axis, 2});
    for (const Symmetry& plane : voted_reflections(surface_, options_)) consider(plane);
    drop_shadows();
    complete();
    drop_shadows();
    sort();
    return std::move(found_);
  }

 private:
  void consider(const Symmetry& candidate) {
    if (found_.size() >= max_reflections || !is_principal(surface_, candidate.axis) || known(candidate))
      return;
    const Symmetry rough = roughly(surface_, candidate);
    if (known(rough)) return;
    tried_.push_back(rough);
    const std::optional<FoundSymmetry> fine = finely(surface_, rough, options_);
    if (!fine) return;
    for (const FoundSymmetry& other : found_)
      if (same_plane(other.symmetry, fine->symmetry)) return;
    found_.push_back(*fine);
  }

  bool known(const Symmetry& plane) const {
    const auto same = [&](const Symmetry& other) { return same_plane(plane, other); };
    return std::any_of(tried_.begin(), tried_.end(), same) ||
           std::any_of(found_.begin(), found_.end(),
                       [&](const FoundSymmetry& other) { return same(other.symmetry); });
  }

  /// The image of one reflection in another is a symmetry as well.
  void complete() {
    for (std::size_t i = 0; i < found_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (const auto& [mirror, plane] : {std::pair(i, j), std::pair(j, i)}) {
          const Eigen::Isometry3d map = isometry_of(found_[mirror].symmetry);
          Symmetry image = found_[plane].symmetry;
          image.point = map * image.point;
          image.axis = map.linear() * image.axis;
          consider(image);
        }
  }

  /// Removes spurious planes. With facets and flutes, planes between the true ones nearly fit, too. A plane
  /// is removed when another one at a small angle is far better.
  void drop_shadows() {
    const auto shadow = [&](const FoundSymmetry& found) {
      return std::any_of(found_.begin(), found_.end(), [&](const FoundSymmetry& other) {
        return std::abs(other.symmetry.axis.dot(found.symmetry.axis)) > shadow_cosine &&
               found.residual > std::max(shadow_factor * other.residual, options_.tolerance / shadow_factor);
      });
    };
    std::vector<FoundSymmetry> kept;
    for (const FoundSymmetry& found : found_)
      if (!shadow(found)) kept.push_back(found);
    found_ = std::move(kept);
  }

  void sort() {
    const auto whole_steps = [](double value) { return std::round(value / tolerance::relative); };
    const auto key = [&](const FoundSymmetry& found) {
      double extent = 0;
      for (int k = 0; k < 3; ++k)
        if (std::abs(surface_.box.axes.col(k).dot(found.symmetry.axis)) > tolerance::aligned)
          extent = surface_.box.half_extents(k);
      // Values that differ by rounding are equal.
      return std::pair(-whole_steps(extent), extent > 0 ? 0 : whole_steps(found.residual));
    };
    std::stable_sort(found_.begin(), found_.end(),
                     [&](const FoundSymmetry& a, const FoundSymmetry& b) { return key(a) < key(b); });
  }

  const SymmetrySurface& surface_;
  SymmetryOptions options_;
  std::vector<FoundSymmetry> found_;
  std::vector<Symmetry> tried_;  ///< approached candidates, good or bad
};

}  // namespace

std::vector<FoundSymmetry> find_reflections(const SymmetrySurface& surface, const SymmetryOptions& options) {
  return ReflectionSearch(surface, options).run();
}

std::optional<FoundSymmetry> reflection_near(const SymmetrySurface& surface, const Symmetry& candidate,
                                             const SymmetryOptions& options) {
  return finely(surface, roughly(surface, candidate), options);
}

bool is_principal(const SymmetrySurface& surface, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d image = surface.spread * axis;
  return (image - axis * axis.dot(image)).norm() <= off_principal * surface.spread.trace();
}

Eigen::Matrix<double, 3, 6> axes_of(const SymmetrySurface& surface) {
  Eigen::Matrix<double, 3, 6> axes;
  axes << Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(surface.spread).eigenvectors(), surface.box.axes;
  return axes;
}

}  // namespace stackabilization::detail
