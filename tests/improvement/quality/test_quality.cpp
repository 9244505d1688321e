#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/quality.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/still_designs.h"
#include "support/structures.h"
#include "support/symmetric_solids.h"
#include "support/voxels.h"

using namespace stackabilization;

namespace {

using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

Shape mapped(Shape shape, const Map& map) {
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    shape.vertices.row(v) = map(shape.vertices.row(v).transpose()).transpose();
  return shape;
}

/// Moves the vertices of one part.
Shape with_part_moved(Shape shape, int part, const Eigen::Vector3d& by) {
  std::vector<bool> moves(static_cast<std::size_t>(shape.vertex_count()));
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    if (shape.triangle_part[static_cast<std::size_t>(t)] == part)
      for (int k = 0; k < 3; ++k) moves[static_cast<std::size_t>(shape.triangles(t, k))] = true;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    if (moves[static_cast<std::size_t>(v)]) shape.vertices.row(v) += by.transpose();
  return shape;
}

double measured(const std::vector<QualityValue>& values, QualityMeasure measure) {
  for (const QualityValue& value : values)
    if (value.measure == measure) return value.value;
  FAIL("not measured: " + name_of(measure));
  return 0;
}

double measured(const StructuredShape& rest, const Shape& now, QualityMeasure measure) {
  return measured(QualityMeter(rest).measure(now), measure);
}

/// An upright tube of length 10 and radius 1, with rings of vertices along it.
StructuredShape upright_tube() {
  return structures::tube_alone(structures::straight_cylinder({0, 0, 0}, {0, 0, 10}, 1, 21), 32);
}

/// A plate of 10 x 8 x 1, with many vertices.
StructuredShape plate() {
  return structures::box_alone({10, 8, 1});
}

/// Two boxes joined end to end: [0, 4] and [4, 8] along x.
StructuredShape joined_boxes(double gap = 0) {
  return analyse_structure(
      concatenate(solids::box({0, 0, 0}, {4, 1, 1}), solids::box({4 + gap, 0, 0}, {8 + gap, 1, 1})));
}

}  // namespace

TEST_CASE("An unchanged object has ideal values, whatever it is", "[quality]") {
  solids::FrustumShell coarse;  // whose centre line is uneven, since its triangles are long
  coarse.segments = 16;
  for (const StructuredShape& rest :
       {analyse_structure(solids::frustum_shell(coarse)), upright_tube(), plate(), structures::table(),
        structures::mug(), structures::rough_stool()})
    for (const QualityValue& value : QualityMeter(rest).measure(rest.shape)) {
      CAPTURE(name_of(value.measure));
      CHECK(value.value == Approx(ideal_value(value.measure)).margin(1e-9));
      CHECK(is_within(value, QualityLimits()));
    }
}

TEST_CASE("A pose and a scale change no measure but those of fixed places", "[quality]") {
  const StructuredShape rest = structures::table();
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d::UnitZ());
  const QualityMeter meter(rest);
  const Shape bad = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x() * (1 + 0.1 * p.z()), p.y(), p.z() + 0.05 * p.x() * p.x());
  });
  const std::vector<QualityValue> before = meter.measure(bad);
  const std::vector<QualityValue> after = meter.measure(mapped(
      bad, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return turn * p + Eigen::Vector3d(1, 2, 3); }));
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (before[k].measure == QualityMeasure::symmetry) continue;
    CAPTURE(name_of(before[k].measure));
    CHECK(after[k].value == Approx(before[k].value).margin(1e-9));
  }
}

TEST_CASE("A straight tube that is bent to an arc is as far from straight as the arc", "[quality]") {
  // Of 1,280 triangles, and of 20,480: more than there are pieces of a part.
  const int finer = GENERATE(1, 4);
  const StructuredShape rest = structures::tube_alone(
      structures::straight_cylinder({0, 0, 0}, {0, 0, 10}, 1, 20 * finer + 1), 32 * finer);
  const double radius = 40;
  const Shape bent = mapped(rest.shape, [&](const Eigen::Vector3d& p) {
    const double angle = p.z() / radius, r = radius - p.x();
    return Eigen::Vector3d(radius - r * std::cos(angle), p.y(), r * std::sin(angle));
  });
  // The rise of the arc over the best line is between two thirds of its rise over the chord and all of it.
  const double rise = radius * (1 - std::cos(10 / radius / 2)) / 10;
  const double found = measured(rest, bent, QualityMeasure::straightness);
  CHECK(found > 0.55 * rise);
  CHECK(found < rise);
  CHECK(found > QualityLimits()[QualityMeasure::straightness]);
}

