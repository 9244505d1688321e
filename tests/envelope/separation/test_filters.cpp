// The filters of the exact separation may only ever be too careful. Their bounds are held against exact
// values here, pair by pair: a bound that is wrong by a rounding would show in the end-to-end tests only by
// luck.
#include <array>
#include <cmath>
#include <limits>

#include "envelope/separation/exact_pair.h"
#include "envelope/separation/node_pair.h"
#include "envelope/separation/triangle_pair.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::detail;
using namespace stackabilization::solids;

namespace {

Shape soup(std::uint64_t seed, int bits, double size = 1) {
  Soup options;
  options.seed = seed;
  options.count = 14;
  options.size = size;
  options.grid_bits = bits;
  return triangle_soup(options);
}

Shape stretched(const Shape& shape, const Eigen::Vector3d& factors) {
  return transformed(shape, factors.asDiagonal(), Eigen::Vector3d::Zero());
}

/// Soups in general position and on grids, slivers, details next to something large, products that underflow,
/// and neighbours that share corners and edges.
std::vector<Shape> hostile_shapes(std::uint64_t seeds = 4) {
  const double tiny = std::ldexp(1.0, -540);
  std::vector<Shape> list;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    list.push_back(soup(seed, 0));
    list.push_back(soup(seed, 1));
    list.push_back(soup(seed, 2, 3));
    list.push_back(stretched(soup(seed, 0), {1, 1e-9, 1}));
    list.push_back(stretched(soup(seed, 2), {1e-14, 1, 1e6}));
    list.push_back(concatenate(stretched(soup(seed, 0), {tiny, tiny, 1}), box({1, 1, 0}, {2, 2, 1})));
    list.push_back(
        concatenate(stretched(soup(seed, 2), {1e-170, 1e-150, 1e-160}), box({1, 1, 0}, {2, 2, 1})));
    for (const Shape& surface : {bumpy_bowl(3), box({1, 2, 1e-9})})
      list.push_back(transformed(surface, random_rotation(seed), Eigen::Vector3d::Zero()));
  }
  return list;
}

const std::vector<Direction>& hostile_directions() {
  static const std::vector<Direction> list = {{0, 0, 1},        {1, 0, 0},      {0, 1, 1},
                                              {0.3, -0.2, 1},   {1e-9, 0, 1},   {1e-200, 1e-17, 1},
                                              {-0.7, 0.7, 0.7}, {5e-324, 0, -3}};
  return list;
}

Rational rational(const DoubleDouble& value) {
  return Rational(value.high) + Rational(value.low);
}

bool at_most(const DoubleDouble& bound, const Rational& value) {
  return bound.high == -infinity || rational(bound) <= value;
}

bool at_least(const DoubleDouble& bound, const std::optional<Rational>& value) {
  if (!value) return true;
  return bound.high != -infinity && rational(bound) >= *value;
}

constexpr DoubleDouble no_floor{-infinity, 0};

/// The triangles of a shape that lies at the origin; those of a tree are cut and repeated.
std::vector<TreeTriangle> triangles_of(const Shape& shape) {
  std::vector<TreeTriangle> triangles(static_cast<std::size_t>(shape.triangle_count()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    triangles[t].index = static_cast<std::int32_t>(t);
    for (int c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis)
        triangles[t].corners[c][axis] = shape.corner(static_cast<Eigen::Index>(t), c)[axis];
  }
  return triangles;
}

/// The exact largest height difference of a pair.
std::optional<Rational> exact_height(const TreeTriangle& upper, const TreeTriangle& lower,
                                     const Projection& projection) {
  const std::optional<Rational> value = exact_maximum(upper, lower, projection.shear, projection.semantics);
  if (!value) return value;
  return *value * Rational(std::abs(projection.shear.r[projection.shear.k]));
}

double magnitude(const Shape& shape) {
  return shape.vertices.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("bounds of a pair of triangles hold the exact height difference") {
  int certain = 0, narrow = 0;
  for (const Shape& shape : hostile_shapes())
    for (const Direction& r : hostile_directions())
      for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed}) {
        const Projection projection(r, magnitude(shape), semantics);
        const std::vector<TreeTriangle> triangles = triangles_of(shape);
        for (const TreeTriangle& a : triangles)
          for (const TreeTriangle& b : triangles) {
            const std::optional<Rational> exact = exact_height(a, b, projection);
            const PairBounds bounds = bound_pair(ProjectedTriangle(a, projection),
                                                 ProjectedTriangle(b, projection), projection, no_floor);
            REQUIRE(at_least(bounds.high, exact));
            if (bounds.low.high == -infinity) continue;
            REQUIRE(exact);
            REQUIRE(at_most(bounds.low, *exact));
            ++certain;
            if (bounds.high.high - bounds.low.high < 1e-9 * magnitude(shape)) ++narrow;
          }
      }
  // The filter is worth something only if it decides most, even here.
  CHECK(certain > 10000);
  CHECK(narrow > certain / 2);
}

