#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/direction_bound.h"
#include "stackabilization/stacking/search.h"
#include "support/catch.h"
#include "support/point_sets.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

Stackability along(const StackabilitySolver& solver, double x, double y, double z) {
  return solver.measure(Direction(x, y, z));
}

/// Rotates z to the direction.
Eigen::Matrix3d frame_matrix(const Direction& direction) {
  const Frame frame = frame_of(direction);
  Eigen::Matrix3d matrix;
  matrix << frame.u, frame.v, frame.w;
  return matrix;
}

/// Largest S of random directions of a region.
double best_sample(const StackabilitySolver& solver, const DirectionRegion& region, int count) {
  point_sets::Random random(3);
  double best = -1e300;
  for (int i = 0; i < count; ++i)
    if (const auto direction = region.nearest(random.unit()))
      best = std::max(best, solver.measure(Direction(*direction)).value);
  return best;
}

void check_same(const BoundedStackability& a, const BoundedStackability& b) {
  CHECK(a.bound.bound == b.bound.bound);
  CHECK(a.bound.cells == b.bound.cells);
  CHECK(a.bound.open == b.bound.open);
  CHECK(a.best.value == b.best.value);
  CHECK(a.best.direction == b.best.direction);
  CHECK(a.evaluated == b.evaluated);
}

}  // namespace

TEST_CASE("a box stacks along no direction, and this is proven") {
  const StackabilitySolver box(solids::box({1, 2, 3}));
  for (const double accuracy : {0.1, 0.01}) {
    const BoundedStackability found = stackability_bound(box, along(box, 0, 0, 1), {.accuracy = accuracy});
    CHECK(found.best.value == Approx(0).margin(1e-12));
    CHECK(found.bound.proven);
    CHECK(found.bound.open == 0);
    CHECK(found.bound.bound >= 0);
    CHECK(found.bound.bound <= accuracy);
  }
}

TEST_CASE("an upright prism stacks along no direction, and this is proven") {
  // Across the prism, the longest chord times the width is the least rectangle around its base for triangles
  // and hexagons along every direction, along it the rectangle: S is 0. Aslant it is less.
  const std::vector<Shape> prisms = {solids::prism(solids::regular_polygon(3), 1),
                                     solids::prism({{0, 0}, {3, 0}, {1, 2}}, 2),
                                     solids::prism(solids::regular_polygon(6), 3)};
  for (const Shape& prism : prisms) {
    const StackabilitySolver solver(prism);
    CHECK(along(solver, 1, 0, 0).value == Approx(0).margin(1e-12));
    const BoundedStackability found = stackability_bound(solver, along(solver, 1, 2, 3), {.accuracy = 0.05});
    CHECK(found.best.value == Approx(0).margin(1e-9));
    CHECK(found.bound.proven);
    CHECK(found.bound.bound >= 0);
    CHECK(found.bound.bound <= found.best.value + 0.05);
  }
}

TEST_CASE("a leaning prism stacks best along its edges, to a closed form, and this is proven") {
  // The base is a long along x, and the top is moved by s. Along the edges (s, 0, h) one more copy takes the
  // base times h; V(M) is the least rectangle around the parallelogram of a and (s, h), on the side (s, h),
  // times the width.
  struct Leaning {
    solids::Polygon base;
    double a, s, h;
  };
  const std::vector<Leaning> prisms = {{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 2, 1, 3},
                                       {solids::regular_polygon(3), 1.5, 1, 2},
                                       {solids::regular_polygon(6), 2, 1, 2}};
  for (const Leaning& prism : prisms) {
    Shape shape = solids::prism(prism.base, prism.h);
    for (Eigen::Index v = 0; v < shape.vertices.rows(); ++v)
      shape.vertices(v, 0) += shape.vertices(v, 2) / prism.h * prism.s;
    const StackabilitySolver solver(shape);
    const double lean = prism.a * prism.s, best = lean / (prism.s * prism.s + prism.h * prism.h + lean);
    CHECK(along(solver, prism.s, 0, prism.h).value == Approx(best));
    SearchOptions options;
    options.certify = 0.05;
    const SearchResult found = best_direction(solver, options);
    CHECK(found.best.value == Approx(best).margin(1e-9));
    REQUIRE(found.bound);
    CHECK(found.bound->proven);
    CHECK(found.bound->bound >= best);
    CHECK(found.bound->bound <= best + 0.05 + 1e-9);
  }
}

