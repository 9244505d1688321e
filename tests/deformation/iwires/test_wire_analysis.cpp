#include <algorithm>
#include <cmath>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/wire_analysis.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

/// How many wires have a form.
long count(const WireStructure& wires, WireForm form) {
  return std::count_if(wires.wires.begin(), wires.wires.end(), [&](const Wire& w) { return w.form == form; });
}

/// Counter-clockwise rectangle with corners rounded by arcs of eight segments.
solids::Polygon rounded_rectangle(double width, double depth, double radius) {
  solids::Polygon polygon;
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector2d centre((corner == 1 || corner == 2 ? -1 : 1) * (width / 2 - radius),
                                 (corner >= 2 ? -1 : 1) * (depth / 2 - radius));
    for (int k = 0; k <= 8; ++k)
      polygon.push_back(centre + radius * solids::circle_point((8 * corner + k) % 32, 32));
  }
  return polygon;
}

}  // namespace

TEST_CASE("creases are edges that turn by more than the angle") {
  FeatureCurveOptions options;
  const Shape octagon = solids::prism(solids::regular_polygon(8), 1);
  options.crease_angle = 44;
  CHECK(feature_curves(octagon, options).size() == 24);
  options.crease_angle = 46;
  const std::vector<FeatureCurve> rims = feature_curves(octagon, options);
  REQUIRE(rims.size() == 2);
  for (const FeatureCurve& rim : rims) {
    CHECK(rim.closed);
    CHECK(rim.vertices.size() == 8);
  }
}

TEST_CASE("boundaries and edges of many triangles are feature curves, whichever way triangles are turned") {
  // Three squares on one hinge, the last one turned around.
  Points vertices(8, 3);
  vertices << 0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1, -1, 0.5, 0, -1, 0.5, 1, -1, -0.5, 0, -1, -0.5, 1;
  Triangles triangles(6, 3);
  triangles << 0, 2, 3, 0, 3, 1, 0, 4, 5, 0, 5, 1, 0, 7, 6, 0, 1, 7;
  const std::vector<FeatureCurve> curves = feature_curves(make_shape(vertices, triangles));
  CHECK(curves.size() == 10);
  // A flat pair of triangles that disagree about their side has its outline only.
  CHECK(feature_curves(make_shape(vertices.topRows(4), (Triangles(2, 3) << 0, 2, 3, 0, 1, 3).finished()))
            .size() == 4);
}

TEST_CASE("a rounded rectangle has four sides and four quarter circles") {
  const Shape slab = solids::prism(rounded_rectangle(4, 2, 0.25), 0.5);
  const WireStructure wires = analysed_wires(slab, feature_curves(slab));
  CHECK(wires.wires.size() == 16);
  CHECK(count(wires, WireForm::straight) == 8);
  CHECK(count(wires, WireForm::circular) == 8);
  for (const Wire& wire : wires.wires)
    if (wire.form == WireForm::circular) {
      CHECK(wire.radius == Approx(0.25));
      CHECK(std::abs(wire.centre.x()) == Approx(1.75));
    }
  CHECK(wires.parallel.size() == 2);
  CHECK(wires.planes.size() == 2);
  CHECK(wires.junctions.size() == 16);
  CHECK(wires.congruent.size() == 3);
}

TEST_CASE("circles are found with centre, axis and radius") {
  const Shape cone = solids::surface_of_revolution({{0, 0}, {2, 0}, {1, 3}, {0, 3}}, 20);
  const WireStructure wires = analysed_wires(cone, feature_curves(cone));
  REQUIRE(wires.wires.size() == 2);
  for (const Wire& wire : wires.wires) {
    CHECK(wire.form == WireForm::circular);
    CHECK(wire.radius == Approx(wire.centre.z() > 1 ? 1 : 2));
    CHECK(std::abs(wire.axis.z()) == Approx(1));
    CHECK(wire.length == Approx(40 * wire.radius * std::sin(std::numbers::pi / 20)));
  }
  CHECK(wires.congruent.empty());
}

TEST_CASE("symmetric wires are found, and none where there are none") {
  const Shape box = solids::box({-1, -1, -1}, {1, 2, 3});
  WireAnalysisOptions options;
  options.symmetries = {{SymmetryKind::reflection, {0, 0, 0}, {1, 0, 0}, 2},
                        {SymmetryKind::reflection, {0, 0, 0}, {0, 1, 0}, 2},
                        {SymmetryKind::rotation, {0, 0.5, 1}, {1, 0, 0}, 2}};
  const WireStructure wires = analysed_wires(box, feature_curves(box), options);
  std::vector<int> found(3, 0);
  for (const WireSymmetry& pair : wires.symmetric) ++found[static_cast<std::size_t>(pair.symmetry)];
  CHECK(found == std::vector<int>{12, 0, 12});
}

TEST_CASE("small networks of creases are dropped") {
  const Shape both = concatenate(solids::box({1, 1, 1}), solids::box({3, 3, 3}, {3.01, 3.01, 3.01}));
  CHECK(feature_curves(both).size() == 12);
  FeatureCurveOptions options;
  options.smallest_length = 1e-3;
  CHECK(feature_curves(both, options).size() == 24);
}

TEST_CASE("options out of range are refused") {
  const Shape box = solids::box({1, 1, 1});
  FeatureCurveOptions curves;
  curves.crease_angle = -1;
  CHECK_THROWS_AS(feature_curves(box, curves), UsageError);
  WireAnalysisOptions relations;
  relations.angle_tolerance = NAN;
  CHECK_THROWS_AS(analysed_wires(box, {}, relations), UsageError);
}
