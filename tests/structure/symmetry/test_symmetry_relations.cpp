#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/symmetry_detection.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/symmetric_solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

std::vector<Relation> relations_of(const Shape& shape) {
  return symmetry_relations(shape, find_symmetries(shape));
}

std::set<std::set<std::string>> pairs_of(const Shape& shape, const std::vector<Relation>& relations) {
  std::set<std::set<std::string>> pairs;
  for (const Relation& relation : relations)
    if (relation.type == RelationType::symmetry)
      pairs.insert({shape.part_names[static_cast<std::size_t>(relation.parts[0])],
                    shape.part_names[static_cast<std::size_t>(relation.parts[1])]});
  return pairs;
}

/// Self-symmetries of the part called `name`.
std::vector<Symmetry> own_of(const Shape& shape, const std::vector<Relation>& relations,
                             const std::string& name) {
  std::vector<Symmetry> own;
  for (const Relation& relation : relations)
    if (relation.type == RelationType::self_symmetry &&
        shape.part_names[static_cast<std::size_t>(relation.parts[0])] == name)
      own.push_back(relation.symmetry);
  return own;
}

int planes_in(const std::vector<Symmetry>& symmetries) {
  return static_cast<int>(std::count_if(symmetries.begin(), symmetries.end(), [](const Symmetry& each) {
    return each.kind == SymmetryKind::reflection;
  }));
}

using Pairs = std::set<std::set<std::string>>;

}  // namespace

TEST_CASE("the legs of a square table are a cycle of pairs, without its diagonals") {
  const Shape table = solids::table({});
  const auto relations = relations_of(table);
  CHECK(pairs_of(table, relations) ==
        Pairs{{"leg_1", "leg_2"}, {"leg_2", "leg_3"}, {"leg_3", "leg_4"}, {"leg_4", "leg_1"}});
  const auto top = own_of(table, relations, "top");
  REQUIRE(top.size() == 2);
  CHECK(std::abs(top[0].axis.dot(top[1].axis)) <= 1e-15);
  for (const Symmetry& plane : top) CHECK(plane.axis.cwiseAbs().maxCoeff() == Approx(1));
  CHECK(relations.size() == 6);
  for (const Relation& relation : relations) CHECK(relation.residual <= 1e-9);
}

TEST_CASE("the rails of a square may differ from side to side") {
  const solids::Table options;
  const double w = options.width, l = options.leg, z = options.height / 3;
  std::vector<Shape> parts = {solids::table(options)};
  const auto rail = [&](double x, double y, const Eigen::Vector3d& size, const std::string& name) {
    const Eigen::Vector3d low(x, y, z);
    parts.push_back(solids::named(solids::box(low, low + size), name));
  };
  rail(l, 0, {w - 2 * l, l, l}, "front");
  rail(l, w - l, {w - 2 * l, l, l}, "back");
  rail(0, l, {l, w - 2 * l, l}, "left");
  rail(w - l, l, {l, w - 2 * l, l}, "right");
  const Shape table = solids::joined(parts);
  const Pairs pairs = pairs_of(table, relations_of(table));
  CHECK(pairs.count({"front", "back"}) == 1);
  CHECK(pairs.count({"left", "right"}) == 1);
  CHECK(pairs.size() == 6);
}

TEST_CASE("every symmetry relation takes its first part onto its second") {
  const Shape table = transformed(solids::table({8, 6, 0.5, 1}), solids::random_rotation(3), {1, 2, 3});
  for (const Relation& relation : relations_of(table)) {
    const Shape first = extract_part(table, relation.parts.front()),
                second = extract_part(table, relation.parts.back());
    const Eigen::Isometry3d map = isometry_of(relation.symmetry);
    for (Eigen::Index v = 0; v < first.vertex_count(); ++v) {
      const Eigen::Vector3d image = map * first.vertices.row(v).transpose();
      CHECK((second.vertices.rowwise() - image.transpose()).rowwise().norm().minCoeff() <= 1e-8);
    }
  }
}

TEST_CASE("a part between two symmetric ones has a symmetry of its own") {
  using solids::box;
  using solids::named;
  const Shape trestle = solids::joined({named(box({-3, -1, 0}, {-2.5, 1, 4}), "left"),
                                        named(box({2.5, -1, 0}, {3, 1, 4}), "right"),
                                        named(box({-2.5, 0.6, 1}, {2.5, 0.8, 1.2}), "bar")});
  const auto relations = relations_of(trestle);
  CHECK(pairs_of(trestle, relations) == Pairs{{"left", "right"}});
  REQUIRE(own_of(trestle, relations, "bar").size() == 1);
  CHECK(std::abs(own_of(trestle, relations, "bar").front().axis.x()) == Approx(1));
}

