#include "stackabilization/improvement/closed.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/index.h"
#include "mesh/clip.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/direction.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization {

namespace {

using detail::at;

/// Pixels along the longer side of the shape.
constexpr int pixels = 96;
/// Directions of moves, and distances along each.
constexpr int move_directions = 16, move_distances = 4;
/// Scalings that are tried, on either side of 1: both pieces may change, one by the factor, one by its
/// inverse.
constexpr int scalings = 6;
/// Pieces apart if at most this share of the pixels in which they overlapped is left, and this many pixels.
constexpr double apart_share = 0.02;
constexpr int apart_pixels = 2;
/// Halvings of the interval in which the bound of S lies.
constexpr int bisections = 6;

using SlabPolygon = std::vector<Eigen::Vector3d>;

/// Pixels that a piece covers, as seen along z.
struct PixelMask {
  std::vector<std::pair<int, int>> covered;  ///< column and row of each, without repetition
  std::vector<bool> image;                   ///< row by row

  /// The middle of the box around the covered pixels, in pixels. There must be some.
  Eigen::Vector2d middle() const {
    Eigen::AlignedBox2d box;
    for (const auto& [column, row] : covered) box.extend(Eigen::Vector2d(column + 0.5, row + 0.5));
    return box.center();
  }
};

/// The grid on which pieces are compared.
class PixelGrid {
 public:
  explicit PixelGrid(const Points& points) {
    low_ = points.leftCols<2>().colwise().minCoeff().transpose();
    const Eigen::Vector2d size = points.leftCols<2>().colwise().maxCoeff().transpose() - low_;
    pixel_ = size.maxCoeff() / pixels;
    columns_ = static_cast<int>(size.x() / pixel_) + 1;
    rows_ = static_cast<int>(size.y() / pixel_) + 1;
  }

  PixelMask empty() const { return {{}, std::vector<bool>(static_cast<std::size_t>(columns_ * rows_))}; }

  /// Adds the pixels whose centres lie in a convex polygon.
  void fill(PixelMask& mask, const SlabPolygon& polygon) const {
    if (polygon.size() < 3) return;
    double lowest = polygon.front().y(), highest = lowest;
    for (const Eigen::Vector3d& p : polygon)
      lowest = std::min(lowest, p.y()), highest = std::max(highest, p.y());
    for (int row = index(lowest - low_.y()); row <= std::min(index(highest - low_.y()), rows_ - 1); ++row) {
      const double y = low_.y() + (row + 0.5) * pixel_;
      double left = 0, right = 0;
      bool crossed = false;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Eigen::Vector3d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        if ((a.y() > y) == (b.y() > y)) continue;
        const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        left = crossed ? std::min(left, x) : x;
        right = crossed ? std::max(right, x) : x;
        crossed = true;
      }
      if (!crossed) continue;
      for (int column = index(left - low_.x()); column <= std::min(index(right - low_.x()), columns_ - 1);
           ++column) {
        const double x = low_.x() + (column + 0.5) * pixel_;
        if (x >= left && x <= right) add(mask, column, row);
      }
    }
  }

  /// The middle of the grid, in pixels.
  Eigen::Vector2d middle() const { return {columns_ / 2.0, rows_ / 2.0}; }

  /// Returns in how many pixels `a` meets `b` after a scaling of `a` about `centre`, in pixels, and a move.
  int overlap(const PixelMask& a, const PixelMask& b, double factor, const Eigen::Vector2d& centre,
              const Eigen::Vector2d& move) const {
    int count = 0;
    for (const auto& [column, row] : a.covered) {
      const Eigen::Vector2d place =
          centre + factor * (Eigen::Vector2d(column + 0.5, row + 0.5) - centre) + move / pixel_;
      const int x = static_cast<int>(std::floor(place.x())), y = static_cast<int>(std::floor(place.y()));
      if (x >= 0 && y >= 0 && x < columns_ && y < rows_ && b.image[at(y * columns_ + x)]) ++count;
    }
    return count;
  }

 private:
  int index(double distance) const { return std::max(0, static_cast<int>(distance / pixel_)); }

  void add(PixelMask& mask, int column, int row) const {
    const std::size_t place = at(row * columns_ + column);
    if (mask.image[place]) return;
    mask.image[place] = true;
    mask.covered.emplace_back(column, row);
  }

  Eigen::Vector2d low_;
  double pixel_ = 0;
  int columns_ = 0, rows_ = 0;
};

/// A connected piece of a part near one end of the shape.
struct EndPiece {
  int part = -1;
  PixelMask mask;
};

class ClosedSearch {
 public:
  ClosedSearch(const Shape& shape, const Direction& direction)
      : shape_(shape), welded_(detail::weld(shape, detail::Weld::within_parts)), points_(welded_.points) {
    const Frame frame = frame_of(direction);
    for (Eigen::Index i = 0; i < points_.rows(); ++i) {
      const Eigen::Vector3d p = welded_.points.row(i).transpose();
      points_.row(i) << p.dot(frame.u), p.dot(frame.v), p.dot(frame.w);
    }
    low_ = points_.col(2).minCoeff();
    high_ = points_.col(2).maxCoeff();
    const Eigen::RowVector3d size = points_.colwise().maxCoeff() - points_.colwise().minCoeff();
    diagonal_ = size.norm();
    if (size.head<2>().minCoeff() > 0) grid_.emplace(points_);
  }

  bool is_flat() const { return !grid_; }
  double height() const { return high_ - low_; }