TEST_CASE("A leaning or longer tube stays straight, and its length and width are its sizes", "[quality]") {
  const StructuredShape rest = upright_tube();
  const Shape leaning = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x() + 0.2 * p.z(), p.y(), p.z());
  });
  CHECK(measured(rest, leaning, QualityMeasure::straightness) == Approx(0).margin(1e-9));
  CHECK(measured(rest, leaning, QualityMeasure::size) == Approx(1 / std::sqrt(1.04)).epsilon(1e-3));
  CHECK(measured(rest, leaning, QualityMeasure::section) == Approx(1 - 1 / std::sqrt(1.04)).epsilon(0.05));
  const Shape longer =
      mapped(rest.shape, [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.y(), 1.3 * p.z()); });
  CHECK(measured(rest, longer, QualityMeasure::size) == Approx(1 / 1.3));
  CHECK(measured(rest, longer, QualityMeasure::height) == Approx(0.3));
}

TEST_CASE("A tube that lacks a piece of one side is straight as a cone", "[quality]") {
  const StructuredShape whole = upright_tube();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index t = 0; t < whole.shape.triangle_count(); ++t) {
    const Eigen::Vector3d p = whole.shape.corner(t, 0);
    if (p.z() < 3 || p.z() > 7 || p.x() < 0.8) kept.push_back(t);
  }
  REQUIRE(static_cast<Eigen::Index>(kept.size()) < whole.shape.triangle_count());
  const Shape open = make_shape(whole.shape.vertices, whole.shape.triangles(kept, Eigen::all));
  const StructuredShape rest = designs::alone(open, whole.structure.parts.front().primitive);
  const Shape cone = mapped(open, [](const Eigen::Vector3d& p) {
    const double r = 1 + 0.05 * p.z();
    return Eigen::Vector3d(r * p.x(), r * p.y(), p.z());
  });
  // The mean of what is left in the middle lies 0.24 radii off the line, and moves by a quarter of that.
  CHECK(measured(rest, cone, QualityMeasure::straightness) < 0.1 * 0.24 * 0.25 / 10);
}

TEST_CASE("A kink in a line that was smooth is its angle", "[quality]") {
  const solids::Torus torus{.ring_radius = 5, .tube_radius = 0.5};
  const Shape ring = solids::torus(torus);
  GeneralizedCylinder curve;
  curve.closed = true;
  curve.centres.resize(24, 3);
  curve.radii = Eigen::VectorXd::Constant(24, 0.5);
  for (int k = 0; k < 24; ++k) {
    const double angle = 2 * std::numbers::pi * k / 24;
    curve.centres.row(k) << 5 * std::cos(angle), 5 * std::sin(angle), 0;
  }
  const StructuredShape rest = designs::alone(ring, curve);
  // A fold about the x axis by 80 degrees.
  const double fold = 80 * std::numbers::pi / 180;
  const Shape folded = mapped(ring, [&](const Eigen::Vector3d& p) {
    return p.y() < 0 ? p
                     : Eigen::Vector3d(p.x(), p.y() * std::cos(fold) - p.z() * std::sin(fold),
                                       p.y() * std::sin(fold) + p.z() * std::cos(fold));
  });
  CHECK(measured(rest, folded, QualityMeasure::bending) > 10);
  const Shape oval =
      mapped(ring, [](const Eigen::Vector3d& p) { return Eigen::Vector3d(1.1 * p.x(), p.y(), p.z()); });
  CHECK(measured(rest, oval, QualityMeasure::bending) == Approx(0).margin(1e-6));
}

