#pragma once

#include <limits>
#include <vector>

#include "stackabilization/stacking/place.h"
#include "stacking/place/place_bounds.h"

namespace stackabilization::detail {

/// Bounds of the mean gap below the shape, or of the mean depth of the space below it, see PlaceGoal.
///
/// The integrals over the projection of the shape are sums over rectangles, which are quartered where they
/// leave most open. Over a rectangle, g = t - (u - l) for the lift t. Of a rectangle that the border of a
/// projection meets, any share of the area may count, as long as all together are the area of the projection.
class PlaceGap {
 public:
  /// `area` is what the mean is taken over: the area of the projection of the shape, or for the mean gap what
  /// the overlap is to have, at least. Keeps a reference to `bounds`.
  PlaceGap(PlaceBounds& bounds, PlaceGoal goal, double floor, const Range& area);

  /// Returns what no place of the cell has less of, where lifts are at least `lift`; inf where the overlap is
  /// too small at all of them. Ends early when the bound is `enough`. Where lift and surfaces change with the
  /// place alike, the bound does not suffer: both are taken as linear in it.
  double low(const PlaceCell& cell, const LinearBound& lift, double enough);
  /// Returns the value at a place with its lift by samples of both surfaces; inf where there is no overlap in
  /// them.
  double estimate(const LocalPlace& place, double lift);
  /// Returns a range of the value at a place with its lift, as narrow as `accuracy` if 2^16 rectangles allow
  /// that; {inf, inf} where the overlap is not certainly large enough. Ends early when the value is certainly
  /// not below `enough`; then the upper end is inf.
  Range at(const LocalPlace& place, double lift, double accuracy, double enough);

 private:
  /// A rectangle of the shape with what it contributes.
  struct Block {
    PlanarBox box{};
    double area = 0;
    bool certain = false;              ///< the gap counts all over it
    double gap_low = 0, gap_high = 0;  ///< where it counts, or its mean where it counts all over
    LinearBound gap;                   ///< from below, at the places of the cell
    double doubt = 0;                  ///< how much it may change the integral

    friend bool operator<(const Block& a, const Block& b) { return a.doubt < b.doubt; }
  };
  /// A partition of the shape, and the query that it answers.
  struct Query {
    const PlaceCell& cell;
    LinearBound lift;
    double finest;
    Range mean{0, std::numeric_limits<double>::infinity()};  ///< as far as it is known
    std::vector<Block> heap{};                               ///< by `doubt`
    std::vector<Block> settled{};                            ///< not cut further
  };

  void add(Query& query, const PlanarBox& box);
  double doubt(const Query& query, const Block& block) const;
  void sort_by_doubt(Query& query, const Range& mean);
  /// Cuts the blocks with most doubt until there are `count`; false where no doubt is left.
  bool refine(Query& query, std::size_t count);
  Range value(const Query& query) const;

  PlaceBounds& bounds_;
  PlaceGoal goal_;
  double floor_;
  Range area_;
};

}  // namespace stackabilization::detail
