#include <cmath>
#include <functional>

#include "improvement/refinement/magnitude_model.h"
#include "support/catch.h"
#include "support/point_sets.h"

namespace stackabilization::magnitude_model_test {

using namespace detail;

namespace {

/// Linear functions of the magnitudes: value at 0, and slopes as rows.
struct Linear {
  Eigen::VectorXd value;
  Eigen::MatrixXd slope;

  Eigen::VectorXd at(const Magnitudes& x) const {
    return value + slope * Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  }
};

/// A convex problem: the sum of |changes|, or the largest of the constraints, which are <= 0 where satisfied.
struct Problem {
  Linear changes, constraints;

  MagnitudeSample sample(const Magnitudes& x) const {
    MagnitudeSample result;
    result.made = true;
    result.changes = changes.at(x);
    result.change = result.changes.cwiseAbs().sum();
    result.violations = constraints.at(x);
    return result;
  }
  MagnitudeSlopes slopes() const { return {changes.slope, constraints.slope, {}, {}, {}, {}}; }

  MagnitudeModel model(MagnitudeGoal goal, const Magnitudes& centre) const {
    return {goal, centre, sample(centre), slopes()};
  }
};

Magnitudes all(double value, std::size_t count = 2) {
  return Magnitudes(count, value);
}

/// |x| + 2 |y|, where x + y >= 1.
Problem weighted() {
  Problem problem;
  problem.changes = {Eigen::Vector2d::Zero(), Eigen::Vector2d(1, 2).asDiagonal()};
  problem.constraints = {Eigen::VectorXd::Constant(1, 1), Eigen::RowVector2d(-1, -1)};
  return problem;
}

/// One constraint over one magnitude that is linearised where it is sampled.
struct Curve {
  std::function<double(double)> value, slope;

  MagnitudeSample sample(double x) const {
    MagnitudeSample result;
    result.made = true;
    result.changes = Eigen::VectorXd::Constant(1, x);
    result.change = std::abs(x);
    result.violations = Eigen::VectorXd::Constant(1, value(x));
    return result;
  }
  MagnitudeSlopes slopes(double x) const {
    return {Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Constant(1, 1, slope(x)), {}, {}, {}, {}};
  }
};

/// Falls at slope 1 to 0.15 below zero at 1.15, and rises at slope 3 from there.
const Curve kink = {[](double x) { return std::max(1 - x, 3 * x - 3.6); },
                    [](double x) { return x < 1.15 ? -1.0 : 3.0; }};

}  // namespace

TEST_CASE("a step goes to the minimum of a linear problem, and tells what it gains") {
  const MagnitudeModel model = weighted().model(MagnitudeGoal::min_change, {0.8, 0.6});
  const MagnitudeModel::Step step = model.step(all(-3), all(3));
  CHECK(step.to[0] == Approx(1).margin(1e-6));
  CHECK(step.to[1] == Approx(0).margin(1e-6));
  CHECK(step.predicted_decrease == Approx(2.0 - 1).epsilon(1e-6));
  CHECK(step.reduced_costs.norm() < 1e-6);
}

TEST_CASE("at a bound the reduced cost is what each unit beyond it would gain") {
  const MagnitudeModel model = weighted().model(MagnitudeGoal::min_change, {0.25, 0.9});
  const MagnitudeModel::Step step = model.step(all(-3), {0.5, 3});
  CHECK(step.to[0] == Approx(0.5).margin(1e-6));
  CHECK(step.to[1] == Approx(0.5).margin(1e-6));
  CHECK(step.predicted_decrease == Approx(2.05 - 1.5).epsilon(1e-6));
  CHECK(step.reduced_costs[0] == Approx(2 - 1).epsilon(1e-5));  // y, of weight 2, gives way to x
  CHECK(step.reduced_costs[1] == Approx(0).margin(1e-5));
}

TEST_CASE("a step stays within its bounds to the last bit, also where they leave nothing") {
  const MagnitudeModel model = weighted().model(MagnitudeGoal::min_change, {0.8, 0.6});
  const MagnitudeModel::Step none = model.step({0.8, 0.6}, {0.8, 0.6});
  CHECK(none.to == Magnitudes{0.8, 0.6});
  CHECK(none.predicted_decrease == Approx(0).margin(1e-9));
  const MagnitudeModel::Step some = model.step({0.7, 0.5}, {0.9, 0.6});
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(some.to[k] >= (k == 0 ? 0.7 : 0.5));
    CHECK(some.to[k] <= (k == 0 ? 0.9 : 0.6));
  }
}

