#include "stackabilization/structure/symmetry_detection.h"

#include "structure/symmetry/symmetry_candidates.h"
#include "structure/symmetry/symmetry_verification.h"

namespace stackabilization {

namespace {

constexpr int dense_samples = 1200;
constexpr int roundest_prism = 13;  // that is not called round

/// With an axis that points to the positive side of the file's axis next to it.
FoundSymmetry in_model_units(const detail::SymmetrySurface& surface, FoundSymmetry found) {
  found.symmetry = detail::to_model(surface, found.symmetry);
  Eigen::Index largest;
  found.symmetry.axis.cwiseAbs().maxCoeff(&largest);
  if (found.symmetry.axis(largest) < 0) found.symmetry.axis *= -1;
  return found;
}

}  // namespace

std::vector<FoundSymmetry> find_symmetries(const Shape& shape, const SymmetryOptions& options) {
  validate(shape);
  detail::validate(options);
  const detail::SymmetrySurface surface = detail::symmetry_surface(shape, dense_samples);
  std::vector<FoundSymmetry> found;
  std::vector<Symmetry> axes = detail::revolutions(surface, options, detail::Roundness::faceted);
  if (axes.empty()) {
    found = detail::find_reflections(surface, options);
    const std::vector<FoundSymmetry> rotations = detail::find_rotations(surface, found, options);
    found.insert(found.end(), rotations.begin(), rotations.end());
    if (!rotations.empty() && rotations.front().symmetry.order > roundest_prism) {
      axes.push_back(rotations.front().symmetry);
      axes.front().kind = SymmetryKind::revolution;
      found.clear();
    }
  }
  // A body of revolution is symmetric in every plane through its axis; only those across one are named.
  for (const Symmetry& axis : axes)
    if (const auto across =
            detail::reflection_near(surface, {SymmetryKind::reflection, axis.point, axis.axis, 2}, options))
      found.push_back(*across);
  for (const Symmetry& axis : axes) {
    const detail::Agreement agreement = detail::verify(surface, axis, options, detail::Effort::dense);
    found.push_back({axis, agreement.residual, agreement.support});
  }
  for (FoundSymmetry& each : found) each = in_model_units(surface, each);
  return found;
}

}  // namespace stackabilization
