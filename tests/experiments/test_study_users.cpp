#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "stackabilization/deformation/factory.h"
#include "stackabilization/stacking/tolerances.h"
#include "study/manual_work.h"
#include "support/catch.h"
#include "support/cups.h"
#include "support/still_designs.h"
#include "support/structures.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

constexpr double out_of_reach = 0.99;
const Habit habits[] = {Habit::random, Habit::greedy, Habit::careful};

/// A design space, a target, and a tool to reach it with.
struct Task {
  Task(std::unique_ptr<DeformationModel> designs, double target)
      : space(std::move(designs)),
        checker(*space, designs::frame_requirements(target)),
        tool(checker, {0, 0, 1}) {}

  std::unique_ptr<DeformationModel> space;
  RequirementChecker checker;
  ManualTool tool;
};

Task table(double target = out_of_reach) {
  return {deformation_model(structures::table()), target};
}

Task cup(double target = out_of_reach) {
  return {std::make_unique<cups::Cups>(), target};
}

bool ascending(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

}  // namespace

TEST_CASE("a greedy user gains with every edit, a random one never loses") {
  const Task task = table();
  const double before = task.tool.at_rest().measured.value;
  std::size_t greedy = 0, random = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::vector<double> gained = worked(task.tool, {Habit::greedy, seed, 60, 6}).kept;
    gained.insert(gained.begin(), before);
    CHECK(ascending(gained));
    greedy += gained.size() - 1;
    double last = before;
    for (const double S : worked(task.tool, {Habit::random, seed, 60}).kept) {
      CHECK(S >= last - tolerance::stackability);
      last = S;
      ++random;
    }
  }
  CHECK(greedy > 0);
  CHECK(random > greedy);  // on a plateau a random user goes on
}

TEST_CASE("what a user ends with is what the edits make, and it holds all requirements but the target") {
  const Task task = table();
  for (const Habit habit : habits) {
    const Candidate result = worked(task.tool, {habit, 3, 60, 6}).result;
    REQUIRE_FALSE(result.design.edits.empty());
    const DeformationResult again = task.space->deformed(
        result.design.edits,
        deformation_constraints(task.checker.requirements(), task.space->rest(), Direction(0, 0, 1)));
    REQUIRE_FALSE(again.refusal);
    CHECK(again.design.shape.vertices == result.design.shape.vertices);
    const Assessment assessment = task.checker.check(again.design, Direction(0, 0, 1));
    CHECK(assessment.measured.value == Approx(result.measured.value).margin(1e-11));
    for (const Check& check : assessment.checks) CHECK(check.passed == (check.kind != CheckKind::target));
    const EnergyMeter meter(task.space->rest(), BoxModel::frame);
    const double gain = result.measured.value - task.tool.at_rest().measured.value;
    CHECK(result.energy.value == Approx(meter.energy(again.design, gain).value).margin(1e-11));
  }
}

TEST_CASE("a careful user takes hold of what touches, and lowers E with every edit") {
  const Task task = table();
  const auto& parts = task.space->rest().shape.part_names;
  std::size_t kept = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const ManualWork work = worked(task.tool, {Habit::careful, seed, 80, 4});
    kept += work.kept.size();
    Candidate now = task.tool.at_rest();
    for (const Edit& edit : work.result.design.edits) {
      const std::vector<Handle> touching = task.tool.touching_handles(now);
      CHECK(std::find(touching.begin(), touching.end(), edit.handle) != touching.end());
      const double before = now.energy.value;
      now = task.tool.edited(now, edit).value();
      CHECK(now.energy.value < before);
    }
  }
  CHECK(kept > 0);
  // Legs stand on the top, and nothing else does.
  for (const Handle& handle : task.tool.touching_handles(task.tool.at_rest()))
    CHECK_FALSE(parts[static_cast<std::size_t>(handle.part)].starts_with("bar"));
}

TEST_CASE("users have the handles of the automatic method and its largest steps, and no others") {
  const Task task = table();
  for (const Handle& handle : task.tool.handles()) CHECK(handle.kind != HandleKind::shape);
  CHECK(task.tool.handles().size() + 1 == task.space->handles().size());
  const Eigen::Vector3d extents(8, 8, 6);
  for (unsigned seed = 1; seed <= 4; ++seed)
    for (const Edit& edit : worked(task.tool, {Habit::random, seed, 80}).result.design.edits) {
      if (const auto* move = std::get_if<Move>(&edit.operation)) {
        CHECK((move->by.array() != 0).count() == 1);
        CHECK((move->by.cwiseQuotient(extents).cwiseAbs().array() <= 0.18 + 1e-12).all());
      }
      if (const auto* scale = std::get_if<Scale>(&edit.operation)) CHECK(std::abs(scale->factor - 1) <= 0.3);
    }
}

TEST_CASE("the frame of a tool is that of its direction") {
  const Task task = cup();
  for (const Eigen::Vector3d& r : {Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(0.3, 4, -0.2)}) {
    const ManualTool tool(task.checker, r);
    CHECK(tool.frame().isUnitary(1e-12));
    CHECK(tool.frame().determinant() == Approx(1));
    CHECK(tool.frame().col(2).dot(r) == Approx(r.norm()));
  }
  CHECK(task.tool.extent(0) == Approx(2));
  CHECK(task.tool.extent(2) == Approx(cups::Cups::height));
}

TEST_CASE("users stop at the target, and S of a cup is its closed form") {
  const Task task = cup(0.5);
  for (const Habit habit : habits)
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const ManualWork work = worked(task.tool, {habit, seed, 400, 8});
      REQUIRE(work.reached);
      CHECK(work.tried < 400);
      CHECK(work.kept.size() == work.result.design.edits.size());
      CHECK(work.kept.back() >= 0.5);
      CHECK(std::all_of(work.kept.begin(), work.kept.end() - 1, [](double S) { return S < 0.5; }));
      const Eigen::Vector2d radii = cups::radii(work.result.design);
      const double wide = radii.maxCoeff(), narrow = radii.minCoeff();
      CHECK(work.kept.back() == Approx(1 - cups::Cups::wall * wide / (wide - narrow)).margin(1e-9));
    }
}

TEST_CASE("users try nothing where the target is met at rest, and give up where it never is") {
  const Task met = cup(-0.5), never = cup();
  for (const Habit habit : habits) {
    const ManualWork at_once = worked(met.tool, {habit, 1, 50, 8});
    CHECK(at_once.reached);
    CHECK(at_once.tried == 0);
    const ManualWork patient = worked(never.tool, {habit, 1, 50, 8});
    CHECK_FALSE(patient.reached);
    CHECK(patient.tried == 50);  // not a multiple of eight
    CHECK(patient.result.design.edits.size() == patient.kept.size());
  }
}

TEST_CASE("a seed decides what a user does, whatever the number of threads") {
  const Task task = table();
  const auto edited = [&](unsigned seed, int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    return worked(task.tool, {Habit::random, seed, 40}).result.design.shape.vertices;
  };
  CHECK(edited(1, 1) == edited(1, 4));
  CHECK(edited(1, 1) != edited(2, 1));
}