  /// Returns the parts of two pieces, within `depth` of the ends, that cannot pass each other.
  std::optional<std::pair<int, int>> pair(double depth) const {
    const std::vector<EndPiece> above = pieces(1, high_ - depth), below = pieces(-1, -(low_ + depth));
    for (const EndPiece& a : above)
      for (const EndPiece& b : below)
        if (!may_pass(a.mask, b.mask)) return std::pair{a.part, b.part};
    return std::nullopt;
  }

 private:
  /// Returns the pieces whose heights times `sign` are at least `level`, largest first.
  std::vector<EndPiece> pieces(double sign, double level) const {
    DisjointSets sets(static_cast<std::size_t>(points_.rows()));
    const auto is_in = [&](std::int32_t point) { return sign * points_(point, 2) >= level; };
    for (Eigen::Index t = 0; t < welded_.triangles.rows(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = welded_.triangles(t, k), b = welded_.triangles(t, (k + 1) % 3);
        if (is_in(a) && is_in(b)) sets.join(at(a), at(b));
      }
    std::map<std::size_t, EndPiece> found;
    for (Eigen::Index t = 0; t < welded_.triangles.rows(); ++t) {
      SlabPolygon polygon;
      std::optional<std::size_t> root;
      for (int k = 0; k < 3; ++k) {
        const std::int32_t point = welded_.triangles(t, k);
        if (is_in(point)) root = sets.root(at(point));
        polygon.emplace_back(points_(point, 0), points_(point, 1), sign * points_(point, 2));
      }
      if (!root) continue;
      const auto [entry, fresh] = found.try_emplace(*root);
      if (fresh) entry->second = {shape_.triangle_part[static_cast<std::size_t>(t)], grid_->empty()};
      grid_->fill(entry->second.mask,
                  detail::clipped(polygon, [&](const Eigen::Vector3d& p) { return p.z() - level; }));
    }
    std::vector<EndPiece> result;
    for (auto& [root, piece] : found)
      if (!piece.mask.covered.empty()) result.push_back(std::move(piece));
    std::stable_sort(result.begin(), result.end(), [](const EndPiece& a, const EndPiece& b) {
      return a.mask.covered.size() > b.mask.covered.size();
    });
    if (result.size() > tolerance::closed_pieces) result.resize(tolerance::closed_pieces);
    return result;
  }

  /// Returns whether pieces do not overlap, or no longer after one of the moves and scalings.
  bool may_pass(const PixelMask& a, const PixelMask& b) const {
    const Eigen::Vector2d stay = Eigen::Vector2d::Zero();
    const int overlap = grid_->overlap(a, b, 1, stay, stay);
    const double most = std::max<double>(apart_pixels, apart_share * overlap);
    if (overlap <= most) return true;
    const double widest = std::pow(1 - tolerance::closed_scale, -2);
    for (const Eigen::Vector2d& centre : {a.middle(), grid_->middle()})
      for (int k = 1; k <= scalings; ++k) {
        const double factor = std::pow(widest, static_cast<double>(k) / scalings);
        for (const double f : {factor, 1 / factor})
          if (grid_->overlap(a, b, f, centre, stay) <= most) return true;
      }
    const double farthest = tolerance::closed_move * diagonal_;
    for (int k = 0; k < move_directions; ++k) {
      const double angle = 2 * std::numbers::pi * k / move_directions;
      for (int distance = 1; distance <= move_distances; ++distance)
        if (grid_->overlap(a, b, 1, stay,
                           distance * farthest / move_distances *
                               Eigen::Vector2d(std::cos(angle), std::sin(angle))) <= most)
          return true;
    }
    return false;
  }

  const Shape& shape_;
  detail::WeldedMesh welded_;
  Points points_;                  ///< in the frame of the direction
  std::optional<PixelGrid> grid_;  ///< none of a shape that is flat along the direction
  double low_ = 0, high_ = 0, diagonal_ = 0;
};

}  // namespace

std::optional<ClosedPair> closed_pair(const Shape& shape, const Direction& direction,
                                      const Stackability& measured, double target) {
  const ClosedSearch search(shape, direction);
  const double allowed = (1 - target) / measured.loss_per_length();
  double deep = std::min((search.height() - allowed) / 2, tolerance::closed_depth * search.height());
  if (search.is_flat() || !(deep > 0)) return std::nullopt;
  const auto found = search.pair(deep);
  if (!found) return std::nullopt;
  double open = 0;
  for (int k = 0; k < bisections; ++k) {
    const double middle = (open + deep) / 2;
    (search.pair(middle) ? deep : open) = middle;
  }
  const double bound = measured.value_at(search.height() - 2 * deep);
  return ClosedPair{found->first, found->second, std::max(bound, measured.value)};
}

std::string describe(const ClosedPair& pair, const Structure& rest) {
  const auto name = [&](int part) { return "'" + rest.parts[at(part)].name + "'"; };
  return "Closed: " + name(pair.upper_part) + " at the top of each copy lies under " +
         (pair.upper_part == pair.lower_part ? "the bottom" : name(pair.lower_part) + " at the bottom") +
         " of the next one, and no move by " + fixed_text(100 * tolerance::closed_move, 0) +
         " % of the diagonal, nor a scaling of both by " + fixed_text(100 * tolerance::closed_scale, 0) +
         " % takes it out of the way. While it does not, S is at most " + fixed_text(pair.stackability, 3) +
         ".";
}

}  // namespace stackabilization