TEST_CASE("the best direction of a shell between cones is its axis, and this is proven in every pose") {
  const solids::FrustumShell cup{.segments = 24};
  const double f = solids::frustum_shell_f_max(cup);
  point_sets::Random random(4);
  Eigen::Matrix3d cyclic;
  cyclic << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  // The axis along z, x and y, and between them.
  for (const Eigen::Matrix3d& pose : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), cyclic,
                                      Eigen::Matrix3d(cyclic * cyclic), random.rotation()}) {
    Shape shape = solids::frustum_shell(cup);
    shape.vertices = shape.vertices * pose.transpose();
    const StackabilitySolver solver(shape);
    const Stackability axis = solver.measure(Direction(pose.col(2)));
    CHECK(axis.f_max == Approx(f));
    // From a poor start the bound finds the axis by itself.
    const BoundedStackability found =
        stackability_bound(solver, solver.measure(Direction(pose.col(0))), {.accuracy = 0.01});
    CHECK(found.bound.proven);
    CHECK(found.best.value == Approx(axis.value).margin(1e-6));
    CHECK(found.bound.bound >= axis.value);
    CHECK(found.bound.bound <= found.best.value + 0.01);
  }
}

TEST_CASE("no direction has an S above the bound, however early the work ends") {
  const std::vector<Shape> shapes = {
      solids::frustum_shell({.segments = 24}), solids::triangle_soup({.seed = 8, .count = 30}),
      solids::boxes_sharing_wall(),
      solids::tetrahedron({Eigen::Vector3d(0, 0, 0), {3, 0, 1}, {0, 1, 0}, {1, 1, 2}})};
  for (const Shape& shape : shapes)
    for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed}) {
      const StackabilitySolver solver(shape, {.semantics = semantics});
      const double sample = best_sample(solver, {{}, {}}, 2000);
      double before = 1;
      for (const std::int64_t cells : {1, 300, 1500}) {
        const DirectionBound bound =
            stackability_bound(solver, along(solver, 0, 0, 1), {.accuracy = 0.02, .max_cells = cells}).bound;
        CHECK(bound.bound >= sample);
        CHECK(bound.bound <= before);
        CHECK((bound.proven || bound.open > 0));
        before = bound.bound;
      }
    }
}

TEST_CASE("clearance counts in the bound as it does in S") {
  const StackabilitySolver touching(solids::frustum_shell({.segments = 24})),
      apart(touching.shape(), {.clearance = 0.5});
  const auto bound = [](const StackabilitySolver& solver) {
    return stackability_bound(solver, along(solver, 0, 0, 1), {.accuracy = 0.01});
  };
  const BoundedStackability found = bound(apart);
  CHECK(found.bound.proven);
  CHECK(found.bound.bound >= found.best.value);
  CHECK(found.bound.bound < bound(touching).best.value);
}

TEST_CASE("a bound over a cone or a plane holds there, and is no larger than that over the sphere") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 24}));
  const DirectionCone cone{{1, 0.2, 0.4}, 0.35};
  const Eigen::Vector3d normal(0.3, 1, 0.1);
  const double sphere = stackability_bound(solver, along(solver, 0, 0, 1), {.accuracy = 0.02}).bound.bound;
  struct Region {
    std::optional<DirectionCone> cone;
    std::optional<Eigen::Vector3d> plane;
  };
  for (const Region& part : {Region{cone, {}}, Region{{}, normal}}) {
    const DirectionRegion region(part.cone, part.plane);
    SearchOptions search;
    search.cone = part.cone;
    search.plane_normal = part.plane;
    const Stackability best = best_direction(solver, search).best;
    const BoundedStackability found = stackability_bound(
        solver, best, {.cone = part.cone, .plane_normal = part.plane, .accuracy = 0.02, .max_cells = 4000});
    CHECK(region.member(found.best.direction));
    CHECK(found.best.value >= best.value);
    CHECK(found.bound.bound >= best_sample(solver, region, 1000));
    CHECK(found.bound.bound <= sphere);
    CHECK(found.bound.proven);
  }
}

