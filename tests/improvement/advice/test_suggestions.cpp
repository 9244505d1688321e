#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/suggestions.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/still_designs.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

/// A design space and what is asked of it.
struct Task {
  explicit Task(StructuredShape rest, Requirements requirements = designs::frame_requirements(0))
      : space(deformation_model(std::move(rest))), checker(*space, std::move(requirements)) {}

  std::vector<Suggestion> all(const SuggestionOptions& options = {}) const {
    return suggestions(checker, space->at_rest(), upwards, options);
  }
  DeformationConstraints constraints() const {
    return deformation_constraints(checker.requirements(), space->rest(), upwards);
  }

  std::unique_ptr<DeformationModel> space;
  RequirementChecker checker;
};

std::size_t possible(const std::vector<Suggestion>& list) {
  return static_cast<std::size_t>(
      std::count_if(list.begin(), list.end(), [](const Suggestion& one) { return !one.refusal; }));
}

}  // namespace

TEST_CASE("a table has suggestions: possible ones by energy, then refused ones with their reasons") {
  const Task task(structures::table());
  const std::vector<Suggestion> list = task.all();
  const std::size_t count = possible(list);
  REQUIRE(count > 0);
  for (std::size_t k = 0; k < list.size(); ++k) {
    CHECK(list[k].refusal.has_value() == (k >= count));
    if (list[k].refusal) CHECK(!describe(*list[k].refusal, task.space->rest().structure).empty());
    if (k > 0 && k < count) CHECK(list[k - 1].energy.value <= list[k].energy.value);
  }
}

TEST_CASE("what a suggestion promises is what its edit does") {
  const Task task(structures::mug());
  const double at_rest = task.checker.check(task.space->at_rest(), upwards).measured.value;
  const EnergyMeter meter(task.space->rest(), BoxModel::frame);
  const std::vector<Suggestion> list = task.all();
  REQUIRE(possible(list) > 0);
  for (const Suggestion& one : list) {
    const DeformationResult outcome =
        task.space->edited(task.space->at_rest(), one.edit.edit, task.constraints());
    if (one.refusal) continue;
    REQUIRE(!outcome.refusal);
    const double value = stackability(outcome.design.shape, upwards, {.boxes = BoxModel::frame}).value;
    CHECK(one.measured.value == Approx(value).margin(1e-9));
    const Energy energy = meter.energy(outcome.design, one.measured.value - at_rest);
    CHECK(one.energy.value == energy.value);
    CHECK(one.energy.gain == Approx(value - at_rest).margin(1e-9));
    CHECK(one.energy.value ==
          Approx(0.2 * one.energy.distortion.total() - 0.8 * one.energy.gain).margin(1e-12));
    CHECK(one.measured.extent == Approx(range_along(task.space->rest().shape, {0, 0, 1}).length()));
  }
}

TEST_CASE("gains of later steps are against rest, not against the step before") {
  const Task task(structures::mug());
  const std::vector<Suggestion> first = task.all();
  REQUIRE(possible(first) > 0);
  const Design design =
      task.space->edited(task.space->at_rest(), first[0].edit.edit, task.constraints()).design;
  const Situation now = situation(task.checker, design, upwards);
  CHECK(now.measured.value == first[0].measured.value);
  CHECK(now.energy.value == first[0].energy.value);
  CHECK(!now.contacts.empty());
  const double at_rest = situation(task.checker, task.space->at_rest(), upwards).measured.value;
  for (const Suggestion& one : suggestions(task.checker, design, upwards))
    if (!one.refusal) CHECK(one.energy.gain == Approx(one.measured.value - at_rest).margin(1e-12));
}

TEST_CASE("the weight of distortion changes the order, nothing else") {
  const Task task(structures::mug());
  SuggestionOptions options;
  options.alpha = 0;
  const std::vector<Suggestion> by_gain = task.all(options);
  REQUIRE(possible(by_gain) > 1);
  for (std::size_t k = 1; k < possible(by_gain); ++k)
    CHECK(by_gain[k - 1].energy.gain >= by_gain[k].energy.gain);
  options.alpha = 1;
  const std::vector<Suggestion> by_distortion = task.all(options);
  CHECK(possible(by_distortion) == possible(by_gain));
  for (std::size_t k = 1; k < possible(by_distortion); ++k)
    CHECK(by_distortion[k - 1].energy.distortion.total() <= by_distortion[k].energy.distortion.total());
  options.alpha = 1.5;
  CHECK_THROWS_AS(task.all(options), UsageError);
}

TEST_CASE("parts that have to stay stay, and the target is told") {
  Requirements requirements = designs::frame_requirements(0);
  requirements.kept_parts = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  CHECK(possible(Task(structures::table(), requirements).all()) == 0);

  const std::vector<Suggestion> easy = Task(structures::mug(), designs::frame_requirements(-10)).all();
  const std::vector<Suggestion> hard = Task(structures::mug(), designs::frame_requirements(0.999)).all();
  REQUIRE(possible(easy) > 0);
  CHECK(possible(easy) == possible(hard));  // the target alone refuses nothing
  for (std::size_t k = 0; k < possible(easy); ++k) {
    CHECK(easy[k].reaches_target);
    CHECK(!hard[k].reaches_target);
  }
}

TEST_CASE("suggestions do not depend on the number of threads") {
  const Task task(structures::table());
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return task.all();
  };
  const std::vector<Suggestion> one = run(1), four = run(4);
  REQUIRE(one.size() == four.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    CHECK(one[k].edit.reason == four[k].edit.reason);
    CHECK(one[k].refusal == four[k].refusal);
    if (one[k].refusal) continue;
    CHECK(one[k].measured.value == four[k].measured.value);
    CHECK(one[k].energy.value == four[k].energy.value);
  }
}
