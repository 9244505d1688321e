#include <cmath>
#include <numbers>
#include <set>

#include "improvement/design/configuration_key.h"
#include "improvement/design/distinct.h"
#include "improvement/search/cone_search.h"
#include "improvement/search/design_store.h"
#include "improvement/search/search_tree.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/factory.h"
#include "support/catch.h"
#include "support/cups.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/structures.h"

namespace stackabilization::detail {
namespace {

using Eigen::Vector3d;

SearchNode node(int queue, double energy, std::uint64_t key, int parent = -1) {
  SearchNode node;
  node.parent = parent;
  node.queue = queue;
  node.energy.value = energy;
  node.key = key;
  return node;
}

Design after(const DeformationModel& space, const std::vector<Edit>& edits) {
  const DeformationResult outcome = space.deformed(edits, {});
  REQUIRE(!outcome.refusal);
  return outcome.design;
}

/// One design that nothing changes, of any shape.
class Fixed : public DeformationModel {
 public:
  Fixed(const Shape& shape, const std::vector<Symmetry>& symmetries) {
    rest_.shape = shape;
    rest_.structure.parts = {
        {"part", cuboid_of({Vector3d::Zero(), Eigen::Matrix3d::Identity(), Vector3d::Ones()}), {}}};
    rest_.structure.symmetries = symmetries;
    rest_.structure.diagonal = 1;
  }
  const StructuredShape& rest() const override { return rest_; }
  DeformationKind kind() const override { return DeformationKind::controllers; }
  std::vector<Handle> handles() const override { return {}; }
  Eigen::Vector3d centre(const Handle&) const override { return Eigen::Vector3d::Zero(); }
  DeformationResult edited(const Design& now, const Edit&, const DeformationConstraints&) const override {
    return {Refusal{.cause = RefusalCause::fixed_part, .part = 0}, now};
  }

 private:
  StructuredShape rest_;
};

Symmetry mirror(const Vector3d& normal) {
  return {SymmetryKind::reflection, Vector3d::Zero(), normal, 2};
}

Vector3d tilted(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::sin(angle), 0, std::cos(angle)};
}

}  // namespace

TEST_CASE("queues give the candidate of least energy, the first made of equal ones, and take turns") {
  SearchTree tree(2);
  tree.add(node(0, 0.5, 1));
  tree.add(node(0, 0.25, 2));
  tree.add(node(0, 0.25, 3));
  tree.add(node(1, 9, 1));
  std::vector<int> order;
  while (const auto next = tree.next()) {
    order.push_back(*next);
    tree.settle(*next, NodeState::expanded);
  }
  CHECK(order == std::vector<int>{1, 3, 2, 0});
  CHECK(tree.queued() == 0);
  CHECK(tree.knows(1, 1));
  CHECK(!tree.knows(1, 2));
}

TEST_CASE("a path leads from below the root to a candidate") {
  SearchTree tree(1);
  tree.add(node(0, 0, 1));
  tree.add(node(0, 0, 2, 0));
  tree.add(node(0, 0, 3, 0));
  tree.add(node(0, 0, 4, 2));
  CHECK(tree.path(0).empty());
  CHECK(tree.path(3) == std::vector<int>{2, 3});
}

TEST_CASE("one configuration has one key however it was made, and wherever it is") {
  const auto space = deformation_model(structures::table());
  const ConfigurationKeys keys(*space);
  const Edit leg{{HandleKind::face, 1, 0}, Move{{0.1, 0, 0}}};
  const Edit top{{HandleKind::face, 0, 5}, Move{{0, 0, 0.2}}};
  const Edit all{{HandleKind::shape, 0, 0}, Move{{0, 0, 5}}};
  CHECK(keys.key(after(*space, {leg, top})) == keys.key(after(*space, {top, leg})));
  CHECK(keys.key(after(*space, {leg, all})) == keys.key(after(*space, {leg})));
  CHECK(keys.key(after(*space, {all})) == keys.key(space->at_rest()));
  const Edit hardly{{HandleKind::face, 1, 0}, Move{{1e-4, 0, 0}}};
  const std::set<std::uint64_t> different = {
      keys.key(space->at_rest()), keys.key(after(*space, {leg})), keys.key(after(*space, {top})),
      keys.key(after(*space, {leg, top})), keys.key(after(*space, {hardly}))};
  CHECK(different.size() == 5);
}

TEST_CASE("radii belong to a configuration") {
  const cups::Cups space;
  const ConfigurationKeys keys(space);
  const auto key = [&](double bottom) { return keys.key(after(space, {cups::scale(0, bottom)})); };
  CHECK(key(1) == keys.key(space.at_rest()));
  CHECK(key(0.9) != key(1));
  CHECK(key(0.9) == key(0.9 * (1 + 1e-12)));
}

TEST_CASE("designs are made again from their edits, the same to the bit") {
  const cups::Cups space;
  const RequirementChecker checker(space, {});
  SearchTree tree(1);
  tree.add(node(0, 0, 1));
  for (int k = 0; k < 4; ++k) {
    SearchNode next = node(0, 0, static_cast<std::uint64_t>(2 + k), k);
    next.edit = cups::scale(k % 2, 0.9 + 0.03 * k);
    tree.add(next);
  }
  const Design expected =
      after(space, {cups::scale(0, 0.9), cups::scale(1, 0.93), cups::scale(0, 0.96), cups::scale(1, 0.99)});
  DesignStore store(checker, tree);
  CHECK(store.of(4)->shape.vertices == expected.shape.vertices);
  DesignStore from_parent(checker, tree);
  from_parent.of(3);
  CHECK(from_parent.of(4)->shape.vertices == expected.shape.vertices);

  SearchNode foreign = node(0, 0, 9, 4);
  foreign.edit = {{HandleKind::part, 0, 0}, Move{{1, 0, 0}}};
  tree.add(foreign);
  CHECK_THROWS_AS(store.of(5), InputError);
}

