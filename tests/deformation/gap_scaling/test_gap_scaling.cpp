#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/gap_scaling.h"
#include "stackabilization/deformation/refine.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/io/read.h"
#include "support/catch.h"
#include "support/differences.h"
#include "support/directions.h"
#include "support/handles.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

Edit squash(double factor, const Eigen::Vector3d& along = {0, 0, 1}) {
  return {whole_shape, Scale{factor, along}};
}

Shape squashed(const Shape& shape, double factor, const Direction& direction = upwards) {
  const DeformationResult result =
      gap_scaling(unstructured(shape), direction)->deformed({squash(factor, direction.vector())});
  REQUIRE_FALSE(result.refusal);
  return result.design.shape;
}

double f_max(const Shape& shape, const Direction& direction = upwards) {
  return minimal_stacking_translation(shape, direction).length;
}

/// A slab between two rough surfaces over one n x n grid: both envelopes are linear over the same triangles.
Shape slab(int n, std::uint64_t seed) {
  solids::Random random(seed);
  const int top = (n + 1) * (n + 1);
  Points vertices(2 * top, 3);
  for (int k = 0; k < top; ++k) {
    const double z = random.uniform(), x = k % (n + 1), y = k / (n + 1);
    vertices.row(k) << x, y, z;
    vertices.row(top + k) << x, y, z + random.uniform(0.1, 2);
  }
  Triangles triangles(0, 3);
  const auto add = [&](int a, int b, int c) {
    triangles.conservativeResize(triangles.rows() + 1, 3);
    triangles.bottomRows(1) << a, b, c;
  };
  const auto wall = [&](int a, int b) { add(a, b, top + b), add(a, top + b, top + a); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
      add(a, d, b), add(a, c, d), add(top + a, top + b, top + d), add(top + a, top + d, top + c);
    }
  for (int k = 0; k < n; ++k) {
    wall(k, k + 1), wall(n * (n + 1) + k + 1, n * (n + 1) + k);
    wall((k + 1) * (n + 1), k * (n + 1)), wall(k * (n + 1) + n, (k + 1) * (n + 1) + n);
  }
  return make_shape(vertices, triangles);
}

}  // namespace

TEST_CASE("a squash that leaves nothing of upright sides is refused, whatever the size of the shape") {
  const Eigen::Matrix3d small = 1e-6 * Eigen::Matrix3d::Identity();
  for (const Shape& shape : {solids::box({1, 1, 1}), transformed(solids::box({1, 1, 1}), small, {0, 0, 0})}) {
    const auto model = gap_scaling(unstructured(shape), upwards);
    CHECK_FALSE(model->deformed({squash(0.002)}).refusal);
    const DeformationResult refused = model->deformed({squash(0.5), squash(0.0002)});
    REQUIRE(refused.refusal);
    CHECK(refused.refusal->cause == RefusalCause::collapsed_triangle);
    CHECK(refused.design.edits.size() == 1);
  }
}

TEST_CASE("gap scaling: f_max is scaled exactly where the vertices resolve the envelope") {
  for (const double factor : {0.25, 0.8, 1.5}) {
    CHECK(f_max(squashed(solids::box({1, 2, 3}), factor)) == Approx(3 * factor).epsilon(1e-14));
    CHECK(f_max(squashed(solids::table({}), factor)) == Approx(6 * factor).epsilon(1e-14));
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Shape shape = slab(6, seed);
      REQUIRE(solids::is_closed(shape));
      CHECK(f_max(squashed(shape, factor)) == Approx(factor * f_max(shape)).epsilon(1e-12));
    }
  }
}

TEST_CASE("gap scaling: the upper envelope stays, in any pose") {
  const Shape upright = slab(5, 9);
  const Shape expected = squashed(upright, 0.4);
  const bool stays = expected.vertices.bottomRows(36) == upright.vertices.bottomRows(36);
  CHECK(stays);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Eigen::Matrix3d turn = solids::random_rotation(seed);
    const Eigen::Vector3d by(20, -3, 7);
    const Direction direction(3 * turn * Eigen::Vector3d(0, 0, 1));
    const Shape now = squashed(transformed(upright, turn, by), 0.4, direction);
    CHECK(largest_difference(now.vertices, transformed(expected, turn, by).vertices) < 1e-10);
  }
}

