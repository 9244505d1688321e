#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/iwires_model.h"
#include "support/catch.h"
#include "support/differences.h"
#include "support/handles.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

Edit on_wire(int wire, const Operation& operation) {
  return {{HandleKind::wire, 0, wire}, operation};
}

/// The wire of `model` whose centre is at `centre`.
int wire_at(const IWiresModel& model, const Eigen::Vector3d& centre) {
  const auto& wires = model.wires().wires;
  for (std::size_t k = 0; k < wires.size(); ++k)
    if ((wires[k].centre - centre).norm() < 1e-9) return static_cast<int>(k);
  FAIL("no wire at " << centre.transpose());
  return -1;
}

Symmetry mirror(const Eigen::Vector3d& point, const Eigen::Vector3d& axis) {
  return {SymmetryKind::reflection, point, axis, 2};
}

IWiresOptions with_symmetries(const std::vector<Symmetry>& symmetries) {
  IWiresOptions options;
  options.relations.symmetries = symmetries;
  return options;
}

/// A flat sheet [0, 1] x [0, 1] at z = 0 of n x n squares, each cut in two.
Shape sheet(int n) {
  Points vertices((n + 1) * (n + 1), 3);
  Triangles triangles(2 * n * n, 3);
  const auto row = [n](int i, int j) { return i * (n + 1) + j; };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      vertices.row(row(i, j)) << static_cast<double>(i) / n, static_cast<double>(j) / n, 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      triangles.row(2 * (i * n + j)) << row(i, j), row(i + 1, j), row(i + 1, j + 1);
      triangles.row(2 * (i * n + j) + 1) << row(i, j), row(i + 1, j + 1), row(i, j + 1);
    }
  return make_shape(vertices, triangles);
}

Eigen::Vector3d extents(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).transpose();
}

}  // namespace

TEST_CASE("the wires of a box are twelve segments in three classes") {
  const IWiresModel model(unstructured(solids::box({1, 2, 3})));
  const WireStructure& wires = model.wires();
  CHECK(wires.wires.size() == 12);
  REQUIRE(wires.parallel.size() == 3);
  for (const auto& parallel : wires.parallel) CHECK(parallel.size() == 4);
  CHECK(wires.orthogonal.size() == 3);
  CHECK(wires.congruent == wires.parallel);
  CHECK(wires.planes.size() == 6);
  CHECK(wires.junctions.size() == 8);
}

TEST_CASE("a box stays a box when an edge moves, with the opposite faces where they were") {
  const Shape box = solids::box({1, 2, 3});
  const IWiresModel model(unstructured(box));
  const int edge = wire_at(model, {0.5, 0, 0});
  const DeformationResult result = model.deformed({on_wire(edge, Move{{0.125, 0.25, -0.5}})});
  REQUIRE(!result.refusal);
  const Shape expected = solids::box({0.125, 0.25, -0.5}, {1.125, 2, 3});
  CHECK(largest_distance(result.design.shape.vertices, expected.vertices) < 1e-12);
}

TEST_CASE("a scaled edge of a box stretches the box") {
  const Shape box = solids::box({1, 2, 3});
  const IWiresModel model(unstructured(box));
  const DeformationResult result = model.deformed({on_wire(wire_at(model, {0.5, 0, 0}), Scale{1.5, {}})});
  REQUIRE(!result.refusal);
  CHECK(largest_distance(result.design.shape.vertices, solids::box({-0.25, 0, 0}, {1.25, 2, 3}).vertices) <
        1e-12);
}

TEST_CASE("a cylinder becomes a cone frustum when one circle is scaled") {
  const Shape cylinder = solids::cylinder(1, 2, 32);
  const IWiresModel model(unstructured(cylinder));
  REQUIRE(model.wires().wires.size() == 2);
  const DeformationResult result = model.deformed({on_wire(wire_at(model, {0, 0, 2}), Scale{1.5, {}})});
  REQUIRE(!result.refusal);
  Points expected = cylinder.vertices;
  for (Eigen::Index v = 0; v < expected.rows(); ++v)
    if (expected(v, 2) > 1) expected.row(v).head<2>() *= 1.5;
  CHECK(largest_distance(result.design.shape.vertices, expected) < 1e-12);
}

TEST_CASE("a smooth closed surface has no wire to hold on to") {
  CHECK_THROWS_AS(IWiresModel(unstructured(solids::sphere(1, 3))), InputError);
}