TEST_CASE("random problems end in the least of all their corners") {
  // In two magnitudes: where two lines of constraints, kinks of changes and bounds cross, lies the minimum.
  point_sets::Random random(7);
  for (int trial = 0; trial < 30; ++trial) {
    Problem problem;
    problem.changes = {Eigen::Vector3d::Zero(), Eigen::MatrixXd::Zero(3, 2)};
    problem.constraints = {Eigen::Vector3d::Zero(), Eigen::MatrixXd::Zero(3, 2)};
    for (Eigen::Index row = 0; row < 3; ++row) {
      problem.changes.value(row) = random.uniform(-1, 1);
      // 0 satisfies all of them, but not by far.
      problem.constraints.value(row) = random.uniform(-0.3, -0.05);
      for (Eigen::Index k = 0; k < 2; ++k) {
        problem.changes.slope(row, k) = random.uniform(-1, 1);
        problem.constraints.slope(row, k) = random.uniform(-1, 1);
      }
    }
    std::vector<Eigen::Vector3d> lines;  // a + b x + c y = 0
    for (Eigen::Index row = 0; row < 3; ++row)
      for (const Linear* linear : {&problem.changes, &problem.constraints})
        lines.emplace_back(linear->value(row), linear->slope(row, 0), linear->slope(row, 1));
    for (const double sign : {1.0, -1.0}) {
      lines.emplace_back(-1, sign, 0);
      lines.emplace_back(-1, 0, sign);
    }
    double least = problem.sample(all(0)).change;
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Eigen::Vector3d corner = lines[i].cross(lines[j]);
        const Magnitudes x = {corner(1) / corner(0), corner(2) / corner(0)};
        if (!(std::max(std::abs(x[0]), std::abs(x[1])) <= 1 + 1e-9)) continue;
        const MagnitudeSample sample = problem.sample(x);
        if (sample.violations.maxCoeff() <= 1e-9) least = std::min(least, sample.change);
      }
    const MagnitudeModel::Step step = problem.model(MagnitudeGoal::min_change, all(0)).step(all(-1), all(1));
    const MagnitudeSample there = problem.sample(step.to);
    CHECK(there.violations.maxCoeff() <= 1e-6);
    CHECK(there.change == Approx(least).margin(1e-6));
    CHECK(problem.sample(all(0)).change - step.predicted_decrease == Approx(least).margin(1e-6));
  }
}

TEST_CASE("the nearest displacement on the border of a constraint is the foot of the target") {
  // The displacement is the distance from (2, 1); the constraint x + 2 y <= 1.
  const Eigen::Vector2d target(2, 1), normal(1, 2), centre(-0.3, 0.4);
  Problem problem;
  problem.changes = {Eigen::VectorXd(0), Eigen::MatrixXd(0, 2)};
  problem.constraints = {Eigen::VectorXd::Constant(1, -1), normal.transpose()};
  const Eigen::Vector2d off = centre - target;
  MagnitudeSample base = problem.sample({centre.x(), centre.y()});
  base.displacement = base.change = off.norm();
  MagnitudeSlopes slopes = problem.slopes();
  slopes.gram.resize(3, 3);
  slopes.gram << off.squaredNorm(), off.transpose(), off, Eigen::Matrix2d::Identity();
  const MagnitudeModel model(MagnitudeGoal::min_change, {centre.x(), centre.y()}, base, slopes);
  const MagnitudeModel::Step step = model.step(all(-3), all(3));
  const double beyond = (normal.dot(target) - 1) / normal.squaredNorm();
  const Eigen::Vector2d foot = target - beyond * normal;
  CHECK((Eigen::Vector2d(step.to[0], step.to[1]) - foot).norm() < 1e-5);
  CHECK(step.predicted_decrease == Approx(off.norm() - beyond * normal.norm()).epsilon(1e-5));
}

