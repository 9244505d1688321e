#include <cmath>
#include <numbers>

#include "deformation/model/hollow.h"
#include "stackabilization/deformation/controller_model.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

/// A cup and its generalized cylinder, whose radii are those of the outer wall.
StructuredShape cup(const solids::FrustumShell& frustum) {
  StructuredShape cup{solids::frustum_shell(frustum), {}};
  GeneralizedCylinder cylinder = structures::straight_cylinder({0, 0, 0}, {0, 0, frustum.height}, 1, 24);
  for (Eigen::Index i = 0; i < cylinder.radii.size(); ++i)
    cylinder.radii(i) = frustum.outer_bottom +
                        (frustum.outer_top - frustum.outer_bottom) * cylinder.centres(i, 2) / frustum.height;
  cup.structure.parts = {{cup.shape.part_names.front(), cylinder, {}}};
  cup.structure.diagonal = 10;
  return cup;
}

/// Horizontal thickness of the wall at the rim, from the corner of the outer cone to that of the inner one.
double rim_thickness(const Shape& shape, double height) {
  double inner = 1e300, outer = 0;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v) {
    if (shape.vertices(v, 2) < height - 1e-9) continue;
    const double rho = shape.vertices.row(v).head<2>().norm();
    inner = std::min(inner, rho);
    outer = std::max(outer, rho);
  }
  return outer - inner;
}

Edit scaled_top(double factor) {
  return {{HandleKind::section, 0, 23}, Scale{factor, std::nullopt}, Falloff::linear};
}

}  // namespace

TEST_CASE("The inner side of a wall is found, floors and solid bodies have none", "[hollow]") {
  const solids::FrustumShell frustum;
  const StructuredShape shell = cup(frustum);
  const auto& cylinder = std::get<GeneralizedCylinder>(shell.structure.parts.front().primitive);
  const Eigen::VectorXd radii = detail::inner_radii(shell.shape, cylinder);
  REQUIRE(radii.size() == 24);
  // The middle of the first piece of the curve, at 8 / 46 of the height, lies in the floor.
  CHECK(radii(0) == 0);
  const double flattest = std::cos(std::numbers::pi / frustum.segments);
  for (Eigen::Index i = 3; i < 23; ++i) {
    const double inner = 2.5 + (cylinder.centres(i, 2) - 0.5) / 7.5;
    CHECK(radii(i) <= inner + 1e-9);
    CHECK(radii(i) >= inner * flattest - 1e-9);
  }
  CHECK(detail::inner_radii(solids::cylinder(1, 5, 48),
                            structures::straight_cylinder({0, 0, 0}, {0, 0, 5}, 1, 24))
            .size() == 0);
}

TEST_CASE("Walls keep their thickness in smooth designs, and scale in those of the paper", "[hollow]") {
  const solids::FrustumShell frustum;
  for (const double factor : {0.7, 1.3}) {
    const ControllerModel smooth(cup(frustum), {}, Following::smooth), free(cup(frustum), {});
    const DeformationResult kept = smooth.deformed({scaled_top(factor)}, {}),
                            scaled = free.deformed({scaled_top(factor)}, {});
    REQUIRE_FALSE(kept.refusal);
    REQUIRE_FALSE(scaled.refusal);
    CHECK(rim_thickness(kept.design.shape, frustum.height) == Approx(0.5).epsilon(1e-3));
    CHECK(rim_thickness(scaled.design.shape, frustum.height) == Approx(0.5 * factor).epsilon(1e-3));
    CHECK(std::abs(kept.design.shape.vertices.maxCoeff() - scaled.design.shape.vertices.maxCoeff()) < 1e-9);
  }
}

TEST_CASE("A wall that is thicker than the new radius gets thinner and does not turn inside out",
          "[hollow]") {
  const ControllerModel smooth(cup({}), {}, Following::smooth);
  const DeformationResult narrow = smooth.deformed({scaled_top(0.1)}, {});
  REQUIRE_FALSE(narrow.refusal);
  const double left = rim_thickness(narrow.design.shape, 8);
  CHECK(left > 0.05);
  CHECK(left < 0.5);
}
