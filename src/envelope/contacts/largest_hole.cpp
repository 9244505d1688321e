#include <algorithm>
#include <limits>

#include "envelope/contacts/outline_bounds.h"
#include "envelope/contacts/planar_union.h"

namespace stackabilization::detail {
namespace {

/// Coarse bitmap of the cells that the outlines touch. Touched cells count as covered, which closes cracks
/// and small gaps between neighbouring outlines.
class CoverageBitmap {
 public:
  CoverageBitmap(const OutlineBounds& bounds) : low_(bounds.low), covered_(side * side, 0) {
    const double longer = (bounds.high - bounds.low).maxCoeff();
    // One empty cell all around connects the outside.
    cell_ = longer > 0 ? longer / (side - 2) : 1;
  }

  void add(const ConvexPolygon& outline) {
    OutlineBounds bounds;
    bounds.add(outline);
    const int last = row_of(bounds.high.y());
    for (int row = row_of(bounds.low.y()); row <= last; ++row) fill_row(outline, row);
  }

  /// Returns the area of the largest set of free cells that does not reach the border.
  double largest_hole() {
    if (!has_gaps()) return 0;
    flood(0);
    std::size_t largest = 0;
    for (std::size_t cell = 0; cell < covered_.size(); ++cell)
      if (!covered_[cell]) largest = std::max(largest, flood(cell));
    return static_cast<double>(largest) * cell_ * cell_;
  }

 private:
  static constexpr int side = 256;

  int index_of(double offset) const { return 1 + std::clamp(static_cast<int>(offset / cell_), 0, side - 3); }
  int row_of(double y) const { return index_of(y - low_.y()); }

  /// Covers the cells of one row that the outline reaches within it.
  void fill_row(const ConvexPolygon& outline, int row) {
    const double bottom = low_.y() + (row - 1) * cell_, top = bottom + cell_;
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (std::size_t c = 0; c < outline.size(); ++c) {
      const Eigen::Vector2d &a = outline[c], &b = outline[(c + 1) % outline.size()];
      for (const double y : {std::clamp(a.y(), bottom, top), std::clamp(b.y(), bottom, top)}) {
        if (std::max(a.y(), b.y()) < bottom || std::min(a.y(), b.y()) > top) continue;
        const double x = a.y() == b.y() ? a.x() : a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        left = std::min({left, x, a.y() == b.y() ? b.x() : x});
        right = std::max({right, x, a.y() == b.y() ? b.x() : x});
      }
    }
    if (left > right) return;
    const auto cells = covered_.begin() + static_cast<std::ptrdiff_t>(row) * side;
    std::fill(cells + index_of(left - low_.x()), cells + index_of(right - low_.x()) + 1, char{1});
  }

  /// Returns whether some row is covered in several runs. Otherwise all free cells reach the border along
  /// their row.
  bool has_gaps() const {
    for (auto row = covered_.begin(); row != covered_.end(); row += side) {
      const auto first = std::find(row, row + side, 1);
      const auto end = std::find(first, row + side, 0);
      if (std::find(end, row + side, 1) != row + side) return true;
    }
    return false;
  }

  /// Covers all free cells connected with `start` by sides; returns their number.
  std::size_t flood(std::size_t start) {
    std::vector<std::size_t> open{start};
    covered_[start] = 1;
    std::size_t count = 0;
    const auto visit = [&](std::size_t cell) {
      if (covered_[cell]) return;
      covered_[cell] = 1;
      open.push_back(cell);
    };
    while (!open.empty()) {
      const std::size_t cell = open.back(), column = cell % side, row = cell / side;
      open.pop_back();
      ++count;
      if (column > 0) visit(cell - 1);
      if (column + 1 < side) visit(cell + 1);
      if (row > 0) visit(cell - side);
      if (row + 1 < side) visit(cell + side);
    }
    return count;
  }

  Eigen::Vector2d low_;
  double cell_;
  std::vector<char> covered_;
};

}  // namespace

double largest_hole(const std::vector<ConvexPolygon>& outlines) {
  OutlineBounds bounds;
  for (const ConvexPolygon& outline : outlines) bounds.add(outline);
  CoverageBitmap bitmap(bounds);
  for (const ConvexPolygon& outline : outlines) bitmap.add(outline);
  return bitmap.largest_hole();
}

}  // namespace stackabilization::detail
