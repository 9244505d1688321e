#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/best_first.h"
#include "stackabilization/improvement/shape_change.h"
#include "support/catch.h"
#include "support/cups.h"
#include "support/directions.h"
#include "support/still_designs.h"

namespace stackabilization {
namespace {

using cups::checker;
using cups::Cups;

BestFirstOptions options() {
  BestFirstOptions options;
  options.edits.family = EditFamily::paper;
  return options;
}

double closed_form(const Design& design) {
  const Eigen::Vector2d sizes = cups::radii(design);
  return sizes[1] > sizes[0] ? 1 - Cups::wall * sizes[1] / (sizes[1] - sizes[0]) : 0;
}

/// Candidates of Algorithm 1, looked at one after the other with nothing but a list.
struct Listed {
  Design design;
  double energy = 0, stackability = 0;
  bool taken = false;
};

std::vector<ContactEdit> suggested(const Design& design, const ContactEditOptions& how) {
  const SeparationTree tree(design.shape);
  const auto regions =
      contact_regions({design.shape, tree, upwards, separation(tree, tree, upwards)}, how.contacts).regions;
  const std::vector<Handle> handles = cups::space.handles();
  return contact_edits({cups::space.rest(), cups::space.capabilities(), handles, design, regions, upwards},
                       how);
}

/// The first solution of Algorithm 1 for cups, without any of the library's search.
std::optional<Listed> listed_solution(double target, const BestFirstOptions& how) {
  const EnergyMeter meter(cups::space.rest(), BoxModel::frame, how.alpha);
  const StackabilityOptions frame{ContactSemantics::solid, BoxModel::frame};
  const double at_rest = stackability(cups::space.rest().shape, upwards, frame).value;
  std::vector<Listed> list = {{cups::space.at_rest(), 0, at_rest}};
  for (int round = 0; round < 1000; ++round) {
    auto best = list.end();
    for (auto row = list.begin(); row != list.end(); ++row)
      if (!row->taken && (best == list.end() || row->energy < best->energy)) best = row;
    if (best == list.end()) return std::nullopt;
    if (best->stackability >= target) return *best;
    best->taken = true;
    const Design now = best->design;
    for (const ContactEdit& suggestion : suggested(now, how.edits)) {
      const DeformationResult outcome = cups::space.edited(now, suggestion.edit, {});
      const auto is_same = [&](const Listed& other) {
        return (cups::radii(other.design) - cups::radii(outcome.design)).norm() < 1e-6;
      };
      if (outcome.refusal || std::any_of(list.begin(), list.end(), is_same)) continue;
      const double value = stackability(outcome.design.shape, upwards, frame).value;
      list.push_back({outcome.design, meter.energy(outcome.design, value - at_rest).value, value});
    }
  }
  return std::nullopt;
}

void check_same_candidate(const Candidate& a, const Candidate& b) {
  CHECK(a.design.shape.vertices == b.design.shape.vertices);
  CHECK(a.direction == b.direction);
  CHECK(a.measured.value == b.measured.value);
  CHECK(a.energy.value == b.energy.value);
  CHECK(a.reasons == b.reasons);
  CHECK(a.design.edits.size() == b.design.edits.size());
}

void check_same_search(const BestFirstResult& a, const BestFirstResult& b) {
  CHECK(a.end == b.end);
  CHECK(a.progress.expanded == b.progress.expanded);
  CHECK(a.progress.evaluated == b.progress.evaluated);
  CHECK(a.progress.queued == b.progress.queued);
  CHECK(a.progress.best_energy == b.progress.best_energy);
  CHECK(a.progress.best_stackability == b.progress.best_stackability);
  REQUIRE(a.solutions.size() == b.solutions.size());
  for (std::size_t k = 0; k < a.solutions.size(); ++k) check_same_candidate(a.solutions[k], b.solutions[k]);
  REQUIRE(a.nearest.size() == b.nearest.size());
  for (std::size_t k = 0; k < a.nearest.size(); ++k) check_same_candidate(a.nearest[k], b.nearest[k]);
  REQUIRE(a.refusals.size() == b.refusals.size());
  for (std::size_t k = 0; k < a.refusals.size(); ++k) {
    CHECK(a.refusals[k].obstacle == b.refusals[k].obstacle);
    CHECK(a.refusals[k].count == b.refusals[k].count);
  }
}

}  // namespace

TEST_CASE("a cup becomes conical until it reaches its target, S as in closed form") {
  for (const double target : {0.3, 0.5, 0.6}) {
    const BestFirstResult result = best_first(checker(target), options());
    CHECK(result.end == SearchEnd::solved);
    REQUIRE(result.solutions.size() == 1);
    const Candidate& found = result.solutions.front();
    CHECK(found.measured.value >= target);
    CHECK(found.measured.value == Approx(closed_form(found.design)).epsilon(1e-12));
    CHECK(found.energy.gain == Approx(found.measured.value).margin(1e-12));
    CHECK(found.energy.value ==
          Approx(0.2 * found.energy.distortion.total() - 0.8 * found.energy.gain).margin(1e-12));
    CHECK(found.reasons.size() == found.design.edits.size());
    CHECK(result.progress.solutions == 1);
    CHECK(result.progress.best_stackability >= found.measured.value);
  }
}

TEST_CASE("the first solution is that of Algorithm 1 done by hand") {
  for (const EditFamily family : {EditFamily::paper, EditFamily::extended})
    for (const double alpha : {0.1, 0.2, 0.8}) {
      BestFirstOptions how = options();
      how.edits.family = family;
      how.alpha = alpha;
      const auto expected = listed_solution(0.5, how);
      const BestFirstResult result = best_first(checker(0.5), how);
      REQUIRE(expected);
      REQUIRE(result.solutions.size() == 1);
      CHECK((cups::radii(result.solutions[0].design) - cups::radii(expected->design)).norm() < 1e-12);
      CHECK(result.solutions[0].energy.value == Approx(expected->energy).epsilon(1e-12));
    }
}

TEST_CASE("what stacks well enough is left alone") {
  const BestFirstResult result = best_first(checker(-0.5), options());
  CHECK(result.end == SearchEnd::solved);
  REQUIRE(result.solutions.size() == 1);
  CHECK(result.solutions[0].design.edits.empty());
  CHECK(result.solutions[0].energy.value == 0);
  CHECK(result.solutions[0].design.shape.vertices == cups::space.rest().shape.vertices);
  CHECK(result.progress.expanded == 0);
  CHECK(result.progress.evaluated == 1);
}

TEST_CASE("several solutions differ, and come least energy first") {
  BestFirstOptions how = options();
  how.solutions = 3;
  how.expansions = 200;
  const BestFirstResult result = best_first(checker(0.5), how);
  REQUIRE(result.solutions.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Candidate& one = result.solutions[i];
    CHECK(one.measured.value >= 0.5);
    if (i > 0) CHECK(result.solutions[i - 1].energy.value <= one.energy.value);
    for (std::size_t j = 0; j < i; ++j) {
      const Shape &other = result.solutions[j].design.shape, &rest = cups::space.rest().shape;
      const double from_rest = std::min(shape_change(rest, one.design.shape).root_mean_square,
                                        shape_change(rest, other).root_mean_square);
      CHECK(shape_change(other, one.design.shape).root_mean_square >= 0.1 * from_rest);
    }
  }
}

TEST_CASE("nothing reaches what is impossible, and the nearest come by S, each in its own way") {
  BestFirstOptions how = options();
  how.expansions = 12;
  const BestFirstResult result = best_first(checker(0.99), how);
  CHECK(result.end == SearchEnd::expansion_limit);
  CHECK(result.solutions.empty());
  CHECK(result.progress.expanded == 12);
  REQUIRE(result.nearest.size() > 2);
  CHECK(result.nearest.size() <= 8);
  CHECK(result.nearest.front().measured.value == result.progress.best_stackability);
  for (std::size_t k = 1; k < result.nearest.size(); ++k)
    CHECK(result.nearest[k].measured.value <= result.nearest[k - 1].measured.value);
}

TEST_CASE("with limits of quality the best that keeps all but the target is among the nearest") {
  BestFirstOptions how = options();
  how.expansions = 60;
  Requirements requirements = checker(0.99).requirements();
  requirements.quality.emplace();
  for (std::size_t k = 0; k < quality_measure_count; ++k)
    requirements.quality->relax(static_cast<QualityMeasure>(k));
  requirements.standing_copies = 1;
  bool seen = false;
  for (const double degrees : {20.0, 25.0, 30.0}) {  // the more conical a cup, the sooner it topples
    CAPTURE(degrees);
    requirements.min_tipping_degrees = degrees;
    const RequirementChecker standing(cups::space, requirements);
    const auto keeps = [&](const Design& design) {
      const Assessment assessment = standing.check(design, upwards);
      return std::all_of(assessment.checks.begin(), assessment.checks.end(),
                         [](const Check& check) { return check.passed || check.is_of_target(); });
    };
    const std::vector<Candidate> nearest = best_first(standing, how).nearest;
    REQUIRE(!nearest.empty());
    if (!keeps(cups::space.at_rest()) || keeps(nearest.front().design)) continue;
    const auto best =
        std::find_if(nearest.begin(), nearest.end(), [&](const Candidate& one) { return keeps(one.design); });
    REQUIRE(best != nearest.end());
    // The same search finds the solutions of lower targets on its way.
    Requirements lower = requirements;
    for (lower.target = 0.5; lower.target < 0.8; lower.target += 0.1)
      for (const Candidate& one : best_first(RequirementChecker(cups::space, lower), how).solutions) {
        CHECK(best->measured.value >= one.measured.value);
        seen = true;
      }
  }
  CHECK(seen);
}

TEST_CASE("a search that may change nothing is exhausted and tells what forbids it") {
  Requirements requirements;
  requirements.target = 0.5;
  requirements.kept_parts = {0};
  const BestFirstResult result = best_first(RequirementChecker(cups::space, requirements), options());
  CHECK(result.end == SearchEnd::exhausted);
  CHECK(result.progress.expanded == 1);
  REQUIRE(result.nearest.size() == 1);
  CHECK(result.nearest[0].design.edits.empty());
  REQUIRE(result.refusals.size() == 1);
  CHECK(result.refusals[0].obstacle == Obstacle(Refusal{.cause = RefusalCause::fixed_part, .part = 0}));
  CHECK(result.refusals[0].count >= 2);
}

TEST_CASE("the result does not depend on the number of threads") {
  BestFirstOptions how = options();
  how.edits.family = EditFamily::extended;
  how.solutions = 2;
  how.expansions = 30;
  std::vector<BestFirstResult> results;
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(best_first(checker(0.6), how));
  }
  check_same_search(results[0], results[1]);
}

