#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "deformation/model/vertex_constraints.h"
#include "mesh/surface_index.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/surface_model.h"
#include "stackabilization/io/read.h"
#include "support/catch.h"
#include "support/differences.h"
#include "support/handles.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

Shape model(const std::string& name) {
  return read_shape(STACKABILIZATION_SOURCE_DIR "/data/models/" + name + ".obj");
}

template <class Value>
SurfaceModelOptions with(Value SurfaceModelOptions::*option, Value value) {
  SurfaceModelOptions options;
  options.*option = std::move(value);
  return options;
}

double diagonal(const Shape& shape) {
  return (shape.vertices.colwise().maxCoeff() - shape.vertices.colwise().minCoeff()).norm();
}

/// Rings at the heights 0, 0.75, ..., 6, of which each is alone in a slice of 0.25: slices 0, 3, ..., 21, 23.
Shape tube() {
  return solids::subdivided(solids::subdivided(solids::subdivided(solids::cylinder(1, 6, 12))));
}

/// Vertices that did not move, to the bit.
int unmoved(const Shape& rest, const Shape& now) {
  int count = 0;
  for (Eigen::Index v = 0; v < rest.vertex_count(); ++v) count += rest.vertices.row(v) == now.vertices.row(v);
  return count;
}

Shape deformed(const DeformationModel& model, const std::vector<Edit>& edits,
               const DeformationConstraints& constraints = {}) {
  const DeformationResult result = model.deformed(edits, constraints);
  REQUIRE_FALSE(result.refusal);
  return result.design.shape;
}

std::vector<int> vertices_between(const Shape& shape, double low, double high) {
  std::vector<int> rows;
  for (int v = 0; v < shape.vertex_count(); ++v)
    if (shape.vertices(v, 2) >= low && shape.vertices(v, 2) <= high) rows.push_back(v);
  return rows;
}

}  // namespace

TEST_CASE("surface: edits that change nothing leave every vertex to the bit") {
  const Shape shape = model("bottle");
  const auto surface = surface_model(unstructured(shape));
  CHECK(deformed(*surface, {}).vertices == shape.vertices);
  const Handle ring{HandleKind::section, 0, 0}, point{HandleKind::point, 0, 100},
      part{HandleKind::part, 1, 0};
  for (const Handle& handle : {whole_shape, ring, point, part}) {
    CHECK(deformed(*surface, {{handle, Move{}}}).vertices == shape.vertices);
    CHECK(deformed(*surface, {{handle, Rotate{}}}).vertices == shape.vertices);
    CHECK(deformed(*surface, {{handle, Scale{}}}).vertices == shape.vertices);
    const std::vector<Edit> there_and_back{{handle, Scale{0.8, {}}}, {handle, Scale{1.25, {}}}};
    CHECK(largest_difference(deformed(*surface, there_and_back).vertices, shape.vertices) <
          1e-12 * diagonal(shape));
  }
}

TEST_CASE("surface: the whole shape is moved, turned and scaled exactly") {
  const Shape shape = tube();
  const auto surface = surface_model(unstructured(shape));
  const Eigen::Vector3d centre = surface->centre(whole_shape);
  CHECK((centre - Eigen::Vector3d(0, 0, 3)).norm() < 1e-12);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Eigen::Vector3d by(0.3, -4, 2);
  const Shape now = deformed(
      *surface,
      {{whole_shape, Rotate{{1, 2, -1}, 0.7}}, {whole_shape, Move{by}}, {whole_shape, Scale{2, {}}}});
  const Points expected = (2 * (shape.vertices.rowwise() - centre.transpose()) * turn.transpose()).rowwise() +
                          (centre + by).transpose();
  CHECK(largest_difference(now.vertices, expected) < 1e-13);
  const Shape tall = deformed(*surface, {{whole_shape, Scale{3, Eigen::Vector3d(0, 0, -2)}}});
  CHECK(tall.vertices.leftCols(2) == shape.vertices.leftCols(2));
  CHECK(range_along(tall, {0, 0, 1}).length() == Approx(18).epsilon(1e-14));
}