TEST_CASE("A wave across the plane of a handle counts as much as one within it", "[quality]") {
  // Half of a ring of radius 5.
  GeneralizedCylinder curve;
  curve.centres.resize(93, 3);
  curve.radii = Eigen::VectorXd::Constant(93, 0.5);
  for (int k = 0; k < 93; ++k) {
    const double angle = std::numbers::pi * k / 92;
    curve.centres.row(k) << 5 * std::cos(angle), 5 * std::sin(angle), 0;
  }
  const StructuredShape rest = structures::tube_alone(curve, 16);
  const double height = 0.05 * 5, waves = 6;
  const auto wave = [&](const Eigen::Vector3d& p) {
    return height * std::sin(waves * std::atan2(p.y(), p.x()));
  };
  const Shape across = mapped(
      rest.shape, [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.y(), p.z() + wave(p)); });
  const Shape within = mapped(rest.shape, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return p + wave(p) * Eigen::Vector3d(p.x(), p.y(), 0).normalized();
  });
  // The turn at a station of a wave of height a and length 2 pi / w, at stations of step h, each the mean
  // under a hat of that step: (2 - 2 cos(w h)) a / h, times the mean of the hat, the square of sin(w h / 2) /
  // (w h / 2). At the two stations beside a crest together it is 2 cos(w h / 2) times that.
  const double half = waves * std::numbers::pi / 23 / 2;
  const double at_station =
      (2 - 2 * std::cos(2 * half)) * 0.05 * waves / (2 * half) * std::pow(std::sin(half) / half, 2);
  const double expected = 2 * std::cos(half) * at_station * 180 / std::numbers::pi;
  CHECK(measured(rest, across, QualityMeasure::bending) == Approx(expected).epsilon(0.1));
  CHECK(measured(rest, within, QualityMeasure::bending) > 0.9 * expected);
}

TEST_CASE("A vessel is as thick as its wall, a solid member as it is wide", "[quality]") {
  const StructuredShape vessel = analyse_structure(solids::frustum_shell({})), member = upright_tube();
  REQUIRE(vessel.structure.parts.size() == 1);
  // The lower end gets narrower by 15 % of its radius, and all of the wall there moves inwards alike.
  const auto narrowed = [](const Shape& shape) {
    const Points& points = shape.vertices;
    const double low = points.col(2).minCoeff(), height = points.col(2).maxCoeff() - low;
    double radius = 0;
    for (Eigen::Index v = 0; v < points.rows(); ++v)
      if (points(v, 2) == low) radius = std::max(radius, points.row(v).head<2>().norm());
    return mapped(shape, [=](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      const double inwards = 0.15 * radius * (1 - (p.z() - low) / height);
      const Eigen::Vector3d across(p.x(), p.y(), 0);
      return p - std::min(inwards, across.norm()) * across.stableNormalized();
    });
  };
  CHECK(measured(vessel, narrowed(vessel.shape), QualityMeasure::thickness) > 0.95);
  CHECK(measured(member, narrowed(member.shape), QualityMeasure::thickness) == Approx(0.85).epsilon(0.02));
}

TEST_CASE("A crease across a plate is as long as its two faces are wide", "[quality]") {
  const StructuredShape rest = plate();
  const auto folded = [&](double degrees) {
    const double slope = std::tan(degrees * std::numbers::pi / 180);
    return measured(rest,
                    mapped(rest.shape,
                           [&](const Eigen::Vector3d& p) {
                             return Eigen::Vector3d(p.x(), p.y(), p.z() + slope * std::max(0.0, p.x()));
                           }),
                    QualityMeasure::creases);
  };
  const double whole = 2 * 8 / rest.structure.diagonal;
  CHECK(folded(30) == Approx(whole));
  CHECK(folded(-26) == Approx(whole));
  CHECK(folded(20) == Approx(0.5 * whole));
  CHECK(folded(14.9) == 0);
  // Each of the lines between five rows of vertices turns by atan(2.5 / 20), 7 degrees.
  const Shape bent = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), p.z() + p.x() * p.x() / (2 * 20));
  });
  CHECK(measured(rest, bent, QualityMeasure::creases) == 0);
  // The edges of the plate are no creases, however its ends lean.
  const Shape leaning = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x() + 0.5 * p.z(), p.y(), p.z());
  });
  CHECK(measured(rest, leaning, QualityMeasure::creases) == 0);
}

TEST_CASE("A step is two creases, but one on a sliver is not seen", "[quality]") {
  // A sheet of three strips; the one in the middle becomes a slope of 30 degrees.
  const auto step = [](double width) {
    Points points(8, 3);
    points << -5, -4, 0, -5, 4, 0, 0, -4, 0, 0, 4, 0, width, -4, 0, width, 4, 0, 5, -4, 0, 5, 4, 0;
    Triangles triangles(6, 3);
    triangles << 0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3, 4, 6, 7, 4, 7, 5;
    const StructuredShape rest = analyse_structure(make_shape(points, triangles));
    const Shape after = mapped(rest.shape, [&](const Eigen::Vector3d& p) {
      return Eigen::Vector3d(p.x(), p.y(), std::clamp(p.x(), 0.0, width) / std::sqrt(3));
    });
    return measured(rest, after, QualityMeasure::creases) * rest.structure.diagonal;
  };
  CHECK(step(0.5) == Approx(2 * 8));
  CHECK(step(0.05) == Approx(2 * 8));
  CHECK(step(0.03) == 0);
}

