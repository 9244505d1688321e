#include "improvement/contacts/block_separations.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

namespace stackabilization::detail {

namespace {

/// Approximate number of blocks.
constexpr int many_blocks = 96;

/// Directions across r, with their opposites, along which an overlap is measured.
constexpr int overlap_axes = 8;
using Extents = Eigen::Matrix<double, overlap_axes, 1>;

/// Smallest and largest coordinates of points across r, along each of the axes of overlaps.
class Silhouette {
 public:
  explicit Silhouette(const Frame& frame) : frame_(frame) {
    for (int k = 0; k < overlap_axes; ++k) {
      const double angle = k * std::numbers::pi / overlap_axes;
      axes_.row(k) << std::cos(angle), std::sin(angle);
    }
  }

  /// Adds the part of a triangle on which sign * z >= least, z along r.
  void add(const std::array<Eigen::Vector3d, 3>& triangle, double sign, double least) {
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d from = frame_.to_local(triangle[static_cast<std::size_t>(corner)]),
                            to = frame_.to_local(triangle[static_cast<std::size_t>((corner + 1) % 3)]);
      const double above = sign * from.z() - least, next = sign * to.z() - least;
      if (above >= 0) add(from.head<2>());
      if ((above < 0) != (next < 0)) add((from + above / (above - next) * (to - from)).head<2>());
    }
  }

  /// Returns the least distance by which `other` has to move along one of the axes, either way, to pass.
  double overlap(const Silhouette& other) const {
    return std::min((high_ - other.low_).minCoeff(), (other.high_ - low_).minCoeff());
  }

 private:
  void add(const Eigen::Vector2d& point) {
    const Extents at = axes_ * point;
    low_ = low_.cwiseMin(at);
    high_ = high_.cwiseMax(at);
  }

  const Frame& frame_;
  Eigen::Matrix<double, overlap_axes, 2> axes_;
  Extents low_ = Extents::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
};

}  // namespace

struct BlockSeparations::Placed {
  Shape shape;
  Eigen::AlignedBox3d box;                     ///< box in the frame of r
  std::shared_ptr<const SeparationTree> tree;  ///< built on demand
};

BlockSeparations::BlockSeparations(const Shape& rest, const Direction& direction, ContactSemantics semantics,
                                   int max_slabs)
    : direction_(direction), frame_(frame_of(direction)), semantics_(semantics) {
  const Range heights = range_along(rest, frame_.w);
  const int slabs = std::clamp(many_blocks / static_cast<int>(rest.part_count()), 1, max_slabs);
  std::vector<std::vector<std::int32_t>> members(static_cast<std::size_t>(rest.part_count() * slabs));
  for (std::int32_t t = 0; t < rest.triangle_count(); ++t) {
    const double height = frame_.w.dot(rest.corner(t, 0) + rest.corner(t, 1) + rest.corner(t, 2)) / 3;
    const double share = heights.length() > 0 ? (height - heights.low) / heights.length() : 0;
    const int slab = std::clamp(static_cast<int>(share * slabs), 0, slabs - 1);
    const int part = rest.triangle_part[static_cast<std::size_t>(t)];
    members[static_cast<std::size_t>(part * slabs + slab)].push_back(t);
  }
  std::vector<std::int32_t> row_in_block(static_cast<std::size_t>(rest.vertex_count()), -1);
  for (const std::vector<std::int32_t>& triangles : members) {
    if (triangles.empty()) continue;
    Block block;
    block.triangles.resize(static_cast<Eigen::Index>(triangles.size()) + 1, 3);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (int c = 0; c < 3; ++c) {
        const std::int32_t vertex = rest.triangles(triangles[t], c);
        std::int32_t& row = row_in_block[static_cast<std::size_t>(vertex)];
        if (row < 0) {
          row = static_cast<std::int32_t>(block.vertices.size());
          block.vertices.push_back(vertex);
        }
        block.triangles(static_cast<Eigen::Index>(t), c) = row;
      }
    block.triangles.bottomRows<1>().setConstant(static_cast<std::int32_t>(block.vertices.size()));
    for (const std::int32_t vertex : block.vertices) row_in_block[static_cast<std::size_t>(vertex)] = -1;
    blocks_.push_back(std::move(block));
  }
}