TEST_CASE("where feasibility is the goal the largest violation is made least") {
  Problem problem;  // max(1 - x, x - 0.4, 0.1), least at 0.7
  problem.changes = {Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(1, 1)};
  problem.constraints = {Eigen::Vector3d(1, -0.4, 0.1), Eigen::Vector3d(-1, 1, 0)};
  const MagnitudeModel model = problem.model(MagnitudeGoal::feasible, {0.1});
  CHECK(model.merit(problem.sample({0.1})) == Approx(0.9).epsilon(1e-14));
  const MagnitudeModel::Step step = model.step(all(-3, 1), all(3, 1));
  CHECK(step.to[0] == Approx(0.7).margin(1e-6));
  CHECK(step.predicted_decrease == Approx(0.9 - 0.3).epsilon(1e-6));
}

TEST_CASE("a magnitude does not go where its neighbour was refused, so that others do") {
  Problem problem;  // 1 - 2 x - y, both wanted upwards
  problem.changes = {Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(1, 2)};
  problem.constraints = {Eigen::VectorXd::Constant(1, 1), Eigen::RowVector2d(-2, -1)};
  const MagnitudeSample base = problem.sample({0, 0});
  for (const bool above : {true, false}) {
    MagnitudeSlopes slopes = problem.slopes();
    (above ? slopes.refused_above : slopes.refused_below) = {true, false};
    const MagnitudeModel model(MagnitudeGoal::feasible, {0, 0}, base, slopes);
    const MagnitudeModel::Step step = model.step(all(-1), all(1));
    CHECK(step.to[0] == Approx(above ? 0 : 1).margin(1e-6));
    CHECK(step.to[1] == Approx(1).margin(1e-6));
    CHECK(step.predicted_decrease == Approx(above ? 1 : 3).epsilon(1e-6));
  }
}

TEST_CASE("a cut from a rejected point makes the kink known between it and the centre") {
  MagnitudeModel model(MagnitudeGoal::feasible, {0}, kink.sample(0), kink.slopes(0));
  const MagnitudeModel::Step blind = model.step(all(-2, 1), all(2, 1));
  CHECK(blind.to[0] == Approx(2).margin(1e-6));
  CHECK(blind.predicted_decrease == Approx(2).margin(1e-6));  // it knows no better
  model.add({2}, kink.sample(2), kink.slopes(2));
  const MagnitudeModel::Step known = model.step(all(-2, 1), all(2, 1));
  CHECK(known.to[0] == Approx(1.15).margin(1e-6));
  CHECK(known.predicted_decrease == Approx(1 + 0.15).margin(1e-6));
}

TEST_CASE("cutting planes alone end in the minimum of a smooth convex function") {
  // Kelley's method: e^x - 2 x is least at log 2.
  const Curve curve = {[](double x) { return std::exp(x) - 2 * x; },
                       [](double x) { return std::exp(x) - 2; }};
  MagnitudeModel model(MagnitudeGoal::feasible, {-1}, curve.sample(-1), curve.slopes(-1));
  double x = -1;
  for (int round = 0; round < 30; ++round) {
    x = model.step(all(-2, 1), all(2, 1)).to[0];
    model.add({x}, curve.sample(x), curve.slopes(x));
  }
  CHECK(curve.value(x) == Approx(2 - 2 * std::log(2.0)).epsilon(1e-6));
}

TEST_CASE("a cut that is too high at the centre is lowered to what was measured there") {
  // 1 at the centre 0; from 2 a cut of slope 1 and value 4 says 2 there.
  const Curve hump = {[](double x) { return x < 1 ? 1 - x : 4.0; },
                      [](double x) { return x < 1 ? -1.0 : 1.0; }};
  MagnitudeModel model(MagnitudeGoal::feasible, {0}, hump.sample(0), hump.slopes(0));
  model.add({2}, hump.sample(2), hump.slopes(2));
  // As 1 + x it leaves nothing to gain, as 2 + x it would promise less than nothing.
  const MagnitudeModel::Step step = model.step(all(-2, 1), all(2, 1));
  CHECK(step.to[0] == Approx(0).margin(1e-6));
  CHECK(step.predicted_decrease == Approx(0).margin(1e-6));
}