TEST_CASE("A crease from a smooth ridge to a smooth hollow is the sum of both folds", "[quality]") {
  const StructuredShape rest = plate();
  const auto folded = [&](double degrees) {
    const double slope = std::tan(degrees * std::numbers::pi / 180);
    StructuredShape result = rest;
    for (Eigen::Index v = 0; v < result.shape.vertex_count(); ++v)
      result.shape.vertices(v, 2) += slope * std::max(0.0, result.shape.vertices(v, 0));
    return result;
  };
  // From 9 degrees down to 11 degrees up: 20 in all, half of a crease.
  CHECK(measured(folded(-9), folded(11).shape, QualityMeasure::creases) ==
        Approx(0.5 * 2 * 8 / rest.structure.diagonal));
}

TEST_CASE("Parts of one surface may turn where they meet, and nowhere else", "[quality]") {
  // Two halves of a sheet that meet at x = 0, and the right one bent up along a line.
  constexpr int steps = 16;
  Points points(2 * (steps + 1), 3);
  Triangles triangles(2 * steps, 3);
  std::vector<std::int32_t> parts;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j < 2; ++j) points.row(2 * i + j) << i - steps / 2, 4 * j, 0;
  for (int i = 0; i < steps; ++i) {
    triangles.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 3;
    triangles.row(2 * i + 1) << 2 * i, 2 * i + 3, 2 * i + 1;
    parts.insert(parts.end(), 2, i < steps / 2 ? 0 : 1);
  }
  Shape sheet = make_shape(points, triangles);
  sheet.triangle_part = parts;
  sheet.part_names = {"left", "right"};
  const StructuredShape rest = analyse_structure(sheet);
  REQUIRE(rest.shape.part_count() == 2);
  const auto creases = [&](double line, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return measured(rest,
                    mapped(rest.shape,
                           [&](const Eigen::Vector3d& p) {
                             const double beyond = std::max(0.0, p.x() - line);
                             return Eigen::Vector3d(std::min(p.x(), line) + beyond * std::cos(angle), p.y(),
                                                    beyond * std::sin(angle));
                           }),
                    QualityMeasure::creases);
  };
  const double whole = 4 / rest.structure.diagonal;
  for (const double degrees : {20, 30, 40}) CHECK(creases(0, degrees) == 0);
  CHECK(creases(4, 30) == Approx(whole));
  // A step where they meet is two creases: the parts themselves do not turn.
  const Shape step = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), std::clamp(p.x(), 0.0, 1.0));
  });
  CHECK(measured(rest, step, QualityMeasure::creases) == Approx(2 * whole));
}

TEST_CASE("Sections at a seam follow the other part, and tell nothing of their own", "[quality]") {
  const StructuredShape whole = upright_tube();
  // The uppermost of twenty rings of triangles belongs to another part.
  StructuredShape rest = whole;
  rest.shape.part_names.push_back("cap");
  for (Eigen::Index t = 0; t < rest.shape.triangle_count(); ++t)
    if (rest.shape.corner(t, 0).z() + rest.shape.corner(t, 1).z() + rest.shape.corner(t, 2).z() > 3 * 9.5)
      rest.shape.triangle_part[static_cast<std::size_t>(t)] = 1;
  rest.structure.parts.push_back(
      {"cap", cuboid_of({{0, 0, 9.75}, Eigen::Matrix3d::Identity(), {1, 1, 0.25}}), {}});
  const auto profile = [](const StructuredShape& structured, double height) {
    return measured(structured,
                    mapped(structured.shape,
                           [&](const Eigen::Vector3d& p) {
                             const double wider = std::abs(p.z() - height) < 0.3 ? 1.3 : 1;
                             return Eigen::Vector3d(wider * p.x(), wider * p.y(), p.z());
                           }),
                    QualityMeasure::profile);
  };
  const double limit = QualityLimits()[QualityMeasure::profile];
  CHECK(profile(whole, 9.5) > limit);
  CHECK(profile(rest, 9.5) < limit);
  CHECK(profile(rest, 5) > limit);
}

