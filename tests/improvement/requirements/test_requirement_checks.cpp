#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/tolerances.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/still_designs.h"
#include "support/structures.h"

using namespace stackabilization;
using namespace stackabilization::designs;

namespace {

/// A bar of two boxes that share the four vertices between them.
StructuredShape bar_of_two() {
  StructuredShape bar =
      alone(solids::box({2, 1, 1}), structures::straight_cylinder({0, 0, 0}, {1, 0, 0}, 1, 2));
  Shape& shape = bar.shape;
  shape.part_names = {"a", "b"};
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    shape.triangle_part[static_cast<std::size_t>(t)] = t % 2 == 0 ? 0 : 1;
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5);
  bar.structure.parts = {{"a", cuboid_of({{0.5, 0.5, 0.5}, Eigen::Matrix3d::Identity(), half}), {}},
                         {"b", cuboid_of({{1.5, 0.5, 0.5}, Eigen::Matrix3d::Identity(), half}), {}}};
  return bar;
}

std::optional<Check> first_failed_but_target(const std::vector<Check>& checks) {
  for (const Check& check : checks)
    if (!check.passed && !check.is_of_target()) return check;
  return std::nullopt;
}

/// Returns the check of one kind, after a look whether the first obstacle is the first check that failed.
Check check_of(const DeformationModel& space, const Requirements& requirements, const Design& design,
               CheckKind kind) {
  const RequirementChecker checker(space, requirements);
  const std::vector<Check> checks = checker.check(design, upwards).checks;
  CHECK(checker.obstacle(design, upwards) == first_failed_but_target(checks));
  for (const Check& check : checks)
    if (check.kind == kind) return check;
  FAIL("there is no check of the " + name_of(Check{kind}));
  return {};
}

}  // namespace

TEST_CASE("The target is compared without slack", "[requirements]") {
  const Still space(cup());
  const double reached =
      RequirementChecker(space, frame_requirements()).check(space.at_rest(), upwards).measured.value;
  const Check passes = check_of(space, frame_requirements(reached), space.at_rest(), CheckKind::target);
  CHECK(passes.passed);
  CHECK(passes.value == reached);
  CHECK(passes.demanded == reached);
  const Requirements above = frame_requirements(std::nextafter(reached, 1.0));
  CHECK_FALSE(check_of(space, above, space.at_rest(), CheckKind::target).passed);
  CHECK_FALSE(RequirementChecker(space, above).check(space.at_rest(), upwards).passed());
}

TEST_CASE("A room is compared by the length of the stack, whatever the boxes are", "[requirements]") {
  const Still space(cup());
  Requirements requirements = frame_requirements(0.9);  // not what is asked for
  requirements.keep_height = false;
  const double length = 8 + 4 * 4;
  requirements.length_limit = StackLengthLimit{5, length * (1 + 1e-12)};
  const Check fits = check_of(space, requirements, space.at_rest(), CheckKind::room);
  CHECK(fits.passed);
  CHECK(fits.value == Approx(length));
  CHECK(fits.demanded == requirements.length_limit->length);
  CHECK(RequirementChecker(space, requirements).check(space.at_rest(), upwards).passed());
  requirements.length_limit->length = length * (1 - 1e-12);
  CHECK_FALSE(check_of(space, requirements, space.at_rest(), CheckKind::room).passed);
  // As wide as it may be, and S with it; a fifth higher, and the stack is too.
  CHECK(check_of(space, requirements, scaled(space.at_rest(), {3, 3, 0.99}), CheckKind::room).passed);
  CHECK_FALSE(check_of(space, requirements, scaled(space.at_rest(), {3, 3, 1.2}), CheckKind::room).passed);
}

TEST_CASE("What S a design needs for a room follows from its extent and its boxes", "[requirements]") {
  const Still space(cup());
  Requirements requirements = frame_requirements(0.6);
  CHECK(RequirementChecker(space, requirements).required_stackability({}) == 0.6);
  for (const double length : {9.0, 12.0, 30.0})
    for (const double extent : {5.0, 8.0})
      for (const double slenderness : {0.5, 1.0, 1.7})
        for (const double f_max : {0.0, 0.4, 1.5, 8.0}) {
          requirements.length_limit = StackLengthLimit{6, length};
          const RequirementChecker checker(space, requirements);
          Stackability measured{{0, 0, 1}, f_max, extent, 10, 10 * slenderness / extent, 0};
          measured.value = 1 - f_max / extent * slenderness;
          INFO(length << ' ' << extent << ' ' << slenderness << ' ' << f_max);
          CHECK(checker.meets_target(measured) == (extent + 5 * f_max <= length));
          CHECK(checker.meets_target(measured) ==
                (measured.value >= checker.required_stackability(measured)));
        }
}

