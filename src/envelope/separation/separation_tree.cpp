#include "envelope/separation/separation_tree.h"

#include <tbb/parallel_invoke.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "envelope/separation/shear.h"
#include "envelope/separation/triangle_copies.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {
namespace {

using namespace detail;

/// Largest node with a slab. A slab over more triangles is no tighter than the box.
constexpr std::int32_t largest_slab = 256;
constexpr std::int32_t min_task_size = 8192;

/// Centre of the box of a triangle, for splitting: small, because it moves often.
struct Place {
  std::array<double, 3> centre;
  std::int32_t triangle;  ///< row of the list that the tree is built from
};

/// Builds the tree top down by median splits, in parallel, into nodes whose places depend on the counts
/// alone, so that the result is the same for any number of threads. Bounding volumes are fitted on the way
/// back.
class TreeBuilder {
 public:
  TreeBuilder(const std::vector<TreeTriangle>& triangles, SeparationTree::Data& data)
      : triangles_(triangles), data_(data), rounding_(16 * unit_roundoff * data.magnitude) {
    const auto count = static_cast<std::int32_t>(triangles.size());
    places_.reserve(triangles.size());
    for (std::int32_t t = 0; t < count; ++t) places_.push_back(place_of(triangles[t], t));
    data_.triangles.resize(triangles.size());
    data_.nodes.resize(node_count(count));
    build(0, 1, 0, count);
  }

 private:
  static Place place_of(const TreeTriangle& triangle, std::int32_t row) {
    Place place{{}, row};
    const auto& [a, b, c] = triangle.corners;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
      place.centre[axis] = low / 2 + high / 2;
    }
    return place;
  }

  static std::size_t node_count(std::int32_t triangles) {
    return triangles <= leaf_size ? 1 : 1 + node_count(triangles / 2) + node_count(triangles - triangles / 2);
  }

  /// Node `self` over [first, last); its descendants occupy the nodes from `free` on. Returns which way its
  /// triangles face: the sum of their area normals, each turned to the side of those before.
  Eigen::Vector3d build(std::size_t self, std::size_t free, std::int32_t first, std::int32_t last) {
    TreeNode& node = data_.nodes[self];
    const std::int32_t count = last - first;
    Eigen::Vector3d facing;
    if (count <= leaf_size) {
      node.first = first;
      node.count = count;
      facing = fill(node, first, last);
    } else {
      const std::int32_t middle = first + count / 2;
      split(first, middle, last);
      node.first = static_cast<std::int32_t>(free);
      node.count = 0;
      const std::size_t left_descendants = free + 2;
      const std::size_t right_descendants = left_descendants + node_count(count / 2) - 1;
      Eigen::Vector3d left_facing, right_facing;
      const auto left = [&] { left_facing = build(free, left_descendants, first, middle); };
      const auto right = [&] { right_facing = build(free + 1, right_descendants, middle, last); };
      if (count < min_task_size) {
        left();
        right();
      } else {
        tbb::parallel_invoke(left, right);
      }
      unite(node, data_.nodes[free], data_.nodes[free + 1]);
      facing = joined(left_facing, right_facing);
    }
    fit_slab(node, facing, first, last);
    return facing;
  }

  /// The triangles of a leaf, its box and its diagonals.
  Eigen::Vector3d fill(TreeNode& node, std::int32_t first, std::int32_t last) {
    node.low.fill(infinity);
    node.high.fill(-infinity);
    std::array<double, diagonal_count> diagonal_low, diagonal_high;
    diagonal_low.fill(infinity);
    diagonal_high.fill(-infinity);
    Eigen::Vector3d facing = Eigen::Vector3d::Zero();
    for (std::int32_t t = first; t < last; ++t) {
      const TreeTriangle& triangle = data_.triangles[t] = triangles_[places_[t].triangle];
      for (const auto& corner : triangle.corners) {
        for (int axis = 0; axis < 3; ++axis) {
          node.low[axis] = std::min(node.low[axis], corner[axis]);
          node.high[axis] = std::max(node.high[axis], corner[axis]);
        }
        for (int diagonal = 0; diagonal < diagonal_count; ++diagonal) {
          const double offset = along_diagonal(corner.data(), diagonal);
          diagonal_low[diagonal] = std::min(diagonal_low[diagonal], offset);
          diagonal_high[diagonal] = std::max(diagonal_high[diagonal], offset);
        }
      }
      facing = joined(facing, area_normal(triangle));
    }
    for (int diagonal = 0; diagonal < diagonal_count; ++diagonal) {
      node.diagonal_low[diagonal] = single_below(diagonal_low[diagonal] - rounding_);
      node.diagonal_high[diagonal] = single_above(diagonal_high[diagonal] + rounding_);
    }
    return facing;
  }