TEST_CASE("A round section that is squashed loses roundness, and a bulge is a profile", "[quality]") {
  const StructuredShape rest = upright_tube();
  const Shape oval =
      mapped(rest.shape, [](const Eigen::Vector3d& p) { return Eigen::Vector3d(0.9 * p.x(), p.y(), p.z()); });
  CHECK(measured(rest, oval, QualityMeasure::section) == Approx(0.1).epsilon(0.02));
  const Shape cone = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    const double r = 0.8 + 0.04 * p.z();
    return Eigen::Vector3d(r * p.x(), r * p.y(), p.z());
  });
  CHECK(measured(rest, cone, QualityMeasure::profile) < 0.02);
  const Shape bulging = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    const double r = 1 + 0.2 * std::sin(std::numbers::pi * p.z() / 10);
    return Eigen::Vector3d(r * p.x(), r * p.y(), p.z());
  });
  // A half wave of amplitude a departs from its mean by up to 2 a / pi.
  CHECK(measured(rest, bulging, QualityMeasure::profile) > 0.2 * (1 - 2 / std::numbers::pi) * 0.8);
  CHECK(measured(rest, bulging, QualityMeasure::profile) < 0.2 * 2 / std::numbers::pi * 1.1);
}

TEST_CASE("Opposite walls of a crate may lean, the two sides of a wall may not", "[quality]") {
  const bool inner_part = GENERATE(false, true);  // whether the inner sides of two walls are a part
  Shape crate = solids::grid_union({{{0, 0, 0}, {20, 14, 2}},
                                    {{0, 0, 2}, {2, 14, 10}},
                                    {{18, 0, 2}, {20, 14, 10}},
                                    {{2, 0, 2}, {18, 2, 10}},
                                    {{2, 12, 2}, {18, 14, 10}}});
  crate.part_names = {"crate"};
  crate.triangle_part.assign(crate.triangle_part.size(), 0);
  if (inner_part) crate.part_names.push_back("inner sides");
  for (Eigen::Index t = 0; inner_part && t < crate.triangle_count(); ++t)
    for (const double x : {2.0, 18.0})
      if (crate.corner(t, 0).x() == x && crate.corner(t, 1).x() == x && crate.corner(t, 2).x() == x)
        crate.triangle_part[static_cast<std::size_t>(t)] = 1;
  AnalysisOptions options;
  options.segmentation.method = SegmentationMethod::given;
  const StructuredShape rest = analyse_structure(crate, options);
  const double degrees = 5, slope = std::tan(degrees * std::numbers::pi / 180);
  // Walls across x lean outwards by so much, and stay as thick as they are.
  const Shape drafted = mapped(rest.shape, [&](const Eigen::Vector3d& p) {
    const double side = p.x() <= 2 ? -1 : p.x() >= 18 ? 1 : 0;
    return Eigen::Vector3d(p.x() + side * slope * p.z(), p.y(), p.z());
  });
  CHECK(measured(rest, drafted, QualityMeasure::parallelism) == Approx(0).margin(0.01));
  if (inner_part) return;
  // Only the outer side of one wall leans.
  const Shape wedge = mapped(rest.shape, [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x() == 20 ? p.x() + slope * p.z() : p.x(), p.y(), p.z());
  });
  // A thousandth of the diagonal across the inner side of 10 x 8 is not seen.
  const double unseen = 0.001 * std::sqrt(20 * 20 + 14 * 14 + 10 * 10) / (80 / std::sqrt(10 * 10 + 8 * 8));
  CHECK(measured(rest, wedge, QualityMeasure::parallelism) ==
        Approx(degrees - unseen * 180 / std::numbers::pi));
}

TEST_CASE("Two soles of a part in one plane stay parallel, whatever is opposite", "[quality]") {
  Shape bridge =
      solids::grid_union({{{0, 0, 0}, {6, 10, 8}}, {{14, 0, 0}, {20, 10, 8}}, {{0, 0, 8}, {20, 10, 10}}});
  bridge.part_names = {"bridge"};
  bridge.triangle_part.assign(bridge.triangle_part.size(), 0);
  AnalysisOptions options;
  options.segmentation.method = SegmentationMethod::given;
  // The upper side slopes, so that no face is parallel to the soles.
  const StructuredShape rest =
      analyse_structure(mapped(bridge,
                               [](const Eigen::Vector3d& p) {
                                 return Eigen::Vector3d(p.x(), p.y(), p.z() + (p.z() >= 8 ? 0.3 * p.x() : 0));
                               }),
                        options);
  const double degrees = 5, slope = std::tan(degrees * std::numbers::pi / 180);
  const Shape tilted = mapped(rest.shape, [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), p.x() >= 14 && p.z() == 0 ? slope * (p.x() - 14) : p.z());
  });
  // A thousandth of the diagonal across the soles of 10 x 6 is not seen.
  const double unseen = 0.001 * std::sqrt(20 * 20 + 10 * 10 + 16 * 16) / (60 / std::sqrt(10 * 10 + 6 * 6));
  CHECK(measured(rest, tilted, QualityMeasure::parallelism) ==
        Approx(degrees - unseen * 180 / std::numbers::pi));
}