TEST_CASE("a search that is cancelled anywhere goes on to the same result") {
  BestFirstOptions how = options();
  how.solutions = 2;
  how.expansions = 6;
  how.directions = {{0, 0, 1}, {0, 0, 2}};
  const RequirementChecker task = checker(0.55);
  const BestFirstResult whole = best_first(task, how);
  int stopped = 0;
  for (const int moment : {1, 2, 7, 25}) {
    std::string state;
    int asked = 0;
    BestFirstOptions interrupted = how;
    interrupted.cancelled = [&] { return ++asked >= moment; };
    interrupted.save = [&](const std::string& text) { state = text; };
    if (best_first(task, interrupted).end == SearchEnd::cancelled) ++stopped;
    check_same_search(resume_best_first(task, how, {state}), whole);
  }
  CHECK(stopped >= 3);
}

TEST_CASE("a search that ended at a limit goes on when the limit is raised") {
  BestFirstOptions how = options();
  how.expansions = 2;
  std::string state;
  how.save = [&](const std::string& text) { state = text; };
  CHECK(best_first(checker(0.6), how).end == SearchEnd::expansion_limit);
  how.expansions = 50;
  const BestFirstResult resumed = resume_best_first(checker(0.6), how, {state});
  CHECK(resumed.end == SearchEnd::solved);
  check_same_search(resumed, best_first(checker(0.6), how));
}

