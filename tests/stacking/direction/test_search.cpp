#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/io/read.h"
#include "stackabilization/stacking/map.h"
#include "stackabilization/stacking/search.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

constexpr double degree = std::numbers::pi / 180;

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// No direction is special, and S has many narrow peaks.
Shape irregular() {
  return solids::triangle_soup({.seed = 8, .count = 30});
}

/// Walls of sheets swept along (1, 2, 3), exactly parallel to it.
Shape slanted_sheets() {
  Points vertices(8, 3);
  vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 2, 3, 2, 2, 3, 2, 3, 3, 1, 3, 3;
  Triangles triangles(8, 3);
  triangles << 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7;
  return make_shape(vertices, triangles);
}

double best_of_map(const StackabilitySolver& solver, double step) {
  double best = -1e300;
  for (const MapSample& sample : stackability_map(solver, {.step_degrees = step}).samples)
    best = std::max(best, sample.stackability);
  return best;
}

}  // namespace

TEST_CASE("a search climbs along cliffs") {
  // The chair stacks best where its back legs just pass the back: S drops by half on one side of that.
  const StackabilitySolver chair(
      read_shape(std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "data" / "models" / "chair.obj"));
  const double best = best_direction(chair).best.value;
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.07, -0.07, 1)}) {
    SearchOptions options;
    options.cone = DirectionCone{axis, 8 * degree};
    CHECK(best_direction(chair, options).best.value == Approx(best).margin(1e-8));
  }
}

TEST_CASE("the search of a sheet ends where its copies coincide") {
  // A funnel without thickness: every direction that sees it without folds has S = 1.
  Points vertices(8, 3);
  vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -0.2, -0.2, 1, 1.2, -0.2, 1, 1.2, 1.2, 1, -0.2, 1.2, 1;
  Triangles triangles(10, 3);
  triangles << 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7, 0, 3, 2, 0, 2, 1;
  const SearchResult found = best_direction(StackabilitySolver(make_shape(vertices, triangles)));
  CHECK(found.best.direction == Eigen::Vector3d(0, 0, 1));
  CHECK(found.best.f_max == Approx(0).margin(1e-12));
  CHECK(found.separation.value == Rational(0.0));
  CHECK(found.evaluated < 500);
}

TEST_CASE("a cup stacks best along its axis, in any pose") {
  const Shape cup = solids::frustum_shell({.segments = 8});
  const SearchOptions quick{.spacing = 0.1, .climbs = 2};
  const SearchResult upright = best_direction(StackabilitySolver(cup), quick);
  CHECK(upright.best.direction == Eigen::Vector3d(0, 0, 1));
  CHECK(upright.separation.length == Approx(solids::frustum_shell_f_max({.segments = 8})).epsilon(1e-12));
  const Eigen::Matrix3d rotation = solids::random_rotation(1);
  const StackabilitySolver turned(transformed(cup, rotation, Eigen::Vector3d::Ones()));
  const SearchResult found = best_direction(turned, quick);
  CHECK(found.best.value == Approx(upright.best.value).margin(1e-7));
  CHECK(found.best.direction.cross(rotation.col(2)).norm() < 1e-6);
}

TEST_CASE("ties go to the first candidate, unmoved") {
  const SearchResult cube = best_direction(StackabilitySolver(solids::box({1, 1, 1})));
  CHECK(cube.best.direction == Eigen::Vector3d(1, 0, 0));
  CHECK(cube.best.value == Approx(0).margin(1e-12));
}

TEST_CASE("no direction of a map is better than the search") {
  for (const Shape& shape :
       {irregular(), solids::l_shape(4, 1), solids::triangle_soup({.seed = 9, .count = 60})}) {
    const StackabilitySolver solver(shape);
    const SearchResult found = best_direction(solver, {.climbs = 4});
    CHECK(found.best.value >= best_of_map(solver, 2) - 1e-6);
    CHECK(found.best.value == Approx(solver.measure(Direction(found.best.direction)).value).margin(1e-15));
    CHECK(found.separation.length == Approx(found.best.f_max).margin(1e-12 * found.best.extent));
  }
}

