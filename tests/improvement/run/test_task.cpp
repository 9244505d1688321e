#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/task.h"
#include "stackabilization/stacking/plan.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/solids.h"
#include "support/still_designs.h"

using namespace stackabilization;
using designs::frame_requirements;

namespace {

/// An L that jams along z and slides into itself along (1, 0, 1).
StructuredShape letter_l() {
  Cuboid box;
  for (int k = 0; k < 8; ++k) box.corners.row(k) << (k & 1 ? 4 : 0), (k & 2 ? 1 : 0), (k & 4 ? 4 : 0);
  return designs::alone(solids::l_shape(4, 1), box);
}

/// The cup, turned about the x axis, with its axis of revolution.
StructuredShape leaning_cup(double degrees) {
  StructuredShape cup = designs::cup();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitX()).toRotationMatrix();
  cup.shape.vertices = (cup.shape.vertices * turn.transpose()).eval();
  Symmetry axis;
  axis.kind = SymmetryKind::revolution;
  axis.axis = -turn.col(2);
  cup.structure.symmetries = {axis};
  return cup;
}

Requirements oriented_requirements() {
  Requirements requirements;
  requirements.target = 0.6;
  return requirements;
}

}  // namespace

TEST_CASE("a task starts along the directions given, the first of which is the main axis") {
  ImprovementTaskOptions options;
  options.directions = {{0, 2, 0}, {1, 0, 0}};
  options.progress = [](double) { FAIL("no direction is looked for"); };
  const ImprovementTask task(designs::cup(), frame_requirements(0.9), options);
  CHECK(task.directions() == options.directions);
  CHECK_FALSE(task.cancelled());
  CHECK(task.checker().requirements().target == 0.9);
  CHECK(&task.checker().space() == &task.space());
}

TEST_CASE("a task starts upwards, and along another direction that is clearly better") {
  const ImprovementTask cup(designs::cup(), frame_requirements(0.9));
  REQUIRE(cup.directions().size() == 1);
  CHECK(cup.directions()[0] == Eigen::Vector3d(0, 0, 1));

  const ImprovementTask l(letter_l(), oriented_requirements());
  REQUIRE(l.directions().size() == 2);
  CHECK(l.directions()[0] == Eigen::Vector3d(0, 0, 1));
  const double up = l.checker().measure(l.rest().shape, Direction(0, 0, 1)).value;
  CHECK(l.checker().measure(l.rest().shape, Direction(l.directions()[1])).value > up + 0.1);

  ImprovementTaskOptions stopped;
  stopped.cancelled = [] { return true; };
  const ImprovementTask early(letter_l(), oriented_requirements(), stopped);
  CHECK(early.cancelled());
  CHECK(early.directions().size() == 1);
}

TEST_CASE("up is the axis of a shape that leans by less than a degree") {
  const ImprovementTask leaning(leaning_cup(0.5), oriented_requirements());
  const double angle = 0.5 * std::numbers::pi / 180;
  CHECK((leaning.directions()[0] - Eigen::Vector3d(0, -std::sin(angle), std::cos(angle))).norm() < 1e-12);
  const ImprovementTask fallen(leaning_cup(2), oriented_requirements());
  CHECK(fallen.directions()[0] == Eigen::Vector3d(0, 0, 1));
}

TEST_CASE("a length limit becomes a target, air included, and looks for no other direction") {
  Requirements requirements = frame_requirements();
  requirements.length_limit = StackLengthLimit{5, 20};
  requirements.measure.clearance = 0.1;
  const ImprovementTask task(designs::cup(), requirements);
  const Stackability rest = task.checker().measure(task.rest().shape, Direction(0, 0, 1));
  CHECK(task.checker().requirements().target == stackability_within(rest, 5, 20));
  CHECK(task.checker().requirements().target == Approx(1 - (20 - 8.) / 4 / 8));

  requirements = oriented_requirements();
  requirements.length_limit = StackLengthLimit{2, 7};
  CHECK(ImprovementTask(letter_l(), requirements).directions().size() == 1);
}

TEST_CASE("a task refuses a length without room, and requirements that are none") {
  Requirements requirements = frame_requirements();
  requirements.length_limit = StackLengthLimit{5, 7};
  CHECK(message_of<UsageError>([&] {
          ImprovementTask(designs::cup(), requirements);
        }).find("the length 7 has no room for 5 copies of height 8") == 0);
  requirements.length_limit = StackLengthLimit{3, 9};
  requirements.measure.clearance = 0.6;
  CHECK(message_of<UsageError>([&] {
          ImprovementTask(designs::cup(), requirements);
        }).find("with 0.6 of air between them") != std::string::npos);
  CHECK_THROWS_AS(ImprovementTask(designs::cup(), frame_requirements(1)), UsageError);
}

TEST_CASE("limits of quality make a search smooth, and directions that nobody gave may turn") {
  Requirements wish = frame_requirements(0.9);
  const ImprovementTask free(designs::cup(), wish);
  CHECK(free.space().following() == Following::free);
  CHECK(improvement_options(free).search.edits.family == EditFamily::extended);
  CHECK(improvement_options(free).search.cone_degrees == 10);

  wish.quality.emplace();
  const ImprovementTask smooth(designs::cup(), wish);
  CHECK(smooth.space().following() == Following::smooth);
  CHECK(improvement_options(smooth).search.edits.family == EditFamily::smooth);
  CHECK(improvement_options(smooth).refinement.edit_price > 0);

  ImprovementTaskOptions how;
  how.following = Following::free;
  how.directions = {{0, 0, 1}};
  const ImprovementTask obeyed(designs::cup(), wish, how);
  CHECK(obeyed.space().following() == Following::free);
  CHECK(improvement_options(obeyed).search.edits.family == EditFamily::extended);
  CHECK(improvement_options(obeyed).search.cone_degrees == 0);

  wish.quality->relax(QualityMeasure::size);
  wish.length_limit = StackLengthLimit{3, 20};
  CHECK(improvement_options(ImprovementTask(designs::cup(), wish)).search.cone_degrees == 0);
}

TEST_CASE("a task goes on along the directions of an earlier run, which stay free") {
  ImprovementTaskOptions how;
  how.chosen = {{0, 0, 1}, {1, 0, 1}};
  how.progress = [](double) { FAIL("no direction is looked for"); };
  const ImprovementTask again(letter_l(), oriented_requirements(), how);
  CHECK(again.directions() == how.chosen);
  CHECK(improvement_options(again).search.cone_degrees == 10);
  how.directions = {{0, 1, 1}};
  CHECK(ImprovementTask(letter_l(), oriented_requirements(), how).directions() == how.directions);
}

TEST_CASE("improving a task is improving along its directions") {
  ImprovementTaskOptions how;
  how.directions = {{0, 0, 1}};
  const ImprovementTask task(designs::cup(), frame_requirements(0.55), how);
  ImprovementOptions options;
  options.effort = std::numeric_limits<double>::infinity();
  options.search.expansions = 3;
  options.refinement.evaluations = 30;
  const Improvement by_task = improve(task, options);
  options.search.directions = how.directions;
  const Improvement by_hand = improve(task.checker(), options);
  REQUIRE(by_task.solutions.size() == 1);
  REQUIRE(by_hand.solutions.size() == 1);
  CHECK(by_task.solutions[0].design.shape.vertices == by_hand.solutions[0].design.shape.vertices);
  CHECK(by_task.solutions[0].measured.value >= 0.55);
}