TEST_CASE("a search that ran out of time goes on with time of its own, and saves the same bytes") {
  BestFirstOptions how = options();
  std::string whole, state;
  how.save = [&](const std::string& text) { whole = text; };
  best_first(checker(0.6), how);
  how.save = [&](const std::string& text) { state = text; };
  how.seconds = 1e-9;
  CHECK(best_first(checker(0.6), how).end == SearchEnd::time_limit);
  CHECK(state != whole);
  CHECK(resume_best_first(checker(0.6), how, {state}).end == SearchEnd::time_limit);
  how.seconds = std::numeric_limits<double>::infinity();
  CHECK(resume_best_first(checker(0.6), how, {state}).end == SearchEnd::solved);
  CHECK(state == whole);
}

TEST_CASE("a state that belongs to another task, or is none, is refused") {
  BestFirstOptions how = options();
  how.expansions = 2;
  std::string state;
  how.save = [&](const std::string& text) { state = text; };
  best_first(checker(0.6), how);
  CHECK_NOTHROW(resume_best_first(checker(0.6), how, {state}));
  CHECK_THROWS_AS(resume_best_first(checker(0.61), how, {state}), InputError);
  BestFirstOptions other = how;
  other.alpha = 0.3;
  CHECK_THROWS_AS(resume_best_first(checker(0.6), other, {state}), InputError);
  for (const std::string& text : {std::string(), std::string("{}"), std::string("[1, 2]"),
                                  state.substr(0, state.size() / 2), state.substr(1)})
    CHECK_THROWS_AS(resume_best_first(checker(0.6), how, {text}), InputError);
}

