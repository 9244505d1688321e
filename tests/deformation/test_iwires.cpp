#include "stackabilization/deformation/iwires_model.h"
#include "stackabilization/shape/errors.h"
#include "support/catch.h"
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

double difference(const Points& a, const Points& b) {
  return (a - b).rowwise().norm().maxCoeff();
}

}  // namespace

TEST_CASE("the wires of a box are twelve segments in three classes") {
  const IWiresModel model(solids::box({1, 2, 3}));
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
  const IWiresModel model(box);
  const int edge = wire_at(model, {0.5, 0, 0});
  const DeformationResult result = model.deformed({on_wire(edge, Move{{0.125, 0.25, -0.5}})});
  REQUIRE(!result.refusal);
  const Shape expected = solids::box({0.125, 0.25, -0.5}, {1.125, 2, 3});
  CHECK(difference(result.shape.vertices, expected.vertices) < 1e-12);
}

TEST_CASE("a scaled edge of a box stretches the box") {
  const Shape box = solids::box({1, 2, 3});
  const IWiresModel model(box);
  const DeformationResult result = model.deformed({on_wire(wire_at(model, {0.5, 0, 0}), Scale{1.5, {}})});
  REQUIRE(!result.refusal);
  CHECK(difference(result.shape.vertices, solids::box({-0.25, 0, 0}, {1.25, 2, 3}).vertices) < 1e-12);
}

TEST_CASE("a cylinder becomes a cone frustum when one circle is scaled") {
  const Shape cylinder = solids::cylinder(1, 2, 32);
  const IWiresModel model(cylinder);
  REQUIRE(model.wires().wires.size() == 2);
  const DeformationResult result = model.deformed({on_wire(wire_at(model, {0, 0, 2}), Scale{1.5, {}})});
  REQUIRE(!result.refusal);
  Points expected = cylinder.vertices;
  for (Eigen::Index v = 0; v < expected.rows(); ++v)
    if (expected(v, 2) > 1) expected.row(v).head<2>() *= 1.5;
  CHECK(difference(result.shape.vertices, expected) < 1e-12);
}

TEST_CASE("a smooth closed surface has no wire to hold on to") {
  CHECK_THROWS_AS(IWiresModel(solids::sphere(1, 3)), InputError);
}