TEST_CASE("surface: where nothing stays, a handle takes everything with it rigidly") {
  SurfaceModelOptions options;
  options.influence = std::numeric_limits<double>::infinity();
  options.handle_radius = 0.1;
  const Shape shape = tube();
  const auto surface = surface_model(unstructured(shape), options);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2.5, Eigen::Vector3d(0, 3, 1).normalized()).toRotationMatrix();
  for (const Handle& handle : {Handle{HandleKind::point, 0, 17}, Handle{HandleKind::section, 0, 6}}) {
    const Eigen::Vector3d centre = surface->centre(handle), by(5, 1, 1);
    const Points expected = ((shape.vertices.rowwise() - centre.transpose()) * turn.transpose()).rowwise() +
                            (centre + by).transpose();
    const Shape now = deformed(*surface, {{handle, Move{by}}, {handle, Rotate{{0, 3, 1}, 2.5}}});
    CHECK(largest_difference(now.vertices, expected) < 1e-11);
  }
}

TEST_CASE("surface: edits of the whole and of handles commute where they should") {
  const Shape shape = tube();
  const auto surface = surface_model(unstructured(shape));
  const Handle ring{HandleKind::section, 0, 3}, point{HandleKind::point, 0, 200};
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.9, Eigen::Vector3d(2, 0, 1).normalized()).toRotationMatrix();
  const Eigen::Vector3d centre = surface->centre(whole_shape), by(1, 2, 3);
  const std::vector<Edit> bend{{ring, Scale{1.3, {}}}, {point, Move{{0.2, 0, 0.1}}}};
  const Shape bent = deformed(*surface, bend);
  // About the centre of what it has become, so turn first.
  const Edit rotate{whole_shape, Rotate{{2, 0, 1}, 0.9}}, move{whole_shape, Move{by}},
      grow{whole_shape, Scale{2, {}}};
  const Shape now = deformed(
      *surface,
      {rotate, move, grow, {ring, Scale{1.3, {}}}, {point, Move{2 * turn * Eigen::Vector3d(0.2, 0, 0.1)}}});
  const Points expected = (2 * (bent.vertices.rowwise() - centre.transpose()) * turn.transpose()).rowwise() +
                          (centre + by).transpose();
  CHECK(largest_difference(now.vertices, expected) < 1e-11);
}

TEST_CASE("surface: a handle that comes back to a fixed place keeps it") {
  const Shape shape = tube();
  DeformationConstraints constraints;
  constraints.fixed_points = {{1, 0, 0}};
  constraints.keep_extent = Direction(0, 0, 1);
  const Handle ring{HandleKind::section, 0, 0}, other{HandleKind::section, 0, 23};
  const auto surface = surface_model(unstructured(shape));
  const Edit away{ring, Move{{0, 0, -1}}}, back{ring, Move{{0, 0, 1}}};
  CHECK(surface->deformed({away}, constraints).refusal);
  const Design without = surface->deformed({away, {other, Move{{0, 0, 2}}}}).design;
  const Shape now = surface->edited(without, back, constraints).design.shape;
  const double h = range_along(now, {0, 0, 1}).length();
  CHECK(h == Approx(6).epsilon(1e-12));
  for (const std::int32_t v : fixed_vertices(shape, constraints))
    CHECK(now.vertices.row(v) == shape.vertices.row(v));
}

TEST_CASE("surface: beyond the influence nothing moves, to the bit") {
  const Shape shape = tube();
  SurfaceModelOptions options;
  options.influence = 0.25;
  const auto surface = surface_model(unstructured(shape), options);
  const double reach = 0.25 * diagonal(shape);
  const Shape now = deformed(*surface, {{{HandleKind::section, 0, 0}, Scale{0.5, {}}}});
  for (const int v : vertices_between(shape, 1.001 * reach, 7))
    CHECK(now.vertices.row(v) == shape.vertices.row(v));
  // The slice itself is scaled across the axis.
  for (const int v : vertices_between(shape, -1, 0)) {
    CHECK((now.vertices.row(v).head(2) - 0.5 * shape.vertices.row(v).head(2)).norm() < 1e-13);
    CHECK(now.vertices(v, 2) == Approx(0).margin(1e-13));
  }
  // Between both, radii change in between.
  for (const int v : vertices_between(shape, 0.5, 1)) {
    const double before = shape.vertices.row(v).head(2).norm(), after = now.vertices.row(v).head(2).norm();
    if (before < 0.9) continue;  // cap
    CHECK(after < before);
    CHECK(after > 0.5 * before);
  }
}