TEST_CASE("the surface of a cylinder follows a scaled circle in straight lines") {
  // Rings at heights 0.3 and 1.2 between the circles, none in the caps.
  const Shape cylinder =
      solids::surface_of_revolution({{0, 0}, {1, 0}, {1, 0.3}, {1, 1.2}, {1, 2}, {0, 2}}, 24);
  const IWiresModel model(unstructured(cylinder));
  REQUIRE(model.wires().wires.size() == 2);
  const DeformationResult result = model.deformed({on_wire(wire_at(model, {0, 0, 2}), Scale{0.5, {}})});
  REQUIRE(!result.refusal);
  Points expected = cylinder.vertices;
  for (Eigen::Index v = 0; v < expected.rows(); ++v) expected.row(v).head<2>() *= 1 - expected(v, 2) / 4;
  CHECK(largest_distance(result.design.shape.vertices, expected) < 1e-12);
}

TEST_CASE("a rotated edge takes its parallels along and makes the box a parallelepiped") {
  const Shape box = solids::box({1, 2, 3});
  const IWiresModel model(unstructured(box));
  const double angle = 0.25;
  const DeformationResult result =
      model.deformed({on_wire(wire_at(model, {0.5, 0, 0}), Rotate{{0, 0, 1}, angle})});
  REQUIRE(!result.refusal);
  Points expected = box.vertices;
  for (Eigen::Index v = 0; v < expected.rows(); ++v) {
    const double along = expected(v, 0) - 0.5;
    expected(v, 0) = 0.5 + along * std::cos(angle);
    expected(v, 1) += along * std::sin(angle);
  }
  CHECK(largest_distance(result.design.shape.vertices, expected) < 1e-12);
}

TEST_CASE("no edit and edits that change nothing leave every vertex") {
  const Shape table = solids::table({});
  const IWiresModel model(unstructured(table));
  CHECK(model.deformed({}).design.shape.vertices == table.vertices);
  for (std::size_t k = 0; k < model.wires().wires.size(); ++k)
    for (const Operation& nothing :
         {Operation(Move{}), Operation(Rotate{{1, 2, 3}, 0}), Operation(Scale{1, {}})}) {
      const DeformationResult result = model.deformed({on_wire(static_cast<int>(k), nothing)});
      REQUIRE(!result.refusal);
      CHECK(largest_distance(result.design.shape.vertices, table.vertices) < 1e-12);
    }
}

TEST_CASE("an edit of the whole shape is an affine map") {
  const Shape table = solids::table({});
  const IWiresModel model(unstructured(table));
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -1).normalized();
  const DeformationResult result = model.deformed({{whole_shape, Move{{1, 2, 3}}},
                                                   {whole_shape, Rotate{axis, 0.5}},
                                                   {whole_shape, Scale{1.25, Eigen::Vector3d(0, 0, 2)}}});
  REQUIRE(!result.refusal);
  const Eigen::Vector3d centre = model.centre(whole_shape), moved = centre + Eigen::Vector3d(1, 2, 3);
  Eigen::Matrix3d linear = Eigen::AngleAxisd(0.5, axis).toRotationMatrix();
  linear.row(2) *= 1.25;
  const Points expected =
      ((table.vertices.rowwise() - centre.transpose()) * linear.transpose()).rowwise() + moved.transpose();
  CHECK(largest_distance(result.design.shape.vertices, expected) < 1e-12);
}

TEST_CASE("mirror images follow, and the box is stretched both ways") {
  const Shape box = solids::box({-1, -2, -3}, {1, 2, 3});
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  const IWiresModel model(unstructured(box), with_symmetries({mirror(origin, Eigen::Vector3d::UnitX()),
                                                              mirror(origin, Eigen::Vector3d::UnitY()),
                                                              mirror(origin, Eigen::Vector3d::UnitZ())}));
  CHECK(model.wires().symmetric.size() == 36);
  const int edge = wire_at(model, {0, 2, 3});
  const DeformationResult result = model.deformed({on_wire(edge, Move{{0, 0.5, -1}})});
  REQUIRE(!result.refusal);
  CHECK(largest_distance(result.design.shape.vertices, solids::box({-1, -2.5, -2}, {1, 2.5, 2}).vertices) <
        1e-12);
  for (const double residual : wire_symmetry_residuals(box, model.wires(), result.design.shape.vertices))
    CHECK(residual < 1e-12);
  // Its own image under x: it cannot move along x.
  const DeformationResult refused = model.deformed({on_wire(edge, Move{{0.5, 0, 0}})});
  REQUIRE(refused.refusal);
  CHECK(refused.refusal->amount > 1e-2);
  CHECK(refused.refusal->cause == RefusalCause::wire_image);
  CHECK(refused.design.shape.vertices == box.vertices);
}

