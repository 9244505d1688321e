#include <cmath>
#include <numbers>
#include <stdexcept>

#include "deformation_models/trial.h"
#include "stackabilization/io/read.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

const Variant& variant(const std::string& name) {
  for (const Variant& one : variants())
    if (one.name == name) return one;
  throw std::invalid_argument(name);
}

/// Limits with which nothing takes long.
constexpr Limits few{1, 10, 3600};

Shape cup() {
  solids::FrustumShell cup;
  cup.segments = 24;
  return solids::frustum_shell(cup);
}

Task task(ImprovementPreset preset, double target) {
  return {preset, 0.2, 0.5, target};
}

}  // namespace

TEST_CASE("a target that the shape at rest reaches costs nothing, whatever the model") {
  const Subject subject(cup());
  CHECK(subject.stackability_at_rest() > 0.1);
  for (const std::string name : {"cuboids", "cylinders", "mixed", "surface", "gap-scaling"}) {
    const Trial trial = subject.trials(variant(name), {task(ImprovementPreset::paper, 0.1)}, few).front();
    INFO(name);
    CHECK(trial.variant == name);
    REQUIRE(trial.reached);
    REQUIRE(trial.best);
    CHECK(trial.best->stackability == subject.stackability_at_rest());
    CHECK(trial.best->distortion.total() == 0);
    CHECK(trial.best->change.root_mean_square == Approx(0).margin(1e-12));
    CHECK(trial.best->edits == 0);
    CHECK(trial.reason.empty());
  }
}

TEST_CASE("a target out of reach has what came nearest, and why") {
  const Subject subject(solids::box({1, 2, 3}));
  const Trial trial = subject.trials(mixed_variant(), {task(ImprovementPreset::paper, 0.9)}, few).front();
  CHECK_FALSE(trial.reached);
  REQUIRE(trial.best);
  CHECK(trial.best->stackability < 0.9);
  CHECK_FALSE(trial.reason.empty());
}

TEST_CASE("a variant is measured on the structure of the mixed one") {
  const Subject subject(cup());
  REQUIRE(subject.consists_of(PrimitiveKind::cylinder));
  CHECK_FALSE(subject.consists_of(PrimitiveKind::cuboid));
  const double target = 0.5 * (1 + subject.stackability_at_rest());
  const std::vector<Task> tasks = {task(ImprovementPreset::paper, target)};
  const Limits some{10, 10, 3600};
  const Trial cuboids = subject.trials(variant("cuboids"), tasks, some).front();
  REQUIRE(cuboids.best);
  REQUIRE(cuboids.best->edits > 0);
  // The cuboid around a cup and the cylinder in it change in the same way, but not by the same volume.
  CHECK(cuboids.best->distortion.total() > 0);
  CHECK(cuboids.best->distortion.total() != cuboids.best->own_distortion);
  CHECK(cuboids.best->change.root_mean_square > 0);
}

TEST_CASE("a model that cannot be deformed in some way says why, for every task") {
  // A ball has no feature curves.
  solids::Polygon profile;
  constexpr int steps = 16;
  for (int k = 0; k <= steps; ++k) {
    const double angle = std::numbers::pi * k / steps;
    profile.emplace_back(k == 0 || k == steps ? 0 : std::sin(angle), -std::cos(angle));
  }
  const Subject subject(solids::surface_of_revolution(profile, 32));
  const std::vector<Trial> trials = subject.trials(
      variant("iwires"), {task(ImprovementPreset::paper, 0.1), task(ImprovementPreset::refined, 0.2)}, few);
  REQUIRE(trials.size() == 2);
  for (const Trial& trial : trials) {
    CHECK_FALSE(trial.reached);
    CHECK_FALSE(trial.best);
    CHECK(trial.reason.find("feature") != std::string::npos);
  }
  CHECK(trials.back().task.target == 0.2);
}
