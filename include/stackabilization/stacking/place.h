#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/stacking/rigid_transform.h"

namespace stackabilization {

/// A place of a shape across the direction r, in the frame of r (see frame_of): where the centre of its box
/// goes, and its turn about the line along r through that centre. The box is that of the shape as given,
/// along the axes u and v of the frame.
struct Place {
  double x = 0, y = 0;     ///< coordinates of the centre along u and v, model units
  double yaw_degrees = 0;  ///< right-handed turn about r, degrees, in (-180, 180]
};

/// Returns the place that the coordinates of a shape say, with no turn. Throws InputError when
/// `validate(shape)` fails.
Place given_place(const Shape& shape, const Direction& direction);

/// Returns the rigid transform that takes a shape from its given place to another one, without lift.
RigidTransform transform_to(const Shape& shape, const Direction& direction, const Place& place);

/// Where a shape comes to rest that comes down along r.
struct Drop {
  Place place;               ///< across r
  RigidTransform transform;  ///< to the place, without lift; coordinates are then rounded to double
  Separation separation;     ///< sep(base, shape at the place, r), exact for the rounded coordinates
  bool on_floor = false;     ///< nothing blocks it above the lowest point of the base
  Rational lift;             ///< from the height of the coordinates, units of r
  double lift_length = 0;    ///< `lift` in model units
  double height = 0;  ///< of the lowest point of the shape above the lowest point of the base, model units
};

/// Lets `shape` come down along r onto `base` at a place, until it touches `base` or stands on the floor
/// below the lowest point of `base`. Exact for the coordinates at the place, rounded to double. Throws
/// InputError when `validate` fails for either shape, and UsageError when the place is not finite.
Drop drop_at(const Shape& base, const Shape& shape, const Direction& direction, const Place& place,
             ContactSemantics semantics = ContactSemantics::solid);

/// What the best place has the least of, in model units.
enum class PlaceGoal {
  height,  ///< height of the lowest point of the shape above that of the base
  gap,     ///< mean distance along r between the two, over the area across r where one lies above the other
  volume,  ///< empty space below the shape, down to the base, or to the floor where there is no base;
           ///< divided by the area of the shape seen along r, which is its mean depth
};

/// Places to choose from, and how well the choice is to be proven.
struct PlaceOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< what counts as a collision
  PlaceGoal goal = PlaceGoal::height;                    ///< what the best place has the least of
  /// For PlaceGoal::gap: least area across r where one lies above the other, fraction of the smaller one of
  /// their areas seen along r, in [0, 1].
  double min_overlap = 0.5;
  /// Corners, in order, of a simple polygon that the centre stays in, border included; coordinates along u
  /// and v, model units. Empty: along u and along v, the box of the shape stays within the box of the base,
  /// or where it is longer, around it.
  std::vector<Eigen::Vector2d> region;
  bool turn = false;  ///< whether the shape may turn about r by any angle
  /// Largest distance between the value of the goal found and the proven bound, model units, > 0.
  double accuracy = 0;
  std::int64_t max_cells = 200'000;           ///< limit of the cells examined, >= 1
  std::function<bool()> cancelled = {};       ///< asked from the calling thread; true ends the search early
  std::function<void(double)> progress = {};  ///< called from the calling thread with a fraction in [0, 1]
};

/// The best place found, and what is proven.
struct BestPlace {
  Drop drop;  ///< at the best place found
  /// Of the goal at that place, model units: a certified range. Of the height, both ends are `drop.height`.
  Range value{0, 0};
  double bound = 0;  ///< no place of the region has a smaller value, model units
  /// Area of the shape seen along r, model units squared: a certified range; 0 for the height.
  Range footprint{0, 0};
  bool proven = false;     ///< value.high - bound <= accuracy
  std::int64_t cells = 0;  ///< cells of places that were examined
  std::int64_t open = 0;   ///< of these, cells that may hold a value below value.high - accuracy
  bool cancelled = false;  ///< whether the search was ended early
};

/// Searches the place where `shape` rests on `base` with the least height, mean gap or space below, with a
/// proof.
///
/// Branch and bound over cells of places (x, y and, with `turn`, yaw). The heights at places are exact. The
/// lower bound of a cell holds for all its places: it compares the upper envelope of one shape over a
/// rectangle with the lower envelope of the other one over all places that a point of it can have there.
/// Mean gap and space are sums over such rectangles, with what is certain of each, for lifts below which no
/// place of the cell has any. Rounding is allowed for, so the bound holds for exact arithmetic. Where
/// `closed` semantics lift the shape higher, the bound stays that of `solid`.
///
/// Values equal to rounding count as equal, mean gaps and spaces equal to a quarter of the accuracy may; of
/// equally good places the first one wins, in the order: given place, centre of the base, places flush with
/// its box, others. Deterministic for any number of threads.
///
/// Throws InputError when `validate` fails for either shape, or when the shape has no area seen along r and
/// the goal needs one, and UsageError for options out of range, or when no place with enough overlap was
/// found.
BestPlace best_place(const Shape& base, const Shape& shape, const Direction& direction,
                     const PlaceOptions& options);

/// Heights at places of a grid.
struct DropMap {
  std::vector<double> x, y;     ///< coordinates of the centre along u and v, rising, model units
  std::vector<double> heights;  ///< as Drop::height, row by row: heights[j * x.size() + i] at (x[i], y[j])
  bool cancelled = false;       ///< whether it was ended early; then `heights` is empty
};

/// Computes the height at every place of the box of the region, with the turn of `yaw_degrees`. The places
/// are `step` apart, from the middle of the box to both sides; exact for the coordinates at each place,
/// rounded to double, as drop_at. Throws as `best_place`, and UsageError when `step` is not positive or gives
/// more than four million places.
DropMap drop_map(const Shape& base, const Shape& shape, const Direction& direction, double step,
                 double yaw_degrees, const PlaceOptions& options);

}  // namespace stackabilization