TEST_CASE("The height is kept to a billionth, unless it need not be", "[requirements]") {
  const Still space(cup());
  const Design higher = scaled(space.at_rest(), {1, 1, 1 + 1.1e-9});
  const Design nearly = scaled(space.at_rest(), {1, 1, 1 + 0.9e-9});
  CHECK_FALSE(check_of(space, frame_requirements(), higher, CheckKind::height).passed);
  CHECK(check_of(space, frame_requirements(), nearly, CheckKind::height).passed);
  CHECK(check_of(space, frame_requirements(), higher, CheckKind::height).value ==
        Approx(1.1e-9).epsilon(1e-5));
  // Other directions have other heights.
  const Design wider = scaled(space.at_rest(), {1.5, 1, 1});
  const RequirementChecker checker(space, frame_requirements());
  CHECK(checker.check(wider, upwards).checks[1].passed);
  CHECK(checker.check(wider, Direction(1, 0, 0)).checks[1].value == Approx(0.5));
  Requirements free = frame_requirements();
  free.keep_height = false;
  CHECK(RequirementChecker(space, free).check(higher, upwards).passed());
}

TEST_CASE("Relations are held against the primitives of controllers", "[requirements]") {
  const auto moved = [](const Still& space, double fraction) {
    Design design = space.at_rest();
    std::get<Cuboid>(design.primitives[1]).corners.col(1).array() += fraction * std::sqrt(18.0);
    return design;
  };
  const Still space(two_cubes());
  CHECK(check_of(space, frame_requirements(), moved(space, 0.99e-6), CheckKind::relations).passed);
  const Check broken = check_of(space, frame_requirements(), moved(space, 1.01e-6), CheckKind::relations);
  CHECK_FALSE(broken.passed);
  CHECK(broken.value == Approx(1.01e-6));
  CHECK(broken.where == 0);
  // Models that edit the mesh are not judged by their primitives.
  const Still surface(two_cubes(), DeformationKind::surface);
  CHECK(check_of(surface, frame_requirements(), moved(surface, 0.1), CheckKind::relations).value == 0);
}

TEST_CASE("Relations are held against the mesh of models that edit it", "[requirements]") {
  const Still space(two_cubes(), DeformationKind::surface);
  const auto moved = [&](double fraction) {
    Design design = space.at_rest();
    design.shape.vertices.bottomRows(8).col(1).array() += fraction * std::sqrt(18.0);
    return design;
  };
  CHECK(check_of(space, frame_requirements(), moved(0.99 * tolerance::visible), CheckKind::relations).passed);
  const Check broken =
      check_of(space, frame_requirements(), moved(1.01 * tolerance::visible), CheckKind::relations);
  CHECK_FALSE(broken.passed);
  CHECK(broken.value == Approx(1.01 * tolerance::visible));
  CHECK(broken.where == 0);
  CHECK_FALSE(RequirementChecker(space, frame_requirements())
                  .check(moved(1.01 * tolerance::visible), upwards)
                  .passed());
}

TEST_CASE("A table in pieces is no solution, whatever the model", "[requirements]") {
  const StructuredShape table = structures::table();
  for (const DeformationKind kind : deformation_kinds()) {
    if (capabilities_of(kind).edits_primitives) continue;
    INFO(name_of(kind));
    const Still space(table, kind);
    Design apart = space.at_rest();
    const Shape& rest = space.rest().shape;
    for (Eigen::Index t = 0; t < rest.triangle_count(); ++t)
      if (rest.triangle_part[static_cast<std::size_t>(t)] != 0)
        for (int k = 0; k < 3; ++k) {
          const Eigen::Index v = rest.triangles(t, k);
          apart.shape.vertices.row(v) = 0.9 * rest.vertices.row(v);  // smaller and below the top
        }
    Requirements free = frame_requirements();
    free.keep_height = false;
    free.min_size_ratio = 0;
    const RequirementChecker checker(space, free);
    CHECK(checker.check(space.at_rest(), upwards).passed());
    const Assessment found = checker.check(apart, upwards);
    CHECK_FALSE(found.passed());
    for (const Check& check : found.checks) CHECK(check.passed == (check.kind != CheckKind::relations));
  }
}

