#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "improvement/search/follower_slide.h"
#include "improvement/search/gap_descent.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/still_designs.h"
#include "support/structures.h"
#include "support/symmetric_solids.h"

using namespace stackabilization;

namespace {

enum TrestlePart { leg_left, leg_right, rung };

/// A trestle 10 high, with a rung at 4 between its legs.
struct Trestle {
  StructuredShape rest = structures::trestle();
  Design now = designs::Still(rest).at_rest();
};

ContactEdit lean_of(int part, const Eigen::Vector3d& axis) {
  ContactEdit edit;
  edit.edit = {{HandleKind::part, part, 0}, Lean{{1, 0, 0}, axis}};
  return edit;
}

/// The size of a part, beyond its limit of 0.8.
Check size_of_part(int part, double value) {
  Check check{CheckKind::quality, value, 0.8, false, part};
  check.measure = QualityMeasure::size;
  return check;
}

Eigen::Vector3d slide_of(const std::optional<Edit>& edit) {
  REQUIRE(edit);
  CHECK(edit->handle == Handle{HandleKind::part, rung, 0});
  return std::get<Move>(edit->operation).by;
}

/// A round seat on three legs with a ring around them, at a third of their height.
Shape ringed_stool() {
  const Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
  std::vector<Shape> parts = {
      solids::named(transformed(solids::cylinder(1.7, 0.3, 48), upright, {0, 0, 4.2}), "seat")};
  for (int k = 0; k < 3; ++k) {
    const double angle = 2 * std::numbers::pi * k / 3;
    parts.push_back(solids::named(transformed(solids::cylinder(0.14, 4.25, 16), upright,
                                              {1.25 * std::cos(angle), 1.25 * std::sin(angle), 0}),
                                  "leg_" + std::to_string(k)));
  }
  const Shape ring = solids::torus({.ring_radius = 1.25, .tube_radius = 0.06, .ring_segments = 48});
  parts.push_back(solids::named(transformed(ring, upright, {0, 0, 1.5}), "ring"));
  return solids::joined(parts);
}

}  // namespace

TEST_CASE("what grows with its distance from the end that stays slides there, as far as its growth asks") {
  const Trestle trestle;
  // To 1 / 0.7 of its length, of which 0.8 of a quarter more is to be left.
  const double share = 1 - 0.8 * 0.25 / (1 / 0.7 - 1);
  const auto slide = [&](const ContactEdit& edit) {
    return detail::follower_slide(edit, size_of_part(rung, 0.7), trestle.rest, trestle.now, upwards);
  };
  CHECK((slide_of(slide(lean_of(leg_left, {0, 0, -1}))) - Eigen::Vector3d(0, 0, 6 * share)).norm() < 1e-9);
  CHECK((slide_of(slide(lean_of(leg_left, {0, 0, 2}))) - Eigen::Vector3d(0, 0, -4 * share)).norm() < 1e-9);
  // A foot that leans as a section of its leg.
  ContactEdit foot;
  foot.edit = {{HandleKind::section, leg_right, 0}, Move{{1, 0, 0}}, Falloff::linear};
  foot.reason.leaning = true;
  CHECK((slide_of(slide(foot)) - Eigen::Vector3d(0, 0, 6 * share)).norm() < 1e-9);
  foot.reason.leaning = false;
  CHECK_FALSE(slide(foot));
  foot.edit.handle = {HandleKind::part, leg_right, 0};
  CHECK_FALSE(slide(foot));
}

TEST_CASE("nothing slides where something else is in the way than the size of a follower") {
  const Trestle trestle;
  const ContactEdit lean = lean_of(leg_left, {0, 0, -1});
  const auto slides = [&](const Obstacle& obstacle) {
    return detail::follower_slide(lean, obstacle, trestle.rest, trestle.now, upwards).has_value();
  };
  CHECK(slides(size_of_part(rung, 0.7)));
  CHECK_FALSE(slides(size_of_part(rung, 0.9)));
  CHECK_FALSE(slides(size_of_part(leg_left, 0.7)));
  CHECK_FALSE(slides(size_of_part(leg_right, 0.7)));  // symmetric to the one that leans
  CHECK_FALSE(slides(size_of_part(-1, 0.7)));
  Check bend = size_of_part(rung, 0.7);
  bend.measure = QualityMeasure::straightness;
  CHECK_FALSE(slides(bend));
  CHECK_FALSE(slides(Refusal{RefusalCause::proportions}));
}

TEST_CASE("the ring of a stool slides up where its legs lean outwards") {
  const auto space = deformation_model(analyse_structure(ringed_stool()), {.following = Following::smooth});
  Requirements wanted = designs::frame_requirements(0.15);
  wanted.kept_parts = {0};
  wanted.quality.emplace();
  const RequirementChecker checker(*space, wanted);
  Candidate start;
  start.design = space->at_rest();
  start.direction = upwards.vector();
  start.measured = checker.measure(start.design.shape, upwards);
  GapDescentOptions options;
  options.edits.family = EditFamily::smooth;
  const Candidate found = descend_gaps(checker, start, options).candidate;
  CHECK(found.measured.value >= wanted.target);
  CHECK_FALSE(checker.obstacle(found.design, upwards));
  CHECK(found.reasons.size() == found.design.edits.size());
  const auto height = [&](const Design& design) {
    return control_points(design.primitives[4]).col(2).mean();
  };
  CHECK(height(found.design) > height(start.design) + 0.1);
}