TEST_CASE("a damaged state is named with the place and what was expected there") {
  BestFirstOptions how = options();
  how.expansions = 2;
  std::string state;
  how.save = [&](const std::string& text) { state = text; };
  best_first(checker(0.6), how);
  struct Damage {
    std::string from, to, words;
  };
  for (const Damage& damage : std::vector<Damage>{
           {"\"parent\":0", "\"parent\":7777", "/parent: expected an integer from 0 to 0, found 7777"},
           {"\"queue\":0", "\"queue\":3", "/candidates/0/queue: expected an integer from 0 to 0, found 3"},
           {"\"factor\":", "\"factor\":-", "/edit: "},
           {"\"energy\"", "\"energies\"", "/candidates/0: there is no key 'energies' here"},
           {"\"energy\":[", "\"energy\":[[],", "/candidates/0/energy: expected a list of 2"},
           {"\"measured\":[", "\"measured\":[null,", "/candidates/0/measured: expected a list of 5"},
           {"\"state\":\"expanded\"", "\"state\":\"lost\"", "/candidates/0/state: expected 'queued'"},
           {"\"key\":\"", "\"key\":\"x", "/candidates/0/key: expected a whole number in quotes"},
           {"\"turn\":0", "\"turn\":1", "/turn: expected an integer from 0 to 0, found 1"},
           {"\"directions\":[[0.0,0.0,1.0]]", "\"directions\":[]", "/directions: expected at least one"},
           {"\"directions\":[[0.0,0.0,1.0]]", "\"directions\":[[0.0,0.0,0.0]]", "/directions/0: a direction"},
           {"\"version\":6", "\"version\":5", "/: this is no saved search of this version"},
           {"\"reason\":[", "\"reason\":[true,", "/reason: expected a list of 3"},
           {"\"refusals\":[]", "\"refusals\":{}", "/refusals: expected a list"},
           {"\"refusals\":[]", "\"refusals\":[3]", "/refusals/0: expected an object"},
           {"\"refusals\":[]", "\"refusals\":[{\"count\":-1,\"check\":9,\"measure\":0}]",
            "/refusals/0/count: expected"},
           {"\"refusals\":[]", "\"refusals\":[{\"count\":1,\"check\":13,\"measure\":0}]",
            "/refusals/0/check: expected"},
           {"\"refusals\":[]", "\"refusals\":[{\"count\":1,\"cause\":0,\"rows\":[1,-1,-1,-1,-1]}]",
            "/refusals/0/rows: expected parts and relations of this shape"}}) {
    INFO(damage.from << " -> " << damage.to);
    std::string damaged = state;
    const auto at = damaged.find(damage.from);
    REQUIRE(at != std::string::npos);
    damaged.replace(at, damage.from.size(), damage.to);
    std::string words;
    try {
      resume_best_first(checker(0.6), how, {damaged, "folder/state.json"});
    } catch (const SavedSearchError& error) {
      words = error.what();
    }
    INFO(words);
    CHECK(words.starts_with("folder/state.json: /"));
    CHECK(words.find(damage.words) != std::string::npos);
    CHECK(words.find("json.exception") == std::string::npos);
  }
}