TEST_CASE("the optima are ranked, distinct, and topped by the best direction") {
  const SearchResult found = best_direction(StackabilitySolver(irregular()), {.climbs = 20});
  REQUIRE_FALSE(found.optima.empty());
  CHECK(found.optima.front().direction == found.best.direction);
  CHECK(found.optima.front().stackability == found.best.value);
  for (std::size_t i = 0; i < found.optima.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      CHECK(found.optima[j].stackability >= found.optima[i].stackability - 1e-10);
      CHECK(found.optima[j].direction.cross(found.optima[i].direction).norm() > 1e-3);
    }
  CHECK(found.abandoned < found.evaluated);
  CHECK(found.abandoned > 0);
}

TEST_CASE("a cone is respected") {
  const StackabilitySolver solver(irregular());
  for (const Eigen::Vector3d& axis : std::vector<Eigen::Vector3d>{{0, 0, -2}, {1, 0.2, 0}, {-0.3, -1, -0.1}})
    for (const double half : {2 * degree, 25 * degree, 90 * degree}) {
      const SearchResult found = best_direction(solver, {.cone = DirectionCone{axis, half}});
      CHECK(angle(found.best.direction, axis) <= half + 1e-8);
      double sampled = -1e300;
      for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Eigen::Vector3d r = solids::Random(seed).on_sphere();
        if (angle(r, axis) <= half) sampled = std::max(sampled, solver.measure(Direction(r)).value);
      }
      CHECK(found.best.value >= sampled - 1e-9);
    }
}

TEST_CASE("a cone that ends short of the peak gives a direction on its rim") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 8}));
  const Eigen::Vector3d axis(std::sin(4 * degree), 0, std::cos(4 * degree));
  const SearchResult found = best_direction(solver, {.cone = DirectionCone{axis, 3 * degree}, .climbs = 2});
  CHECK(angle(found.best.direction, axis) == Approx(3 * degree).epsilon(1e-4));
}

TEST_CASE("a plane is respected, alone and with a cone") {
  const StackabilitySolver solver(irregular());
  const Eigen::Vector3d normal(0.2, 1, -0.3);
  const SearchResult found = best_direction(solver, {.plane_normal = normal});
  CHECK(std::abs(found.best.direction.dot(normal)) < 1e-8);
  double sampled = -1e300;
  for (const Eigen::Vector3d& r : half_circle(normal, degree / 2))
    sampled = std::max(sampled, solver.measure(Direction(r)).value);
  CHECK(found.best.value >= sampled - 1e-7);

  // The plane holds (1.2, 0.06, 1).
  const DirectionCone cone{{1, 0, 1}, 20 * degree};
  const SearchResult both = best_direction(solver, {.cone = cone, .plane_normal = normal});
  CHECK(std::abs(both.best.direction.dot(normal)) < 1e-8);
  CHECK(angle(both.best.direction, cone.axis) <= 20 * degree + 1e-8);
}

TEST_CASE("a peak of one single direction is found when it is a candidate") {
  const StackabilitySolver solver(slanted_sheets());
  const SearchResult found = best_direction(solver, {.candidates = {{-1, -2, -3}}, .climbs = 1});
  CHECK(found.best.direction == Eigen::Vector3d(1, 2, 3));
  CHECK(found.best.value == 1);
}

TEST_CASE("the axis of the cone is tried, exactly as given") {
  const StackabilitySolver solver(slanted_sheets());
  for (const double half : {1 * degree, 40 * degree}) {
    const SearchResult found =
        best_direction(solver, {.cone = DirectionCone{{-1, -2, -3}, half}, .climbs = 1});
    CHECK(found.best.direction == Eigen::Vector3d(-1, -2, -3));
    CHECK(found.best.value == 1);
  }
}

TEST_CASE("a peak where the plane meets a face is found") {
  // Two ragged sheets in planes x = 0 and x = 1: nothing blocks along directions in these planes.
  Points vertices(8, 3);
  vertices << 0, 0, 0, 0, 1, 0.3, 0, 1.2, 1, 0, 0.1, 1.1, 1, 0, 0, 1, 1, 0.3, 1, 1.2, 1, 1, 0.1, 1.1;
  Triangles triangles(4, 3);
  triangles << 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7;
  const SearchResult found =
      best_direction(StackabilitySolver(make_shape(vertices, triangles)), {.plane_normal = {{1, 2, 3}}});
  CHECK(found.best.direction.x() == 0);
  CHECK(found.best.direction.cross(Eigen::Vector3d(0, -3, 2).normalized()).norm() < 1e-12);
  CHECK(found.best.value == 1);
}