TEST_CASE("parts whose ends are cut off differently are related, but not parts of other places") {
  using solids::box;
  using solids::named;
  // A bar between two posts, of which the right one takes a share.
  const auto frame = [&](double share) {
    const double end = 2.5 - 5 * share;
    Shape right = concatenate(box({2.5, -1, 0}, {3, 1, 4}), box({end, 0.6, 1}, {2.5, 0.8, 1.2}));
    std::fill(right.triangle_part.begin(), right.triangle_part.end(), 0);
    return solids::joined({named(box({-3, -1, 0}, {-2.5, 1, 4}), "left"), named(std::move(right), "right"),
                           named(box({-2.5, 0.6, 1}, {end, 0.8, 1.2}), "bar")});
  };
  for (const double share : {0.03, 0.06}) {
    const Shape cut = frame(share);
    const auto relations = relations_of(cut);
    CHECK(pairs_of(cut, relations) == Pairs{{"left", "right"}});
    const auto own = own_of(cut, relations, "bar");
    REQUIRE(own.size() == 1);
    CHECK(std::abs(own.front().axis.x()) == Approx(1));
    CHECK(own.front().point.x() == Approx(0).margin(0.01));
  }
  const Shape cut = frame(0.3);
  for (const Symmetry& own : own_of(cut, relations_of(cut), "bar")) CHECK(std::abs(own.axis.x()) <= 0.5);
}

TEST_CASE("a thin leg has no counterpart in one that is thicker or elsewhere") {
  const Shape top = solids::named(solids::box({-5, -3, 5}, {5, 3, 5.3}), "top");
  const auto leg = [](double at, double width, const std::string& name) {
    return solids::named(solids::box({at - width / 2, -0.1, 0}, {at + width / 2, 0.1, 5}), name);
  };
  const auto table = [&](double at, double width) {
    const Shape shape = solids::joined({top, leg(-4, 0.2, "left"), leg(at, width, "right")});
    return pairs_of(shape, relations_of(shape));
  };
  CHECK(table(4, 0.2) == Pairs{{"left", "right"}});
  CHECK(table(4, 0.3).empty());
  CHECK(table(5, 0.2).empty());
}

TEST_CASE("a leg that is a little off its place has a counterpart, whole or cut from another part") {
  // Images of legs miss the others by more than the tolerance, but not by twice as much.
  const Shape top = solids::named(solids::box({-5, -3, 5}, {5, 3, 5.3}), "top");
  const auto leg = [](double at, double width, const std::string& name, bool cut) {
    const Shape box = solids::box({at - width / 2, -width / 2, 0}, {at + width / 2, width / 2, 5});
    std::vector<Eigen::Index> kept;
    for (Eigen::Index t = 0; t < box.triangle_count(); ++t)
      if (!cut || box.corner(t, 0).z() + box.corner(t, 1).z() + box.corner(t, 2).z() < 15) kept.push_back(t);
    return solids::named(make_shape(box.vertices, box.triangles(kept, Eigen::all)), name);
  };
  const auto table = [&](double at, double width, bool cut) {
    const Shape shape = solids::joined({top, leg(-4, 0.2, "left", cut), leg(at, width, "right", cut)});
    return pairs_of(shape, relations_of(shape));
  };
  const double off = 0.5;
  for (const bool cut : {false, true}) {
    CHECK(table(4 + off, 0.2, cut) == Pairs{{"left", "right"}});
    CHECK(table(4 + 2 * off, 0.2, cut).empty());
    CHECK(table(4 + off, 0.25, cut).empty());  // not its size
  }
}

TEST_CASE("the four legs of a round stool are a cycle of pairs, although each is turned towards the middle") {
  std::vector<Shape> parts = {solids::named(solids::cylinder(4, 1, 64), "seat")};
  for (int k = 0; k < 4; ++k) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd((5.0 / 64 + k / 2.0) * std::numbers::pi, Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    parts.push_back(
        solids::named(transformed(solids::box({2.6, -0.2, -5}, {3.4, 0.2, 0}), turn, Eigen::Vector3d::Zero()),
                      "leg_" + std::to_string(k + 1)));
  }
  const Shape stool = solids::joined(parts);
  CHECK(pairs_of(stool, relations_of(stool)) ==
        Pairs{{"leg_1", "leg_2"}, {"leg_2", "leg_3"}, {"leg_3", "leg_4"}, {"leg_4", "leg_1"}});
}

