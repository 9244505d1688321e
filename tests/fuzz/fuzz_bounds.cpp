#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <vector>

#include "envelope/separation/exact_pair.h"
#include "envelope/separation/node_pair.h"
#include "envelope/separation/separation_over_cone.h"
#include "stackabilization/core/errors.h"
#include "stacking/place/place_bounds.h"
#include "support/tight_node.h"

using namespace stackabilization;
using namespace stackabilization::detail;

namespace {

/// A few triangles have all cases of a pair, and their exact values take no time.
constexpr int max_triangles = 5;

/// Reads numbers from bytes; zeros after the last one.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  template <class Value>
  Value take() {
    Value value{};
    const std::size_t count = std::min(sizeof value, size_ - at_);
    if (count > 0) std::memcpy(&value, data_ + at_, count);  // of no bytes the address may be null
    at_ += count;
    return value;
  }
  /// A multiple of 2^-8, below 2^7.
  double on_grid() { return std::ldexp(take<std::int16_t>(), -8); }
  bool empty() const { return at_ == size_; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

/// How coordinates are read: a few bits of each, as many as a double has, or any double.
enum class Numbers { grid, mantissas, doubles };

double coordinate(Bytes& bytes, Numbers numbers) {
  if (numbers == Numbers::grid) return bytes.on_grid();
  if (numbers == Numbers::mantissas) return bytes.on_grid() + std::ldexp(bytes.take<std::int32_t>(), -44);
  return bytes.take<double>();
}

Shape triangles(Bytes& bytes, Numbers numbers) {
  const int count = 1 + bytes.take<std::uint8_t>() % max_triangles;
  Points points(3 * count, 3);
  Triangles rows(count, 3);
  for (int v = 0; v < 3 * count; ++v) {
    // Corners in common make neighbours.
    const std::uint8_t shared = bytes.take<std::uint8_t>();
    if (shared % 2 == 1 && v > 0)
      points.row(v) = points.row(shared / 2 % v);
    else
      for (int axis = 0; axis < 3; ++axis) points(v, axis) = coordinate(bytes, numbers);
    rows(v / 3, v % 3) = v;
  }
  return make_shape(points, rows);
}

Eigen::Vector3d grid_vector(Bytes& bytes) {
  const double x = bytes.on_grid(), y = bytes.on_grid(), z = bytes.on_grid();
  return {x, y, z};
}

void demand(bool holds) {
  if (!holds) std::abort();
}

bool at_least(const DoubleDouble& bound, const Rational& value) {
  return bound.high != -infinity && Rational(bound.high) + Rational(bound.low) >= value;
}

bool at_most(const DoubleDouble& bound, const Rational& value) {
  return bound.high == -infinity || Rational(bound.high) + Rational(bound.low) <= value;
}

/// Returns the rows of SeparationTree::Data::triangles below each node.
std::vector<std::vector<std::int32_t>> triangles_below(const SeparationTree::Data& tree) {
  std::vector<std::vector<std::int32_t>> below(tree.nodes.size());
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {  // children come after their parent
    const TreeNode& node = tree.nodes[n];
    for (std::int32_t t = node.first; t < node.first + node.count; ++t) below[n].push_back(t);
    if (node.count > 0) continue;
    for (const std::int32_t child : {node.first, node.first + 1})
      for (const std::int32_t t : below[static_cast<std::size_t>(child)]) below[n].push_back(t);
  }
  return below;
}

/// The smallest node around a triangle.
TreeNode node_of(const TreeTriangle& triangle) {
  std::array<Eigen::Vector3d, 3> corners;
  for (std::size_t c = 0; c < 3; ++c) corners[c] = Eigen::Vector3d(triangle.corners[c].data());
  Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
  if (!normal.allFinite()) normal.setZero();
  return tight_node::node_around(corners, normal);
}

/// Bounds of pairs of triangles and of nodes, against the exact height differences.
void check_pairs(const SeparationTree::Data& tree, const Direction& direction, ContactSemantics semantics) {
  constexpr DoubleDouble no_floor{-infinity, 0};
  const Projection projection(direction, tree.magnitude, semantics);
  const NodePairBound node_bound(tree.magnitude);
  const Rational scale(std::abs(projection.shear.r[projection.shear.k]));
  const auto below = triangles_below(tree);
  for (std::size_t t = 0; t < tree.triangles.size(); ++t)
    for (std::size_t s = 0; s < tree.triangles.size(); ++s) {
      const TreeTriangle &a = tree.triangles[t], &b = tree.triangles[s];
      const PairBounds bounds = bound_pair(ProjectedTriangle(a, projection), ProjectedTriangle(b, projection),
                                           projection, no_floor);
      const std::optional<Rational> exact = exact_maximum(a, b, projection.shear, semantics);
      if (!exact) {
        demand(bounds.low.high == -infinity);
        continue;
      }
      demand(at_least(bounds.high, *exact * scale));
      demand(at_most(bounds.low, *exact * scale));
      demand(at_least(
          node_bound(ProjectedNode(node_of(a), projection), ProjectedNode(node_of(b), projection), no_floor),
          *exact * scale));
      const auto has = [](const std::vector<std::int32_t>& list, std::size_t triangle) {
        return std::find(list.begin(), list.end(), static_cast<std::int32_t>(triangle)) != list.end();
      };
      for (std::size_t n = 0; n < below.size(); ++n)
        for (std::size_t m = 0; m < below.size(); ++m)
          if (has(below[n], t) && has(below[m], s))
            demand(at_least(node_bound(ProjectedNode(tree.nodes[n], projection),
                                       ProjectedNode(tree.nodes[m], projection), no_floor),
                            *exact * scale));
    }
}

/// The bound of a cone, against exact separations along its edges and half way between them.
void check_cone(Bytes& bytes, const SeparationTree& tree, ContactSemantics semantics) {
  std::vector<Direction> edges;
  for (int i = 0; i < 3; ++i) edges.emplace_back(grid_vector(bytes));
  const double wanted = std::abs(bytes.on_grid()) + std::ldexp(1.0, -8);
  constexpr std::int64_t all_pairs = 10'000;
  const std::optional<double> bound = SeparationOverCone(tree, edges, semantics).at_least(wanted, all_pairs);
  if (!bound) return;
  demand(*bound >= wanted);
  for (const Direction& a : edges)
    for (const Direction& b : edges) {
      // Halves of sums are exact on the grid.
      const Eigen::Vector3d middle = (a.vector() + b.vector()) / 2;
      if (middle.isZero(0)) continue;
      const Separation exact = separation(tree, tree, Direction(middle), {semantics, std::nullopt});
      demand(exact.blocked && exact.value >= Rational(*bound));
    }
}

/// The bounds of a cell of places, against exact separations at places of it. All coordinates on the grid.
void check_places(Bytes& bytes, const Shape& base, const Shape& item) {
  const LocalShapes shapes(base, item, Direction(0, 0, 1));
  const double x = bytes.on_grid() / 16, y = bytes.on_grid() / 16;
  const double width = std::ldexp(bytes.take<std::uint8_t>(), -6);
  const PlaceCell cell{{x, x + width, y, y + width}, 0, 0};
  const Eigen::Vector2d of_shape = grid_vector(bytes).head<2>(), of_base = grid_vector(bytes).head<2>();
  const SeparationTree tree(shapes.base), item_tree(shapes.shape);
  const auto at = [&](double place_x, double place_y) {
    return separation(tree, item_tree.translated({place_x, place_y, 0}), Direction(0, 0, 1));
  };
  PlaceBounds bounds(shapes);
  const double low =
      std::max(bounds.search(cell, at(x, y).length).low, bounds.bound_near(cell, of_shape, of_base).low);
  if (low == -infinity) return;
  for (const double s : {0.0, 0.5, 1.0})
    for (const double t : {0.0, 0.25, 1.0}) {
      const Separation exact =
          separation(tree, item_tree.translated({x + s * width, y + t * width, 0}), Direction(0, 0, 1));
      demand(exact.blocked && exact.value >= Rational(low));
    }
}

}  // namespace

/// Bounds are never on the wrong side of the exact values: those of pairs of triangles and of nodes, of cones
/// of directions and of cells of places.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const auto numbers = static_cast<Numbers>(bytes.take<std::uint8_t>() % 3);
  const ContactSemantics semantics =
      bytes.take<std::uint8_t>() % 2 == 0 ? ContactSemantics::solid : ContactSemantics::closed;
  try {
    const Shape shape = triangles(bytes, numbers);
    validate(shape);
    const SeparationTree tree(shape);
    const double dx = coordinate(bytes, numbers), dy = coordinate(bytes, numbers);
    check_pairs(tree.data(), Direction(dx, dy, coordinate(bytes, numbers)), semantics);
    check_cone(bytes, tree, semantics);
    if (numbers == Numbers::grid && !bytes.empty()) check_places(bytes, shape, triangles(bytes, numbers));
  } catch (const InputError&) {
  } catch (const UsageError&) {
  }
  return 0;
}