TEST_CASE("surface: a thick slice is scaled across the axis only, also when it has been turned") {
  const Shape shape = tube();
  const auto surface =
      surface_model(unstructured(shape), with(&SurfaceModelOptions::sections, 4));  // the first one below 1.5
  const Handle slice{HandleKind::section, 0, 0};
  const Shape wide = deformed(*surface, {{slice, Scale{1.5, {}}}});
  for (const int v : vertices_between(shape, 0, 1)) {
    CHECK((wide.vertices.row(v).head(2) - 1.5 * shape.vertices.row(v).head(2)).norm() < 1e-12);
    CHECK(wide.vertices(v, 2) == Approx(shape.vertices(v, 2)).margin(1e-12));
  }
  const Edit turn{slice, Rotate{{1, 0, 0}, 0.6}}, back{slice, Rotate{{1, 0, 0}, -0.6}};
  CHECK(largest_difference(deformed(*surface, {turn, {slice, Scale{1.5, {}}}, back}).vertices,
                           wide.vertices) < 1e-12);
}

TEST_CASE("surface: a symmetric edit gives a symmetric shape") {
  // cylinder(…, 12) is its own image under a turn by 30 degrees.
  const Shape shape = tube();
  const Shape now =
      deformed(*surface_model(unstructured(shape)), {{{HandleKind::section, 0, 3}, Scale{1.4, {}}}});
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(std::numbers::pi / 6, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  double worst = 0;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v) {
    Eigen::Index image;
    const Eigen::RowVector3d turned = shape.vertices.row(v) * turn.transpose();
    (shape.vertices.rowwise() - turned).rowwise().norm().minCoeff(&image);
    worst = std::max(worst, (now.vertices.row(image) - now.vertices.row(v) * turn.transpose()).norm());
  }
  CHECK(worst < 1e-9);
}

TEST_CASE("surface: equal vertices stay equal, sheets that meet in an edge do not crack") {
  // Three sheets around one edge, every triangle with corners of its own: 9 vertices per place at most.
  Points points(12, 3);
  Triangles triangles(0, 3);
  Points soup(0, 3);
  for (int sheet = 0; sheet < 3; ++sheet) {
    const double angle = 2 * std::numbers::pi * sheet / 3;
    const Eigen::RowVector3d out(std::cos(angle), std::sin(angle), 0), up(0, 0, 0.25);
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 4; ++j) {
        const Eigen::RowVector3d a = i * up + 0.25 * j * out, b = i * up + 0.25 * (j + 1) * out;
        const Eigen::RowVector3d c = (i + 1) * up + 0.25 * (j + 1) * out, d = (i + 1) * up + 0.25 * j * out;
        const Eigen::Index row = soup.rows();
        soup.conservativeResize(row + 6, 3);
        soup.bottomRows(6) << a, b, c, a, c, d;
        triangles.conservativeResize(triangles.rows() + 2, 3);
        for (int k = 0; k < 6; ++k)
          triangles(triangles.rows() - 2 + k / 3, k % 3) = static_cast<int>(row) + k;
      }
  }
  const Shape shape = make_shape(soup, triangles);
  const auto surface = surface_model(unstructured(shape));
  solids::Random random(3);
  for (int k = 0; k < 20; ++k) {
    const int vertex = static_cast<int>(random.below(static_cast<std::uint64_t>(soup.rows())));
    const Shape now = deformed(*surface, {{{HandleKind::point, 0, vertex}, Move{0.3 * random.in_cube()}},
                                          {{HandleKind::section, 0, 21}, Rotate{{1, 1, 0}, 0.3}}});
    CHECK(unmoved(shape, now) < soup.rows());
    bool together = true;
    for (Eigen::Index a = 0; a < soup.rows(); ++a)
      for (Eigen::Index b = 0; b < a; ++b)
        if (soup.row(a) == soup.row(b)) together = together && now.vertices.row(a) == now.vertices.row(b);
    CHECK(together);
  }
}

