// Bounds of pairs of nodes against exact values, with slabs that are as tight as doubles allow. Those of a
// tree have a margin of their own, under which a rounding of the bound would not show.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "envelope/separation/exact_pair.h"
#include "envelope/separation/node_pair.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/tight_node.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::detail;
using namespace stackabilization::tight_node;
using solids::Random;

namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

constexpr DoubleDouble anything{-infinity, 0};

TreeTriangle triangle_of(const Corners& corners) {
  TreeTriangle triangle{};
  for (std::size_t c = 0; c < 3; ++c)
    for (int axis = 0; axis < 3; ++axis) triangle.corners[c][axis] = corners[c][axis];
  return triangle;
}

double magnitude_of(const std::vector<Vector3d>& points) {
  double largest = 0;
  for (const Vector3d& point : points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return largest;
}

/// A coordinate with all bits in use, away from 0 so that its rounding counts.
double coordinate(Random& random) {
  return random.uniform(0.5, 1) * (random.below(2) == 0 ? 1 : -1);
}

Vector3d point(Random& random) {
  const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
  return {x, y, z};
}

/// Not steep along z.
Vector3d slab_normal(Random& random) {
  for (;;) {
    const Vector3d normal = random.on_sphere();
    if (std::abs(normal.z()) > 0.3) return normal;
  }
}

/// Multiples of 2^-54 below 1/4, 2^-55 below 1/8 and 2^-52 below 1/2, so that the sum with `oblique` is
/// exact.
const Vector3d oblique(0.3, -0.2, 1);
Vector3d point_below_oblique(Random& random, double x_low, double x_high) {
  const auto on_grid = [](double value, int bits) {
    return std::ldexp(std::round(std::ldexp(value, bits)), -bits);
  };
  const double x = random.uniform(x_low, x_high), y = random.uniform(-0.04, 0.04), z = random.uniform(0, 0.5);
  return {on_grid(x, 54), on_grid(y, 55), on_grid(z, 52)};
}

std::array<Vector3d, 8> box_corners(const Vector3d& low, const Vector3d& high) {
  std::array<Vector3d, 8> corners;
  for (std::size_t c = 0; c < 8; ++c)
    for (int axis = 0; axis < 3; ++axis) corners[c][axis] = (c >> axis & 1) != 0 ? high[axis] : low[axis];
  return corners;
}

/// The bound is not below the height difference, which is exact.
bool holds(const DoubleDouble& bound, const Rational& height) {
  return bound.high != -infinity && Rational(bound.high) + Rational(bound.low) >= height;
}

}  // namespace

TEST_CASE("two nodes of one point each, one above the other, are bounded by their distance at least") {
  // Along z nothing is rounded but the slabs: without an allowance, half of them would seem to miss their
  // point.
  Random random(21);
  const Projection projection(Direction(0, 0, 1), 1, ContactSemantics::closed);
  const NodePairBound bound(1);
  for (int k = 0; k < 2000; ++k) {
    const Vector3d low = point(random);
    const Vector3d high(low.x(), low.y(), coordinate(random));
    const TreeNode upper = node_around(std::array{high}, slab_normal(random)),
                   lower = node_around(std::array{low}, slab_normal(random));
    REQUIRE(holds(bound(ProjectedNode(upper, projection), ProjectedNode(lower, projection), anything),
                  Rational(high.z()) - Rational(low.z())));
  }
}

TEST_CASE("two nodes that are flat triangles are bounded by the distance at their corners at least") {
  // The triangles have one rectangle, at three of whose corners the planes are bounded without a margin.
  Random random(22);
  const Projection projection(Direction(0, 0, 1), 1, ContactSemantics::closed);
  const NodePairBound bound(1);
  int tight = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vector3d at = point(random), opposite = point(random);
    const auto corners = [&] {
      return Corners{Vector3d(at.x(), at.y(), coordinate(random)),
                     Vector3d(opposite.x(), at.y(), coordinate(random)),
                     Vector3d(at.x(), opposite.y(), coordinate(random))};
    };
    const auto node = [](const Corners& of) {
      return node_around(of, (of[1] - of[0]).cross(of[2] - of[0]).normalized());
    };
    const Corners above = corners(), beneath = corners();
    const std::optional<Rational> height =
        exact_maximum(triangle_of(above), triangle_of(beneath), projection.shear, projection.semantics);
    if (!height) continue;
    const DoubleDouble high =
        bound(ProjectedNode(node(above), projection), ProjectedNode(node(beneath), projection), anything);
    REQUIRE(holds(high, *height));
    tight += high.high - height->to_double() < 1e-12 ? 1 : 0;
  }
  CHECK(tight > 200);  // a bound with room to spare tests nothing
}

TEST_CASE("two nodes with one column along an oblique direction in common are not taken for disjoint") {
  // One point each, the upper one the lower one moved by r: rounded, they lie in different columns.
  Random random(23);
  for (int k = 0; k < 2000; ++k) {
    const Vector3d low = point_below_oblique(random, 0, 0.15), high = low + oblique;
    const double magnitude = magnitude_of({low, high});
    const Projection projection(Direction(oblique), magnitude, ContactSemantics::closed);
    const TreeNode upper = node_around(std::array{high}, slab_normal(random)),
                   lower = node_around(std::array{low}, slab_normal(random));
    REQUIRE(holds(NodePairBound(magnitude)(ProjectedNode(upper, projection), ProjectedNode(lower, projection),
                                           anything),
                  Rational(1.0)));
  }
}

