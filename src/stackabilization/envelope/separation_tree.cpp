#include "stackabilization/envelope/separation_tree.h"

#include <tbb/parallel_invoke.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "stackabilization/envelope/shear.h"
#include "stackabilization/envelope/triangle_pieces.h"

namespace stackabilization {
namespace {

using namespace detail;

/// A slab over many triangles is no tighter than the box; larger nodes keep none.
constexpr std::int32_t largest_slab = 256;
constexpr std::int32_t smallest_task = 8192;

/// Builds the tree top down by median splits, in parallel, into nodes whose places depend on the counts
/// alone, so that the result is the same for any number of threads.
class TreeBuilder {
 public:
  TreeBuilder(Pieces& pieces, const std::vector<TreeTriangle>& triangles, SeparationTree::Data& data)
      : cut_(pieces), pieces_(pieces.pieces), triangles_(triangles), nodes_(data.nodes) {
    nodes_.resize(node_count(static_cast<std::int32_t>(pieces_.size())));
    build(0, 1, 0, static_cast<std::int32_t>(pieces_.size()));
    data.triangles.reserve(pieces_.size());
    for (const Piece& piece : pieces_) data.triangles.push_back(triangles_[piece.triangle]);
  }

 private:
  static std::size_t node_count(std::int32_t pieces) {
    return pieces <= leaf_size ? 1 : 1 + node_count(pieces / 2) + node_count(pieces - pieces / 2);
  }

  /// Node `self` over [first, last); its descendants occupy nodes_ from `free` on. Returns which way its
  /// triangles face: the sum of area n n^T over them.
  Eigen::Matrix3d build(std::size_t self, std::size_t free, std::int32_t first, std::int32_t last) {
    TreeNode& node = nodes_[self];
    fit_box(node, first, last);
    const std::int32_t count = last - first;
    if (count <= leaf_size) {
      node.first = first;
      node.count = count;
      const Eigen::Matrix3d facing = facing_of(first, last);
      fit_slab(node, facing, first, last);
      return facing;
    }
    const std::int32_t middle = first + count / 2;
    split(node, first, middle, last);
    node.first = static_cast<std::int32_t>(free);
    node.count = 0;
    const std::size_t left_descendants = free + 2;
    const std::size_t right_descendants = left_descendants + node_count(count / 2) - 1;
    Eigen::Matrix3d left_facing, right_facing;
    const auto left = [&] { left_facing = build(free, left_descendants, first, middle); };
    const auto right = [&] { right_facing = build(free + 1, right_descendants, middle, last); };
    if (count < smallest_task) {
      left();
      right();
    } else {
      tbb::parallel_invoke(left, right);
    }
    const Eigen::Matrix3d facing = left_facing + right_facing;
    fit_slab(node, facing, first, last);
    return facing;
  }

  void fit_box(TreeNode& node, std::int32_t first, std::int32_t last) const {
    node.low.fill(std::numeric_limits<double>::infinity());
    node.high.fill(-std::numeric_limits<double>::infinity());
    for (std::int32_t t = first; t < last; ++t)
      for (int axis = 0; axis < 3; ++axis) {
        node.low[axis] = std::min(node.low[axis], pieces_[t].low[axis]);
        node.high[axis] = std::max(node.high[axis], pieces_[t].high[axis]);
      }
  }

  Eigen::Matrix3d facing_of(std::int32_t first, std::int32_t last) const {
    Eigen::Matrix3d facing = Eigen::Matrix3d::Zero();
    for (std::int32_t t = first; t < last; ++t) {
      const Eigen::Vector3d normal = area_normal(triangles_[pieces_[t].triangle]);
      const double length = normal.stableNorm();
      if (length > 0) facing += normal * (normal / length).transpose();
    }
    return facing;
  }

