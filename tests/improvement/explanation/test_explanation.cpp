#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/explanation.h"
#include "stackabilization/improvement/tolerances.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/still_designs.h"
#include "support/structures.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;
using Lines = std::vector<std::string>;

constexpr double radians_of_degree = std::numbers::pi / 180;

Shape mapped(Shape shape, const Map& map) {
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    shape.vertices.row(v) = map(shape.vertices.row(v).transpose()).transpose();
  return shape;
}

/// Maps the vertices of the parts whose names begin with `start`.
Shape with_parts_mapped(Shape shape, const std::string& start, const Map& map) {
  std::vector<bool> moves(static_cast<std::size_t>(shape.vertex_count()));
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const std::int32_t part = shape.triangle_part[static_cast<std::size_t>(t)];
    if (shape.part_names[static_cast<std::size_t>(part)].starts_with(start))
      for (int k = 0; k < 3; ++k) moves[static_cast<std::size_t>(shape.triangles(t, k))] = true;
  }
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    if (moves[static_cast<std::size_t>(v)])
      shape.vertices.row(v) = map(shape.vertices.row(v).transpose()).transpose();
  return shape;
}

Map moved(const Eigen::Vector3d& by) {
  return [by](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p + by; };
}

Map scaled(const Eigen::Vector3d& by) {
  return [by](const Eigen::Vector3d& p) -> Eigen::Vector3d { return by.cwiseProduct(p); };
}

/// Leans the legs of `structures::table` by an angle in the plane of x and z; their upper ends stay.
Shape leaned_legs(const StructuredShape& table, double degrees) {
  const double top = range_along(extract_part(table.shape, 1), Eigen::Vector3d::UnitZ()).high;
  const double slope = std::tan(degrees * radians_of_degree);
  return with_parts_mapped(table.shape, "leg", [=](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x() + std::copysign(1.0, p.x()) * slope * (top - p.z()), p.y(), p.z());
  });
}

Lines lines_of(const StructuredShape& rest, const Shape& now, const ExplanationOptions& options = {}) {
  return lines(explain(rest, now, options));
}

double amount(const Explanation& explanation, FormChangeKind kind) {
  for (const GroupChange& group : explanation.groups)
    for (const FormChange& change : group.changes)
      if (change.kind == kind) return change.amount;
  return 0;
}

/// An upright tube of length 10 and radius 1, with rings of vertices along it.
StructuredShape upright_tube() {
  return structures::tube_alone(structures::straight_cylinder({0, 0, 0}, {0, 0, 10}, 1, 21), 32);
}

/// Boxes "base", "arm" and "castor" in a row along x, each joined to the one before.
StructuredShape base_arm_castor() {
  StructuredShape result;
  const auto add = [&](const std::string& name, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    Shape box = solids::box(low, high);
    box.part_names = {name};
    result.shape = result.structure.parts.empty() ? box : concatenate(result.shape, box);
    const Eigen::Vector3d half = (high - low) / 2;
    result.structure.parts.push_back({name, cuboid_of({low + half, Eigen::Matrix3d::Identity(), half}), {}});
  };
  add("base", {-10, -5, 0}, {0, 5, 4});
  add("arm", {0, -1, 1}, {6, 1, 3});
  add("castor", {6, -0.5, 0}, {7, 0.5, 2});
  for (const int part : {1, 2}) {
    Relation joint;
    joint.type = RelationType::point_joint;
    joint.parts = {part - 1, part};
    joint.points = Points::Zero(1, 3);
    joint.points(0, 0) = part == 1 ? 0 : 6;
    joint.points(0, 2) = 2;
    result.structure.relations.push_back(joint);
  }
  result.structure.diagonal = std::sqrt(17 * 17 + 10 * 10 + 4 * 4.0);
  return result;
}

}  // namespace