  static void unite(TreeNode& node, const TreeNode& left, const TreeNode& right) {
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis] = std::min(left.low[axis], right.low[axis]);
      node.high[axis] = std::max(left.high[axis], right.high[axis]);
    }
    for (int diagonal = 0; diagonal < diagonal_count; ++diagonal) {
      node.diagonal_low[diagonal] = std::min(left.diagonal_low[diagonal], right.diagonal_low[diagonal]);
      node.diagonal_high[diagonal] = std::max(left.diagonal_high[diagonal], right.diagonal_high[diagonal]);
    }
  }

  static Eigen::Vector3d joined(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a.dot(b) < 0 ? Eigen::Vector3d(a - b) : Eigen::Vector3d(a + b);
  }

  /// Slab across `facing`. Any axis gives a valid bound; this one is good for what is nearly flat.
  void fit_slab(TreeNode& node, const Eigen::Vector3d& facing, std::int32_t first, std::int32_t last) const {
    node.normal.fill(0);
    node.slab_low = node.slab_high = 0;
    if (last - first > largest_slab) return;
    const Eigen::Vector3d axis = facing.stableNormalized();
    if (!axis.allFinite() || axis.isZero(0)) return;
    double low = infinity, high = -infinity;
    for (std::int32_t t = first; t < last; ++t)
      for (const auto& corner : data_.triangles[t].corners) {
        const double offset = axis[0] * corner[0] + axis[1] * corner[1] + axis[2] * corner[2];
        low = std::min(low, offset);
        high = std::max(high, offset);
      }
    node.normal = {axis[0], axis[1], axis[2]};
    node.slab_low = low - rounding_;
    node.slab_high = high + rounding_;
  }

  static Eigen::Vector3d area_normal(const TreeTriangle& triangle) {
    const Eigen::Map<const Eigen::Vector3d> a(triangle.corners[0].data()), b(triangle.corners[1].data()),
        c(triangle.corners[2].data());
    return (b - a).cross(c - a);
  }

  /// In the middle along the axis along which the centres are spread most.
  void split(std::int32_t first, std::int32_t middle, std::int32_t last) {
    std::array<double, 3> low = places_[first].centre, high = low;
    for (std::int32_t t = first; t < last; ++t)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], places_[t].centre[axis]);
        high[axis] = std::max(high[axis], places_[t].centre[axis]);
      }
    int axis = 0;
    for (int other = 1; other < 3; ++other)
      if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
    std::nth_element(places_.begin() + first, places_.begin() + middle, places_.begin() + last,
                     [axis](const Place& a, const Place& b) {
                       return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis]
                                                               : a.triangle < b.triangle;
                     });
  }

  const std::vector<TreeTriangle>& triangles_;
  SeparationTree::Data& data_;
  double rounding_;            ///< of an offset from the origin along a unit vector or a diagonal
  std::vector<Place> places_;  ///< in tree order
};

/// A number that can be subtracted from everything in [low, high] without rounding, close to it if it is far
/// from 0. By Sterbenz's lemma x - c is exact for c / 2 <= x <= 2 c.
double exact_origin(double low, double high) {
  const double size = high - low;
  if (low > 4 * size) return low;
  if (high < -4 * size) return high;
  return 0;
}

std::vector<TreeTriangle> triangles_of(const Shape& shape) {
  std::vector<TreeTriangle> triangles(static_cast<std::size_t>(shape.triangle_count()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    triangles[t].index = static_cast<std::int32_t>(t);
    for (int c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis)
        triangles[t].corners[c][axis] = shape.vertices(shape.triangles(triangles[t].index, c), axis);
  }
  return triangles;
}

std::array<double, 3> exact_origin(const std::vector<TreeTriangle>& triangles) {
  std::array<double, 3> low = triangles.front().corners[0], high = low;
  for (const TreeTriangle& triangle : triangles)
    for (const auto& corner : triangle.corners)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], corner[axis]);
        high[axis] = std::max(high[axis], corner[axis]);
      }
  return {exact_origin(low[0], high[0]), exact_origin(low[1], high[1]), exact_origin(low[2], high[2])};
}