TEST_CASE("Parts keep their proportions", "[requirements]") {
  const Still space(two_cubes());
  const auto stretched = [&](double factor) {
    Design design = space.at_rest();
    std::get<Cuboid>(design.primitives[1]).corners.col(2) *= factor;
    return design;
  };
  Requirements requirements = frame_requirements();
  const RequirementChecker checker(space, requirements);
  for (const double factor : {0.401, 1.0, 2.49}) {
    CHECK(check_of(space, requirements, stretched(factor), CheckKind::proportions).passed);
    CHECK_FALSE(checker.form_obstacle(stretched(factor)));
  }
  for (const double factor : {0.399, 2.51}) {
    CHECK_FALSE(check_of(space, requirements, stretched(factor), CheckKind::proportions).passed);
    CHECK(checker.form_obstacle(stretched(factor)) ==
          Obstacle(Refusal{.cause = RefusalCause::proportions, .part = 1}));
  }
  requirements.min_size_ratio = 0;
  CHECK_FALSE(RequirementChecker(space, requirements).form_obstacle(stretched(0.1)));
  for (const Check& check : RequirementChecker(space, requirements).check(stretched(0.1), upwards).checks)
    CHECK(check.kind != CheckKind::proportions);
}

TEST_CASE("The sides of the box change by so much at most", "[requirements]") {
  const Still space(structures::box_alone({4, 2, 1}));
  Requirements requirements = frame_requirements();
  requirements.box_tolerance = 0.1;
  CHECK(check_of(space, requirements, scaled(space.at_rest(), {0.9, 1.1, 1}), CheckKind::box).passed);
  const Check wider =
      check_of(space, requirements, scaled(space.at_rest(), {0.95, 1.1001, 1}), CheckKind::box);
  CHECK_FALSE(wider.passed);
  CHECK(wider.value == Approx(0.1001));
  CHECK(wider.where == 1);
  CHECK_FALSE(check_of(space, requirements, scaled(space.at_rest(), {0.8999, 1, 1}), CheckKind::box).passed);
  requirements.box_tolerance = 0;
  CHECK(check_of(space, requirements, space.at_rest(), CheckKind::box).passed);
}

TEST_CASE("Parts that stay have not moved", "[requirements]") {
  StructuredShape cubes = two_cubes();
  cubes.structure.relations.clear();  // else the right one may change with the left one
  const Still space(std::move(cubes));
  const auto moved = [&](int part, double fraction) {
    Design design = space.at_rest();
    design.shape.vertices(8 * part, 1) += fraction * std::sqrt(18.0);
    return design;
  };
  Requirements kept = frame_requirements(), editable = frame_requirements();
  kept.kept_parts = {1};
  editable.editable_parts = {0};
  for (const Requirements& requirements : {kept, editable}) {
    CHECK(check_of(space, requirements, moved(0, 0.01), CheckKind::parts).passed);
    CHECK(check_of(space, requirements, moved(1, 0.9e-9), CheckKind::parts).passed);
    const Check broken = check_of(space, requirements, moved(1, 1.1e-9), CheckKind::parts);
    CHECK_FALSE(broken.passed);
    CHECK(broken.where == 1);
  }
}

TEST_CASE("At a seam with a part that may change, the primitive has to stay", "[requirements]") {
  Requirements requirements = frame_requirements();
  requirements.kept_parts = {0};
  const Still controllers(bar_of_two()), surface(bar_of_two(), DeformationKind::surface);
  Design stretched = controllers.at_rest();
  stretched.shape.vertices.col(0) *= 1.1;
  CHECK(check_of(controllers, requirements, stretched, CheckKind::parts).passed);
  CHECK_FALSE(check_of(surface, requirements, stretched, CheckKind::parts).passed);
  std::get<Cuboid>(stretched.primitives[0]).corners.col(0) *= 1.1;
  CHECK_FALSE(check_of(controllers, requirements, stretched, CheckKind::parts).passed);
  // With both kept there is no such seam.
  requirements.kept_parts = {0, 1};
  stretched.primitives = controllers.at_rest().primitives;
  CHECK_FALSE(check_of(controllers, requirements, stretched, CheckKind::parts).passed);
}