TEST_CASE("Symmetric parts on both sides of what is seen are told of together", "[explanation]") {
  const StructuredShape table = structures::table();
  const double seen = tolerance::visible * table.structure.diagonal;
  const auto raised = [&](double first, double others) {
    const Shape top = with_parts_mapped(table.shape, "top", moved({0, 0, 10 * seen}));
    const Shape all = with_parts_mapped(top, "leg", moved({others * seen, 0, 0}));
    return lines_of(table, with_parts_mapped(all, "leg_1", moved({(first - others) * seen, 0, 0})));
  };
  const Lines top = raised(0, 0);
  REQUIRE(top.size() == 1);
  CHECK(raised(1.02, 0.98) == top);
  CHECK(raised(1.5, 0.98) == Lines{top.front(), "leg 1 further in by 0.32 % of the height"});
  CHECK(raised(1.02, 1.04).size() == 3);  // two legs go in, two go out
}

TEST_CASE("An unchanged object, and one that was moved as a whole, has no lines", "[explanation]") {
  for (const StructuredShape& rest : {structures::table(), structures::mug(), structures::rough_stool()}) {
    CHECK(lines_of(rest, rest.shape).empty());
    CHECK(lines_of(rest, mapped(rest.shape, moved({3, -2, 5}))).empty());
    const Shape nearly = mapped(rest.shape, scaled({1.0005, 1, 1}));
    CHECK(lines_of(rest, nearly).empty());
  }
}

TEST_CASE("Symmetric legs that lean by an angle are one line with that angle", "[explanation]") {
  const StructuredShape rest = structures::table(2);
  for (const double degrees : {5.0, 1.2}) {
    const Explanation found = explain(rest, leaned_legs(rest, degrees));
    REQUIRE(found.groups.size() == 1);
    CHECK(found.groups[0].parts == std::vector{1, 2, 3, 4});
    REQUIRE(found.groups[0].changes.size() == 1);
    CHECK(found.groups[0].changes[0].amount == Approx(degrees).epsilon(1e-9));
  }
  CHECK(lines_of(rest, leaned_legs(rest, 5)) == Lines{"4 legs lean outwards by 5 degrees"});
  CHECK(lines_of(rest, leaned_legs(rest, -6.24)) == Lines{"4 legs lean inwards by 6.2 degrees"});
}

TEST_CASE("Legs at the long sides of a bed lean outwards across it, not sideways", "[explanation]") {
  StructuredShape bed = structures::table(2);
  bed.shape = with_parts_mapped(bed.shape, "top", scaled({6, 1, 1}));
  bed.shape = with_parts_mapped(bed.shape, "leg", [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return p + std::copysign(20.0, p.x()) * Eigen::Vector3d::UnitX();
  });
  const double top = range_along(extract_part(bed.shape, 1), Eigen::Vector3d::UnitZ()).high;
  const auto leaned = [&](double slope, bool across) {
    return with_parts_mapped(bed.shape, "leg", [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      const double by = slope * (top - p.z());
      return across ? Eigen::Vector3d(p.x(), p.y() + std::copysign(1.0, p.y()) * by, p.z())
                    : Eigen::Vector3d(p.x() + std::copysign(by, p.x()), p.y(), p.z());
    });
  };
  const double slope = std::tan(5 * radians_of_degree);
  CHECK(lines_of(bed, leaned(slope, true)) == Lines{"4 legs lean outwards by 5 degrees"});
  CHECK(lines_of(bed, leaned(-slope, true)) == Lines{"4 legs lean inwards by 5 degrees"});
  CHECK(lines_of(bed, leaned(slope, false)) == Lines{"4 legs lean outwards by 5 degrees"});
}

TEST_CASE("A rigid rotation of a leg is a lean by its angle, without a change of size", "[explanation]") {
  const StructuredShape rest = structures::table(2);
  const Eigen::AngleAxisd turn(5 * radians_of_degree, Eigen::Vector3d::UnitY());
  const Eigen::Vector3d hinge(3.5, 3.5, 5.5);
  const Shape now = with_parts_mapped(rest.shape, "leg_1", [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return hinge + turn * (p - hinge);
  });
  const Explanation found = explain(rest, now);
  REQUIRE(found.groups.size() == 1);
  CHECK(amount(found, FormChangeKind::lean) == Approx(5).epsilon(1e-9));
  CHECK(amount(found, FormChangeKind::length) == 0);
  CHECK(amount(found, FormChangeKind::thickness) == 0);
}