namespace {

struct WithKnob {
  Shape rest, now;
  Eigen::Index first;  ///< vertex of the knob
};

/// A box just beside the tube, which is widened and turned there.
WithKnob with_knob(double reach) {
  const Shape body = tube(), knob = solids::subdivided(solids::box({1.05, -0.1, 0.1}, {1.25, 0.1, 0.3}));
  const Shape shape = concatenate(body, knob);
  const Handle ring{HandleKind::section, 0, 3};
  const auto surface = surface_model(unstructured(shape), with(&SurfaceModelOptions::reach, reach));
  return {shape, deformed(*surface, {{ring, Scale{1.5, {}}}, {ring, Rotate{{0, 1, 0}, 0.2}}}),
          body.vertex_count()};
}

/// Largest change of a distance between two vertices of the knob.
double strain(const WithKnob& knob) {
  double change = 0;
  for (Eigen::Index a = knob.first; a < knob.rest.vertex_count(); ++a)
    for (Eigen::Index b = knob.first; b < a; ++b)
      change = std::max(change, std::abs((knob.now.vertices.row(a) - knob.now.vertices.row(b)).norm() -
                                         (knob.rest.vertices.row(a) - knob.rest.vertices.row(b)).norm()));
  return change;
}

double gap(const Shape& shape) {
  const SurfaceIndex body(extract_part(shape, 0));
  const Points knob = extract_part(shape, 1).vertices;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index v = 0; v < knob.rows(); ++v)
    least = std::min(least, body.nearest(knob.row(v).transpose()).distance);
  return least;
}

}  // namespace

TEST_CASE("surface: a shell without handle or anchor follows the nearest one rigidly") {
  const WithKnob knob = with_knob(0);
  CHECK(strain(knob) < 1e-14);
  CHECK((knob.now.vertices - knob.rest.vertices).bottomRows(8).rowwise().norm().minCoeff() > 0.1);
  CHECK(gap(knob.now) == Approx(gap(knob.rest)).margin(0.03));
}

TEST_CASE("surface: shells that nearly touch deform together") {
  const WithKnob knob = with_knob(0.01);
  CHECK((knob.now.vertices - knob.rest.vertices).bottomRows(8).rowwise().norm().minCoeff() > 0.1);
  CHECK(gap(knob.now) == Approx(gap(knob.rest)).margin(0.03));
  CHECK(strain(knob) < 0.03);

  // The collar stays around the neck of the bottle when the mouth is pulled aside.
  const Shape shape = model("bottle");
  const Shape now =
      deformed(*surface_model(unstructured(shape)), {{{HandleKind::point, 0, 1200}, Move{{0.03, 0, 0}}}});
  const SurfaceIndex before(extract_part(shape, 0)), after(extract_part(now, 0));
  const Points collar = extract_part(shape, 1).vertices, moved = extract_part(now, 1).vertices;
  double worst = 0;
  for (Eigen::Index v = 0; v < collar.rows(); ++v)
    worst = std::max(worst, std::abs(after.nearest(moved.row(v).transpose()).distance -
                                     before.nearest(collar.row(v).transpose()).distance));
  CHECK(worst < 0.002);
}

TEST_CASE("surface: triangles without area and vertices without triangles do no harm") {
  Shape shape = tube();
  const Eigen::Index n = shape.vertex_count();
  Points points(n + 2, 3);
  points << shape.vertices, 0, 0, 9, std::nan(""), 0, 0;
  shape.vertices = points;
  Triangles triangles(shape.triangle_count() + 2, 3);
  // A needle out to a vertex of its own, and a triangle that is a point.
  triangles << shape.triangles, 0, 0, static_cast<int>(n), 5, 5, 5;
  shape.triangles = triangles;
  shape.triangle_part.resize(static_cast<std::size_t>(triangles.rows()), 0);
  const auto surface = surface_model(unstructured(shape));
  const Shape now = deformed(*surface, {{{HandleKind::point, 0, 0}, Move{{0.1, 0, 0.2}}}});
  CHECK(now.vertices.topRows(n + 1).allFinite());
  CHECK(std::isnan(now.vertices(n + 1, 0)));
  CHECK(unmoved(shape, now) < n);
  CHECK_THROWS_AS(surface->centre({HandleKind::point, 0, static_cast<int>(n) + 1}), UsageError);
}

