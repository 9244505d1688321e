#include "stackabilization/envelope/triangle_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stackabilization/envelope/shear.h"

namespace stackabilization::detail {
namespace {

void fit_box(Piece& piece, double rounding) {
  for (int axis = 0; axis < 3; ++axis) {
    double low = piece.points[0][axis], high = low;
    for (int p = 1; p < piece.point_count; ++p) {
      low = std::min(low, piece.points[p][axis]);
      high = std::max(high, piece.points[p][axis]);
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

void add(Piece& piece, const std::array<double, 3>& point) {
  piece.points[piece.point_count++] = point;
}

/// The halves on either side of the middle of the longest axis; they share the cut points. Precondition: at
/// least one free point.
std::array<Piece, 2> halves(const Piece& piece, double rounding) {
  const int axis = longest_axis(piece);
  const double at = piece.low[axis] + (piece.high[axis] - piece.low[axis]) / 2;
  std::array<Piece, 2> result;
  result[0].triangle = result[1].triangle = piece.triangle;
  for (int p = 0; p < piece.point_count; ++p) {
    const auto& a = piece.points[p];
    const auto& b = piece.points[(p + 1) % piece.point_count];
    if (a[axis] <= at) add(result[0], a);
    if (a[axis] >= at) add(result[1], a);
    if ((a[axis] < at && b[axis] > at) || (a[axis] > at && b[axis] < at)) {
      const double t = (at - a[axis]) / (b[axis] - a[axis]);
      std::array<double, 3> point;
      for (int other = 0; other < 3; ++other) point[other] = a[other] + t * (b[other] - a[other]);
      point[axis] = at;
      add(result[0], point);
      add(result[1], point);
    }
  }
  for (Piece& half : result)
    if (half.point_count > 0) fit_box(half, rounding);
  return result;
}

/// What cutting a piece saves in box surface. The split is cheap enough to be done twice.
double gain(const Piece& piece, double rounding) {
  if (piece.point_count >= Piece::most_points) return 0;
  const std::array<Piece, 2> parts = halves(piece, rounding);
  if (parts[0].point_count < 3 || parts[1].point_count < 3) return 0;
  return box_area(piece) - box_area(parts[0]) - box_area(parts[1]);
}

struct Saving {
  double area;
  std::size_t piece;

  friend bool operator<(const Saving& a, const Saving& b) {
    return a.area != b.area ? a.area < b.area : a.piece > b.piece;
  }
};

}  // namespace

std::vector<Piece> cut_into_pieces(const std::vector<TreeTriangle>& triangles) {
  double magnitude = 0;
  for (const TreeTriangle& triangle : triangles)
    for (const auto& corner : triangle.corners)
      for (const double coordinate : corner) magnitude = std::max(magnitude, std::abs(coordinate));
  const double rounding = 8 * unit_roundoff * magnitude;

  std::vector<Piece> pieces(triangles.size());
  double total = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    pieces[t].triangle = static_cast<std::int32_t>(t);
    for (const auto& corner : triangles[t].corners) add(pieces[t], corner);
    fit_box(pieces[t], 0);
    total += box_area(pieces[t]);
  }
  // Cuts that save less than a small share of the mean box are not worth a node.
  const std::size_t most = 2 * triangles.size() + 2048;
  const double least = total / static_cast<double>(most) / 64;
  std::vector<Saving> savings;
  const auto offer = [&](std::size_t piece) {
    const double area = gain(pieces[piece], rounding);
    if (!(area > least)) return;
    savings.push_back({area, piece});
    std::push_heap(savings.begin(), savings.end());
  };
  for (std::size_t t = 0; t < triangles.size(); ++t) offer(t);
  while (!savings.empty() && pieces.size() < most) {
    const std::size_t chosen = savings.front().piece;
    std::pop_heap(savings.begin(), savings.end());
    savings.pop_back();
    const std::array<Piece, 2> parts = halves(pieces[chosen], rounding);
    pieces[chosen] = parts[0];
    pieces.push_back(parts[1]);
    offer(chosen);
    offer(pieces.size() - 1);
  }
  return pieces;
}

}  // namespace stackabilization::detail