TEST_CASE("at a new centre only the cuts that are right there stay") {
  MagnitudeModel model(MagnitudeGoal::feasible, {0}, kink.sample(0), kink.slopes(0));
  model.add({2}, kink.sample(2), kink.slopes(2));
  // Both are right at 1.05, -0.05 and -0.45: the one that rises still stands in the way.
  MagnitudeModel right = model;
  right.move_to({1.05}, kink.sample(1.05), kink.slopes(1.05));
  CHECK(right.centre() == Magnitudes{1.05});
  CHECK(right.step(all(-2, 1), all(2, 1)).to[0] == Approx(1.15).margin(1e-6));
  // At 0.5 it lies at -2.1, too far below to be kept.
  MagnitudeModel far = model;
  far.move_to({0.5}, kink.sample(0.5), kink.slopes(0.5));
  CHECK(far.step(all(-2, 1), all(2, 1)).to[0] == Approx(2).margin(1e-6));
  // Measured lower than both say at 1.5, which is 0.9, they are wrong there.
  MagnitudeSample low = kink.sample(1.5);
  low.violations[0] = 0.2;
  MagnitudeModel wrong = model;
  wrong.move_to({1.5}, low, kink.slopes(0));
  CHECK(wrong.step(all(-2, 1), all(2, 1)).to[0] == Approx(2).margin(1e-6));
}

TEST_CASE("corrections take back twice a violation at the slopes of the centre, until cuts are added") {
  // x is least at 1, where 1 / x - 1 is 0; the tangent at 1.2 leads below it.
  const Curve inverse = {[](double x) { return 1 / x - 1; }, [](double x) { return -1 / (x * x); }};
  const auto tangent_ends = [&](double x, double slope_at) {
    return x - inverse.value(x) / inverse.slope(slope_at);
  };
  MagnitudeModel model(MagnitudeGoal::min_change, {1.2}, inverse.sample(1.2), inverse.slopes(1.2));
  const double first = model.step(all(-3, 1), all(3, 1)).to[0];
  CHECK(first == Approx(tangent_ends(1.2, 1.2)).margin(1e-6));
  REQUIRE(inverse.value(first) > 0);
  model.correct({first}, inverse.sample(first));
  const double second = model.step(all(-3, 1), all(3, 1)).to[0];
  CHECK(second - first == Approx(2 * (tangent_ends(first, 1.2) - first)).margin(1e-6));
  CHECK(inverse.value(second) < 0);
  // What is measured takes their place: the tangent at the first point.
  model.add({first}, inverse.sample(first), inverse.slopes(first));
  CHECK(model.step(all(-3, 1), all(3, 1)).to[0] == Approx(tangent_ends(first, first)).margin(1e-6));
}

TEST_CASE("changes that are multiples of each other count as their sum, fixed ones as they are") {
  Problem problem;  // |x| + |-2 x| + |y| + 5, where x + y >= 1
  problem.changes.value = Eigen::Vector4d(0, 0, 0, -5);
  problem.changes.slope.resize(4, 2);
  problem.changes.slope << 1, 0, -2, 0, 0, 1, 0, 0;
  problem.constraints = {Eigen::VectorXd::Constant(1, 1), Eigen::RowVector2d(-1, -1)};
  const MagnitudeModel::Step step =
      problem.model(MagnitudeGoal::min_change, {0.5, 0.6}).step(all(-3), {3, 0.75});
  CHECK(step.to[0] == Approx(0.25).margin(1e-6));
  CHECK(step.to[1] == Approx(0.75).margin(1e-6));
  CHECK(step.predicted_decrease == Approx(7.1 - (0.75 + 0.75 + 5)).epsilon(1e-6));
  CHECK(step.reduced_costs[1] == Approx(3 - 1).epsilon(1e-5));
}

}  // namespace stackabilization::magnitude_model_test
