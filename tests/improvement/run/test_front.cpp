#include <tbb/global_control.h>

#include <cmath>
#include <string>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/front.h"
#include "stackabilization/improvement/tolerances.h"
#include "stackabilization/stacking/tolerances.h"
#include "support/catch.h"
#include "support/cups.h"

using namespace stackabilization;
using cups::checker;
using cups::Cups;

namespace {

FrontOptions few(int points) {
  FrontOptions options;
  options.points = points;
  options.improvement.effort = 0.02;
  return options;
}

/// The least change D of a cup that reaches a target, in closed form: where the volume is kept, only the box
/// grows, see test_improve.cpp.
double least_distortion(double target) {
  const double c = 1 - Cups::wall / (1 - target), top = std::sqrt(3 / (c * c + c + 1));
  return (top - 1) / 8;
}

void check_front(const Front& front) {
  REQUIRE(!front.points.empty());
  CHECK(front.points.front().candidate.design.edits.empty());
  CHECK(front.points.front().change == 0);
  for (std::size_t k = 0; k < front.points.size(); ++k) {
    const FrontPoint& point = front.points[k];
    CHECK(point.assessment.passed());
    CHECK(point.assessment.measured.value >= point.target - tolerance::stackability);
    if (k == 0) continue;
    CHECK(point.target > front.points[k - 1].target);
    CHECK(point.change >= front.points[k - 1].change);
    CHECK(point.candidate.measured.value >= front.points[k - 1].candidate.measured.value);
  }
}

}  // namespace

TEST_CASE("a front begins at rest and has equally spaced targets, and more S costs no less", "[front]") {
  const Front front = improvement_front(checker(0.8), few(6));
  check_front(front);
  CHECK(front.reached);
  REQUIRE(front.points.size() == 6);
  const double lowest = front.points.front().target;
  for (std::size_t k = 0; k < 6; ++k)
    CHECK(front.points[k].target == Approx(lowest + (0.8 - lowest) * static_cast<double>(k) / 5));
}

TEST_CASE("the designs of a front of cups have the least change in closed form", "[front]") {
  FrontOptions options = few(3);
  options.improvement.effort = 0.05;
  options.improvement.refinement.objective = ChangeMeasure::distortion;
  const Front front = improvement_front(checker(0.8), options);
  check_front(front);
  REQUIRE(front.points.size() == 3);
  for (std::size_t k = 1; k < 3; ++k)
    CHECK(front.points[k].change == Approx(least_distortion(front.points[k].target)).epsilon(0.02));
}

TEST_CASE("a front ends at the largest target that is reached", "[front]") {
  // With sizes of at least 0.8 of those at rest, the bottom is at least 0.8 and the top at most 1 / 0.8: S is
  // at most 1 - wall top / (top - bottom).
  Requirements requirements = checker(0.99).requirements();
  requirements.min_size_ratio = 0.8;
  const RequirementChecker limited(cups::space, requirements);
  FrontOptions options = few(4);
  options.bisections = 4;
  const Front front = improvement_front(limited, options);
  check_front(front);
  CHECK_FALSE(front.reached);
  CHECK(front.diagnosis);
  REQUIRE(front.points.size() == 4);
  const double most = 1 - Cups::wall * 1.25 / (1.25 - 0.8);
  CHECK(front.points.back().target <= most + tolerance::stackability);
  CHECK(front.points.back().target >= most - 0.05);
}

TEST_CASE("a front is the same for any number of threads", "[front]") {
  std::vector<Front> fronts;
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    fronts.push_back(improvement_front(checker(0.75), few(3)));
  }
  REQUIRE(fronts[0].points.size() == fronts[1].points.size());
  for (std::size_t k = 0; k < fronts[0].points.size(); ++k)
    CHECK(fronts[0].points[k].candidate.design.shape.vertices ==
          fronts[1].points[k].candidate.design.shape.vertices);
  CHECK(fronts[0].evaluated == fronts[1].evaluated);
}

TEST_CASE("a target below S at rest has the shape at rest alone", "[front]") {
  const Front front = improvement_front(checker(-1), few(3));
  CHECK(front.points.size() == 1);
}

TEST_CASE("a front of one point, of a length or of coarse steps is refused", "[front]") {
  CHECK_THROWS_AS(improvement_front(checker(0.8), few(1)), UsageError);
  FrontOptions coarse = few(3);
  coarse.improvement.preset = ImprovementPreset::paper;
  CHECK_THROWS_AS(improvement_front(checker(0.8), coarse), UsageError);
  Requirements room = checker(0.8).requirements();
  room.length_limit = StackLengthLimit{3, 10};
  CHECK_THROWS_AS(improvement_front(RequirementChecker(cups::space, room), few(3)), UsageError);
}