TEST_CASE("gap scaling: columns along walls reach up to their ends") {
  // All walls are parallel to the direction, and rounded where the prism is turned: the map is affine.
  const Shape prism = solids::prism(solids::regular_polygon(7), 5);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Eigen::Matrix3d turn = solids::random_rotation(seed);
    const Shape turned = transformed(prism, turn, {1, 2, 3});
    const Direction direction(turn * Eigen::Vector3d(0, 0, 1));
    Shape expected = prism;
    expected.vertices.col(2) = 5 - 0.3 * (5 - prism.vertices.col(2).array());
    CHECK(largest_difference(squashed(turned, 0.3, direction).vertices,
                             transformed(expected, turn, {1, 2, 3}).vertices) < 1e-12);
  }
}

TEST_CASE("gap scaling: every vertex of a table goes where its column says") {
  const Shape table = solids::table({});  // from 0 to 6, top half a unit thick
  const Shape now = squashed(table, 0.5);
  for (Eigen::Index v = 0; v < table.vertex_count(); ++v)
    CHECK(now.vertices(v, 2) == 6 - 0.5 * (6 - table.vertices(v, 2)));
  CHECK(now.vertices.leftCols(2) == table.vertices.leftCols(2));
}

TEST_CASE("gap scaling: refined triangles follow the envelope below slopes, not below steps") {
  RefineOptions fine;
  fine.max_edge_length = 0.02;
  // The outer wall of a cup is one triangle high, the inner bottom above it has a corner half way.
  solids::FrustumShell options;
  options.segments = 16;
  const Shape cup = solids::frustum_shell(options), fine_cup = refine(cup, fine);
  const double wanted = 0.5 * solids::frustum_shell_f_max(options);
  CHECK(f_max(fine_cup) == Approx(2 * wanted).epsilon(1e-12));
  CHECK(f_max(squashed(cup, 0.5)) > 1.2 * wanted);
  CHECK(f_max(squashed(fine_cup, 0.5)) < 1.05 * wanted);
  CHECK(f_max(squashed(fine_cup, 0.5)) > wanted * (1 - 1e-9));

  // Beyond x = 1.3 no roof covers the plate, and no vertex of the plate is right there.
  const Shape roof = concatenate(solids::box({0, 0, 0}, {4, 1, 1}), solids::box({0, 0, 3}, {1.3, 1, 4}));
  CHECK(f_max(squashed(refine(roof, fine), 0.5)) > 1.2 * 0.5 * f_max(roof));
}

TEST_CASE("gap scaling: no edit, no change, and factors multiply") {
  const Shape shape = solids::frustum_shell({});
  const auto model = gap_scaling(unstructured(shape), upwards);
  CHECK(model->deformed({}).design.shape.vertices == shape.vertices);
  CHECK(model->deformed({squash(1)}).design.shape.vertices == shape.vertices);
  CHECK(largest_difference(model->deformed({squash(0.4), squash(2.5)}).design.shape.vertices,
                           shape.vertices) < 1e-14);
  CHECK(largest_difference(model->deformed({squash(0.4), squash(0.5, {0, 0, -7})}).design.shape.vertices,
                           model->deformed({squash(0.2)}).design.shape.vertices) < 1e-14);
  CHECK(model->handles() == std::vector<Handle>{whole_shape});
  CHECK((model->centre(model->handles()[0]) - Eigen::Vector3d(0, 0, 4)).norm() < 1e-14);
}

TEST_CASE("gap scaling: constraints") {
  const Shape table = solids::table({});
  const auto model = gap_scaling(unstructured(table), upwards);
  DeformationConstraints constraints;
  constraints.keep_extent = upwards;
  const DeformationResult kept = model->deformed({squash(0.5)}, constraints);
  REQUIRE_FALSE(kept.refusal);
  CHECK(largest_difference(kept.design.shape.vertices, table.vertices) < 1e-14);
  constraints = {};
  constraints.box_tolerance = 0.4;
  CHECK(model->deformed({squash(0.5)}, constraints).refusal);
  constraints.box_tolerance = 0.6;
  CHECK_FALSE(model->deformed({squash(0.5)}, constraints).refusal);
  constraints.fixed_points = {{4, 4, 6}};
  CHECK_FALSE(model->deformed({squash(0.5)}, constraints).refusal);
  constraints.fixed_points = {{4, 4, 5.5}};
  CHECK(model->deformed({squash(0.5)}, constraints).refusal);
  constraints = {};
  constraints.fixed_parts = {1};
  const DeformationResult refused = model->deformed({squash(0.5)}, constraints);
  CHECK(refused.refusal);
  CHECK(refused.design.shape.vertices == table.vertices);
  CHECK(model->deformed(std::vector<Edit>(11, squash(edit_limits::max_scale))).refusal);
}