TEST_CASE("the bound of a pair of nodes holds every pair below it") {
  for (const Shape& shape : hostile_shapes(1)) {
    const SeparationTree tree(shape);
    const std::vector<TreeNode>& nodes = tree.data().nodes;
    const std::vector<TreeTriangle> triangles = triangles_of(shape);
    // Triangles are cut into pieces: only their leaves together are bound to hold the maximum.
    std::vector<std::vector<std::size_t>> leaves(triangles.size());
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (std::int32_t t = nodes[n].first; t < nodes[n].first + nodes[n].count; ++t)
        leaves[static_cast<std::size_t>(tree.data().triangles[static_cast<std::size_t>(t)].index)].push_back(
            n);
    for (const Direction& r : {hostile_directions()[0], hostile_directions()[3], hostile_directions()[6]}) {
      const Projection projection(r, tree.data().magnitude, ContactSemantics::closed);
      const NodePairBound node_bound(tree.data().magnitude);
      const auto bound = [&](std::size_t a, std::size_t b) {
        return node_bound(ProjectedNode(nodes[a], projection), ProjectedNode(nodes[b], projection), no_floor);
      };
      for (const TreeTriangle& a : triangles)
        for (const TreeTriangle& b : triangles) {
          const std::optional<Rational> exact = exact_height(a, b, projection);
          if (!exact) continue;
          REQUIRE(at_least(bound(0, 0), exact));
          DoubleDouble highest = no_floor;
          for (const std::size_t n : leaves[static_cast<std::size_t>(a.index)])
            for (const std::size_t m : leaves[static_cast<std::size_t>(b.index)])
              if (const DoubleDouble high = bound(n, m); highest <= high) highest = high;
          REQUIRE(at_least(highest, exact));
        }
    }
  }
}

TEST_CASE("the bound of two nodes holds where nothing is to spare") {
  // Points and the same points moved by r without rounding: multiples of the last bits of r, whose sums with
  // r have as many bits. So two triangles differ by r exactly, or have one column in common.
  const Eigen::Vector3d r(0.3, -0.2, 1);
  Random random(11);
  const auto random_point = [&](double x_low, double x_high) {
    const auto on_grid = [](double value, int bits) {
      return std::ldexp(std::round(std::ldexp(value, bits)), -bits);
    };
    return Eigen::Vector3d(on_grid(random.uniform(x_low, x_high), 54),
                           on_grid(random.uniform(-0.04, 0.04), 55), on_grid(random.uniform(0, 0.5), 52));
  };
  const auto triangle = [](const std::array<Eigen::Vector3d, 3>& corners) {
    Points points(3, 3);
    for (int c = 0; c < 3; ++c) points.row(c) = corners[static_cast<std::size_t>(c)].transpose();
    Triangles triangles(1, 3);
    triangles << 0, 1, 2;
    return make_shape(points, triangles);
  };
  const auto check = [&](const Shape& below, const Shape& above) {
    const SeparationTree::Data upper = SeparationTree(below).data().in_file_axes();
    const SeparationTree::Data lower = SeparationTree(above).data().in_file_axes();
    const double size = std::max(upper.magnitude, lower.magnitude);
    const Projection projection(Direction(r), size, ContactSemantics::closed);
    const DoubleDouble bound = NodePairBound(size)(ProjectedNode(upper.nodes[0], projection),
                                                   ProjectedNode(lower.nodes[0], projection), no_floor);
    const std::optional<Rational> exact =
        exact_height(triangles_of(below).front(), triangles_of(above).front(), projection);
    REQUIRE(exact);
    REQUIRE(at_least(bound, exact));
  };
  for (int k = 0; k < 2000; ++k) {
    const std::array<Eigen::Vector3d, 3> corners = {random_point(0, 0.15), random_point(0, 0.15),
                                                    random_point(0, 0.15)};
    check(triangle({corners[0] + r, corners[1] + r, corners[2] + r}), triangle(corners));
    // The one lies to the left of the column along r through a corner of the other, whose rest is to the
    // right.
    const Eigen::Vector3d shared = random_point(0.07, 0.08), left(-2, 0, 0), right(2, 0, 0);
    check(triangle({shared + r, shared + r + left, shared + r + left + Eigen::Vector3d(0, 0.5, 0)}),
          triangle({shared, shared + right, shared + right + Eigen::Vector3d(0, 0.5, 0)}));
  }
}

TEST_CASE("a tree is the same in any unit") {
  const Shape shape = soup(40, 0);
  const auto order = [](const Shape& of) {
    std::vector<std::int32_t> indices;
    const SeparationTree tree(of);
    for (const TreeTriangle& triangle : tree.data().triangles) indices.push_back(triangle.index);
    return indices;
  };
  for (const int exponent : {-190, -60, 60, 190}) {
    const double unit = std::ldexp(1.0, exponent);
    CHECK(order(stretched(shape, {unit, unit, unit})) == order(shape));
  }
}
