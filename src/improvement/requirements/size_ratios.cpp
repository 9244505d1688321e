#include "improvement/requirements/size_ratios.h"

#include <algorithm>

#include "stackabilization/structure/tolerances.h"

namespace stackabilization {

namespace {

double ratio_of(double rest, double now) {
  return now > 0 ? std::min(rest / now, now / rest) : 0;
}

double smallest_ratio(const Cuboid& rest, const Cuboid& now) {
  const double smallest = tolerance::min_thickness * (rest.corners.row(7) - rest.corners.row(0)).norm();
  double least = 1;
  for (int axis = 1; axis < 8; axis *= 2) {
    Eigen::RowVector3d whole_before = Eigen::RowVector3d::Zero(), whole_after = whole_before;
    for (int corner = 0; corner < 8; ++corner) {
      if (corner & axis) continue;
      const Eigen::RowVector3d before = rest.corners.row(corner | axis) - rest.corners.row(corner),
                               after = now.corners.row(corner | axis) - now.corners.row(corner);
      if (before.norm() > 2 * smallest) least = std::min(least, after.norm() / before.norm());
      whole_before += before;
      whole_after += after;
    }
    if (whole_before.norm() > 8 * smallest)
      least = std::min(least, ratio_of(whole_before.norm(), whole_after.norm()));
  }
  return least;
}

double smallest_ratio(const GeneralizedCylinder& rest, const GeneralizedCylinder& now) {
  const Eigen::VectorXd before = section_arc_lengths(rest), after = section_arc_lengths(now);
  double least = ratio_of(before(before.size() - 1), after(after.size() - 1));
  for (Eigen::Index i = 0; i < rest.radii.size(); ++i)
    least = std::min(least, ratio_of(rest.radii(i), now.radii(i)));
  return least;
}

}  // namespace

SizeRatio min_size_ratio(const StructuredShape& rest, const Design& design) {
  SizeRatio result;
  for (std::size_t part = 0; part < design.primitives.size(); ++part) {
    const Primitive &before = rest.structure.parts[part].primitive, &after = design.primitives[part];
    const double ratio =
        std::holds_alternative<Cuboid>(before)
            ? smallest_ratio(std::get<Cuboid>(before), std::get<Cuboid>(after))
            : smallest_ratio(std::get<GeneralizedCylinder>(before), std::get<GeneralizedCylinder>(after));
    if (ratio < result.ratio) result = {ratio, static_cast<int>(part)};
  }
  return result;
}

}  // namespace stackabilization