TEST_CASE("Walls become no thinner than asked for, or than they are", "[requirements]") {
  const Still space(structures::box_alone({4, 4, 1}));
  Requirements requirements = frame_requirements();
  requirements.keep_height = false;
  requirements.min_thickness = 0.5;
  const auto thinned = [&](double factor) {
    return check_of(space, requirements, scaled(space.at_rest(), {1, 1, factor}), CheckKind::thickness);
  };
  CHECK(thinned(1).passed);
  CHECK(thinned(0.5).passed);
  CHECK(thinned(0.5).value == Approx(0.5));
  CHECK_FALSE(thinned(0.4999).passed);
  CHECK(thinned(0.4999).where == 0);
  // What is thinner at rest may stay so, but become no thinner.
  requirements.min_thickness = 2;
  CHECK(thinned(1).passed);
  CHECK(thinned(1).value == Approx(1));
  CHECK_FALSE(thinned(0.999).passed);
}

TEST_CASE("Contacts are as steep as the walls of a cup", "[requirements]") {
  const Still space(cup());
  // A facet's middle is nearer to the axis than its ends.
  const double angle = std::atan(std::cos(std::numbers::pi / 64) / 8) * 180 / std::numbers::pi;
  Requirements requirements = frame_requirements();
  requirements.min_draft_degrees = 0.999 * angle;
  const Check draft = check_of(space, requirements, space.at_rest(), CheckKind::draft);
  CHECK(draft.value == Approx(angle));
  CHECK(draft.passed);
  requirements.min_draft_degrees = 1.001 * angle;
  CHECK_FALSE(check_of(space, requirements, space.at_rest(), CheckKind::draft).passed);
}

TEST_CASE("A stack stands up to the tilt at which it topples", "[requirements]") {
  const Still space(structures::box_alone({2, 2, 4}));
  const double tilt = std::atan(0.25) * 180 / std::numbers::pi;
  Requirements requirements = frame_requirements();
  requirements.standing_copies = 2;
  requirements.min_tipping_degrees = tilt - 1e-6;
  const Check stands = check_of(space, requirements, space.at_rest(), CheckKind::standing);
  CHECK(stands.value == Approx(tilt));
  CHECK(stands.passed);
  requirements.min_tipping_degrees = tilt + 1e-6;
  CHECK_FALSE(check_of(space, requirements, space.at_rest(), CheckKind::standing).passed);
  requirements.standing_copies = 1;
  CHECK(check_of(space, requirements, space.at_rest(), CheckKind::standing).passed);
}

TEST_CASE("A stack that stands neither topples nor slides, where there is friction", "[requirements]") {
  const Still space(structures::box_alone({2, 2, 4}));
  Requirements requirements = frame_requirements();
  requirements.standing_copies = 2;
  requirements.friction = 0.1;
  const double slides = std::atan(0.1) * 180 / std::numbers::pi;
  const Check standing = check_of(space, requirements, space.at_rest(), CheckKind::standing);
  CHECK(standing.value == Approx(slides).epsilon(0.01));
  CHECK(standing.where == 1);
  requirements.min_tipping_degrees = 1.01 * slides;
  CHECK_FALSE(check_of(space, requirements, space.at_rest(), CheckKind::standing).passed);
}

TEST_CASE("Copies of a cup jam where friction is more than its draft", "[requirements]") {
  const Still space(cup());
  const double tangent = std::cos(std::numbers::pi / 64) / 8;
  Requirements requirements = frame_requirements();
  requirements.friction = 0.99 * tangent;
  CHECK(check_of(space, requirements, space.at_rest(), CheckKind::jam).passed);
  requirements.friction = 3 * tangent;
  const Check jams = check_of(space, requirements, space.at_rest(), CheckKind::jam);
  CHECK_FALSE(jams.passed);
  CHECK(jams.value == Approx(0.5));  // (3 - 1) / (3 + 1)
  CHECK(jams.where == 0);
  // Level tops do not jam.
  const Still boxes(two_cubes());
  CHECK(check_of(boxes, requirements, boxes.at_rest(), CheckKind::jam).passed);
}