TEST_CASE("A wedge has the angle between its faces, and a dent is no plane", "[quality]") {
  const StructuredShape rest = plate();
  const double degrees = 5, slope = std::tan(degrees * std::numbers::pi / 180);
  const Shape wedge = mapped(rest.shape, [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), p.z() > 0.4 ? p.z() + slope * p.x() : p.z());
  });
  // A thousandth of the diagonal across the faces of 10 x 8 is not seen.
  const double unseen = 0.001 * std::sqrt(10 * 10 + 8 * 8 + 1) / (80 / std::sqrt(10 * 10 + 8 * 8));
  CHECK(measured(rest, wedge, QualityMeasure::parallelism) ==
        Approx(degrees - unseen * 180 / std::numbers::pi));
  CHECK(measured(rest, wedge, QualityMeasure::flatness) == Approx(0).margin(1e-9));
  const Shape twisted = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), p.z() + 0.02 * (p.x() - 5) * (p.y() - 4));
  });
  // The corners leave the plane of 10 x 8 by 0.02 * 5 * 4, of which a thousandth of the diagonal is not seen.
  const double seen = 0.4 - 0.001 * std::sqrt(10 * 10 + 8 * 8 + 1);
  CHECK(measured(rest, twisted, QualityMeasure::flatness) == Approx(seen / std::sqrt(80)).epsilon(0.01));
}

TEST_CASE("A plate pressed to half its thickness has half of it", "[quality]") {
  const StructuredShape rest = plate();
  const Shape thin =
      mapped(rest.shape, [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.y(), p.z() / 2); });
  CHECK(measured(rest, thin, QualityMeasure::thickness) == Approx(0.5));
  CHECK(measured(rest, thin, QualityMeasure::size) == Approx(0.5));
}

TEST_CASE("A thin shelf that slides along a narrower post stays joined to it", "[quality]") {
  // The corners of the shelf stand beside the post, and the marks of the post stay where the shelf was.
  const StructuredShape rest = analyse_structure(
      concatenate(solids::box({0, 1, 0}, {0.2, 3, 10}), solids::box({0.2, 0, 5}, {4, 4, 5.005})));
  const double diagonal = rest.structure.diagonal;
  const Shape higher = with_part_moved(rest.shape, 1, {0, 0, 2});
  CHECK(measured(rest, higher, QualityMeasure::joints) == Approx(0).margin(1e-9));
  const Shape apart = with_part_moved(rest.shape, 1, {0.3, 0, 2});
  CHECK(measured(rest, apart, QualityMeasure::joints) == Approx(0.3 / diagonal));
}

TEST_CASE("A part that collapsed to a line away from its neighbour floats", "[quality]") {
  const StructuredShape rest = joined_boxes();
  Shape line = rest.shape;
  for (Eigen::Index t = 0; t < line.triangle_count(); ++t)
    if (line.triangle_part[static_cast<std::size_t>(t)] == 1)
      for (int k = 0; k < 3; ++k) line.vertices.row(line.triangles(t, k)) << 6, 0.5, line.corner(t, k).z();
  CHECK(measured(rest, line, QualityMeasure::joints) == Approx(2 / rest.structure.diagonal));
}

TEST_CASE("A bar taken from its neighbour floats, one pushed into it pierces", "[quality]") {
  const StructuredShape rest = joined_boxes();
  const double diagonal = rest.structure.diagonal;
  const Shape apart = with_part_moved(rest.shape, 1, {0.5, 0, 0});
  CHECK(measured(rest, apart, QualityMeasure::joints) == Approx(0.5 / diagonal));
  const Shape inside = with_part_moved(rest.shape, 1, {-0.5, 0.01, 0.01});
  // As deep as the nearest face of either box is away.
  CHECK(measured(rest, inside, QualityMeasure::piercing) > 0.2 / diagonal);
  CHECK(measured(rest, inside, QualityMeasure::piercing) <= 0.51 / diagonal);
  CHECK(measured(rest, inside, QualityMeasure::joints) == Approx(0).margin(1e-9));
}