TEST_CASE("a sheet stretches evenly and stays flat") {
  const Shape flat = sheet(8);
  const IWiresModel model(unstructured(flat));
  REQUIRE(model.wires().wires.size() == 4);
  const DeformationResult result = model.deformed({on_wire(wire_at(model, {1, 0.5, 0}), Move{{0.5, 0, 0}})});
  REQUIRE(!result.refusal);
  Points expected = flat.vertices;
  expected.col(0) *= 1.5;
  CHECK(largest_distance(result.design.shape.vertices, expected) < 1e-12);
}

TEST_CASE("vertices of equal coordinates stay together, and separate parts stay where they are") {
  const Shape near = solids::box({1, 2, 3});
  const Shape both = concatenate(concatenate(near, near), solids::box({10, 11, 12}, {11.3, 13.4, 15.5}));
  const IWiresModel model(unstructured(both));
  const DeformationResult result =
      model.deformed({on_wire(wire_at(model, {0.5, 0, 0}), Move{{0, 0.5, 0.25}})});
  REQUIRE(!result.refusal);
  const Points expected = solids::box({0, 0.5, 0.25}, {1, 2, 3}).vertices;
  const Eigen::Index n = near.vertex_count();
  CHECK(largest_distance(result.design.shape.vertices.topRows(n), expected) < 1e-12);
  CHECK(result.design.shape.vertices.topRows(n) == result.design.shape.vertices.middleRows(n, n));
  CHECK(largest_distance(result.design.shape.vertices.bottomRows(n), both.vertices.bottomRows(n)) < 1e-12);
}

TEST_CASE("a piece without wires follows its nearest wire") {
  Shape ball = solids::sphere(0.25, 2);
  ball.vertices.rowwise() += Eigen::RowVector3d(0.5, -0.5, 0);
  const Shape box = solids::box({1, 2, 3});
  const IWiresModel model(unstructured(concatenate(box, ball)));
  CHECK(model.wires().wires.size() == 12);
  const Eigen::RowVector3d by(0.5, 0, 0);
  const DeformationResult result =
      model.deformed({on_wire(wire_at(model, {0.5, 0, 0}), Move{by.transpose()})});
  REQUIRE(!result.refusal);
  CHECK(largest_distance(result.design.shape.vertices.bottomRows(ball.vertex_count()),
                         ball.vertices.rowwise() + by) < 1e-12);
}

TEST_CASE("results move with the shape") {
  const Shape table = solids::table({});
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d by(5, -3, 2);
  const IWiresModel here(unstructured(table)), there(unstructured(transformed(table, turn, by)));
  REQUIRE(here.wires().wires.size() == there.wires().wires.size());
  for (int k = 0; k < static_cast<int>(here.wires().wires.size()); k += 7) {
    const DeformationResult a = here.deformed({on_wire(k, Move{{0.1, -0.2, 0.05}})});
    const DeformationResult b = there.deformed({on_wire(k, Move{turn * Eigen::Vector3d(0.1, -0.2, 0.05)})});
    REQUIRE(!a.refusal);
    REQUIRE(!b.refusal);
    CHECK(largest_distance(transformed(a.design.shape, turn, by).vertices, b.design.shape.vertices) < 1e-9);
  }
}

TEST_CASE("edits are made one after the other") {
  const IWiresModel model(unstructured(solids::box({1, 2, 3})));
  const int edge = wire_at(model, {0.5, 0, 0});
  const DeformationResult result = model.deformed({on_wire(edge, Move{{0, 0.5, 0}}),
                                                   {whole_shape, Scale{2, {}}},
                                                   on_wire(edge, Move{{0, 0, 1}}),
                                                   on_wire(edge, Scale{1.5, {}})});
  REQUIRE(!result.refusal);
  // The shape is scaled about its centre at rest, carried along: (0.5, 1, 1.5).
  const Shape expected = solids::box({-1, 0, -0.5}, {2, 3, 4.5});
  CHECK(largest_distance(result.design.shape.vertices, expected.vertices) < 1e-12);
}