TEST_CASE("A panel whose faces slide along each other is as wide as before", "[explanation]") {
  Shape base = solids::box({-1, -5, -1}, {10, 5, 0}), panel = solids::box({0, 0, 0}, {9, 0.4, 8});
  base.part_names = {"base"};
  panel.part_names = {"panel"};
  const StructuredShape rest = analyse_structure(concatenate(base, panel));
  const Explanation found =
      explain(rest, with_parts_mapped(rest.shape, "panel", [](const Eigen::Vector3d& p) {
                return Eigen::Vector3d(p.x() + 0.4 * p.y(), p.y(), p.z());
              }));
  for (const FormChangeKind kind : {FormChangeKind::width, FormChangeKind::length, FormChangeKind::size,
                                    FormChangeKind::thickness, FormChangeKind::turn})
    CHECK(amount(found, kind) == 0);
}

TEST_CASE("A flat part without a name is a frame when it is mostly open, else a board or panel",
          "[explanation]") {
  const auto bars = [](double x, double y, double rim) {
    Shape frame =
        concatenate(solids::box({0, 0, 2}, {x, rim, 2.2}), solids::box({0, y - rim, 2}, {x, y, 2.2}));
    frame = concatenate(frame, solids::box({0, rim, 2}, {rim, y - rim, 2.2}));
    frame = concatenate(frame, solids::box({x - rim, rim, 2}, {x, y - rim, 2.2}));
    frame.part_names = {"part_2"};
    frame.triangle_part.assign(frame.triangle_part.size(), 0);
    return frame;
  };
  Shape block = solids::box({0, 0, 0}, {6, 5, 1.5});
  block.part_names = {"block"};
  for (const double rim : {0.5, 2.0}) {  // 7 % to 13 % of the area per bar, nearly all of it
    const StructuredShape rest = analyse_structure(concatenate(block, bars(6, 5, rim)));
    const Explanation found = explain(rest, with_parts_mapped(rest.shape, "part_2", moved({0, 0, 1})));
    REQUIRE(found.groups.size() == 1);
    CHECK(found.groups[0].name == (rim < 1 ? "frame" : "board"));
  }
}

TEST_CASE("Members without names are legs, uprights, slats and bars", "[explanation]") {
  // Posts below a top, two slats and two bars on it.
  const auto stand = [](int posts, double ground) {
    std::vector<Shape> parts{solids::box({0, 0, 7}, {10, 10, 8})};
    for (int k = 0; k < posts; ++k)
      parts.push_back(solids::box({k % 2 * 9.0, k / 2 * 9.0, ground}, {k % 2 * 9.0 + 1, k / 2 * 9.0 + 1, 7}));
    parts.push_back(solids::box({0, 2, 8}, {10, 3.5, 8.5}));
    parts.push_back(solids::box({0, 6, 8}, {10, 6.8, 8.5}));
    if (ground > 0) parts.push_back(solids::box({4, 4, 0}, {6, 6, 7}));
    Shape shape = parts[0];
    for (std::size_t k = 1; k < parts.size(); ++k) shape = concatenate(shape, parts[k]);
    for (std::size_t k = 0; k < parts.size(); ++k) shape.part_names[k] = "part_" + std::to_string(k + 1);
    return analyse_structure(shape);
  };
  const auto name_of_moved = [](const StructuredShape& rest, int part) {
    const std::string name = "part_" + std::to_string(part);
    const Explanation found = explain(rest, with_parts_mapped(rest.shape, name, moved({0, 0, 0.2})));
    REQUIRE(found.groups.size() == 1);
    return found.groups[0].name.substr(0, found.groups[0].name.find(' '));
  };
  const StructuredShape table = stand(4, 0);
  CHECK(name_of_moved(table, 2) == "leg");
  CHECK(name_of_moved(table, 6) == "slat");
  CHECK(name_of_moved(table, 7) == "bar");
  CHECK(name_of_moved(stand(2, 0), 2) == "upright");
  CHECK(name_of_moved(stand(4, 0.5), 2) == "upright");
}