/// Takes triangles in the file's axes, in the order of their indices.
SeparationTree::Data build(std::vector<TreeTriangle> triangles, std::vector<TriangleCopy> copies,
                           const std::array<double, 3>& origin) {
  SeparationTree::Data data;
  data.copies = std::move(copies);
  data.origin = origin;
  for (TreeTriangle& triangle : triangles)
    for (auto& corner : triangle.corners)
      for (int axis = 0; axis < 3; ++axis) {
        corner[axis] -= origin[axis];
        data.magnitude = std::max(data.magnitude, std::abs(corner[axis]));
      }
  TreeBuilder(triangles, data);
  return data;
}

}  // namespace

TreeTriangle SeparationTree::Data::in_file_axes(std::int32_t triangle) const {
  TreeTriangle result = triangles[static_cast<std::size_t>(triangle)];
  for (auto& corner : result.corners)
    for (int axis = 0; axis < 3; ++axis) corner[axis] += origin[axis];
  return result;
}

SeparationTree::Data SeparationTree::Data::in_file_axes() const {
  std::vector<TreeTriangle> in_order(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) in_order[t] = in_file_axes(static_cast<std::int32_t>(t));
  std::sort(in_order.begin(), in_order.end(),
            [](const TreeTriangle& a, const TreeTriangle& b) { return a.index < b.index; });
  return build(std::move(in_order), copies, {});
}

SeparationTree::SeparationTree(const Shape& shape) {
  validate(shape);
  std::vector<TreeTriangle> triangles = triangles_of(shape);
  std::vector<TriangleCopy> copies = take_copies(triangles);
  const std::array<double, 3> origin = exact_origin(triangles);
  data_ = std::make_unique<const Data>(build(std::move(triangles), std::move(copies), origin));
}

SeparationTree::SeparationTree(std::unique_ptr<const Data> data) : data_(std::move(data)) {}

SeparationTree SeparationTree::translated(const Eigen::Vector3d& shift) const {
  if (!shift.allFinite()) throw UsageError("a tree is translated by a finite vector");
  auto moved = std::make_unique<Data>(*data_);
  const std::array<double, 3> origin = std::exchange(moved->origin, {});
  // Rounded additions are monotonic, so the box of moved corners is the moved box; other bounds get a margin.
  const auto move = [&](std::array<double, 3>& point) {
    for (int axis = 0; axis < 3; ++axis) point[axis] = (point[axis] + origin[axis]) + shift[axis];
  };
  moved->magnitude = 0;
  for (TreeTriangle& triangle : moved->triangles)
    for (auto& corner : triangle.corners) {
      move(corner);
      for (const double coordinate : corner)
        moved->magnitude = std::max(moved->magnitude, std::abs(coordinate));
    }
  const double rounding = 32 * unit_roundoff * std::max(moved->magnitude, shift.cwiseAbs().maxCoeff());
  for (TreeNode& node : moved->nodes) {
    move(node.low);
    move(node.high);
    double offset = 0;
    for (int axis = 0; axis < 3; ++axis) offset += node.normal[axis] * (origin[axis] + shift[axis]);
    node.slab_low += offset - rounding;
    node.slab_high += offset + rounding;
    for (int diagonal = 0; diagonal < diagonal_count; ++diagonal) {
      const double along = along_diagonal(origin.data(), diagonal) + along_diagonal(shift.data(), diagonal);
      node.diagonal_low[diagonal] = single_below(node.diagonal_low[diagonal] + along - rounding);
      node.diagonal_high[diagonal] = single_above(node.diagonal_high[diagonal] + along + rounding);
    }
  }
  return SeparationTree(std::move(moved));
}

SeparationTree::SeparationTree(SeparationTree&&) noexcept = default;
SeparationTree& SeparationTree::operator=(SeparationTree&&) noexcept = default;
SeparationTree::~SeparationTree() = default;

}  // namespace stackabilization