TEST_CASE("A thin rod enters a post as deep as its end is, wherever the points of equal area lie",
          "[quality]") {
  const StructuredShape rest = analyse_structure(
      concatenate(solids::box({0, -2, -2}, {4, 2, 2}), solids::box({3.7, -0.1, -0.1}, {103.7, 0.1, 0.1})));
  const double diagonal = rest.structure.diagonal;
  const Shape pushed = with_part_moved(rest.shape, 1, {-0.4, 0, 0});
  CHECK(measured(rest, pushed, QualityMeasure::piercing) == Approx(0.4 / diagonal).epsilon(1e-9));
  const Shape shorter = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x() > 50 ? 3.7 + 0.7 * (p.x() - 3.7) : p.x(), p.y(), p.z());
  });
  CHECK(measured(rest, shorter, QualityMeasure::piercing) == Approx(0).margin(1e-12));
}

TEST_CASE("A rod that slides through a post is as deep in it as before", "[quality]") {
  const StructuredShape rest = analyse_structure(
      concatenate(solids::box({0, -2, -2}, {4, 2, 2}), solids::box({-41.3, -0.1, -0.1}, {58.7, 0.1, 0.1})));
  for (const double by : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6})
    CHECK(measured(rest, with_part_moved(rest.shape, 1, {by, 0, 0}), QualityMeasure::piercing) ==
          Approx(0).margin(1e-12));
}

TEST_CASE("Parts that were apart collide where they meet", "[quality]") {
  const StructuredShape rest = joined_boxes(1);
  CHECK(measured(rest, with_part_moved(rest.shape, 1, {-0.9, 0, 0}), QualityMeasure::collision) == 0);
  CHECK(measured(rest, with_part_moved(rest.shape, 1, {-1.1, 0.01, 0.01}), QualityMeasure::collision) == 1);
  // Wholly inside, without a common point of the surfaces.
  const Shape within = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    return p.x() < 4.5 ? p : Eigen::Vector3d((p.x() - 5) / 4 + 1, p.y() / 2 + 0.25, p.z() / 2 + 0.25);
  });
  CHECK(measured(rest, within, QualityMeasure::collision) == 1);
}

TEST_CASE("A tube folded through itself intersects itself", "[quality]") {
  const StructuredShape rest = upright_tube();
  const Shape folded = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x() * (p.z() > 4.9 && p.z() < 5.1 ? -0.5 : 1), p.y(), p.z());
  });
  CHECK(measured(rest, folded, QualityMeasure::self_intersection) > 0);
}

TEST_CASE("A leg that leaves its mirror image breaks the symmetry by its way", "[quality]") {
  StructuredShape rest = structures::table();
  rest.structure.symmetries = {Symmetry{}};  // the plane x = 0
  const Shape one_leg = with_part_moved(rest.shape, 1, {0.1, 0, 0});
  const double found = measured(rest, one_leg, QualityMeasure::symmetry);
  CHECK(found == Approx(0.1 / rest.structure.diagonal).epsilon(1e-6));
  const Shape one_lifted = with_part_moved(rest.shape, 1, {0, 0, 0.05});
  CHECK(measured(rest, one_lifted, QualityMeasure::symmetry) ==
        Approx(0.05 / rest.structure.diagonal).epsilon(1e-6));
}

TEST_CASE("A board whose ends lean alike is symmetric, however its faces are cut into triangles",
          "[quality]") {
  StructuredShape rest = analyse_structure(solids::box({-5, -0.5, -2}, {5, 0.5, 2}));
  rest.structure.symmetries = {Symmetry{}};  // the plane x = 0
  const auto leaning = [&](bool both) {
    return mapped(rest.shape, [both](const Eigen::Vector3d& p) {
      return Eigen::Vector3d(both || p.x() > 0 ? p.x() * (1 - 0.05 * p.z()) : p.x(), p.y(), p.z());
    });
  };
  CHECK(measured(rest, leaning(true), QualityMeasure::symmetry) == Approx(0).margin(1e-12));
  // The lower corners of the end that leans alone are 0.5 outside of the other end.
  CHECK(measured(rest, leaning(false), QualityMeasure::symmetry) ==
        Approx(0.5 / rest.structure.diagonal).epsilon(1e-6));
}