TEST_CASE("A mug without names has a body and a handle", "[explanation]") {
  const auto named = [](const std::vector<std::string>& names) {
    StructuredShape mug = structures::mug();
    mug.shape.part_names = names;
    for (std::size_t p = 0; p < names.size(); ++p) mug.structure.parts[p].name = names[p];
    return mug;
  };
  const StructuredShape mug = named({"part_1", "part_2"});
  const auto name_of_moved = [](const StructuredShape& rest, const std::string& part) {
    const Explanation found = explain(rest, with_parts_mapped(rest.shape, part, scaled({1, 1, 0.8})));
    REQUIRE(found.groups.size() == 1);
    return found.groups[0].name;
  };
  CHECK(name_of_moved(mug, "part_1") == "body");
  CHECK(name_of_moved(mug, "part_2") == "handle");

  StructuredShape once_joined = mug, standing = mug;
  once_joined.structure.relations.pop_back();
  CHECK(name_of_moved(once_joined, "part_2") != "handle");
  standing.shape = with_parts_mapped(mug.shape, "part_2", moved({0, 0, -1.6}));
  CHECK(name_of_moved(standing, "part_2") != "handle");

  standing.shape = with_parts_mapped(mug.shape, "part_2", moved({-6, 0, 0}));  // around the axis of the body
  CHECK(name_of_moved(standing, "part_2") != "handle");
  ExplanationOptions lying;
  lying.up = Eigen::Vector3d::UnitY();
  const Shape lower = with_parts_mapped(mug.shape, "part_2", scaled({1, 1, 0.8}));
  CHECK(explain(mug, lower, lying).groups.at(0).name != "handle");
  CHECK(name_of_moved(named({"vessel", "grip"}), "vessel") == "vessel");
  CHECK(name_of_moved(named({"vessel", "grip"}), "grip") == "grip");
}

TEST_CASE("Walls lean by their angle, however long they are", "[explanation]") {
  for (const double length : {4.0, 8.0}) {  // as long as a panel, and as a member
    Shape tray = solids::box({0, 0, 0}, {length, 5, 0.1});
    tray.part_names = {"floor"};
    for (const double y : {0.0, 4.9}) {
      Shape wall = solids::box({0, y, 0.1}, {length, y + 0.1, 2.1});
      wall.part_names = {y > 0 ? "back" : "front"};
      tray = concatenate(tray, wall);
    }
    const StructuredShape rest = analyse_structure(tray);
    const double slope = std::tan(5 * radians_of_degree);
    const Explanation found = explain(rest, mapped(rest.shape, [=](const Eigen::Vector3d& p) {
                                        const double by = slope * std::max(0.0, p.z() - 0.1);
                                        return Eigen::Vector3d(p.x(), p.y() + (p.y() > 2 ? by : -by), p.z());
                                      }));
    REQUIRE(found.groups.size() == 1);
    CHECK(found.groups[0].parts == std::vector{1, 2});
    REQUIRE(found.groups[0].changes.size() == 1);
    CHECK(found.groups[0].changes[0].kind == FormChangeKind::lean);
    CHECK(found.groups[0].changes[0].amount == Approx(5).epsilon(1e-9));
  }
}

TEST_CASE("A plate that gets narrower does so by its ratio", "[explanation]") {
  const StructuredShape rest = structures::box_alone({12, 8, 1});
  const auto line = [&](const Eigen::Vector3d& by) { return lines_of(rest, mapped(rest.shape, scaled(by))); };
  CHECK(line({1, 0.93, 1}) == Lines{"box 7 % narrower"});
  CHECK(line({1.07, 1, 1}) == Lines{"box 7 % longer"});
  CHECK(line({0.93, 0.93, 1}) == Lines{"box 7 % smaller"});
  CHECK(line({1, 1, 0.9}) == Lines{"box 10 % thinner"});
  CHECK(line({1, 0.945, 1}) == Lines{"box 5.5 % narrower"});
}