TEST_CASE("a cone much smaller than the cells at the start is not missed") {
  // Away from the middle of every cell.
  const Eigen::Matrix3d pose = frame_matrix(Direction(0.3, 0.5, 1));
  Shape shape = solids::frustum_shell({.segments = 24});
  shape.vertices = shape.vertices * pose.transpose();
  const StackabilitySolver solver(shape);
  const auto beside_axis = [&](double x, double y) -> Eigen::Vector3d {
    return pose * Eigen::Vector3d(x, y, 1);
  };
  const double best = solver.measure(Direction(beside_axis(0, 0))).value;
  const DirectionCone cone{beside_axis(0.02, 0.01), 0.03};
  const BoundedStackability found = stackability_bound(
      solver, solver.measure(Direction(beside_axis(0.04, 0.02))), {.cone = cone, .accuracy = 0.01});
  CHECK(found.bound.bound >= best);
  CHECK(found.best.value == Approx(best).margin(1e-6));
}

TEST_CASE("a bound is the same for any number of threads") {
  const StackabilitySolver solver(solids::triangle_soup({.seed = 8, .count = 30}));
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return stackability_bound(solver, along(solver, 0, 0, 1), {.accuracy = 0.05, .max_cells = 1000});
  };
  check_same(with_threads(1), with_threads(2));
}

TEST_CASE("a bound that is cancelled holds, and progress rises to the end") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 24}));
  int asked = 0;
  DirectionBoundOptions options{.accuracy = 0.01};
  options.cancelled = [&asked] { return ++asked > 2; };
  const BoundedStackability ended = stackability_bound(solver, along(solver, 0, 0, 1), options);
  CHECK(ended.bound.cancelled);
  CHECK(!ended.bound.proven);
  CHECK(ended.bound.bound >= ended.best.value);
  std::vector<double> fractions;
  options.cancelled = {};
  options.progress = [&](double fraction) { fractions.push_back(fraction); };
  CHECK(stackability_bound(solver, along(solver, 0, 0, 1), options).bound.proven);
  REQUIRE(!fractions.empty());
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK(fractions.front() >= 0);
  CHECK(fractions.back() == 1);
}

TEST_CASE("a search with a proof says the bound, and finds what a coarse search alone misses") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 24}));
  SearchOptions options{.cone = DirectionCone{{0, 0, 1}, 1.4}, .spacing = 1, .climbs = 1};
  options.certify = 0.02;
  const SearchResult found = best_direction(solver, options);
  REQUIRE(found.bound);
  CHECK(found.bound->proven);
  CHECK(found.bound->accuracy == 0.02);
  CHECK(found.best.value == found.optima.front().stackability);
  CHECK(found.bound->bound >= best_direction(solver).best.value);
  options.certify.reset();
  CHECK(!best_direction(solver, options).bound);
}

TEST_CASE("a bound refuses what it is not known for") {
  const Shape shape = solids::box({1, 2, 3});
  const StackabilitySolver solver(shape);
  const Stackability best = along(solver, 0, 0, 1);
  for (const double accuracy : {0.0, -1.0, 1.5, std::nan("")})
    CHECK_THROWS_AS(stackability_bound(solver, best, {.accuracy = accuracy}), UsageError);
  CHECK_THROWS_AS(stackability_bound(solver, best, {.max_cells = 0}), UsageError);
  CHECK_THROWS_AS(stackability_bound(solver.with_play(0.1), best), UsageError);
  CHECK_THROWS_AS(stackability_bound(StackabilitySolver(shape, {.boxes = BoxModel::frame}), best),
                  UsageError);
}