TEST_CASE("A foot off the ground, and a top that is lower, smaller or tilted", "[quality]") {
  const StructuredShape rest = structures::table();
  const Shape lifted = with_part_moved(rest.shape, 1, {0, 0, 0.05});
  CHECK(measured(rest, lifted, QualityMeasure::feet) == Approx(0.05 / rest.structure.diagonal));
  const Shape smaller =
      mapped(rest.shape, [](const Eigen::Vector3d& p) { return Eigen::Vector3d(0.8 * p.x(), p.y(), p.z()); });
  CHECK(measured(rest, smaller, QualityMeasure::seat) == Approx(0.8));
  const double degrees = 3, slope = std::tan(degrees * std::numbers::pi / 180);
  const Shape tilted = mapped(rest.shape, [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), p.z() + slope * p.x());
  });
  CHECK(measured(rest, tilted, QualityMeasure::tilt) == Approx(degrees));
}

TEST_CASE("A bar is no seat, and a board is one", "[quality]") {
  // Above a footprint of 4 x 10, each covers a quarter of it.
  const auto lowered = [](double width, double thickness) {
    const StructuredShape rest = analyse_structure(
        concatenate(solids::named(solids::box({-2, -5, 0}, {2, 5, 0.2}), "ground"),
                    solids::named(solids::box({-width / 2, -5, 8 - thickness}, {width / 2, 5, 8}), "bar")));
    return measured(rest, with_part_moved(rest.shape, 1, {0, 0, -1.6}), QualityMeasure::seat);
  };
  CHECK(lowered(1, 0.51) == 1);
  CHECK(lowered(1, 0.49) == Approx(0.8));
  CHECK(lowered(3.4, 3.4) == Approx(0.8));  // as long as 2.9 widths
}

TEST_CASE("Posts lean more than at rest and than 15 degrees", "[quality]") {
  const auto leaning = [](double degrees) {
    const double slope = std::tan(degrees * std::numbers::pi / 180);
    return [slope](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x() + slope * p.z(), p.y(), p.z()); };
  };
  const Shape post = solids::subdivided(solids::box({-0.5, -0.5, 0}, {0.5, 0.5, 8}));
  const auto lean = [&](double rest, double now) {
    return measured(analyse_structure(mapped(post, leaning(rest))), mapped(post, leaning(now)),
                    QualityMeasure::lean);
  };
  CHECK(lean(0, 14.9) == 0);
  CHECK(lean(0, 20) == Approx(5).epsilon(1e-3));
  CHECK(lean(0, -31) == Approx(16).epsilon(1e-3));
  CHECK(lean(20, 30) == Approx(10).epsilon(1e-3));
  CHECK(lean(20, 10) == 0);
  CHECK(lean(20, -20) == Approx(0).margin(1e-6));
  // A brace is no post, nor is a block.
  CHECK(lean(50, 60) == 0);
  const Shape block = solids::subdivided(solids::box({-4, -4, 0}, {4, 4, 8}));
  CHECK(measured(analyse_structure(block), mapped(block, leaning(30)), QualityMeasure::lean) == 0);
}

TEST_CASE("Limits are relaxed by name, and shares of them are fractions", "[quality]") {
  for (std::size_t k = 0; k < quality_measure_count; ++k) {
    const auto measure = static_cast<QualityMeasure>(k);
    CHECK(quality_measure_of(name_of(measure)) == measure);
    QualityLimits limits;
    CHECK(limits.is_limited(measure));
    CHECK(share_of_limit({measure, ideal_value(measure)}, limits) == 0);
    CHECK(share_of_limit({measure, limits[measure]}, limits) ==
          Approx(ideal_value(measure) == limits[measure] ? 0 : 1));
    limits.relax(measure);
    CHECK_FALSE(limits.is_limited(measure));
    CHECK(is_within({measure, has_lower_limit(measure) ? 0 : 1e9}, limits));
  }
  CHECK_FALSE(quality_measure_of("beauty"));
  QualityLimits limits;
  limits[QualityMeasure::size] = 1.5;
  CHECK_THROWS_AS(validate(limits), UsageError);
  limits[QualityMeasure::size] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(validate(limits), UsageError);
}

TEST_CASE("A flat sheet on the ground is no seat", "[quality]") {
  Triangles triangle(1, 3);
  triangle << 0, 1, 2;
  const Shape sheet = make_shape((Points(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished(), triangle);
  const StructuredShape rest = analyse_structure(sheet);
  for (const QualityValue& value : QualityMeter(rest).measure(sheet)) {
    CAPTURE(name_of(value.measure));
    CHECK(value.value == Approx(ideal_value(value.measure)).margin(1e-12));
  }
}

TEST_CASE("Another mesh is refused", "[quality]") {
  const QualityMeter meter(plate());
  CHECK_THROWS_AS(meter.measure(structures::table().shape), UsageError);
}