TEST_CASE("A bar that is raised is higher by its way, in a unit that a person reads", "[explanation]") {
  StructuredShape rest = structures::table();
  const double height = range_along(rest.shape, Eigen::Vector3d::UnitZ()).length();
  const Shape now = with_parts_mapped(rest.shape, "bar_1", moved({0, 0, 0.04 * height}));
  CHECK(lines_of(rest, now) == Lines{"bar 1 higher by 4 % of the height"});
  rest.shape.unit = Unit::centimetre;
  const Shape lower = with_parts_mapped(rest.shape, "bar", moved({0, 0, -0.3}));
  CHECK(lines_of(rest, lower) == Lines{"4 bars 3 mm lower"});
}

TEST_CASE("A cylinder that becomes a cone has other widths at its ends", "[explanation]") {
  const StructuredShape rest = upright_tube();
  const auto cone = [&](double low, double high) {
    return explain(rest, mapped(rest.shape, [=](const Eigen::Vector3d& p) {
                     const double factor = low + (high - low) * p.z() / 10;
                     return Eigen::Vector3d(factor * p.x(), factor * p.y(), p.z());
                   }));
  };
  const Explanation tapered = cone(1, 1.1);
  CHECK(amount(tapered, FormChangeKind::upper_end) == Approx(0.1).margin(0.002));
  CHECK(lines(tapered) == Lines{"tube: upper end 10 % thicker"});
  CHECK(lines(cone(0.88, 1)) == Lines{"tube: lower end 12 % thinner"});
  CHECK(lines(cone(1.05, 1.05)) == Lines{"tube 5 % thicker"});
}

TEST_CASE("A vessel has a rim and a foot", "[explanation]") {
  solids::Polygon profile = {{0, 0}, {1, 0}};  // up the outer wall, down the inner one
  for (int k = 0; k <= 20; ++k) profile.emplace_back(2, 0.4 * k);
  for (int k = 20; k >= 1; --k) profile.emplace_back(1.8, 0.4 * k);
  profile.emplace_back(1, 0.4);
  profile.emplace_back(0, 0.4);
  const StructuredShape rest = designs::alone(solids::surface_of_revolution(profile, 24),
                                              structures::straight_cylinder({0, 0, 0}, {0, 0, 8}, 2, 5));
  const Explanation found = explain(rest, mapped(rest.shape, [](const Eigen::Vector3d& p) {
                                      const double factor = 0.92 + 0.13 * p.z() / 8;
                                      return Eigen::Vector3d(factor * p.x(), factor * p.y(), p.z());
                                    }));
  CHECK(amount(found, FormChangeKind::rim) == Approx(0.05).margin(0.004));
  CHECK(amount(found, FormChangeKind::foot) == Approx(-0.08).margin(0.004));
}

TEST_CASE("A body whose walls lean has other widths at its ends", "[explanation]") {
  const auto tapered = [](Shape shape, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                          double twist = 0, double stretch = 1) {
    while (shape.triangle_count() < 1000) shape = solids::subdivided(shape);
    const Shape now = mapped(shape, [&](const Eigen::Vector3d& p) {
      const Eigen::Vector2d factors = low + p.z() / 3 * (high - low);
      const double turn = (p.z() / 3 - 0.5) * twist;
      return Eigen::Vector3d(factors.x() * p.x() - turn * p.y(), factors.y() * p.y() + turn * p.x(),
                             stretch * p.z());
    });
    return explain(
        designs::alone(std::move(shape), structures::box_alone({6, 4, 3}).structure.parts[0].primitive), now);
  };
  const Shape block = solids::box({-3, -2, 0}, {3, 2, 3});
  Shape crate = block;
  Eigen::Index kept = 0;
  for (Eigen::Index t = 0; t < block.triangle_count(); ++t) {
    double low = 3;
    for (int k = 0; k < 3; ++k) low = std::min(low, block.corner(t, k).z());
    if (low < 3) crate.triangles.row(kept++) = block.triangles.row(t);
  }
  crate.triangles.conservativeResize(kept, 3);
  crate.triangle_part.resize(static_cast<std::size_t>(kept));

  const Explanation foot = tapered(crate, {0.88, 0.88}, {1, 1});
  CHECK(lines(foot) == Lines{"part: foot 12 % narrower"});
  CHECK(lines(tapered(block, {0.88, 0.88}, {1, 1})) == Lines{"part: lower end 12 % thinner"});
  CHECK(lines(tapered(crate, {1, 1}, {1.2, 1.2})) == Lines{"part: rim 20 % wider"});

  const Explanation taller = tapered(crate, {0.88, 0.88}, {1, 1}, 0, 1.2);
  CHECK(lines(taller) == Lines{"part 20 % taller, foot 12 % narrower"});
  CHECK(amount(tapered(crate, {1, 1}, {1, 1}, 0.5), FormChangeKind::form) > 0.01);

  // Of two widths the root of their product; one width alone, or against the other, has no such word.
  const Explanation both = tapered(crate, {0.8, 0.9}, {1, 1});
  CHECK(amount(both, FormChangeKind::foot) == Approx(std::sqrt(0.72) - 1).margin(0.002));
  CHECK(amount(both, FormChangeKind::form) == 0);
  for (const Eigen::Vector2d& low : {Eigen::Vector2d(0.8, 1), Eigen::Vector2d(0.8, 1.2)}) {
    const Explanation other = tapered(crate, low, {1, 1});
    CHECK(amount(other, FormChangeKind::foot) == 0);
    CHECK(amount(other, FormChangeKind::form) > 0);
  }
}

