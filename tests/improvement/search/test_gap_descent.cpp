// Proportions of designs, and the pursuit of all contacts at once.
#include <cmath>
#include <string>
#include <variant>

#include "improvement/contacts/gap_excess.h"
#include "improvement/requirements/size_ratios.h"
#include "improvement/search/gap_descent.h"
#include "stackabilization/deformation/factory.h"
#include "support/catch.h"
#include "support/still_designs.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

Design design_with(const StructuredShape& rest, Primitive primitive) {
  return {{}, {std::move(primitive)}, rest.shape};
}

Candidate at_rest(const RequirementChecker& checker, const Eigen::Vector3d& direction) {
  Candidate start;
  start.design = checker.space().at_rest();
  start.direction = direction;
  start.measured = checker.measure(start.design.shape, Direction(direction));
  return start;
}

}  // namespace

TEST_CASE("proportions of a cuboid are those of its sides, shrunk or stretched") {
  const StructuredShape rest = structures::box_alone({1, 2, 4});
  const auto& box = std::get<Cuboid>(rest.structure.parts[0].primitive);
  CHECK(min_size_ratio(rest, design_with(rest, box)).ratio == 1);
  CHECK(min_size_ratio(rest, design_with(rest, box)).part == -1);
  for (int axis = 0; axis < 3; ++axis)
    for (const double factor : {0.25, 0.5, 2.0, 5.0}) {
      Cuboid scaled = box;
      scaled.corners.col(axis) *= factor;
      const SizeRatio found = min_size_ratio(rest, design_with(rest, scaled));
      CHECK(found.ratio == Approx(std::min(factor, 1 / factor)).epsilon(1e-12));
      CHECK(found.part == 0);
    }
  Cuboid wedge = box;  // one edge of four shrinks to a tenth
  wedge.corners.row(4) = 0.9 * wedge.corners.row(0) + 0.1 * wedge.corners.row(4);
  CHECK(min_size_ratio(rest, design_with(rest, wedge)).ratio == Approx(0.1).epsilon(1e-12));
  Cuboid frustum = box;  // slanting edges are longer, and that is all
  for (const int corner : {4, 5, 6, 7}) frustum.corners.row(corner).head<2>() *= 0.5;
  CHECK(min_size_ratio(rest, design_with(rest, frustum)).ratio == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("proportions of a cylinder are those of its radii and its length") {
  const GeneralizedCylinder tube = structures::straight_cylinder({0, 0, 0}, {0, 0, 6}, 1, 9);
  const StructuredShape rest = structures::tube_alone(tube, 12);
  GeneralizedCylinder now = tube;
  now.radii(3) = 0.3;
  CHECK(min_size_ratio(rest, design_with(rest, now)).ratio == Approx(0.3).epsilon(1e-12));
  now.radii(3) = 4;
  CHECK(min_size_ratio(rest, design_with(rest, now)).ratio == Approx(0.25).epsilon(1e-12));
  now = tube;
  now.centres.col(2) *= 0.6;
  CHECK(min_size_ratio(rest, design_with(rest, now)).ratio == Approx(0.6).epsilon(1e-12));
}

TEST_CASE("a pursuit frees every contact of one height, where one edit alone would raise nothing") {
  // Bars between the legs, all at one height, in two classes of symmetric parts: both have to go up.
  const auto space = deformation_model(structures::table(1));
  const Requirements wanted = designs::frame_requirements(0.55);
  const RequirementChecker checker(*space, wanted);
  const Candidate start = at_rest(checker, {0, 0, 1});
  const GapDescentResult result = descend_gaps(checker, start);
  const Candidate& found = result.candidate;
  CHECK(found.measured.value >= wanted.target);
  CHECK(found.design.edits.size() > 1);
  CHECK(found.reasons.size() == found.design.edits.size());
  CHECK(found.energy.gain == Approx(found.measured.value - start.measured.value).margin(1e-12));
  CHECK_FALSE(checker.form_obstacle(found.design));
  // What it says is what its edits make.
  const auto constraints =
      deformation_constraints(wanted, space->rest(), Direction(Eigen::Vector3d::UnitZ()));
  const DeformationResult again = space->deformed(found.design.edits, constraints);
  REQUIRE_FALSE(again.refusal);
  CHECK(again.design.shape.vertices == found.design.shape.vertices);

  GapDescentOptions options;
  options.evaluations = result.evaluations;
  CHECK(descend_gaps(checker, start, options).candidate.design.shape.vertices == found.design.shape.vertices);
  for (const std::int64_t limit : {std::int64_t{0}, result.evaluations - 1}) {
    options.evaluations = limit;
    const GapDescentResult less = descend_gaps(checker, start, options);
    CHECK(less.evaluations <= limit);
    CHECK(less.candidate.design.edits.size() < found.design.edits.size());
  }
  options = {};
  options.steps = 1;
  CHECK(descend_gaps(checker, start, options).candidate.design.edits.size() == 1);
  CHECK_FALSE(descend_gaps(checker, start, options).stuck);
  CHECK(descend_gaps(checker, start, options).excess > 0);
  CHECK(result.excess == 0);
  options.cancelled = [] { return true; };
  CHECK(descend_gaps(checker, start, options).candidate.design.edits.empty());
  Requirements met = wanted;
  met.target = -1;
  CHECK(descend_gaps(RequirementChecker(*space, met), start).candidate.design.edits.empty());
}

TEST_CASE("with limits of quality a pursuit passes over edits that break one of the slow ones") {
  // The rung comes down on the legs of the copy below. It has to go up by 1.2, and the step of 1.8 would take
  // it into the shelf.
  const auto space = deformation_model(structures::trestle(true), {.following = Following::smooth});
  Requirements wanted = designs::frame_requirements(0.48);
  wanted.quality.emplace();
  const Direction up(0, 0, 1);
  const auto pursued = [&] {
    const RequirementChecker checker(*space, wanted);
    GapDescentOptions options;
    options.edits.family = EditFamily::smooth;
    return descend_gaps(checker, at_rest(checker, up.unit()), options).candidate;
  };
  const auto collides = [&](const Candidate& found) -> bool {
    Requirements usual = wanted;
    usual.quality.emplace();
    const auto failed = RequirementChecker(*space, usual).obstacle(found.design, up);
    return failed && failed->measure == QualityMeasure::collision;
  };
  const Candidate found = pursued();
  CHECK(found.measured.value >= wanted.target);
  CHECK_FALSE(collides(found));
  (*wanted.quality)[QualityMeasure::collision] = 1;
  CHECK(collides(pursued()));
}

TEST_CASE("a pair counts by the portion of its overlap that is left") {
  // Legs from 3.1 to 3.9 under a top that ends at 4: each has to move out by 0.9 to pass the top below.
  const designs::Still space(structures::table());
  const RequirementChecker checker(space, designs::frame_requirements(0.05));
  const Direction up(0, 0, 1);
  const detail::GapExcess gap(checker, up);
  const double excess = 4 * (6 - 0.95 * 6) / 6;  // of four legs that stand on the top, 6 above the ground
  for (const double move : {0.0, 0.3, 0.6, 0.89, 0.95}) {
    Shape moved = space.rest().shape;
    for (Eigen::Index t = 0; t < moved.triangle_count(); ++t) {
      const std::string& name =
          moved.part_names[static_cast<std::size_t>(moved.triangle_part[static_cast<std::size_t>(t)])];
      if (name.find("leg") != 0) continue;
      for (const std::int32_t v : moved.triangles.row(t)) {
        const double x = space.rest().shape.vertices(v, 0);
        moved.vertices(v, 0) = x + (x < 0 ? -move : move);
      }
    }
    const detail::SummedExcess found = gap.of(moved, checker.measure(moved, up));
    INFO(move);
    CHECK(found.equal == Approx(move < 0.9 ? excess : 0).margin(1e-9));
    CHECK(found.by_overlap == Approx(move < 0.9 ? excess * (1 - move / 0.9) : 0).margin(1e-9));
  }
}
