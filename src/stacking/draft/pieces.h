#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "envelope/contacts/planar_union.h"
#include "stackabilization/core/direction.h"

namespace stackabilization::detail {

/// Corners of a convex polygon in space, in order, either orientation.
using Piece = std::vector<Eigen::Vector3d>;

/// Returns the portion of a piece that lies over another one, seen along `along`.
Piece common_part(const Piece& piece, const Piece& other, const Eigen::Vector3d& along);

/// Areas of pieces of one triangle, which may overlap, seen along a direction.
class Pieces {
 public:
  Pieces(const Piece& triangle, const Eigen::Vector3d& along);

  /// Returns the portion of the triangle under the union of pieces, in [0, 1], and 0 for a triangle without
  /// area. Accuracy of union_area.
  double share(const std::vector<Piece>& pieces) const;
  /// Returns whether the union is the triangle, within tolerance::relative.
  bool cover_all(const std::vector<Piece>& pieces) const;
  /// Moves pieces that meet a condition, largest first. Those in one of the first 8 of `to` meet it too, and
  /// are left out without asking.
  void move_those(std::vector<Piece>& from, std::vector<Piece>& to,
                  const std::function<bool(const Piece&)>& condition) const;
  /// Returns the intersection of two unions. Where there are more than 2^16 pairs of pieces it returns
  /// nothing, and `complete` becomes false.
  std::vector<Piece> common(std::vector<Piece> some, std::vector<Piece> others, bool& complete) const;

 private:
  ConvexPolygon outline(const Piece& piece) const;

  Frame frame_;
  double whole_;
};

}  // namespace stackabilization::detail