Eigen::Vector3d BlockSeparations::anchor(const Shape& shape) const {
  const Eigen::Vector3d low = shape.vertices.colwise().minCoeff(), high = shape.vertices.colwise().maxCoeff();
  return (low + high) / 2 + (high - low).norm() * frame_.u;
}

BlockSeparations::Placed BlockSeparations::placed(const Shape& shape, int block,
                                                  const Eigen::Vector3d& anchor) const {
  const Block& of = blocks_[static_cast<std::size_t>(block)];
  const auto count = static_cast<Eigen::Index>(of.vertices.size());
  Points points(count + 1, 3);
  Placed result;
  for (Eigen::Index v = 0; v < count; ++v) {
    points.row(v) = shape.vertices.row(of.vertices[static_cast<std::size_t>(v)]) - anchor.transpose();
    result.box.extend(frame_.to_local(points.row(v).transpose()));
  }
  points.row(count).setZero();
  result.shape = make_shape(std::move(points), of.triangles);
  return result;
}

BlockSeparation BlockSeparations::separation(const Placed& upper, const Placed& lower) const {
  const Enclosure enclosure =
      separation_enclosure(*upper.tree, *lower.tree, direction_, {semantics_, std::nullopt});
  if (enclosure.upper == -std::numeric_limits<double>::infinity())
    return {false, upper.box.min().z() - lower.box.max().z()};
  return {true, (enclosure.lower + enclosure.upper) / 2 * direction_.length()};
}

double BlockSeparations::overlap(const Placed& upper, const Placed& lower, double lift) const {
  const auto silhouette = [&](const Shape& block, double sign, double least) {
    Silhouette result(frame_);
    for (Eigen::Index t = 0; t + 1 < block.triangle_count(); ++t)  // the last one is the anchor
      result.add({block.corner(t, 0), block.corner(t, 1), block.corner(t, 2)}, sign, least);
    return result;
  };
  const Silhouette below = silhouette(upper.shape, 1, lower.box.min().z() + lift),
                   above = silhouette(lower.shape, -1, lift - upper.box.max().z());
  return std::max(0.0, below.overlap(above));
}

std::vector<BlockPair> BlockSeparations::pairs_above(const Shape& shape, double least) const {
  const int count = static_cast<int>(blocks_.size());
  const Eigen::Vector3d at = anchor(shape);
  std::vector<Placed> placed_blocks;
  for (int b = 0; b < count; ++b) placed_blocks.push_back(placed(shape, b, at));
  const auto with_tree = [&](int b) -> const Placed& {
    Placed& block = placed_blocks[static_cast<std::size_t>(b)];
    if (!block.tree) block.tree = std::make_shared<const SeparationTree>(block.shape);
    return block;
  };
  std::vector<BlockPair> pairs;
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b) {
      const Eigen::AlignedBox3d &upper = placed_blocks[static_cast<std::size_t>(a)].box,
                                &lower = placed_blocks[static_cast<std::size_t>(b)].box;
      const bool apart = (upper.min().head<2>().array() > lower.max().head<2>().array()).any() ||
                         (lower.min().head<2>().array() > upper.max().head<2>().array()).any();
      if (apart || upper.max().z() - lower.min().z() < least) continue;
      const BlockSeparation between = separation(with_tree(a), with_tree(b));
      if (between.blocked && between.f >= least)
        pairs.push_back({a, b, between.f, overlap(with_tree(a), with_tree(b), least)});
    }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const BlockPair& a, const BlockPair& b) { return a.f > b.f; });
  return pairs;
}

std::vector<BlockSeparation> BlockSeparations::separations(const Shape& shape,
                                                           const std::vector<BlockPair>& pairs) const {
  const Eigen::Vector3d at = anchor(shape);
  std::vector<std::optional<Placed>> placed_blocks(blocks_.size());
  const auto with_tree = [&](int b) -> const Placed& {
    std::optional<Placed>& block = placed_blocks[static_cast<std::size_t>(b)];
    if (!block) {
      block = placed(shape, b, at);
      block->tree = std::make_shared<const SeparationTree>(block->shape);
    }
    return *block;
  };
  std::vector<BlockSeparation> result;
  for (const BlockPair& pair : pairs)
    result.push_back(separation(with_tree(pair.upper), with_tree(pair.lower)));
  return result;
}

}  // namespace stackabilization::detail
