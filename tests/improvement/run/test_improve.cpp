#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/effort.h"
#include "stackabilization/improvement/improve.h"
#include "stackabilization/improvement/tolerances.h"
#include "stackabilization/stacking/tolerances.h"
#include "support/catch.h"
#include "support/cups.h"
#include "support/still_designs.h"

using namespace stackabilization;
using cups::checker;
using cups::Cups;

namespace {

Improvement improved(ImprovementPreset preset, double target, int evaluations = 60, int solutions = 1) {
  ImprovementOptions options;
  options.preset = preset;
  options.search.solutions = solutions;
  options.effort = std::numeric_limits<double>::infinity();
  options.search.expansions = 20;
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

TEST_CASE("designs are told of as they are found, the solutions among them") {
  for (const ImprovementPreset preset : {ImprovementPreset::paper, ImprovementPreset::refined}) {
    const auto found_by = checker(0.75);
    std::vector<Points> told;
    ImprovementOptions options;
    options.preset = preset;
    options.effort = std::numeric_limits<double>::infinity();
    options.search.expansions = 20;
    options.refinement.evaluations = 60;
    options.found = [&](const Candidate& candidate) {
      CHECK(found_by.check(candidate.design, Direction(candidate.direction)).passed());
      CHECK(found_by.meets_target(candidate.measured));
      told.push_back(candidate.design.shape.vertices);
    };
    const Improvement result = improve(found_by, options);
    REQUIRE(!result.solutions.empty());
    for (const Candidate& solution : result.solutions)
      CHECK(std::count(told.begin(), told.end(), solution.design.shape.vertices) > 0);
    options.found = {};
    CHECK(improve(found_by, options).progress.evaluated == result.progress.evaluated);
  }
}

TEST_CASE("what a pursuit reaches is told of before the search begins") {
  ImprovementOptions options;
  options.search.solutions = 1;
  options.effort = std::numeric_limits<double>::infinity();
  options.search.expansions = 20;
  options.refinement.evaluations = 60;
  int told = 0, told_before = -1;
  options.found = [&](const Candidate&) { ++told; };
  double best_before = 0;
  options.search.progress = [&](const ImprovementProgress& now) {
    CHECK(now.best_stackability >= best_before);
    best_before = now.best_stackability;
    if (told_before < 0 && now.expanded > 0) told_before = told;
  };
  improve(checker(0.75), options);
  CHECK(told_before == 1);
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

namespace {

/// With so much work at most, which is counted.
ImprovementOptions limited(double effort) {
  ImprovementOptions options;
  options.effort = effort;
  options.search.solutions = 2;
  return options;
}

void check_same_improvement(const Improvement& a, const Improvement& b) {
  CHECK(a.end == b.end);
  CHECK(a.progress.evaluated == b.progress.evaluated);
  CHECK(a.progress.expanded == b.progress.expanded);
  REQUIRE(a.solutions.size() == b.solutions.size());
  for (std::size_t k = 0; k < a.solutions.size(); ++k)
    CHECK(a.solutions[k].design.shape.vertices == b.solutions[k].design.shape.vertices);
  CHECK(a.nearest.has_value() == b.nearest.has_value());
  if (a.nearest && b.nearest) CHECK(a.nearest->design.shape.vertices == b.nearest->design.shape.vertices);
}

}  // namespace

TEST_CASE("an effort bounds the designs measured, whatever the target and the number of threads") {
  for (const double target : {0.75, 0.97})
    for (const double effort : {0.002, 0.01, 0.05}) {
      INFO("target " << target << ", effort " << effort);
      std::vector<Improvement> results;
      for (const std::size_t threads : {1, 4}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(improve(checker(target), limited(effort)));
      }
      check_same_improvement(results[0], results[1]);
      const double designs = designs_of_effort(effort, RestShape(cups::space.rest(), {}));
      // What a refinement needs to tell which edits can leave, and the roots, come on top.
      CHECK(static_cast<double>(results[0].progress.evaluated) <= 1.1 * designs + 50);
      CHECK(results[0].end != SearchEnd::time_limit);
    }
}

TEST_CASE("a run goes on to the same result from every state that it saves") {
  for (const auto preset : {ImprovementPreset::paper, ImprovementPreset::refined})
    for (const double target : {0.6, 0.97}) {
      ImprovementOptions options = limited(0.02);
      options.preset = preset;
      options.search.expansions = 6;
      std::vector<std::string> states;
      options.search.save = [&](const std::string& text) { states.push_back(text); };
      const Improvement whole = improve(checker(target), options);
      REQUIRE(!states.empty());
      options.search.save = {};
      check_same_improvement(improve(checker(target), options, SavedSearch{states.front()}), whole);
      check_same_improvement(improve(checker(target), options, SavedSearch{states.back()}), whole);
    }
}

TEST_CASE("a run expands no more candidates than it may, and with more of them goes on to the same result") {
  for (const double effort : {0.005, 0.02, 0.05}) {
    ImprovementOptions options = limited(effort);
    options.search.expansions = 12;
    const Improvement whole = improve(checker(0.97), options);
    CHECK(whole.progress.expanded <= 12);
    for (const std::int64_t first : {1, 2, 5, 9}) {
      std::string state;
      ImprovementOptions fewer = options;
      fewer.search.expansions = first;
      fewer.search.save = [&](const std::string& text) { state = text; };
      CHECK(improve(checker(0.97), fewer).progress.expanded <= first);
      check_same_improvement(improve(checker(0.97), options, SavedSearch{state}), whole);
    }
  }
  ImprovementOptions none = limited(0.02);
  none.search.expansions = 0;
  CHECK_THROWS_AS(improve(checker(0.97), none), UsageError);
}

TEST_CASE("a run that is cancelled anywhere leaves a state from which the whole result follows") {
  ImprovementOptions options = limited(0.05);
  options.search.expansions = 6;
  std::atomic<int> asked = 0;
  options.search.cancelled = [&] { return ++asked < 0; };
  const Improvement whole = improve(checker(0.75), options);
  const int all = asked;
  std::string state;
  options.search.save = [&](const std::string& text) { state = text; };
  for (const double share : {0.0, 0.2, 0.5, 0.8}) {
    state.clear();
    asked = 0;
    options.search.cancelled = [&, questions = static_cast<int>(share * all)] { return ++asked > questions; };
    const Improvement part = improve(checker(0.75), options);
    CHECK(part.end == SearchEnd::cancelled);
    REQUIRE(!state.empty());
    options.search.cancelled = {};
    check_same_improvement(improve(checker(0.75), options, SavedSearch{state}), whole);
  }
}

TEST_CASE("a deadline that is met is told, and the shape is judged nevertheless") {
  ImprovementOptions options = limited(1);
  options.search.seconds = 1e-9;
  const Improvement late = improve(checker(0.75), options);
  CHECK(late.end == SearchEnd::time_limit);
  REQUIRE(late.nearest);
  CHECK(late.nearest->design.edits.empty());
  REQUIRE(late.diagnosis);
  CHECK(!late.diagnosis->blockers.empty());
  const Improvement met = improve(checker(-1), options);
  REQUIRE(met.solutions.size() == 1);
  CHECK(met.solutions.front().design.edits.empty());
}

TEST_CASE("what comes nearest stacks better by what counts, or is the shape at rest") {
  const Cups open(16, 0.8);
  const auto nearest = [&](double smallest_size) {
    Requirements requirements = designs::frame_requirements(0.9);
    requirements.quality.emplace();
    (*requirements.quality)[QualityMeasure::size] = smallest_size;
    const Improvement found = improve(RequirementChecker(open, requirements), limited(0.05));
    CHECK(found.solutions.empty());
    REQUIRE(found.nearest);
    return *found.nearest;
  };
  // S = 1 - wall top / (top - foot) is 0.5 at rest, and 0.502 when both radii change by 0.0005.
  const Candidate stiff = nearest(0.9995);
  CHECK(stiff.design.edits.empty());
  CHECK(stiff.measured.value == Approx(0.5));
  const Candidate wider = nearest(0.9);
  CHECK(!wider.design.edits.empty());
  CHECK(wider.measured.value > 0.505);
}

TEST_CASE("efforts are shares of a fixed amount of work, less of it for larger shapes") {
  const RestShape rest(cups::space.rest(), {});
  CHECK(designs_of_effort(2, rest) == Approx(2 * designs_of_effort(1, rest)));
  CHECK(std::isinf(designs_of_effort(std::numeric_limits<double>::infinity(), rest)));
  StructuredShape replicated = cups::space.rest();
  replicated.shape.triangles = rest.shape().triangles.replicate(3, 1);
  const std::vector<std::int32_t>& parts = rest.shape().triangle_part;
  while (replicated.shape.triangle_part.size() < 3 * parts.size())
    replicated.shape.triangle_part.insert(replicated.shape.triangle_part.end(), parts.begin(), parts.end());
  const RestShape larger(replicated, {});
  CHECK(designs_of_effort(1, larger) < designs_of_effort(1, rest));
  CHECK(directions_of_effort(1, larger.shape()) < directions_of_effort(1, rest.shape()));
  CHECK(directions_of_effort(1e-12, rest.shape()) == 1);
  CHECK(directions_of_effort(1e300, rest.shape()) == std::numeric_limits<std::int64_t>::max());
  for (const double none : {0.0, -1.0, std::nan("")}) {
    CHECK_THROWS_AS(designs_of_effort(none, rest), UsageError);
    CHECK_THROWS_AS(directions_of_effort(none, rest.shape()), UsageError);
    CHECK_THROWS_AS(improve(checker(0.5), limited(none)), UsageError);
  }
}

TEST_CASE("progress counts the work of all phases, up to all that is allowed") {
  ImprovementOptions options;
  options.effort = 0.05;
  std::vector<ImprovementProgress> seen;
  options.search.progress = [&](const ImprovementProgress& now) { seen.push_back(now); };
  const Improvement found = improve(checker(0.75), options);
  REQUIRE(seen.size() > 2);
  for (std::size_t k = 1; k < seen.size(); ++k) {
    CHECK(seen[k].work >= seen[k - 1].work);
    CHECK(seen[k].evaluated >= seen[k - 1].evaluated);
  }
  CHECK(seen.front().work > 0);
  CHECK(seen.back().work <= 1);
  CHECK(seen.back().evaluated == found.progress.evaluated);
}
