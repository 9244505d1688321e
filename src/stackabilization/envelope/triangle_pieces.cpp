#include "stackabilization/envelope/triangle_pieces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stackabilization/envelope/shear.h"

namespace stackabilization::detail {
namespace {

void fit_box(Piece& piece, const PiecePolygon& polygon, double rounding) {
  for (int axis = 0; axis < 3; ++axis) {
    double low = polygon.points[0][axis], high = low;
    for (int p = 1; p < polygon.point_count; ++p) {
      low = std::min(low, polygon.points[p][axis]);
      high = std::max(high, polygon.points[p][axis]);
    }
    // Interpolation between equal coordinates is exact: flat triangles keep flat boxes.
    const double margin = high > low ? rounding : 0;
    piece.low[axis] = low - margin;
    piece.high[axis] = high + margin;
  }
}

int longest_axis(const Piece& piece) {
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (piece.high[axis] - piece.low[axis] > piece.high[longest] - piece.low[longest]) longest = axis;
  return longest;
}

/// Half the surface of the box.
double box_area(const Piece& piece) {
  const double a = piece.high[0] - piece.low[0], b = piece.high[1] - piece.low[1],
               c = piece.high[2] - piece.low[2];
  return a * b + b * c + c * a;
}

void add(PiecePolygon& polygon, const std::array<double, 3>& point) {
  polygon.points[polygon.point_count++] = point;
}

struct Half {
  Piece piece;
  PiecePolygon polygon;
};

/// The halves on either side of the middle of the longest axis; they share the cut points. Precondition: room
/// for one more point.
std::array<Half, 2> halves(const Piece& piece, const PiecePolygon& polygon, double rounding) {
  const int axis = longest_axis(piece);
  const double at = piece.low[axis] + (piece.high[axis] - piece.low[axis]) / 2;
  std::array<Half, 2> result;
  for (int p = 0; p < polygon.point_count; ++p) {
    const auto& a = polygon.points[p];
    const auto& b = polygon.points[(p + 1) % polygon.point_count];
    if (a[axis] <= at) add(result[0].polygon, a);
    if (a[axis] >= at) add(result[1].polygon, a);
    if ((a[axis] < at && b[axis] > at) || (a[axis] > at && b[axis] < at)) {
      const double t = (at - a[axis]) / (b[axis] - a[axis]);
      std::array<double, 3> point;
      for (int other = 0; other < 3; ++other) point[other] = a[other] + t * (b[other] - a[other]);
      point[axis] = at;
      add(result[0].polygon, point);
      add(result[1].polygon, point);
    }
  }
  for (Half& half : result) {
    half.piece.triangle = piece.triangle;
    if (half.polygon.point_count > 0) fit_box(half.piece, half.polygon, rounding);
  }
  return result;
}

/// What cutting a piece saves in box surface. The cut is cheap enough to be made twice.
double saving(const Piece& piece, const PiecePolygon& polygon, double rounding) {
  if (polygon.point_count >= PiecePolygon::most_points) return 0;
  const std::array<Half, 2> parts = halves(piece, polygon, rounding);
  if (parts[0].polygon.point_count < 3 || parts[1].polygon.point_count < 3) return 0;
  return box_area(piece) - box_area(parts[0].piece) - box_area(parts[1].piece);
}

constexpr std::size_t most_cuts = 100000;

/// Cuts the piece with the largest saving, again and again.
class Cutter {
 public:
  explicit Cutter(const std::vector<TreeTriangle>& triangles) : triangles_(triangles) {
    for (const TreeTriangle& triangle : triangles)
      for (const auto& corner : triangle.corners)
        for (const double coordinate : corner) rounding_ = std::max(rounding_, std::abs(coordinate));
    rounding_ *= 8 * unit_roundoff;
    wrap_triangles();
  }

  Pieces run() {
    // Small shapes may take more, their trees are cheap; of large ones only the worst triangles matter. Cuts
    // that save less than half of the mean box take longer to make than they save.
    const std::size_t most = triangles_.size() + std::min(triangles_.size() + 2048, most_cuts);
    const double least = total_ / static_cast<double>(most) / 2;
    std::vector<double> savings(triangles_.size());
    tbb::parallel_for(std::size_t{0}, savings.size(), [&](std::size_t t) {
      const Piece& piece = result_.pieces[t];
      if (box_area(piece) > least)
        savings[t] = saving(piece, polygon_of(piece, result_, triangles_), rounding_);
    });
    for (std::size_t t = 0; t < savings.size(); ++t)
      if (savings[t] > least) queue_.push_back({savings[t], t});
    std::make_heap(queue_.begin(), queue_.end());
    while (!queue_.empty() && result_.pieces.size() < most) {
      const std::size_t chosen = queue_.front().piece;
      std::pop_heap(queue_.begin(), queue_.end());
      queue_.pop_back();
      cut(chosen, least);
    }
    return std::move(result_);
  }

 private:
  struct Entry {
    double saving;
    std::size_t piece;

    friend bool operator<(const Entry& a, const Entry& b) {
      return a.saving != b.saving ? a.saving < b.saving : a.piece > b.piece;
    }
  };

  void wrap_triangles() {
    result_.pieces.resize(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      Piece& piece = result_.pieces[t];
      piece.triangle = static_cast<std::int32_t>(t);
      fit_box(piece, polygon_of(piece, result_, triangles_), 0);
      total_ += box_area(piece);
    }
  }

  void cut(std::size_t chosen, double least) {
    const Piece piece = result_.pieces[chosen];
    std::array<Half, 2> parts = halves(piece, polygon_of(piece, result_, triangles_), rounding_);
    parts[0].piece.polygon = piece.polygon;
    for (Half& part : parts) {
      if (part.piece.polygon < 0) {
        part.piece.polygon = static_cast<std::int32_t>(result_.polygons.size());
        result_.polygons.emplace_back();
      }
      result_.polygons[static_cast<std::size_t>(part.piece.polygon)] = part.polygon;
    }
    result_.pieces[chosen] = parts[0].piece;
    result_.pieces.push_back(parts[1].piece);
    for (const std::size_t index : {chosen, result_.pieces.size() - 1}) {
      const Piece& half = result_.pieces[index];
      const double worth = saving(half, polygon_of(half, result_, triangles_), rounding_);
      if (!(worth > least)) continue;
      queue_.push_back({worth, index});
      std::push_heap(queue_.begin(), queue_.end());
    }
  }

  const std::vector<TreeTriangle>& triangles_;
  Pieces result_;
  std::vector<Entry> queue_;  ///< binary heap
  double rounding_ = 0;       ///< bound on how far a cut point lies off its triangle
  double total_ = 0;          ///< box surface of all triangles
};

}  // namespace

PiecePolygon polygon_of(const Piece& piece, const Pieces& pieces,
                        const std::vector<TreeTriangle>& triangles) {
  if (piece.polygon >= 0) return pieces.polygons[static_cast<std::size_t>(piece.polygon)];
  PiecePolygon whole;
  for (const auto& corner : triangles[static_cast<std::size_t>(piece.triangle)].corners) add(whole, corner);
  return whole;
}

Pieces cut_into_pieces(const std::vector<TreeTriangle>& triangles) {
  return Cutter(triangles).run();
}

}  // namespace stackabilization::detail