TEST_CASE("A pose and a scale change no words", "[explanation]") {
  const StructuredShape rest = structures::table(2);
  const Shape now = with_parts_mapped(leaned_legs(rest, 4), "bar", moved({0, 0, 0.3}));
  const Lines expected = lines_of(rest, now);
  CHECK(expected == Lines{"4 legs lean outwards by 4 degrees", "4 bars higher by 5 % of the height"});
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d::UnitZ());
  const Map posed = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return 3 * (turn * p) + Eigen::Vector3d(1, 2, 3);
  };
  StructuredShape elsewhere = rest;
  elsewhere.shape = mapped(rest.shape, posed);
  elsewhere.structure.diagonal *= 3;
  for (Part& part : elsewhere.structure.parts) {
    auto& corners = std::get<Cuboid>(part.primitive).corners;
    for (Eigen::Index k = 0; k < 8; ++k) corners.row(k) = posed(corners.row(k).transpose()).transpose();
  }
  CHECK(lines_of(elsewhere, mapped(now, posed)) == expected);
  CHECK(lines_of(rest, mapped(now, moved({1, 2, 3}))) == expected);
}

TEST_CASE("What changed by one affine map is the whole object", "[explanation]") {
  const StructuredShape rest = structures::table();
  CHECK(lines_of(rest, mapped(rest.shape, scaled({1.05, 1.05, 1.05}))) == Lines{"whole object 5 % larger"});
  CHECK(lines_of(rest, mapped(rest.shape, scaled({0.95, 0.95, 1}))) ==
        Lines{"whole object 5 % narrower all round"});
}

TEST_CASE("A part that is carried along follows", "[explanation]") {
  const StructuredShape rest = base_arm_castor();
  const Shape now = with_parts_mapped(with_parts_mapped(rest.shape, "arm", moved({0, 0, 0.4})), "castor",
                                      moved({0, 0, 0.4}));
  // The arm is larger than the castor.
  CHECK(lines_of(rest, now) == Lines{"arm higher by 10 % of the height (castor follows)"});
  ExplanationOptions options;
  options.edits = {{{HandleKind::part, 2, 0}, Move{{0, 0, 0.4}}}};
  CHECK(lines_of(rest, now, options) == Lines{"castor higher by 10 % of the height (arm follows)"});
}

TEST_CASE("The reason of an edit ends the line of its part", "[explanation]") {
  const StructuredShape rest = structures::table(2);
  ExplanationOptions options;
  options.edits = {{{HandleKind::face, 3, 4}, Move{{0.1, 0, 0}}}};
  options.reasons = {{EditEffect::outwards, true, 0}};
  CHECK(lines_of(rest, leaned_legs(rest, 5), options) ==
        Lines{"4 legs lean outwards by 5 degrees, to clear the top of the next copy"});
  options.edits.push_back(options.edits.front());
  for (const bool named_first : {false, true}) {
    options.reasons = {{EditEffect::outwards, true, named_first ? 0 : -1},
                       {EditEffect::outwards, true, named_first ? -1 : 0}};
    CHECK(lines_of(rest, leaned_legs(rest, 5), options) ==
          Lines{"4 legs lean outwards by 5 degrees, to clear the top of the next copy"});
  }
  options.edits.pop_back();
  options.reasons = {{EditEffect::compensation}};
  CHECK(lines_of(rest, leaned_legs(rest, 5), options) == Lines{"4 legs lean outwards by 5 degrees"});
}