TEST_CASE("designs differ when they are far apart, or near but moved otherwise") {
  const cups::Cups space;
  const SolutionDiversity distinct(space.rest());
  const Design narrow = after(space, {cups::scale(0, 0.7)});
  CHECK(!distinct.differ(narrow, narrow));
  Design rest = space.at_rest(), rounded = rest;
  rounded.shape.vertices(0, 0) += 1e-13;
  CHECK(!distinct.differ(rest, rounded));
  CHECK(!distinct.differ(narrow, after(space, {cups::scale(0, 0.72)})));
  CHECK(distinct.differ(narrow, after(space, {cups::scale(0, 0.9)})));
  CHECK(distinct.differ(after(space, {cups::scale(0, 0.9)}), narrow));
  // The same amounts, reached in two ways: the second takes hold of the rim as well, and changes it little.
  CHECK(!distinct.differ(narrow, after(space, {cups::scale(0, 0.7), cups::scale(1, 1.001)})));
  CHECK(distinct.differ(narrow, after(space, {cups::scale(0, 0.7), cups::scale(1, 1.1)})));
}

TEST_CASE("gestures know parts that are symmetric, and no amounts") {
  const StructuredShape table = structures::table();
  const SolutionDiversity distinct(table);
  const auto move = [](int part, const Vector3d& by) { return Edit{{HandleKind::face, part, 0}, Move{by}}; };
  CHECK(distinct.signatures({move(1, {1, 0, 0})}) == distinct.signatures({move(2, {0.5, 0, 0})}));
  CHECK(distinct.signatures({move(1, {1, 0, 0})}) != distinct.signatures({move(1, {-1, 0, 0})}));
  CHECK(distinct.signatures({move(1, {1, 0, 0})}) != distinct.signatures({move(0, {1, 0, 0})}));
  CHECK(distinct.signatures({move(1, {1, 0, 0}), move(0, {0, 0, 1})}) ==
        distinct.signatures({move(0, {0, 0, 1}), move(1, {1, 0, 0}), move(1, {3, 0, 0})}));
}

TEST_CASE("symmetries fix a direction, or leave it a plane") {
  Structure structure;
  CHECK(!freedom_of(structure, upwards).fixed);
  CHECK(!freedom_of(structure, upwards).plane_normal);
  structure.symmetries = {mirror({0, 0, 1})};
  CHECK(!freedom_of(structure, upwards).plane_normal);
  structure.symmetries = {mirror({0, 0, 1}), mirror({0, 1, 0})};
  REQUIRE(freedom_of(structure, upwards).plane_normal);
  CHECK(*freedom_of(structure, upwards).plane_normal == Vector3d(0, 1, 0));
  CHECK(!freedom_of(structure, upwards).fixed);
  structure.symmetries = {mirror({0, 1, 0}), mirror({1, 0, 0})};
  CHECK(freedom_of(structure, upwards).fixed);
  CHECK(!freedom_of(structure, Direction(1, 0, 1)).fixed);
  structure.symmetries = {{SymmetryKind::rotation, Vector3d::Zero(), {0, 0, 1}, 3}};
  CHECK(freedom_of(structure, upwards).fixed);
  CHECK(!freedom_of(structure, Direction(1, 0, 0)).fixed);
}

TEST_CASE("a direction near the best one is turned into it, within its symmetry plane") {
  const Fixed space(solids::l_shape(4, 0.5), {mirror({0, 1, 0})});
  const RequirementChecker checker(space, {});
  const double best = checker.measure(space.rest().shape, Direction(1, 0, 1)).value;
  for (const double degrees : {38.0, 43.0, 49.0}) {
    const Stackability now = checker.measure(space.rest().shape, Direction(tilted(degrees)));
    REQUIRE(now.value < best);
    const auto better = ConeSearch(checker, 10).better(space.rest().shape, now);
    REQUIRE(better);
    CHECK(better->value > now.value);
    CHECK(better->value >= best - 1e-3);
    CHECK(std::abs(better->direction.y()) < 1e-12);
    CHECK(better->direction.normalized().dot(tilted(degrees)) >= std::cos(10.001 * std::numbers::pi / 180));
  }
  const Stackability top = checker.measure(space.rest().shape, Direction(1, 0, 1));
  CHECK(!ConeSearch(checker, 10).better(space.rest().shape, top));
  const Stackability off = checker.measure(space.rest().shape, Direction(tilted(40)));
  CHECK(!ConeSearch(checker, 0).better(space.rest().shape, off));
}

TEST_CASE("a direction is turned only where the height stays what it was") {
  const Fixed space(solids::l_shape(4, 0.5), {mirror({0, 1, 0})});
  const Shape larger = transformed(space.rest().shape, 1.25 * Eigen::Matrix3d::Identity(), Vector3d::Zero());
  Requirements requirements;
  const auto better = [&] {
    const RequirementChecker checker(space, requirements);
    const Direction off(tilted(40));
    return ConeSearch(checker, 10).better(larger, checker.measure(larger, off));
  };
  CHECK(!better());
  requirements.keep_height = false;
  CHECK(better());
}

}  // namespace stackabilization::detail