TEST_CASE("surface: fixed parts and points stay to the bit, or the edit is refused") {
  const Shape shape = model("bottle");
  SurfaceModelOptions options;
  options.influence = std::numeric_limits<double>::infinity();
  const auto surface = surface_model(unstructured(shape), options);
  DeformationConstraints constraints;
  constraints.fixed_parts = {1};
  constraints.fixed_points = {{0.038, 0, 0.1}};
  const Edit squeeze{{HandleKind::section, 0, 0}, Scale{0.8, {}}};
  const Shape now = deformed(*surface, {squeeze}, constraints);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    if (shape.triangle_part[static_cast<std::size_t>(t)] == 1)
      for (int k = 0; k < 3; ++k) CHECK(now.corner(t, k) == shape.corner(t, k));
  CHECK(unmoved(shape, now) < shape.vertex_count());

  const DeformationResult refused =
      surface->deformed({{{HandleKind::part, 1, 0}, Move{{0, 0, 0.01}}}}, constraints);
  REQUIRE(refused.refusal);
  CHECK(refused.refusal->amount == Approx(0.01 / diagonal(shape)));
  CHECK(refused.design.shape.vertices == shape.vertices);
  CHECK(surface->deformed({{whole_shape, Scale{1.1, {}}}}, constraints).refusal);
}

TEST_CASE("surface: with the extent kept, the base goes in and the upper half does not move") {
  const Shape shape = model("bottle");
  const auto surface = surface_model(unstructured(shape));
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(0, 0, 1);
  const Shape now = deformed(
      *surface,
      {{{HandleKind::section, 0, 0}, Scale{0.8, {}}}, {{HandleKind::section, 0, 0}, Move{{0, 0, -0.01}}}},
      constraints);
  const double h = range_along(shape, {0, 0, 1}).length();
  CHECK(std::abs(range_along(now, {0, 0, 1}).length() - h) < 1e-12 * h);
  CHECK(range_along(now, {0, 0, 1}).low == Approx(0).margin(1e-15));
  for (const int v : vertices_between(shape, 0.15, 1)) CHECK(now.vertices.row(v) == shape.vertices.row(v));
}

TEST_CASE("surface: handles are what it says they are") {
  const Shape shape = model("bottle");
  const auto surface = surface_model(unstructured(shape));
  int sections = 0, parts = 0, points = 0;
  for (const Handle& handle : surface->handles()) {
    CHECK(surface->centre(handle).allFinite());
    sections += handle.kind == HandleKind::section;
    parts += handle.kind == HandleKind::part;
    points += handle.kind == HandleKind::point;
    // A body of revolution has its rings around its axis.
    if (handle.kind == HandleKind::section) CHECK(surface->centre(handle).head(2).norm() < 1e-5);
    if (handle.kind == HandleKind::point)
      CHECK(surface->centre(handle) == shape.vertices.row(handle.index).transpose());
  }
  CHECK(parts == 2);
  CHECK(sections >= 12);
  CHECK(points > 2000);
  // A wide bowl has the axis of its rings as well, not its longest side.
  const auto bowl =
      surface_model(unstructured(solids::cylinder(4, 1, 32)), with(&SurfaceModelOptions::sections, 2));
  CHECK((bowl->centre({HandleKind::section, 0, 0}) - Eigen::Vector3d(0, 0, 0)).norm() < 1e-12);
  CHECK((bowl->centre({HandleKind::section, 0, 1}) - Eigen::Vector3d(0, 0, 1)).norm() < 1e-12);
}

