#include "improvement/design/configuration_key.h"

#include <cmath>
#include <cstddef>
#include <variant>

#include "stackabilization/core/fingerprint.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

namespace {

template <class Now, class Rest>
void add_displacements(Fingerprint& print, const Now& now, const Rest& rest, double grid) {
  print.add_numbers(((now - rest) / grid).array().round().matrix());
}

struct Grid {
  Eigen::RowVector3d origin;  ///< translation of the whole shape
  double step;                ///< grid step, model units
};

void add_points(Fingerprint& print, const Points& now, const Points& rest, const Grid& grid) {
  add_displacements(print, (now.rowwise() - grid.origin).eval(), rest, grid.step);
}

void add(Fingerprint& print, const Primitive& now, const Primitive& rest, const Grid& grid) {
  add_points(print, control_points(now), control_points(rest), grid);
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&now);
  if (cylinder == nullptr) return;
  const auto& at_rest = std::get<GeneralizedCylinder>(rest);
  add_displacements(print, cylinder->radii, at_rest.radii, grid.step);
  add_displacements(print, cylinder->rotation.coeffs(), at_rest.rotation.coeffs(), tolerance::same_design);
}

}  // namespace

ConfigurationKeys::ConfigurationKeys(const DeformationModel& space)
    : space_(space),
      rest_(space.at_rest()),
      grid_(tolerance::same_design * space.rest().structure.diagonal) {}

std::uint64_t ConfigurationKeys::key(const Design& design) const {
  Fingerprint print;
  if (!space_.capabilities().edits_primitives) {
    const Points &now = design.shape.vertices, &rest = rest_.shape.vertices;
    add_points(print, now, rest, {now.row(0) - rest.row(0), grid_});
    return print.value();
  }
  const Eigen::RowVector3d origin =
      control_points(design.primitives[0]).row(0) - control_points(rest_.primitives[0]).row(0);
  for (std::size_t part = 0; part < design.primitives.size(); ++part)
    add(print, design.primitives[part], rest_.primitives[part], {origin, grid_});
  return print.value();
}

}  // namespace stackabilization::detail
