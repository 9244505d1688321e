#include <tbb/global_control.h>

#include <cmath>
#include <vector>

#include "improvement/cups.h"
#include "stackabilization/improvement/improve.h"
#include "stackabilization/shape/tolerances.h"
#include "support/catch.h"

using namespace stackabilization;
using cups::Cups;

namespace {

const Cups space;

RequirementChecker checker(double target) {
  Requirements requirements;
  requirements.target = target;
  requirements.measure.boxes = BoxModel::frame;
  return {space, requirements};
}

Improvement improved(ImprovementPreset preset, double target, int evaluations = 60, int solutions = 1) {
  ImprovementOptions options;
  options.preset = preset;
  options.search.solutions = solutions;
  options.search.seconds = 1e6;
  options.search.expansions = 20;
  options.search.cone_degrees = 0;
  options.refinement.evaluations = evaluations;
  return improve(checker(target), options);
}

double distortion(const Improvement& improvement) {
  return improvement.solutions.front().energy.distortion.total();
}

}  // namespace

TEST_CASE("at equal S the refined preset changes no more than the paper's") {
  const Improvement paper = improved(ImprovementPreset::paper, 0.75);
  REQUIRE(paper.solutions.size() == 1);
  const double reached = paper.solutions.front().measured.value - tolerance::stackability;
  CHECK(reached >= 0.75 - tolerance::stackability);
  const Improvement refined = improved(ImprovementPreset::refined, reached);
  REQUIRE(refined.solutions.size() == 1);
  CHECK(refined.solutions.front().measured.value >= reached);
  CHECK(distortion(refined) <= distortion(paper));
  CHECK(refined.assessments.front().passed());
}

TEST_CASE("the refined preset comes to the least change of a cup") {
  // S asks for b <= c t. D is least where the volume is kept: then only the box grows.
  const double target = 0.8;
  const double c = 1 - Cups::wall / (1 - target), top = std::sqrt(3 / (c * c + c + 1));
  const Improvement refined = improved(ImprovementPreset::refined, target, 300);
  REQUIRE(refined.solutions.size() == 1);
  CHECK(distortion(refined) == Approx((top - 1) / 8).epsilon(1e-3));
  CHECK(refined.solutions.front().measured.value <= target + tolerance::target);
  CHECK(distortion(improved(ImprovementPreset::paper, target)) > 1.2 * distortion(refined));
}

TEST_CASE("one solution asked for is the best of three") {
  const Improvement one = improved(ImprovementPreset::refined, 0.7);
  const Improvement three = improved(ImprovementPreset::refined, 0.7, 60, 3);
  REQUIRE(one.solutions.size() == 1);
  REQUIRE(!three.solutions.empty());
  CHECK(distortion(one) == distortion(three));
}

TEST_CASE("improving gives the same bytes for any number of threads") {
  std::vector<Improvement> results;
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(improved(ImprovementPreset::refined, 0.75));
  }
  REQUIRE(results[0].solutions.size() == results[1].solutions.size());
  CHECK(results[0].solutions.front().design.shape.vertices ==
        results[1].solutions.front().design.shape.vertices);
  CHECK(distortion(results[0]) == distortion(results[1]));
  CHECK(results[0].progress.evaluated == results[1].progress.evaluated);
}