TEST_CASE("what is fixed stays, or the edit is refused") {
  const Shape table = solids::table({});
  const IWiresModel model(unstructured(table));
  DeformationConstraints constraints;
  constraints.fixed_parts = {0};
  int made = 0, refused = 0;
  for (int k = 0; k < static_cast<int>(model.wires().wires.size()); ++k) {
    const DeformationResult result = model.deformed({on_wire(k, Move{{0, 0, -0.5}})}, constraints);
    ++(result.refusal ? refused : made);
    if (result.refusal) continue;
    CHECK(largest_distance(extract_part(result.design.shape, 0).vertices, extract_part(table, 0).vertices) ==
          0);
  }
  CHECK(made > 0);
  CHECK(refused >= 12);
}

TEST_CASE("an edge that would pass its opposite is refused") {
  const Shape box = solids::box({1, 2, 3});
  const IWiresModel model(unstructured(box));
  DeformationConstraints constraints;
  constraints.fixed_points = {{0.5, 2, 3}};
  const int edge = wire_at(model, {0.5, 0, 0});
  CHECK(!model.deformed({on_wire(edge, Move{{0, 1.5, 0}})}, constraints).refusal);
  CHECK(model.deformed({on_wire(edge, Move{{0, 2.5, 0}})}, constraints).refusal);
}

TEST_CASE("random edits give finite shapes that keep what is asked, or refusals") {
  const Shape table = solids::table({});
  const Eigen::Vector3d middle =
      (table.vertices.colwise().maxCoeff() + table.vertices.colwise().minCoeff()) / 2;
  const IWiresModel model(unstructured(table), with_symmetries({mirror(middle, Eigen::Vector3d::UnitX()),
                                                                mirror(middle, Eigen::Vector3d::UnitY())}));
  CHECK(model.wires().symmetric.size() == 2 * model.wires().wires.size());
  std::mt19937 random(7);
  const auto number = [&](double scale) { return scale * (random() / 4294967296.0 * 2 - 1); };
  const double diagonal = extents(table.vertices).norm();
  int made = 0;
  for (int i = 0; i < 500; ++i) {
    const int wire = static_cast<int>(random() % model.wires().wires.size());
    Operation operation = Move{{number(1), number(1), number(1)}};
    if (i % 3 == 1) operation = Scale{std::exp(number(0.5)), {}};
    if (i % 3 == 2) operation = Rotate{{number(1), number(1), number(1) + 0.1}, number(0.5)};
    DeformationConstraints constraints;
    if (i % 2 == 0) constraints.keep_extent = Direction(0, 0, 1);
    if (i % 5 == 0) constraints.box_tolerance = 0.1;
    const DeformationResult result = model.deformed({on_wire(wire, operation)}, constraints);
    REQUIRE(result.design.shape.vertices.allFinite());
    if (result.refusal) {
      CHECK(result.refusal->amount > 0);
      CHECK(result.design.shape.vertices == table.vertices);
      continue;
    }
    ++made;
    for (const double residual : wire_symmetry_residuals(table, model.wires(), result.design.shape.vertices))
      REQUIRE(residual <= 1e-6 * diagonal);
    const Eigen::Vector3d before = extents(table.vertices), after = extents(result.design.shape.vertices);
    if (constraints.keep_extent) CHECK(after.z() == Approx(before.z()).epsilon(1e-9));
    if (constraints.box_tolerance)
      CHECK(((after - before).cwiseAbs().array() <= 0.1001 * before.array()).all());
  }
  CHECK(made > 100);
}

TEST_CASE("handles and misuse") {
  const IWiresModel model(unstructured(solids::box({1, 2, 3})));
  CHECK(model.handles().size() == 13);
  for (const Handle& handle : model.handles()) CHECK(model.centre(handle).allFinite());
  CHECK_THROWS_AS(model.centre({HandleKind::wire, 0, 12}), UsageError);
  CHECK_THROWS_AS(model.centre({HandleKind::part, 0, 0}), UsageError);
  CHECK_THROWS_AS(model.deformed({on_wire(-1, Move{})}), UsageError);
  CHECK_THROWS_AS(model.deformed({on_wire(0, Scale{2, Eigen::Vector3d(1, 0, 0)})}), UsageError);
  CHECK_THROWS_AS(model.deformed({on_wire(0, Scale{-1, {}})}), UsageError);
  IWiresOptions options;
  options.link_distance = -1;
  CHECK_THROWS_AS(IWiresModel(unstructured(solids::box({1, 1, 1})), options), UsageError);
}
