#include <optional>
#include <string>
#include <vector>

#include "stackabilization/stacking/collision.h"
#include "stackabilization/stacking/validation.h"
#include "stacking/validation/report_rows.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/f_max.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

using Defect = std::optional<InteriorDefect>;

struct DefectCase {
  std::string name;
  Shape shape;
  Defect defect;  ///< nothing: the interior tests apply
};

Shape cube(double low, double high) {
  return solids::box(Eigen::Vector3d::Constant(low), Eigen::Vector3d::Constant(high));
}

/// Two sheets with different diagonals, and walls without area.
Shape flat_box(double z) {
  return solids::box({0, 0, z}, {2, 2, z});
}

std::vector<DefectCase> cases() {
  const Shape box = cube(0, 2), beside = solids::box({5, 0, 0}, {6, 2, 3}), inner = cube(0.5, 1.5),
              crossing = solids::box({1, 1, 1}, {4, 4, 4}), touching = solids::box({2, 0, 0}, {4, 2, 2});
  const Shape two = concatenate(box, beside), hollow = concatenate(box, solids::flipped(inner));
  const auto inside_out = InteriorDefect::inside_out;
  const auto no_volume = InteriorDefect::no_volume;
  const Shape open = solids::open_box({2, 2, 2});
  return {
      {"a box", box, {}},
      {"all inside out", solids::flipped(two), {}},
      {"one inside out beside one", concatenate(box, solids::flipped(beside)), inside_out},
      {"a large one inside out beside a small one", concatenate(beside, solids::flipped(crossing)),
       inside_out},
      {"one inside out across one", concatenate(box, solids::flipped(crossing)), inside_out},
      {"one inside out against one", concatenate(box, solids::flipped(touching)), inside_out},
      {"a cavity", hollow, {}},
      {"a cavity, all inside out", solids::flipped(hollow), {}},
      {"a ball in a cavity", concatenate(hollow, cube(0.75, 1.25)), {}},
      {"a ball in a cavity, inside out", concatenate(hollow, solids::flipped(cube(0.75, 1.25))), inside_out},
      {"one in another", concatenate(box, inner), {}},
      {"one in another, all inside out", solids::flipped(concatenate(box, inner)), {}},
      {"one across another", concatenate(box, crossing), {}},
      {"one against another", concatenate(box, touching), {}},
      {"one twice", concatenate(box, box), {}},
      {"one and itself inside out", concatenate(box, solids::flipped(box)), no_volume},
      {"a box without thickness", flat_box(1), no_volume},
      {"the same, upright", solids::box({1, 0, 0}, {1, 2, 3}), no_volume},
      {"a box without thickness on a box", concatenate(box, flat_box(2)), no_volume},
      {"a box without thickness over a box", concatenate(box, flat_box(3)), no_volume},
      {"a box without thickness in a box", concatenate(box, flat_box(1)), {}},
      {"one without thickness and one inside out", concatenate(flat_box(5), solids::flipped(two)), no_volume},
      {"an open one", open, InteriorDefect::open},
      {"an open one beside a box", concatenate(open, beside), InteriorDefect::open},
      {"a slanted plate inside out over a prism",
       concatenate(solids::prism(solids::regular_polygon(8), 1),
                   solids::flipped(transformed(cube(0, 1), solids::random_rotation(3), {0, 0, 4}))),
       inside_out}};
}

ValidationReport validated(const Shape& shape, const Direction& direction) {
  ValidationOptions options;
  options.resolutions = {32};
  return validate_translation(shape, direction, options);
}

}  // namespace

TEST_CASE("what winding numbers cannot tell of an interior is found out", "[collision][interior]") {
  for (const DefectCase& one : cases()) {
    CAPTURE(one.name);
    CHECK(CollisionTester(one.shape, one.shape).interior_defect() == one.defect);
    // The defect is one of the shape, not of its pose or of how its triangles are listed.
    const Shape other = solids::permuted(one.shape, 7);
    CHECK(CollisionTester(other, cube(0, 1)).interior_defect() == one.defect);
    CHECK(CollisionTester(cube(0, 1), other).interior_defect() == one.defect);
  }
}

TEST_CASE("interiors of shapes without a defect overlap just below f_max and not from there on",
          "[collision][interior]") {
  for (const Direction& direction : {upwards, Direction(0.3, -0.2, 2)})
    for (const DefectCase& one : cases()) {
      if (one.defect) continue;
      CAPTURE(one.name, direction.vector().transpose());
      const Rational f_max = exact_f_max(one.shape, direction);
      const CollisionTester tester(one.shape, one.shape);
      const Rational little("1", "1000000000000000000000000");
      CHECK_FALSE(tester.interiors_overlap(direction, f_max));
      CHECK_FALSE(tester.interiors_overlap(direction, f_max + little));
      CHECK(tester.interiors_overlap(direction, f_max - little));
      CHECK(tester.interiors_overlap(direction, Rational(0)));
    }
}

TEST_CASE("interior checks that do not apply are skipped with the reason, and all others are made",
          "[validation][interior]") {
  for (const Direction& direction : {upwards, Direction(0.3, -0.2, 2)})
    for (const DefectCase& one : cases()) {
      const ValidationReport report = validated(one.shape, direction);
      CAPTURE(one.name, table(report));
      CHECK(report.passed);
      const ValidationRow* skipped = find_row(report, "overlap of interiors");
      REQUIRE((skipped != nullptr) == one.defect.has_value());
      if (one.defect) {
        CHECK(skipped->verdict == Verdict::skipped);
        const std::string reason = *one.defect == InteriorDefect::open         ? "open or non-manifold"
                                   : *one.defect == InteriorDefect::inside_out ? "inside out"
                                                                               : "cancel each other";
        CHECK(skipped->note.find(reason) != std::string::npos);
        CHECK(find_row(report, "collision search from the top, solid") == nullptr);
        CHECK(find_row(report, "collision search from the top, closed") != nullptr);
      } else {
        for (const std::string name :
             {"no overlap at solid f_max", "no overlap above solid f_max", "overlap below solid f_max"}) {
          CHECK(row_of(report, name).verdict == Verdict::agrees);
        }
        CHECK(find_row(report, "collision search from the top, solid") != nullptr);
      }
      CHECK(row_of(report, "no contact above closed f_max").verdict == Verdict::agrees);
    }
}