TEST_CASE("a board that is a little off the middle is symmetric there") {
  using solids::box;
  using solids::named;
  const auto planes_across = [](double off) {
    const Shape shape = solids::joined(
        {named(box({-5, -1, 4}, {5, 2, 5}), "seat"), named(box({-4, -1, 0}, {-3, 0, 4}), "left"),
         named(box({3, -1, 0}, {4, 0, 4}), "right"), named(box({-1 + off, 1, 5}, {1 + off, 2, 7}), "back")});
    const std::vector<Symmetry> own = own_of(shape, relations_of(shape), "back");
    return std::count_if(own.begin(), own.end(), [](const Symmetry& plane) {
      return std::abs(plane.axis.x()) > 0.999 && std::abs(plane.point.x()) < 1e-3;
    });
  };
  CHECK(planes_across(0) == 1);
  CHECK(planes_across(0.08) == 1);  // its ends miss their images by more than the tolerance
  CHECK(planes_across(0.16) == 0);  // ... and by more than twice the tolerance
}

TEST_CASE("small parts that miss their counterpart by more than their own size tells are pairs") {
  // A trestle of 10, its feet of 0.2: the right one sits 0.05 off.
  using solids::box;
  using solids::named;
  const auto trestle = [&](double off) {
    return solids::joined({named(box({-5, -1, 4}, {5, 1, 5}), "top"),
                           named(box({-4.5, -0.1, 0}, {-4.3, 0.1, 0.2}), "left"),
                           named(box({4.3 + off, -0.1, 0}, {4.5 + off, 0.1, 0.2}), "right")});
  };
  for (const double off : {0.0, 0.05})
    CHECK(pairs_of(trestle(off), relations_of(trestle(off))) == Pairs{{"left", "right"}});
  CHECK(pairs_of(trestle(0.3), relations_of(trestle(0.3))).empty());
}

TEST_CASE("the body of a cup keeps two planes and its axis, the handle one plane") {
  const Shape cup = solids::cup_with_handle();
  const auto relations = relations_of(cup);
  const auto body = own_of(cup, relations, "body");
  REQUIRE(body.size() == 3);
  CHECK(planes_in(body) == 2);
  CHECK(body[2].kind == SymmetryKind::revolution);
  CHECK(body[0].axis.cross(Eigen::Vector3d::UnitY()).norm() <= 1e-6);  // the plane of the whole first
  for (const int plane : {0, 1}) {
    CHECK(std::abs(body[static_cast<std::size_t>(plane)].axis.dot(body[2].axis)) <= 1e-12);
    CHECK(std::abs(body[static_cast<std::size_t>(plane)].axis.dot(
              body[2].point - body[static_cast<std::size_t>(plane)].point)) <= 1e-12);
  }
  CHECK(std::abs(body[0].axis.dot(body[1].axis)) <= 1e-12);
  CHECK(body[2].axis.cross(Eigen::Vector3d::UnitZ()).norm() <= 1e-6);
  const auto handle = own_of(cup, relations, "handle");
  REQUIRE(handle.size() == 1);
  CHECK(handle.front().axis.cross(Eigen::Vector3d::UnitY()).norm() <= 1e-6);
}

TEST_CASE("one round part has two perpendicular planes and its axis") {
  const Shape cup = solids::frustum_shell({});
  const auto own = own_of(cup, relations_of(cup), "part");
  REQUIRE(own.size() == 3);
  CHECK(planes_in(own) == 2);
  CHECK(std::abs(own[0].axis.dot(own[1].axis)) <= 1e-12);
}