TEST_CASE("surface: what it cannot do is said") {
  const Shape shape = tube();
  const auto surface = surface_model(unstructured(shape));
  const auto refuses = [&](const Edit& edit) { CHECK_THROWS_AS(surface->deformed({edit}), UsageError); };
  refuses({{HandleKind::part, 1, 0}, Move{}});
  refuses({{HandleKind::section, 0, 24}, Move{}});
  refuses({{HandleKind::section, 0, -1}, Move{}});
  refuses({{HandleKind::point, 0, -1}, Move{}});
  refuses({{HandleKind::corner, 0, 0}, Move{}});
  refuses({{HandleKind::wire, 0, 0}, Move{}});
  refuses({{HandleKind::section, 0, 0}, Scale{2, Eigen::Vector3d(0, 0, 1)}});
  refuses({whole_shape, Scale{-1, {}}});
  CHECK_THROWS_AS(surface_model(unstructured(shape), with(&SurfaceModelOptions::handle_radius, -1.0)),
                  UsageError);
  CHECK_THROWS_AS(surface_model(unstructured(shape), with(&SurfaceModelOptions::influence, std::nan(""))),
                  UsageError);
  CHECK_THROWS_AS(surface_model(unstructured(shape), with(&SurfaceModelOptions::sections, 0)), UsageError);
  CHECK_THROWS_AS(surface_model(unstructured(shape), with(&SurfaceModelOptions::reach, -1.0)), UsageError);
  CHECK_THROWS_AS(surface_model(unstructured(shape),
                                with(&SurfaceModelOptions::axis, std::optional(Eigen::Vector3d(0, 0, 0)))),
                  UsageError);
  CHECK_THROWS_AS(
      surface_model(unstructured(shape), with(&SurfaceModelOptions::rigidity, RigidityOptions{0, 0})),
      UsageError);
  CHECK_THROWS_AS(
      surface_model(unstructured(shape), with(&SurfaceModelOptions::rigidity, RigidityOptions{1, -1})),
      UsageError);
  CHECK_THROWS_AS(surface_model(unstructured(Shape{})), InputError);
  // Numbers that run away are refused, not computed with.
  refuses({{HandleKind::point, 0, 0}, Move{{1e200, 0, 0}}});
  CHECK(surface->deformed(std::vector<Edit>(11, {whole_shape, Scale{edit_limits::max_scale, {}}})).refusal);
}

TEST_CASE("surface: 1000 random edits each keep the extent and give finite vertices") {
  const std::string name = GENERATE(as<std::string>{}, "bottle", "cup", "stool", "basket");
  const Shape shape = model(name);
  const auto surface =
      surface_model(unstructured(shape), with(&SurfaceModelOptions::rigidity, RigidityOptions{2, 0}));
  const std::vector<Handle> handles = surface->handles();
  const double d = diagonal(shape);
  solids::Random random(11);
  int refusals = 0;
  bool finite = true;
  double worst = 0;
  for (int k = 0; k < 250; ++k) {
    DeformationConstraints constraints;
    const Direction r(k % 2 ? Eigen::Vector3d(0, 0, 1) : random.on_sphere());
    constraints.keep_extent = r;
    std::vector<Edit> edits;
    for (int e = 0; e <= k % 2; ++e) {
      // Points are many: every other handle is one of the others.
      const std::size_t few = handles.size() - static_cast<std::size_t>(shape.vertex_count());
      const Handle handle =
          handles[random.below(random.below(2) ? handles.size() : std::max<std::size_t>(few, 1))];
      switch (random.below(3)) {
        case 0:
          edits.push_back({handle, Move{0.2 * d * random.in_cube()}});
          break;
        case 1:
          edits.push_back({handle, Rotate{random.on_sphere(), random.uniform(-2, 2)}});
          break;
        default:
          edits.push_back({handle, Scale{random.uniform(0.5, 2), {}}});
      }
    }
    const DeformationResult result = surface->deformed(edits, constraints);
    refusals += result.refusal.has_value();
    finite = finite && result.design.shape.vertices.allFinite();
    const double h = range_along(shape, r.unit()).length();
    worst = std::max(worst, std::abs(range_along(result.design.shape, r.unit()).length() - h) / h);
  }
  CHECK(finite);
  CHECK(worst < 1e-9);
  CHECK(refusals == 0);
}