  /// Slab across the direction that the triangles face most: the dominant eigenvector of `facing`.
  void fit_slab(TreeNode& node, const Eigen::Matrix3d& facing, std::int32_t first, std::int32_t last) const {
    node.normal.fill(0);
    node.slab_low = node.slab_high = 0;
    if (last - first > largest_slab) return;
    const Eigen::Vector3d axis = dominant_axis(facing);
    if (!axis.allFinite() || axis.isZero(0)) return;
    double low = std::numeric_limits<double>::infinity(), high = -low, magnitude = 0;
    const auto include = [&](const std::array<double, 3>& point) {
      const double offset = axis[0] * point[0] + axis[1] * point[1] + axis[2] * point[2];
      low = std::min(low, offset);
      high = std::max(high, offset);
      for (const double coordinate : point) magnitude = std::max(magnitude, std::abs(coordinate));
    };
    for (std::int32_t t = first; t < last; ++t) {
      const Piece& piece = pieces_[t];
      if (piece.polygon < 0) {
        for (const auto& corner : triangles_[piece.triangle].corners) include(corner);
      } else {
        const PiecePolygon& polygon = cut_.polygons[piece.polygon];
        std::for_each_n(polygon.points.begin(), polygon.point_count, include);
      }
    }
    const double rounding = 16 * unit_roundoff * magnitude;
    node.normal = {axis[0], axis[1], axis[2]};
    node.slab_low = low - rounding;
    node.slab_high = high + rounding;
  }

  static Eigen::Vector3d area_normal(const TreeTriangle& triangle) {
    const Eigen::Map<const Eigen::Vector3d> a(triangle.corners[0].data()), b(triangle.corners[1].data()),
        c(triangle.corners[2].data());
    return (b - a).cross(c - a);
  }

  /// Dominant eigenvector by squaring the matrix: good enough for a bound, whose validity does not depend on
  /// it.
  static Eigen::Vector3d dominant_axis(Eigen::Matrix3d matrix) {
    for (int step = 0; step < 6; ++step) {
      const double scale = matrix.cwiseAbs().maxCoeff();
      if (!(scale > 0) || !std::isfinite(scale)) return Eigen::Vector3d::Zero();
      matrix /= scale;
      matrix = (matrix * matrix).eval();
    }
    Eigen::Index column = 0;
    matrix.diagonal().maxCoeff(&column);
    return matrix.col(column).normalized();
  }

  void split(const TreeNode& node, std::int32_t first, std::int32_t middle, std::int32_t last) {
    int axis = 0;
    for (int other = 1; other < 3; ++other)
      if (node.high[other] - node.low[other] > node.high[axis] - node.low[axis]) axis = other;
    std::nth_element(pieces_.begin() + first, pieces_.begin() + middle, pieces_.begin() + last,
                     [axis](const Piece& a, const Piece& b) {
                       const double ca = a.low[axis] + a.high[axis], cb = b.low[axis] + b.high[axis];
                       return ca != cb ? ca < cb : a.triangle < b.triangle;
                     });
  }

  const Pieces& cut_;
  std::vector<Piece>& pieces_;  ///< those of `cut_`, reordered
  const std::vector<TreeTriangle>& triangles_;
  std::vector<TreeNode>& nodes_;
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

/// Takes triangles in the file's axes.
SeparationTree::Data build(std::vector<TreeTriangle> triangles, const std::array<double, 3>& origin) {
  SeparationTree::Data data;
  data.origin = origin;
  for (TreeTriangle& triangle : triangles)
    for (auto& corner : triangle.corners)
      for (int axis = 0; axis < 3; ++axis) {
        corner[axis] -= origin[axis];
        data.magnitude = std::max(data.magnitude, std::abs(corner[axis]));
      }
  Pieces pieces = cut_into_pieces(triangles);
  TreeBuilder(pieces, triangles, data);
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
  // Triangles that were cut occur several times.
  std::vector<TreeTriangle> whole;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto index = static_cast<std::size_t>(triangles[t].index);
    if (index >= whole.size()) whole.resize(index + 1);
    whole[index] = in_file_axes(static_cast<std::int32_t>(t));
  }
  return build(std::move(whole), {});
}

SeparationTree::SeparationTree(const Shape& shape) {
  validate(shape);
  std::vector<TreeTriangle> triangles = triangles_of(shape);
  const std::array<double, 3> origin = exact_origin(triangles);
  data_ = std::make_unique<const Data>(build(std::move(triangles), origin));
}

SeparationTree::SeparationTree(SeparationTree&&) noexcept = default;
SeparationTree& SeparationTree::operator=(SeparationTree&&) noexcept = default;
SeparationTree::~SeparationTree() = default;

}  // namespace stackabilization