TEST_CASE("gap scaling: what it cannot do is said") {
  const auto model = gap_scaling(unstructured(solids::box({1, 1, 1})), upwards);
  CHECK_THROWS_AS(model->deformed({{whole_shape, Move{}}}), UsageError);
  CHECK_THROWS_AS(model->deformed({{whole_shape, Rotate{}}}), UsageError);
  CHECK_THROWS_AS(model->deformed({{whole_shape, Scale{2, {}}}}), UsageError);
  CHECK_THROWS_AS(model->deformed({squash(2, {0, 0.1, 1})}), UsageError);
  CHECK_THROWS_AS(model->deformed({squash(-2)}), UsageError);
  CHECK_THROWS_AS(model->deformed({{{HandleKind::part, 0, 0}, Scale{2, Eigen::Vector3d(0, 0, 1)}}}),
                  UsageError);
  CHECK_THROWS_AS(model->centre({HandleKind::part, 0, 0}), UsageError);
  CHECK_THROWS_AS(gap_scaling(unstructured(Shape{}), upwards), InputError);
}

TEST_CASE("gap scaling: 1000 random edits keep the extent and give finite vertices") {
  for (const char* name : {"bottle", "chair", "crate", "bucket_with_handles"}) {
    const Shape shape = read_shape(STACKABILIZATION_SOURCE_DIR "/data/models/" + std::string(name) + ".obj");
    solids::Random random(5);
    double worst = 0;
    bool finite = true;
    int refusals = 0;
    for (int d = 0; d < 5; ++d) {
      const Direction direction(d == 0 ? Eigen::Vector3d(0, 0, 1) : random.on_sphere());
      const auto model = gap_scaling(unstructured(shape), direction);
      for (int k = 0; k < 50; ++k) {
        DeformationConstraints constraints;
        const Direction r(k % 2 ? direction.vector() : random.on_sphere());
        constraints.keep_extent = r;
        const DeformationResult result =
            model->deformed({squash(random.uniform(0.01, 4), direction.vector())}, constraints);
        // Where the envelope has a step, few directions tear a triangle apart until a side is nothing to the
        // others.
        if (result.refusal) CHECK(result.refusal->cause == RefusalCause::collapsed_triangle);
        refusals += result.refusal.has_value();
        finite = finite && result.design.shape.vertices.allFinite();
        const double h = range_along(shape, r.unit()).length();
        worst = std::max(worst, std::abs(range_along(result.design.shape, r.unit()).length() - h) / h);
      }
    }
    CHECK(finite);
    CHECK(refusals <= 10);
    CHECK(worst < 1e-9);
  }
}

TEST_CASE("refined: short edges, the same surface") {
  const Shape shape = read_shape(STACKABILIZATION_SOURCE_DIR "/data/models/table.obj");
  RefineOptions options;
  options.max_edge_length = 0.05;
  const Shape fine = refine(shape, options);
  const double diagonal = (shape.vertices.colwise().maxCoeff() - shape.vertices.colwise().minCoeff()).norm();
  double longest = 0;
  for (Eigen::Index t = 0; t < fine.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (fine.corner(t, k) - fine.corner(t, (k + 1) % 3)).norm());
  CHECK(longest <= 0.05 * diagonal);
  CHECK(fine.triangle_count() > shape.triangle_count());
  CHECK(fine.vertices.topRows(shape.vertex_count()) == shape.vertices);
  CHECK(fine.part_names == shape.part_names);
  for (Eigen::Index part = 0; part < shape.part_count(); ++part) {
    const Shape a = extract_part(shape, part), b = extract_part(fine, part);
    CHECK(solids::surface_area(b) == Approx(solids::surface_area(a)).epsilon(1e-12));
    CHECK(solids::signed_volume(b) == Approx(solids::signed_volume(a)).epsilon(1e-12));
  }
  CHECK(solids::is_closed(refine(solids::torus({}), {0.01, 1'000'000})));
  options.max_edge_length = 1;
  CHECK(refine(shape, options).triangles == shape.triangles);

  options.max_edge_length = 0;
  CHECK_THROWS_AS(refine(shape, options), UsageError);
  options = {1e-300, 100'000};
  CHECK_THROWS_AS(refine(shape, options), UsageError);
}
