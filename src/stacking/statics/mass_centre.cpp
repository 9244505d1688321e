#include "stacking/statics/mass_centre.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "mesh/surface_moments.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/closed_surface.h"

namespace stackabilization::detail {

namespace {

/// Mass and first moment about `MassSums::origin`.
struct Mass {
  double amount = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

struct Body {
  Mass mass;  ///< signed by the orientation
  Eigen::AlignedBox3d box;
};

Eigen::AlignedBox3d box_of(const Shape& shape) {
  Eigen::AlignedBox3d box;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) box.extend(shape.corner(t, k));
  return box;
}

std::vector<Body> bodies(const Shape& shape, const ClosedSurface& surface, const Eigen::Vector3d& origin) {
  std::vector<Body> result(surface.representatives.size());
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const std::int32_t component = surface.component[static_cast<std::size_t>(t)];
    if (component < 0) continue;
    Body& body = result[static_cast<std::size_t>(component)];
    const Eigen::Vector3d a = shape.corner(t, 0) - origin, b = shape.corner(t, 1) - origin,
                          c = shape.corner(t, 2) - origin;
    const double volume = signed_volume(a, b, c);
    body.mass.amount += volume;
    body.mass.moment += volume / 4 * (a + b + c);
    body.box.extend(a).extend(b).extend(c);
  }
  return result;
}

/// Sum over all bodies, less the cavities.
Mass mass_of_bodies(std::vector<Body> bodies) {
  std::stable_sort(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) {
    return std::abs(a.mass.amount) > std::abs(b.mass.amount);
  });
  std::vector<double> factors;  // that make bodies positive and cavities negative
  Mass sum;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    double factor = bodies[i].mass.amount < 0 ? -1 : 1;
    for (std::size_t j = i; j-- > 0;)
      if (bodies[j].box.contains(bodies[i].box)) {
        factor = factors[j];
        const bool turned_against = bodies[i].mass.amount * bodies[j].mass.amount < 0;
        const bool holder_is_cavity = bodies[j].mass.amount * factors[j] < 0;
        if (holder_is_cavity && !turned_against) factor = -factor;
        break;
      }
    factors.push_back(factor);
    sum.amount += factor * bodies[i].mass.amount;
    sum.moment += factor * bodies[i].mass.moment;
  }
  return sum;
}

}  // namespace

MassCentre mass_centre(const Shape& shape) {
  const Eigen::AlignedBox3d box = box_of(shape);
  const Eigen::Vector3d origin = box.center();
  const SurfaceMoments surface_area(shape, origin);
  if (!(surface_area.area() > 0)) throw InputError("the shape has no area, so nothing that could stand");
  if (const ClosedSurface surface = closed_surface(shape); surface.closed) {
    const Mass solid = mass_of_bodies(bodies(shape, surface, origin));
    if (solid.amount > tolerance::relative * surface_area.area() * box.diagonal().norm())
      return {origin + solid.moment / solid.amount, true};
  }
  return {surface_area.centre(), false};
}

}  // namespace stackabilization::detail