TEST_CASE("Changes beyond the number of lines are summed up", "[explanation]") {
  const StructuredShape rest = structures::table(2);
  Shape now = leaned_legs(rest, 5);
  for (int bar = 1; bar <= 4; ++bar)
    now = with_parts_mapped(now, "bar_" + std::to_string(bar), moved({0, 0, 0.05 * bar}));
  const Explanation found = explain(rest, now);
  CHECK(lines(found).size() == 5);
  CHECK(lines(found, 3) == Lines{"4 legs lean outwards by 5 degrees", "bar 4 higher by 3.3 % of the height",
                                 "and 3 more parts by less than 3 % of the height"});
}

TEST_CASE("A change that is hardly seen beside another one of the object is not named", "[explanation]") {
  const StructuredShape rest = structures::table(2);
  const Shape raised = with_parts_mapped(rest.shape, "bar_1", moved({0.02, 0, 0.05}));
  CHECK(lines_of(rest, raised).front().starts_with("bar 1 higher by"));
  CHECK(lines_of(rest, raised).front().find("to the side") != std::string::npos);
  const Lines beside =
      lines_of(rest, with_parts_mapped(leaned_legs(rest, 5), "bar_1", moved({0.02, 0, 0.05})));
  REQUIRE(beside.size() == 2);
  CHECK(beside[0] == "4 legs lean outwards by 5 degrees");
  CHECK(beside[1].starts_with("bar 1 higher by"));
  CHECK(beside[1].find("to the side") == std::string::npos);
}

TEST_CASE("What gets wider one way and narrower the other way says so", "[explanation]") {
  const StructuredShape rest = structures::box_alone({9, 8, 5});
  const Lines found = lines_of(rest, mapped(rest.shape, scaled({1.05, 0.96, 1})));
  REQUIRE(found.size() == 1);
  CHECK(found[0].find("5 % wider one way") != std::string::npos);
  CHECK(found[0].find("4 % narrower the other way") != std::string::npos);
  // Two that do so are one line.
  Shape left = solids::box({0, 0, 0}, {9, 8, 5}), right = solids::box({20, 0, 0}, {29, 8, 5});
  left.part_names = {"crate_1"};
  right.part_names = {"crate_2"};
  const StructuredShape pair = analyse_structure(concatenate(left, right));
  const Map alike = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const Eigen::Vector3d centre(p.x() < 15 ? 4.5 : 24.5, 4, 2.5);
    return centre + Eigen::Vector3d(1.05, 0.96, 1).cwiseProduct(p - centre);
  };
  CHECK(explain(pair, mapped(pair.shape, alike)).groups.size() == 1);
}

TEST_CASE("A part that is longer and less tall is not called longer and shorter", "[explanation]") {
  const auto words = [](FormChangeKind kind, double amount) {
    FormChange change;
    change.kind = kind;
    change.amount = amount;
    return describe(change, {}, false);
  };
  CHECK(words(FormChangeKind::tallness, -0.16) == "16 % less tall");
  CHECK(words(FormChangeKind::tallness, 0.16) == "16 % taller");
  CHECK(words(FormChangeKind::length, -0.05) == "5 % shorter");
}

TEST_CASE("A part that no affine map describes changes its form", "[explanation]") {
  const StructuredShape rest = structures::box_alone({12, 8, 1});
  const Shape folded = mapped(rest.shape, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), p.z() + 0.2 * std::abs(p.x()));
  });
  CHECK(amount(explain(rest, folded), FormChangeKind::form) > 0.2);
}

TEST_CASE("The description of another mesh is refused", "[explanation]") {
  CHECK_THROWS_AS(explain(structures::table(), structures::mug().shape), UsageError);
}
