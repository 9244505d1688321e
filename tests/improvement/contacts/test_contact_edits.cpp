#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/contact_edits.h"
#include "stackabilization/stacking/stackability.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/handles.h"
#include "support/solids.h"
#include "support/structures.h"
#include "support/variants.h"

namespace stackabilization {
namespace {

using Eigen::Vector3d;

std::vector<ContactRegion> regions_of(const Shape& shape, const Direction& direction) {
  const SeparationTree tree(shape);
  return contact_regions({shape, tree, direction, separation(tree, tree, direction)}).regions;
}

/// The edits of a structured shape at rest.
std::vector<ContactEdit> edits_of(const StructuredShape& rest, const std::vector<ContactRegion>& regions,
                                  const Direction& direction, const ContactEditOptions& options = {}) {
  const auto space = deformation_model(rest);
  const Design design = space->at_rest();
  const std::vector<Handle> handles = space->handles();
  return contact_edits({space->rest(), space->capabilities(), handles, design, regions, direction}, options);
}

DeformationConstraints keep_height() {
  DeformationConstraints constraints;
  constraints.keep_extent = upwards;
  return constraints;
}

ContactEditOptions paper() {
  ContactEditOptions options;
  options.family = EditFamily::paper;
  options.bends = true;
  return options;
}

/// A small square of contact around `upper` on part `upper_part` and `lower` on `lower_part`.
ContactRegion region_at(ContactType type, const std::array<int, 2>& parts, const Vector3d& upper,
                        const Vector3d& lower) {
  ContactRegion region;
  region.type = type;
  region.upper_part = parts[0];
  region.lower_part = parts[1];
  region.area = 0.01;
  region.upper_centre = upper;
  region.lower_centre = lower;
  region.long_axis = Vector3d::UnitX();
  const double half = 0.05;
  ContactPolygon polygon{0, 0, Points(4, 3), Points(4, 3)};
  for (int k = 0; k < 4; ++k) {
    const Eigen::RowVector3d corner(k == 0 || k == 3 ? -half : half, k < 2 ? -half : half, 0);
    polygon.upper_points.row(k) = upper.transpose() + corner;
    polygon.lower_points.row(k) = lower.transpose() + corner;
  }
  region.polygons = {polygon};
  return region;
}

bool nearly_same(const Edit& a, const Edit& b) {
  if (!(a.handle == b.handle) || a.falloff != b.falloff || a.operation.index() != b.operation.index())
    return false;
  if (const auto* move = std::get_if<Move>(&a.operation))
    return (move->by - std::get<Move>(b.operation).by).norm() < 1e-6;
  const Scale &one = std::get<Scale>(a.operation), &other = std::get<Scale>(b.operation);
  if (std::abs(one.factor - other.factor) > 1e-6 || one.along.has_value() != other.along.has_value())
    return false;
  return !one.along || one.along->cross(*other.along).norm() < 1e-6;
}

bool offers(const std::vector<ContactEdit>& edits, const Edit& edit) {
  return std::any_of(edits.begin(), edits.end(),
                     [&](const ContactEdit& one) { return nearly_same(one.edit, edit); });
}

bool moves_along(const ContactEdit& edit, const Vector3d& axis) {
  const auto* move = std::get_if<Move>(&edit.edit.operation);
  return move != nullptr && std::abs(move->by.dot(axis)) > 1e-9;
}

Edit move_of(HandleKind kind, int part, int index, const Vector3d& by) {
  return {{kind, part, index}, Move{by}};
}

/// Everything about a structured shape, turned by `rotation` around the origin.
StructuredShape turned(StructuredShape rest, const Eigen::Matrix3d& rotation) {
  rest.shape = transformed(rest.shape, rotation, Vector3d::Zero());
  for (Part& part : rest.structure.parts) {
    auto& cuboid = std::get<Cuboid>(part.primitive);
    cuboid.corners = (cuboid.corners * rotation.transpose()).eval();
  }
  for (Relation& relation : rest.structure.relations) {
    relation.points = (relation.points * rotation.transpose()).eval();
    relation.symmetry.point = rotation * relation.symmetry.point;
    relation.symmetry.axis = rotation * relation.symmetry.axis;
  }
  return rest;
}

ContactRegion turned(ContactRegion region, const Eigen::Matrix3d& rotation) {
  region.upper_centre = rotation * region.upper_centre;
  region.lower_centre = rotation * region.lower_centre;
  region.long_axis = rotation * region.long_axis;
  for (ContactPolygon& polygon : region.polygons) {
    polygon.upper_points = (polygon.upper_points * rotation.transpose()).eval();
    polygon.lower_points = (polygon.lower_points * rotation.transpose()).eval();
  }
  return region;
}

Edit turned(Edit edit, const Eigen::Matrix3d& rotation) {
  if (auto* move = std::get_if<Move>(&edit.operation)) move->by = rotation * move->by;
  auto* scale = std::get_if<Scale>(&edit.operation);
  if (scale != nullptr && scale->along) scale->along = rotation * *scale->along;
  return edit;
}

/// Straight, open at the top, outer radius 4, inner 3.5, height 10, in 11 sections.
StructuredShape straight_cup() {
  StructuredShape cup =
      structures::tube_alone(structures::straight_cylinder({0, 0, 0}, {0, 0, 10}, 4, 11), 8);
  solids::FrustumShell shell;
  shell.outer_bottom = shell.outer_top = 4;
  shell.inner_bottom = shell.inner_top = 3.5;
  shell.height = 10;
  cup.shape = solids::frustum_shell(shell);
  cup.shape.part_names = {"tube"};
  return cup;
}

TEST_CASE("the paper moves the corner of a table top and the foot of a leg sideways") {
  const StructuredShape table = structures::table();
  const auto regions = regions_of(table.shape, upwards);
  REQUIRE(regions.size() == 4);
  const auto edits = edits_of(table, regions, upwards, paper());
  const int top = structures::part_named(table, "top"), leg = regions[0].lower_part;
  const Vector3d at = regions[0].upper_centre;
  // Six ways for the corner and for the foot; the face of the top cannot leave its two mirror planes.
  CHECK(edits.size() == 12);
  for (const ContactEdit& one : edits) {
    CHECK_FALSE(moves_along(one, Vector3d::UnitZ()));
    CHECK(one.of_lower_copy == (one.edit.handle.part == top));
    CHECK(one.edit.handle.kind == (one.of_lower_copy ? HandleKind::corner : HandleKind::face));
  }
  const int corner = 4 + (at.x() > 0 ? 1 : 0) + (at.y() > 0 ? 2 : 0);
  const Vector3d outwards = Vector3d(at.x(), at.y(), 0).normalized();
  for (const Vector3d& by :
       {Vector3d(0.48, 0, 0), Vector3d(-0.48, 0, 0), Vector3d(0, 0.48, 0), Vector3d(0, -0.48, 0),
        Vector3d(0.06 * 8 * std::sqrt(2.0) * outwards), Vector3d(-0.06 * 8 * std::sqrt(2.0) * outwards)}) {
    CHECK(offers(edits, move_of(HandleKind::corner, top, corner, by)));
    CHECK(offers(edits, move_of(HandleKind::face, leg, 4, by)));
  }
}

TEST_CASE("the extended family goes as far as it takes to pass the other part") {
  const StructuredShape table = structures::table();
  const auto regions = regions_of(table.shape, upwards);
  const auto edits = edits_of(table, regions, upwards);
  const int top = structures::part_named(table, "top"), leg = regions[0].lower_part;
  const double side = regions[0].upper_centre.x() > 0 ? 1 : -1;
  // The foot's inner side, at 3.1, has to pass the edge at 4, with the band of 0.0125 of 8.
  CHECK(offers(edits, move_of(HandleKind::face, leg, 4, {side * 1.0, 0, 0})));
  CHECK(offers(edits, move_of(HandleKind::face, leg, 4, {side * 0.48, 0, 0})));
  CHECK_FALSE(offers(edits, move_of(HandleKind::face, leg, 4, {side * 3 * 0.48, 0, 0})));
  // The longer way is tried in one size.
  CHECK(offers(edits, move_of(HandleKind::face, leg, 4, {-side * 0.48, 0, 0})));
  CHECK_FALSE(offers(edits, move_of(HandleKind::face, leg, 4, {-side * 3 * 0.48, 0, 0})));
  CHECK(offers(edits, move_of(HandleKind::face, leg, 5, {side * 0.48, 0, 0})));
  CHECK(offers(edits, move_of(HandleKind::part, leg, 0, {side * 0.48, 0, 0})));
  // The edge of the top at 4 shrinks to 3.1 less the band.
  for (const Vector3d axis : {Vector3d::UnitX(), Vector3d::UnitY()})
    CHECK(offers(edits, {{HandleKind::part, top, 0}, Scale{0.75, axis}}));
  CHECK(edits.size() > 12);
  CHECK(edits.size() <= 60);
}

TEST_CASE("edits that move the contacts apart let copies sink deeper") {
  const StructuredShape table = structures::table();
  const auto space = deformation_model(table);
  const auto edits = edits_of(table, regions_of(table.shape, upwards), upwards);
  const double before = minimal_stacking_translation(table.shape, upwards).length;
  double least = before;
  for (const ContactEdit& one : edits) {
    const DeformationResult outcome = space->edited(space->at_rest(), one.edit, keep_height());
    if (outcome.refusal) continue;
    least = std::min(least, minimal_stacking_translation(outcome.design.shape, upwards).length);
  }
  CHECK(before == Approx(6));
  CHECK(least < 5.9);
}

TEST_CASE("edits turn with the shape") {
  const StructuredShape table = structures::table();
  const int top = structures::part_named(table, "top"), bar = structures::part_named(table, "bar_2");
  const std::vector<ContactRegion> regions = {
      region_at(ContactType::dot, {top, structures::part_named(table, "leg_1")}, {-3.5, -3.5, 6},
                {-3.5, -3.5, 0}),
      region_at(ContactType::line, {top, bar}, {3.5, 0, 6}, {3.5, 0, 2})};
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Eigen::Matrix3d rotation = solids::random_rotation(seed);
    std::vector<ContactRegion> turned_regions;
    for (const ContactRegion& region : regions) turned_regions.push_back(turned(region, rotation));
    for (const ContactEditOptions& options : {ContactEditOptions{}, paper()}) {
      const auto edits = edits_of(table, regions, upwards, options);
      const auto turned_edits =
          edits_of(turned(table, rotation), turned_regions, Direction(rotation.col(2)), options);
      REQUIRE(edits.size() == turned_edits.size());
      for (const ContactEdit& one : edits) CHECK(offers(turned_edits, turned(one.edit, rotation)));
    }
  }
}

TEST_CASE("what touches from above moves up, what is touched moves down, but not the top and bottom") {
  const StructuredShape table = structures::table();
  const int top = structures::part_named(table, "top"), bar = structures::part_named(table, "bar_1");
  const auto on_top =
      edits_of(table, {region_at(ContactType::dot, {top, bar}, {0, -3.5, 6}, {0, -3.5, 2})}, upwards);
  CHECK(offers(on_top, move_of(HandleKind::face, bar, 4, {0, 0, 0.36})));
  CHECK(offers(on_top, move_of(HandleKind::face, bar, 4, {0, 0, 3 * 0.36})));
  CHECK(offers(on_top, move_of(HandleKind::part, bar, 0, {0, 0, 0.36})));
  for (const ContactEdit& one : on_top)
    if (moves_along(one, Vector3d::UnitZ())) {
      CHECK(one.edit.handle.part == bar);
      CHECK(std::get<Move>(one.edit.operation).by.z() > 0);
      CHECK_FALSE(one.of_lower_copy);
    }
  const auto between = edits_of(
      table, {region_at(ContactType::dot, {bar, bar}, {0, -3.5, 2.4}, {0, -3.5, 2})}, upwards, paper());
  CHECK(offers(between, move_of(HandleKind::face, bar, 5, {0, 0, -0.36})));
  CHECK(offers(between, move_of(HandleKind::face, bar, 4, {0, 0, 0.36})));
  CHECK_FALSE(offers(between, move_of(HandleKind::face, bar, 5, {0, 0, 0.36})));
}

TEST_CASE("a part that meets itself is made flatter, but not one that makes the height") {
  const StructuredShape table = structures::table();
  const int bar = structures::part_named(table, "bar_1"), leg = structures::part_named(table, "leg_1");
  const Scale flatter{0.9, Vector3d::UnitZ()};
  const auto bars =
      edits_of(table, {region_at(ContactType::dot, {bar, bar}, {0, -3.5, 2.4}, {0, -3.5, 2})}, upwards);
  CHECK(offers(bars, {{HandleKind::part, bar, 0}, flatter}));
  const auto legs =
      edits_of(table, {region_at(ContactType::dot, {leg, leg}, {-3.5, -3.5, 5.5}, {-3.5, -3.5, 0})}, upwards);
  CHECK_FALSE(offers(legs, {{HandleKind::part, leg, 0}, flatter}));
}

TEST_CASE("lines move along r and across themselves only") {
  const StructuredShape table = structures::table();
  const int bar = structures::part_named(table, "bar_1");
  const std::vector<ContactRegion> regions = {
      region_at(ContactType::line, {bar, bar}, {1, -3.5, 2.4}, {1, -3.5, 2})};
  for (const ContactEditOptions& options : {ContactEditOptions{}, paper()}) {
    const auto edits = edits_of(table, regions, upwards, options);
    CHECK(std::any_of(edits.begin(), edits.end(),
                      [](const auto& e) { return moves_along(e, Vector3d::UnitY()); }));
    CHECK(std::any_of(edits.begin(), edits.end(),
                      [](const auto& e) { return moves_along(e, Vector3d::UnitZ()); }));
    for (const ContactEdit& one : edits) CHECK_FALSE(moves_along(one, Vector3d::UnitX()));
  }
}

TEST_CASE("symmetric regions count once") {
  StructuredShape table = structures::table();
  const auto regions = regions_of(table.shape, upwards);
  const auto all = edits_of(table, regions, upwards), first = edits_of(table, {regions[0]}, upwards);
  REQUIRE(all.size() == first.size());
  for (std::size_t k = 0; k < all.size(); ++k) CHECK(nearly_same(all[k].edit, first[k].edit));

  table.structure.relations.clear();
  const auto each = edits_of(table, regions, upwards, paper());
  CHECK(each.back().region == 3);
  // Without symmetry the face of the top can be moved as well, by each of the four to both sides of two
  // diagonals, and to both sides of both axes.
  CHECK(each.size() == 4 * 12 + 8);
  ContactEditOptions few = paper();
  few.max_regions = 2;
  CHECK(edits_of(table, regions, upwards, few).back().region == 1);
}

TEST_CASE("a round body is one region however it is turned") {
  const StructuredShape cup = straight_cup();
  StructuredShape round = cup;
  Relation relation;
  relation.type = RelationType::self_symmetry;
  relation.parts = {0};
  relation.symmetry = {SymmetryKind::revolution, Vector3d::Zero(), Vector3d::UnitZ(), 2};
  round.structure.relations = {relation};
  std::vector<ContactRegion> regions;
  for (const double angle : {0.0, 1.0, 2.0}) {
    const Vector3d side(4 * std::cos(angle), 4 * std::sin(angle), 0);
    regions.push_back(
        region_at(ContactType::dot, {0, 0}, side + Vector3d(0, 0, 6), side + Vector3d(0, 0, 3)));
  }
  const auto once = edits_of(round, regions, upwards, paper());
  for (const ContactEdit& one : once) {
    CHECK(one.region == 0);
    CHECK_FALSE(moves_along(one, Vector3d::UnitX()));  // off its axis of revolution
  }
  CHECK_FALSE(once.empty());
  CHECK(edits_of(cup, regions, upwards, paper()).back().region == 2);
}

TEST_CASE("rings scale cross-sections") {
  const StructuredShape cup = straight_cup();
  const auto regions = regions_of(cup.shape, upwards);
  REQUIRE(regions.size() == 1);
  REQUIRE(regions[0].type == ContactType::ring);
  const auto edits = edits_of(cup, regions, upwards, paper());
  REQUIRE(edits.size() == 4);
  for (const double factor : {0.9, 1.1})
    for (const int section : {0, 10})
      CHECK(offers(edits, {{HandleKind::section, 0, section}, Scale{factor, std::nullopt}}));
  CHECK(edits[0].edit.handle.index == 10);
  CHECK(edits[0].of_lower_copy);

  const auto extended = edits_of(cup, regions, upwards);
  CHECK(offers(extended, {{HandleKind::section, 0, 0}, Scale{0.7, std::nullopt}, Falloff::linear}));
  for (const ContactEdit& one : extended) {
    CHECK_FALSE(moves_along(one, Vector3d::UnitZ()));
    // A straight wall gets no waist.
    if (one.edit.handle.kind == HandleKind::section) CHECK(one.edit.falloff == Falloff::linear);
  }

  const auto space = deformation_model(cup);
  const DeformationResult outcome =
      space->edited(space->at_rest(),
                    {{HandleKind::section, 0, 0}, Scale{0.7, std::nullopt}, Falloff::linear}, keep_height());
  REQUIRE_FALSE(outcome.refusal);
  CHECK(minimal_stacking_translation(outcome.design.shape, upwards).length < 6);
}

TEST_CASE("contacts amid a leg lean it by its ends") {
  const StructuredShape tube =
      structures::tube_alone(structures::straight_cylinder({2, 0, 0}, {2, 0, 10}, 0.5, 11), 8);
  const std::vector<ContactRegion> regions = {region_at(ContactType::dot, {0, 0}, {2.5, 0, 6}, {1.5, 0, 4})};
  const auto edits = edits_of(tube, regions, upwards);
  const double step = 0.06;  // of the width 1
  for (const int end : {0, 10})
    CHECK(offers(edits, {{HandleKind::section, 0, end}, Move{{step, 0, 0}}, Falloff::linear}));
  for (const ContactEdit& one : edits)
    if (one.edit.handle.kind == HandleKind::section) CHECK(one.edit.falloff == Falloff::linear);
  const auto as_published = edits_of(tube, regions, upwards, paper());
  CHECK(offers(as_published, {{HandleKind::section, 0, 6}, Move{{step, 0, 0}}}));
  for (const ContactEdit& one : as_published) CHECK(one.edit.falloff == Falloff::gaussian);

  ContactEditOptions straight = paper();
  straight.bends = false;
  const auto leaning = edits_of(tube, regions, upwards, straight);
  CHECK(offers(leaning, {{HandleKind::section, 0, 10}, Move{{step, 0, 0}}, Falloff::linear}));
  for (const ContactEdit& one : leaning) CHECK(one.edit.falloff == Falloff::linear);
}

TEST_CASE("every effect of an edit has its words") {
  using enum EditEffect;
  const std::vector<std::string> parts = {"leg", "seat"};
  const std::vector<std::pair<EditEffect, std::string>> words = {
      {down, "down, away from 'seat'"},         {up, "up, away from 'seat'"},
      {outwards, "outwards, away from 'seat'"}, {inwards, "inwards, away from 'seat'"},
      {sideways, "sideways, away from 'seat'"}, {edge_inwards, "edge inwards, away from 'seat'"},
      {narrower, "narrower, away from 'seat'"}, {wider, "wider, away from 'seat'"},
      {flatter, "flatter, away from 'seat'"},   {squash, "everything below squashed upwards"},
      {compensation, "makes up for the others"}};
  REQUIRE(words.size() == static_cast<std::size_t>(compensation) + 1);
  for (std::size_t k = 0; k < words.size(); ++k) {
    CHECK(words[k].first == static_cast<EditEffect>(k));
    CHECK(describe({words[k].first, false, 1}, parts) == words[k].second);
  }
  CHECK(describe({outwards, true}, parts) == "leaning outwards, away from the next copy");
  CHECK_THROWS_AS(describe({down, false, 2}, parts), std::out_of_range);
}

TEST_CASE("suggestions are ordered, different, and the same every time") {
  const StructuredShape mug = structures::mug();
  const auto regions = regions_of(mug.shape, Direction(0.1, 0, 1));
  const auto edits = edits_of(mug, regions, Direction(0.1, 0, 1));
  const auto again = edits_of(mug, regions, Direction(0.1, 0, 1));
  REQUIRE_FALSE(edits.empty());
  REQUIRE(edits.size() == again.size());
  const auto space = deformation_model(mug);
  for (std::size_t k = 0; k < edits.size(); ++k) {
    CHECK(nearly_same(edits[k].edit, again[k].edit));
    CHECK(edits[k].reason == again[k].reason);
    for (std::size_t l = 0; l < k; ++l) CHECK_FALSE(nearly_same(edits[k].edit, edits[l].edit));
    if (k > 0)
      CHECK(std::pair(edits[k - 1].region, !edits[k - 1].of_lower_copy) <=
            std::pair(edits[k].region, !edits[k].of_lower_copy));
    CHECK_NOTHROW(space->edited(space->at_rest(), edits[k].edit, {}));
  }
}

TEST_CASE("models without primitives offer what lies nearest") {
  const StructuredShape table = structures::table(1);
  const auto regions = regions_of(table.shape, upwards);
  DeformationModelOptions options;
  options.kind = DeformationKind::surface;
  const auto space = deformation_model(table, options);
  const Design design = space->at_rest();
  const auto handles = space->handles();
  const auto edits = contact_edits({space->rest(), space->capabilities(), handles, design, regions, upwards});
  REQUIRE_FALSE(edits.empty());
  CHECK(edits.back().region == 3);  // the surface model knows no symmetry
  for (const ContactEdit& one : edits) {
    REQUIRE(one.edit.handle.kind == HandleKind::point);
    const ContactRegion& region = regions[static_cast<std::size_t>(one.region)];
    const Vector3d target = one.of_lower_copy ? region.upper_centre : region.lower_centre;
    const auto distance = [&](const Handle& handle) {
      return (table.shape.vertices.row(handle.index).transpose() - target).norm();
    };
    for (const Handle& handle : handles)
      if (handle.kind == HandleKind::point) CHECK(distance(one.edit.handle) <= distance(handle));
  }

  const std::vector<Handle> wires = {{HandleKind::wire, 0, 0}, {HandleKind::wire, 0, 1}};
  const ContactSituation by_wires{
      space->rest(), capabilities_of(DeformationKind::iwires), wires, design, regions,
      upwards,       {{0, 0, 3}, regions[0].lower_centre}};
  for (const ContactEdit& one : contact_edits(by_wires))
    CHECK(one.edit.handle == (one.of_lower_copy ? wires[0] : wires[1]));

  DeformationModelOptions by_curves;
  by_curves.kind = DeformationKind::iwires;
  const auto curves = deformation_model(table, by_curves);
  const auto curve_handles = curves->handles();
  const auto centres = curves->centres();
  REQUIRE(centres.size() == curve_handles.size());
  const Design drawn = curves->at_rest();
  const auto on_curves = contact_edits(
      {curves->rest(), curves->capabilities(), curve_handles, drawn, regions, upwards, centres});
  REQUIRE_FALSE(on_curves.empty());
  for (const ContactEdit& one : on_curves) {
    CHECK(one.edit.handle.kind == HandleKind::wire);
    CHECK_NOTHROW(curves->edited(drawn, one.edit, keep_height()));
  }

  const auto squashed = contact_edits(
      {space->rest(), capabilities_of(DeformationKind::gap_scaling), handles, design, regions, upwards});
  REQUIRE(squashed.size() == 1);
  CHECK(nearly_same(squashed[0].edit, {whole_shape, Scale{0.9, Vector3d::UnitZ()}}));
}

TEST_CASE("nothing touches: nothing to suggest, and options out of range are refused") {
  const StructuredShape table = structures::table();
  CHECK(edits_of(table, {}, upwards).empty());
  const auto refused = [&](const auto& change) {
    ContactEditOptions options;
    change(options);
    CHECK_THROWS_AS(edits_of(table, {}, upwards, options), UsageError);
  };
  refused([](auto& o) { o.move_step = 0; });
  refused([](auto& o) { o.scale_step = 1; });
  refused([](auto& o) { o.scale_step = -0.1; });
  refused([](auto& o) { o.multiples = {}; });
  refused([](auto& o) { o.multiples = {1, 10}; });
  refused([](auto& o) { o.max_regions = 0; });
}

TEST_CASE("ends of straight cylinders are smooth handles, those of bent bars and inner sections are not") {
  const Primitive post = structures::straight_cylinder({0, 0, 0}, {0, 0, 3}, 0.1, 5),
                  handle = structures::arc_cylinder(3, 0.2, -1, 1, 5);
  const auto smooth = [](const Primitive& primitive, int section, Falloff falloff) {
    return is_smooth({{HandleKind::section, 0, section}, Move{{0.1, 0, 0}}, falloff}, primitive);
  };
  CHECK(smooth(post, 0, Falloff::linear));
  CHECK(smooth(post, 4, Falloff::linear));
  CHECK_FALSE(smooth(post, 2, Falloff::linear));
  CHECK_FALSE(smooth(post, 4, Falloff::gaussian));
  CHECK_FALSE(smooth(handle, 0, Falloff::linear));
  CHECK_FALSE(smooth(handle, 4, Falloff::linear));
}

TEST_CASE(
    "a hoop under a contact leans with its feet, one above with its ends, one that lies flat does not") {
  std::vector<Relation> joints;
  double half = 9;  // of the sides of the other part
  const auto leanings = [&](const GeneralizedCylinder& curve, const Vector3d& at, EditFamily family) {
    StructuredShape rest = structures::tube_alone(curve, 12);
    rest.shape =
        concatenate(rest.shape, solids::named(solids::box({-half, -half, 20}, {half, half, 21}), "seat"));
    rest.structure.parts.push_back(
        {"seat", cuboid_of({{0, 0, 20.5}, Eigen::Matrix3d::Identity(), {half, half, 0.5}}), {}});
    rest.structure.diagonal = 30;
    rest.structure.relations = joints;
    ContactEditOptions options;
    options.family = family;
    std::vector<Lean> found;
    for (const ContactEdit& edit :
         edits_of(rest, {region_at(ContactType::dot, {0, 1}, at, at)}, upwards, options))
      if (const auto* lean = std::get_if<Lean>(&edit.edit.operation)) {
        CHECK(edit.edit.handle == Handle{HandleKind::part, 0, 0});
        CHECK(edit.reason.leaning);
        found.push_back(*lean);
      }
    return found;
  };
  using std::numbers::pi;
  const GeneralizedCylinder hoop = structures::arc_cylinder(4, 0.3, pi, 2 * pi, 25);
  const auto feet = leanings(hoop, {0, 0, -4.3}, EditFamily::smooth);
  REQUIRE_FALSE(feet.empty());
  const bool across =
      std::any_of(feet.begin(), feet.end(), [](const Lean& one) { return std::abs(one.by.y()) > 0; });
  CHECK(across);
  for (const Lean& one : feet) CHECK(one.axis == -Vector3d::UnitZ());
  const auto ends = leanings(hoop, {-4, 0, 0}, EditFamily::smooth);
  REQUIRE_FALSE(ends.empty());
  for (const Lean& one : ends) CHECK(one.axis == Vector3d::UnitZ());
  // Amid the hoop, all of it leans by more than what the contact needs.
  const auto amid = leanings(hoop, {-4 * std::cos(pi / 6), 0, -2.001}, EditFamily::smooth);
  REQUIRE(amid.size() == feet.size());
  CHECK(amid.front().by.norm() == Approx(2 * feet.front().by.norm()).epsilon(0.05));

  CHECK(leanings(hoop, {0, 0, -4.3}, EditFamily::extended).empty());
  GeneralizedCylinder flat = hoop;
  flat.centres.col(1).swap(flat.centres.col(2));
  CHECK(leanings(flat, {0, -4, 0.3}, EditFamily::smooth).empty());

  // What is joined to a larger part stays there, a smaller one follows.
  Relation joint;
  joint.type = RelationType::point_joint;
  joint.parts = {0, 1};
  joint.points = Eigen::RowVector3d(-4, 0, 0);
  joints = {joint};
  CHECK(leanings(hoop, {0, 0, -4.3}, EditFamily::smooth).size() == feet.size());
  CHECK(leanings(hoop, {-4, 0, 0}, EditFamily::smooth).empty());
  half = 1;
  CHECK_FALSE(leanings(hoop, {-4, 0, 0}, EditFamily::smooth).empty());
}

TEST_CASE("a round body tapers evenly, and its end near a contact moves along r") {
  StructuredShape cup = straight_cup();
  cup.structure.parts[0].primitive = structures::straight_cylinder({0, 0, 1}, {0, 0, 9}, 4, 11);
  const std::vector<ContactRegion> ring = {region_at(ContactType::ring, {0, 0}, {3.5, 0, 3}, {3.5, 0, 3})};
  ContactEditOptions options;
  options.family = EditFamily::smooth;
  const auto edits = edits_of(cup, ring, upwards, options);
  const auto tapers = [](const std::vector<ContactEdit>& of, bool even) {
    return std::count_if(of.begin(), of.end(), [&](const ContactEdit& one) {
      const auto* taper = std::get_if<Taper>(&one.edit.operation);
      return taper != nullptr && taper->along.has_value() != even;
    });
  };
  CHECK(tapers(edits, true) == 12);  // three sizes, narrower and wider, towards either end
  CHECK(tapers(edits, false) == 0);
  const auto along_r = [&](int section) {
    return std::any_of(edits.begin(), edits.end(), [&](const ContactEdit& one) {
      return one.edit.handle.kind == HandleKind::section && one.edit.handle.index == section &&
             moves_along(one, Vector3d::UnitZ());
    });
  };
  CHECK(along_r(0));
  CHECK_FALSE(along_r(10));

  // Across its axis the same body is none that is round about r: its widths differ.
  CHECK(tapers(edits_of(cup, ring, Direction(Vector3d::UnitX()), options), false) == 24);
  const StructuredShape table = structures::table();
  CHECK(tapers(edits_of(table, regions_of(table.shape, upwards), upwards, options), false) == 24);
}

}  // namespace
}  // namespace stackabilization