TEST_CASE("a saved search knows its directions, before its first step too") {
  BestFirstOptions how = options();
  how.directions = {{0.1, 0, 1}, {0, 0, 1}, {1. / 3, 2, -1}};
  how.expansions = 2;
  std::vector<std::string> states;
  how.save = [&](const std::string& text) { states.push_back(text); };
  const BestFirstResult whole = best_first(checker(0.6), how);
  REQUIRE(states.size() >= 2);
  CHECK(states.front() == search_at_start(checker(0.6), how));
  for (const std::string& state : states) CHECK(directions_of({state}) == how.directions);
  check_same_search(resume_best_first(checker(0.6), how, {states.front()}), whole);
  CHECK_THROWS_AS(directions_of({"{}"}), SavedSearchError);
}

TEST_CASE("a limit of trials bounds the edits tried, and leaves no trace of what goes beyond it") {
  BestFirstOptions how = options();
  const BestFirstResult whole = best_first(checker(0.6), how);
  REQUIRE(whole.progress.trials > 4);
  std::string state;
  how.save = [&](const std::string& text) { state = text; };
  std::int64_t before = 0;
  for (const std::int64_t limit : {std::int64_t{0}, whole.progress.trials / 2, whole.progress.trials - 1}) {
    how.trials = limit;
    const BestFirstResult part = best_first(checker(0.6), how);
    CHECK(part.end == SearchEnd::trial_limit);
    CHECK(part.progress.trials <= limit);
    CHECK(part.progress.trials >= before);
    before = part.progress.trials;
    BestFirstOptions more = how;
    more.trials = whole.progress.trials;
    check_same_search(resume_best_first(checker(0.6), more, {state}), whole);
  }
  how.trials = whole.progress.trials;
  check_same_search(best_first(checker(0.6), how), whole);
}

TEST_CASE("progress is reported after every candidate") {
  BestFirstOptions how = options();
  std::vector<ImprovementProgress> seen;
  how.progress = [&](const ImprovementProgress& now) { seen.push_back(now); };
  const BestFirstResult result = best_first(checker(0.5), how);
  REQUIRE(!seen.empty());
  CHECK(seen.back().solutions == 1);
  CHECK(seen.back().expanded == result.progress.expanded);
  for (std::size_t k = 1; k < seen.size(); ++k) {
    CHECK(seen[k].best_stackability >= seen[k - 1].best_stackability);
    CHECK(seen[k].best_energy <= seen[k - 1].best_energy);
    CHECK(seen[k].evaluated >= seen[k - 1].evaluated);
    CHECK(seen[k].seconds_left <= seen[k - 1].seconds_left);
    CHECK(seen[k].work >= seen[k - 1].work);
  }
  CHECK(seen.back().work ==
        static_cast<double>(result.progress.expanded) / static_cast<double>(how.expansions));
}

TEST_CASE("gap scaling is searched along its own direction only, and a cone around it is refused") {
  const auto squashed = deformation_model(cups::space.rest(), {DeformationKind::gap_scaling, upwards});
  Requirements requirements = designs::frame_requirements(0.9);
  requirements.keep_height = false;
  const RequirementChecker wish(*squashed, requirements);
  BestFirstOptions how = options();
  how.expansions = 3;
  for (const double cone : {0.001, 10.0}) {
    how.cone_degrees = cone;
    CHECK_THROWS_AS(best_first(wish, how), UsageError);
  }
  how.cone_degrees = 0;
  const BestFirstResult result = best_first(wish, how);
  CHECK(result.progress.expanded == 3);
  REQUIRE(!result.nearest.empty());
  for (const Candidate& candidate : result.nearest) CHECK(candidate.direction == upwards.vector());
}

TEST_CASE("a search refuses options out of range") {
  const auto refused = [](const auto& change) {
    BestFirstOptions how = options();
    change(how);
    CHECK_THROWS_AS(best_first(checker(0.5), how), UsageError);
  };
  refused([](BestFirstOptions& how) { how.solutions = 0; });
  refused([](BestFirstOptions& how) { how.expansions = -1; });
  refused([](BestFirstOptions& how) { how.trials = -1; });
  refused([](BestFirstOptions& how) { how.seconds = 0; });
  refused([](BestFirstOptions& how) { how.seconds = std::nan(""); });
  refused([](BestFirstOptions& how) { how.cone_degrees = -1; });
  refused([](BestFirstOptions& how) { how.cone_degrees = 91; });
  refused([](BestFirstOptions& how) { how.alpha = 2; });
  refused([](BestFirstOptions& how) { how.directions.clear(); });
  refused([](BestFirstOptions& how) { how.directions = {{0, 0, 0}}; });
}

}  // namespace stackabilization