TEST_CASE("one and two threads find the same bits") {
  const StackabilitySolver solver(irregular());
  const auto with_threads = [&](int count) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, count);
    return best_direction(solver);
  };
  const SearchResult one = with_threads(1), two = with_threads(2);
  CHECK(one.evaluated == two.evaluated);
  CHECK(one.abandoned == two.abandoned);
  REQUIRE(one.optima.size() == two.optima.size());
  for (std::size_t i = 0; i < one.optima.size(); ++i) {
    CHECK(one.optima[i].direction == two.optima[i].direction);
    CHECK(one.optima[i].stackability == two.optima[i].stackability);
  }
}

TEST_CASE("a search reports progress and can be ended") {
  const StackabilitySolver solver(irregular());
  std::vector<double> fractions;
  SearchOptions options;
  options.progress = [&](double fraction) { fractions.push_back(fraction); };
  const SearchResult whole = best_direction(solver, options);
  CHECK_FALSE(whole.cancelled);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK(fractions.back() == 1);

  options.cancelled = [] { return true; };
  const SearchResult ended = best_direction(solver, options);
  CHECK(ended.cancelled);
  CHECK(ended.evaluated < whole.evaluated);
  CHECK(ended.best.value <= whole.best.value + 1e-12);
  CHECK(ended.best.value == solver.measure(Direction(ended.best.direction)).value);
}

TEST_CASE("a search can be ended between the steps of its last climbs") {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const StackabilitySolver solver(irregular());
  bool late = false;  // in the last climbs
  int asked = 0, end_after = 1000000;
  SearchOptions options;
  options.climbs = 2;
  options.progress = [&](double fraction) { late = fraction > 0.9; };
  options.cancelled = [&] { return late && ++asked > end_after; };
  const SearchResult whole = best_direction(solver, options);
  CHECK_FALSE(whole.cancelled);
  CHECK(asked > 4);
  asked = 0;
  end_after = 3;
  const SearchResult ended = best_direction(solver, options);
  CHECK(ended.cancelled);
  CHECK(ended.evaluated < whole.evaluated);
  CHECK(ended.best.value <= whole.best.value + 1e-12);
}

TEST_CASE("a search tries no more directions than it may, the same ones on any number of threads") {
  for (const Shape& shape : {solids::frustum_shell({.segments = 8}), irregular()}) {
    const StackabilitySolver solver(shape);
    const SearchResult whole = best_direction(solver);
    CHECK(!whole.limited);
    double before = -std::numeric_limits<double>::infinity();
    for (const std::int64_t limit : {std::int64_t{1}, std::int64_t{7}, std::int64_t{300}, std::int64_t{1500},
                                     whole.evaluated / 2, 100 * whole.evaluated}) {
      INFO("at most " << limit << " of " << whole.evaluated);
      SearchOptions options;
      options.max_directions = limit;
      std::vector<SearchResult> results;
      for (const std::size_t threads : {1, 3}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(best_direction(solver, options));
      }
      CHECK(results[0].evaluated <= limit);
      CHECK(results[0].evaluated == results[1].evaluated);
      CHECK(results[0].best.direction == results[1].best.direction);
      CHECK(!results[0].cancelled);
      if (limit >= 300) CHECK(results[0].best.value >= before - 0.2);
      before = results[0].best.value;
      if (limit > whole.evaluated) CHECK(results[0].best.direction == whole.best.direction);
    }
  }
}

TEST_CASE("a search refuses options that make no sense") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 8}));
  const auto refused = [&](const SearchOptions& options) {
    CHECK_THROWS_AS(best_direction(solver, options), UsageError);
  };
  refused({.spacing = 0});
  refused({.spacing = std::nan("")});
  refused({.climbs = 0});
  refused({.max_directions = 0});
  refused({.cone = DirectionCone{{0, 0, 1}, 0}});
  refused({.cone = DirectionCone{{0, 0, 1}, 2}});
  refused({.cone = DirectionCone{{0, 0, 0}, 0.1}});
  refused({.plane_normal = Eigen::Vector3d::Zero()});
  refused({.cone = DirectionCone{{0, 0, 1}, 0.1}, .plane_normal = Eigen::Vector3d::UnitZ()});
}