TEST_CASE("the legs of a polygon hang together") {
  for (const auto& [legs, planes] : {std::pair{3, 2}, {5, 2}, {6, 3}, {8, 3}}) {
    CAPTURE(legs);
    std::vector<Shape> parts{solids::named(solids::prism(solids::regular_polygon(legs), 0.2), "seat")};
    for (int k = 0; k < legs; ++k) {
      const double angle = 2 * std::numbers::pi * k / legs;
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      parts.push_back(solids::named(
          transformed(solids::box({0.6, -0.05, -1.5}, {0.75, 0.05, 0}), turn, Eigen::Vector3d::Zero()),
          "leg_" + std::to_string(k)));
    }
    const Shape stool = solids::joined(parts);
    const auto relations = relations_of(stool);
    std::set<std::string> reached{"leg_0"};
    const Pairs pairs = pairs_of(stool, relations);
    for (int round = 0; round < legs; ++round)
      for (const auto& pair : pairs)
        if (std::any_of(pair.begin(), pair.end(),
                        [&](const std::string& name) { return reached.count(name) > 0; }))
          reached.insert(pair.begin(), pair.end());
    CHECK(static_cast<int>(reached.size()) == legs);
    CHECK(planes_in(own_of(stool, relations, "seat")) == planes);
  }
}

TEST_CASE("parts that only a rotation makes equal are a chain of pairs") {
  for (const int legs : {3, 4, 5}) {
    CAPTURE(legs);
    const Shape stool = solids::skewed_stool(legs);
    const auto relations = relations_of(stool);
    CHECK(pairs_of(stool, relations).size() == static_cast<std::size_t>(legs) - 1);
    for (const Relation& relation : relations) {
      if (relation.type != RelationType::symmetry) continue;
      CHECK(relation.symmetry.kind == SymmetryKind::rotation);
      CHECK(relation.symmetry.order == legs);
      const Shape first = extract_part(stool, relation.parts[0]),
                  second = extract_part(stool, relation.parts[1]);
      const Eigen::Isometry3d map = isometry_of(relation.symmetry);
      for (Eigen::Index v = 0; v < first.vertex_count(); ++v) {
        const Eigen::Vector3d image = map * first.vertices.row(v).transpose();
        CHECK((second.vertices.rowwise() - image.transpose()).rowwise().norm().minCoeff() <= 0.02);
      }
    }
    for (int k = 0; k < legs; ++k) CHECK(own_of(stool, relations, "leg_" + std::to_string(k)).empty());
  }
}

TEST_CASE("a rotation relates nothing where a leg is missing or elsewhere") {
  const Shape stool = solids::skewed_stool(4);
  const Shape without = solids::joined(
      {extract_part(stool, 0), extract_part(stool, 1), extract_part(stool, 2), extract_part(stool, 3)});
  for (const Relation& relation : relations_of(without)) CHECK(relation.symmetry.order != 4);
}

TEST_CASE("a part has planes of its own where the whole shape has none") {
  using solids::box;
  using solids::named;
  const Shape label = named(box({1.2, -1, 4.5}, {1.9, 0.1, 4.6}), "label");
  std::vector<Shape> parts = solids::chair_parts();
  parts.push_back(label);
  const Shape chair = solids::joined(parts);
  CHECK(own_of(chair, relations_of(chair), "label").empty());
  const Shape lopsided = solids::joined(
      {named(box({-5, -2, 4}, {5, 2, 4.5}), "board"), named(box({-5, -2, 0}, {-4, 0, 4}), "leg"), label});
  const auto own = own_of(lopsided, relations_of(lopsided), "label");
  REQUIRE(own.size() == 3);
  for (const Symmetry& plane : own)
    CHECK(std::abs(plane.axis.dot(plane.point - Eigen::Vector3d(1.55, -0.45, 4.55))) <= 1e-9);
}

TEST_CASE("relations turn with the shape and do not depend on the order of triangles") {
  const Shape chair = solids::chair();
  const auto expected = relations_of(chair);
  const Shape moved = transformed(chair, solids::random_rotation(5), {3, -2, 7});
  for (const Shape& variant : {moved, solids::permuted(chair, 3), solids::subdivided(chair)}) {
    const auto relations = relations_of(variant);
    CHECK(pairs_of(variant, relations) == pairs_of(chair, expected));
    CHECK(relations.size() == expected.size());
  }
}

TEST_CASE("parts without area have no relations, shapes and options out of range are refused") {
  Shape table = solids::table({});
  table.part_names.push_back("nothing");
  for (const Relation& relation : relations_of(table))
    for (const int part : relation.parts) CHECK(part < 5);
  CHECK_THROWS_AS(symmetry_relations(Shape{}, {}), InputError);
  CHECK_THROWS_AS(symmetry_relations(table, {}, {-1, 0.9}), UsageError);
}