TEST_CASE("boards that a direction crosses obliquely are bounded by how far they reach along it") {
  // Along (0.5, 0, 1) a board that is 0.1 thick along x is above itself by 0.2 at most, whatever its height.
  // Along (0.5, -0.5, 1), so is one that is cut from a block by |x - y| <= 0.1.
  const std::array straight = box_corners({0, 0, 0}, {0.1, 1, 1});
  const std::array diagonal{Vector3d(0.1, 0, 0), Vector3d(0, 0.1, 0), Vector3d(1, 0.9, 0),
                            Vector3d(0.9, 1, 0), Vector3d(0.1, 0, 1), Vector3d(0, 0.1, 1),
                            Vector3d(1, 0.9, 1), Vector3d(0.9, 1, 1)};
  const auto highest = [](const auto& corners, const Direction& direction) {
    const Projection projection(direction, 1, ContactSemantics::solid);
    const ProjectedNode node(node_around(corners, Vector3d::Zero()), projection);
    return NodePairBound(1)(node, node, anything).high;
  };
  for (const double sign : {1.0, -1.0}) {
    CHECK(highest(straight, Direction(sign * 0.5, 0, 1)) == Approx(0.2).margin(1e-12));
    CHECK(highest(straight, Direction(0, sign * 0.5, 1)) == Approx(1).margin(1e-12));
    CHECK(highest(straight, Direction(sign, 0, 0.5)) == Approx(0.1).margin(1e-12));
    CHECK(highest(diagonal, Direction(sign * 0.5, -sign * 0.5, 1)) == Approx(0.2).margin(1e-7));
    CHECK(highest(diagonal, Direction(sign * 0.5, sign * 0.5, 1)) == Approx(1).margin(1e-12));
  }
}

TEST_CASE("boxes that a direction passes one after the other have no column in common") {
  // Along (0.5, 0.5, 1), x lets the other box be above this one by 0.2 to 0.6. So does y of the first, and
  // that of the second by 0.8 to 1.2, although the rectangles of both overlap that of this box.
  const std::array below = box_corners({0, 0, 0}, {0.1, 0.1, 1});
  const Projection projection(Direction(0.5, 0.5, 1), 2, ContactSemantics::closed);
  const auto bound_above = [&](const auto& corners) {
    return NodePairBound(2)(ProjectedNode(node_around(corners, Vector3d::Zero()), projection),
                            ProjectedNode(node_around(below, Vector3d::Zero()), projection), anything)
        .high;
  };
  CHECK(bound_above(box_corners({0.2, 0.2, 0}, {0.3, 0.3, 1})) == Approx(0.6).margin(1e-12));
  CHECK(bound_above(box_corners({0.2, 0.5, 0}, {0.3, 0.6, 1})) == -infinity);
}

TEST_CASE("bounds in single precision are on their side, next to the number, whatever its size") {
  const double most = std::numeric_limits<float>::max(), infinite = std::numeric_limits<double>::infinity();
  for (const double value : {0.0, 0.1, 1.0, 1 + 1e-12, 16777217.0, 1e-50, 1e30, most, 1e39, 1e300, infinite})
    for (const double x : {value, -value}) {
      INFO(x);
      CHECK(single_below(x) <= x);
      CHECK(single_above(x) >= x);
      if (std::abs(x) > most) continue;
      CHECK(std::nextafter(single_below(x), std::numeric_limits<float>::infinity()) > x);
      CHECK(std::nextafter(single_above(x), -std::numeric_limits<float>::infinity()) < x);
    }
  CHECK(single_below(0.5) == 0.5F);
  CHECK(single_above(-0.75) == -0.75F);
}

TEST_CASE("the slabs and diagonals of a tree hold the corners of its triangles exactly, moved or not") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    solids::Soup soup;
    soup.seed = seed;
    // Small, so that what a move rounds is much more than what the slabs had to spare.
    Shape shape = solids::triangle_soup(soup);
    shape.vertices *= 1e-3;
    const SeparationTree still(shape);
    Random random(seed);
    const SeparationTree moved = still.translated(random.in_cube());
    for (const SeparationTree* tree : {&still, &moved})
      for (const TreeNode& node : tree->data().nodes)
        for (std::int32_t t = node.first; t < node.first + node.count; ++t)
          for (const auto& corner : tree->data().triangles[static_cast<std::size_t>(t)].corners) {
            const Rational offset = dot(node.normal, {corner[0], corner[1], corner[2]});
            REQUIRE(offset >= Rational(node.slab_low));
            REQUIRE(offset <= Rational(node.slab_high));
            for (int diagonal = 0; diagonal < diagonal_count; ++diagonal) {
              const Rational along = dot(direction_of(diagonal), {corner[0], corner[1], corner[2]});
              REQUIRE(along >= Rational(node.diagonal_low[diagonal]));
              REQUIRE(along <= Rational(node.diagonal_high[diagonal]));
            }
          }
  }
}