TEST_CASE("Copies rest on one part and keep away from the others", "[requirements]") {
  const Still space(two_cubes());
  const auto resting = [&](int part, double higher, double air) {
    Requirements requirements = frame_requirements();
    requirements.keep_height = false;
    requirements.resting_part = part;
    requirements.min_air_elsewhere = air;
    Design design = space.at_rest();
    for (Eigen::Index v = 0; v < 8; ++v)  // the left cube
      if (design.shape.vertices(v, 2) == 1) design.shape.vertices(v, 2) += higher;
    return check_of(space, requirements, design, CheckKind::resting);
  };
  // Of two cubes side by side the left one is higher, by a fifth of the height.
  CHECK(resting(0, 0.25, 0.1).passed);
  CHECK(resting(0, 0.25, 0.1).value == Approx(0.2));
  CHECK(resting(0, 0.25, 0.1).where == 1);
  CHECK(resting(0, 0.25, 0.2).passed);
  CHECK_FALSE(resting(0, 0.25, 0.21).passed);
  CHECK_FALSE(resting(1, 0.25, 0.1).passed);
  CHECK(resting(1, 0.25, 0.1).value == 0);
  CHECK_FALSE(resting(0, 0, 0.001).passed);  // on both
}

TEST_CASE("The obstacle is the first check that failed, but for the target", "[requirements]") {
  const Still space(structures::box_alone({2, 2, 4}));
  Requirements requirements = frame_requirements(0.99);
  const auto obstacle = [&](const Design& design, QualityScope scope = QualityScope::all) {
    return RequirementChecker(space, requirements).obstacle(design, upwards, scope);
  };
  CHECK_FALSE(RequirementChecker(space, requirements).check(space.at_rest(), upwards).passed());
  CHECK_FALSE(obstacle(space.at_rest()));
  requirements.standing_copies = 2;
  requirements.min_tipping_degrees = 89;
  REQUIRE(obstacle(space.at_rest()));
  CHECK(obstacle(space.at_rest())->kind == CheckKind::standing);
  requirements.quality.emplace();
  const Design wider = scaled(space.at_rest(), {4, 1, 1});  // beyond what quality allows, too
  CHECK(obstacle(wider)->kind == CheckKind::standing);
  CHECK(obstacle(scaled(space.at_rest(), {1, 1, 1.1}))->kind == CheckKind::height);
  requirements.standing_copies.reset();
  requirements.min_tipping_degrees = 0;
  requirements.min_size_ratio = 0;
  for (const QualityScope scope : {QualityScope::all, QualityScope::parts}) {
    const std::optional<Check> first = obstacle(wider, scope);
    REQUIRE(first);
    CHECK(first->kind == CheckKind::quality);
    CHECK(first == first_failed_but_target(
                       RequirementChecker(space, requirements).check(wider, upwards, scope).checks));
  }
  CHECK_THROWS_AS(RequirementChecker(space, requirements).obstacle(Still(two_cubes()).at_rest(), upwards),
                  UsageError);
}

TEST_CASE("Checks come in order, and only those that were asked for", "[requirements]") {
  const Still space(two_cubes());
  Requirements all = frame_requirements();
  all.box_tolerance = 0.1;
  all.kept_parts = {0};
  all.min_thickness = 0.1;
  all.min_draft_degrees = 10;
  all.standing_copies = 2;
  std::vector<CheckKind> kinds;
  for (const Check& check : RequirementChecker(space, all).check(space.at_rest(), upwards).checks) {
    kinds.push_back(check.kind);
    CHECK(check.passed);
    CHECK(std::isfinite(check.value));
  }
  using enum CheckKind;
  CHECK(kinds == std::vector<CheckKind>{target, height, relations, proportions, box, parts, thickness, draft,
                                        standing});
  const RequirementChecker few(space, frame_requirements());
  CHECK(few.check(space.at_rest(), upwards).checks.size() == 4);
  CHECK(few.requirements().target == -1);
  CHECK(&few.space() == &space);
}
