#include "stackabilization/stacking/place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stacking/place/local_frame.h"
#include "stacking/place/local_lift.h"
#include "stacking/place/place_bounds.h"
#include "stacking/place/place_gap.h"
#include "stacking/place/place_region.h"

namespace stackabilization {

namespace {

using detail::CellBound;
using detail::LocalLift;
using detail::LocalPlace;
using detail::PlaceCell;
using detail::PlanarBox;
using detail::Touch;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Halvings of the step at the end, and trials per step size: from the accuracy down to rounding.
constexpr int last_halvings = 30;
constexpr int trials_per_step = 4;
/// Width of the range of a mean gap or a mean depth at a place, and what another place is better by, fraction
/// of the accuracy.
constexpr double share_at_place = 0.25;

/// A cell that is not closed, with what is known of it.
struct OpenCell {
  PlaceCell cell;
  CellBound lift;
  double low = 0;           ///< of the goal
  std::int64_t number = 0;  ///< in the order of creation

  /// Heap order: the lowest bound first, then the first one made.
  friend bool operator<(const OpenCell& a, const OpenCell& b) {
    return a.low != b.low ? a.low > b.low : a.number > b.number;
  }
};

/// The search; values of the goal are lifts for PlaceGoal::height.
class PlaceSearch {
 public:
  PlaceSearch(const detail::LocalShapes& shapes, const PlaceOptions& options)
      : options_(options),
        region_(shapes, options.region),
        lift_(shapes, options.semantics),
        bounds_(shapes),
        rounding_(tolerance::rounding * shapes.size),
        radius_(shapes.shape.vertices.leftCols<2>().rowwise().norm().maxCoeff()) {
    const detail::Outline base(shapes.base);
    starts_ = {{shapes.centre.x(), shapes.centre.y(), 0}, {base.centre().x(), base.centre().y(), 0}};
    least_ = lift_.floor();
    if (options.goal == PlaceGoal::height) return;
    footprint_ = bounds_.area_of_shape();
    if (!(footprint_.low > 0))
      throw InputError("the shape has no area seen along the direction, so nothing lies below it");
    Range area = footprint_;
    if (options.goal == PlaceGoal::gap)
      area = {options.min_overlap * std::min(footprint_.high, bounds_.area_of_base().high), infinity};
    gap_.emplace(bounds_, options.goal, range_along(shapes.base, Eigen::Vector3d::UnitZ()).low, area);
    least_ = 0;
  }

  void run() {
    try_starts();
    for (const PlaceCell& cell : first_cells()) examine(cell, {{}, least_});
    while (!open_.empty() && !ended()) {
      const OpenCell next = open_.top();
      if (next.low >= enough()) break;
      open_.pop();
      split(next);
      report(next.low);
    }
    if (!gap_) descend();
  }

  /// Returns nothing where no place has enough overlap.
  std::optional<LocalPlace> best_place() const {
    return best_.high < infinity ? std::optional(best_place_) : std::nullopt;
  }
  Range best() const { return best_; }
  /// Returns the value that no place has less of.
  double bound() const {
    const double open = open_.empty() ? infinity : open_.top().low;
    return std::max(least_, std::min({best_.high, closed_low_, open}));
  }
  const Range& footprint() const { return footprint_; }
  std::int64_t cells() const { return cells_; }
  std::int64_t open_cells() const {
    auto left = open_;
    std::int64_t count = 0;
    for (; !left.empty() && left.top().low < enough(); left.pop()) ++count;
    return count;
  }
  bool cancelled() const { return cancelled_; }
  double floor() const { return lift_.floor(); }

 private:
  /// What is known of a cell.
  struct Known {
    CellBound lift;
    double low;  ///< of the goal
  };

  double enough() const { return best_.high - options_.accuracy; }

  bool ended() {
    if (cells_ >= options_.max_cells) return true;
    if (options_.cancelled && !cancelled_) cancelled_ = options_.cancelled();
    return cancelled_;
  }

  /// Cells are halved until the bound is close: a logarithm of what is left.
  void report(double low) const {
    if (!options_.progress || best_.high == infinity) return;
    const double gap = std::max(best_.high - std::max(low, least_), options_.accuracy);
    const double first = std::max(best_.high - least_, options_.accuracy);
    options_.progress(first > options_.accuracy ? std::log(first / gap) / std::log(first / options_.accuracy)
                                                : 1);
  }

  Touch try_place(const LocalPlace& place) {
    const Touch touch = lift_(place);
    if (!gap_) take(place, {touch.lift, touch.lift});
    return touch;
  }

  void take(const LocalPlace& place, const Range& value) {
    if (value.high >= best_.high - rounding_) return;
    best_ = value;
    best_place_ = place;
  }

  void take_gap(const LocalPlace& place, double lift) {
    const double step = share_at_place * options_.accuracy;
    take(place, gap_->at(place, lift, step, best_.high - std::max(step, rounding_)));
  }

  /// The given place, the middle of the base, and the corners and the middle of the region.
  void try_starts() {
    const auto try_if_allowed = [this](const LocalPlace& place) {
      const PlaceCell cell{{place.x, place.x, place.y, place.y}, place.yaw, 0};
      if (!region_.place_in(cell)) return;
      const Touch touch = try_place(place);
      if (gap_) take_gap(place, touch.lift);
    };
    for (const LocalPlace& start : starts_) try_if_allowed(start);
    for (const double quarter : {0.0, 0.5, -0.5, 1.0}) {
      if (quarter != 0 && !options_.turn) break;
      const double yaw = quarter * std::numbers::pi;
      const PlanarBox box = region_.box(yaw, 0);
      for (const double y : {box.y_low, box.y_low / 2 + box.y_high / 2, box.y_high})
        for (const double x : {box.x_low, box.x_low / 2 + box.x_high / 2, box.x_high})
          try_if_allowed({x, y, yaw});
    }
  }

  std::vector<PlaceCell> first_cells() const {
    if (!options_.turn) return {{region_.box(0, 0), 0, 0}};
    std::vector<PlaceCell> cells;
    constexpr int sectors = 8;
    const double half_turn = std::numbers::pi / sectors;
    for (int i = 0; i < sectors; ++i) {
      // Multiples of an eighth of a turn, so that quarter turns are exact.
      const double yaw = (i <= sectors / 2 ? i : i - sectors) * 2 * half_turn;
      cells.push_back({region_.box(yaw, half_turn), yaw, half_turn});
    }
    return cells;
  }

  /// Two halves, across the side along which places of the cell differ most.
  void split(const OpenCell& open) {
    const PlanarBox& box = open.cell.box;
    PlaceCell first = open.cell, second = open.cell;
    const double turn = 2 * open.cell.half_turn * radius_;
    if (turn >= std::max(box.width(), box.height())) {
      first.half_turn = second.half_turn = open.cell.half_turn / 2;
      first.yaw -= first.half_turn;
      second.yaw += second.half_turn;
    } else if (box.width() >= box.height()) {
      first.box.x_high = second.box.x_low = box.x_low / 2 + box.x_high / 2;
    } else {
      first.box.y_high = second.box.y_low = box.y_low / 2 + box.y_high / 2;
    }
    examine(first, {open.lift, open.low});
    examine(second, {open.lift, open.low});
  }

  /// Closes a cell whose bound is high enough. Of others it tries a place.
  void examine(const PlaceCell& cell, const Known& around) {
    if (region_.excludes(cell)) return;
    ++cells_;
    const auto place = region_.place_in(cell);
    Known known{{std::max(around.lift.low, lift_.floor()), {}}, around.low};
    const bool closed =
        gap_ ? bound_gap(cell, around, place, known) : bound_height(cell, around, place, known);
    if (closed || is_point(cell))
      closed_low_ = std::min(closed_low_, known.low);
    else
      open_.push({cell, known.lift, known.low, cells_});
  }

  /// Returns whether the bound is high enough. The contact at the place that is tried may show more.
  bool bound_height(const PlaceCell& cell, const Known& around, const std::optional<LocalPlace>& place,
                    Known& known) {
    const auto raise = [&](const CellBound& bound) {
      if (bound.low > known.lift.low) known.lift = bound;
      known.low = known.lift.low;
      return known.low >= enough();
    };
    bool closed = around.lift.witness && raise(bounds_.bound(cell, *around.lift.witness));
    if (!closed) {
      const Touch touch = place ? try_place(*place) : Touch{};
      closed = raise(known.lift) ||
               (!touch.on_floor && raise(bounds_.bound_near(cell, touch.of_shape, touch.of_base)));
    }
    return closed || raise(bounds_.search(cell, enough()));
  }

  /// The same for mean gap and volume. They need the lift as high as it can be shown to be: nearly what the
  /// centre and the corners of the cell have, at least.
  bool bound_gap(const PlaceCell& cell, const Known& around, const std::optional<LocalPlace>& place,
                 Known& known) {
    const auto raise = [&](const CellBound& bound) {
      if (bound.low > known.lift.low) known.lift = bound;
    };
    if (around.lift.witness) raise(bounds_.bound(cell, *around.lift.witness));
    Touch lowest{infinity};
    const PlanarBox& box = cell.box;
    for (const LocalPlace& corner :
         {LocalPlace{box.x_low / 2 + box.x_high / 2, box.y_low / 2 + box.y_high / 2, cell.yaw},
          LocalPlace{box.x_low, box.y_low, cell.yaw}, LocalPlace{box.x_high, box.y_low, cell.yaw},
          LocalPlace{box.x_low, box.y_high, cell.yaw}, LocalPlace{box.x_high, box.y_high, cell.yaw}})
      if (const Touch touch = lift_(corner); touch.lift < lowest.lift) lowest = touch;
    if (!lowest.on_floor) raise(bounds_.bound_near(cell, lowest.of_shape, lowest.of_base));
    const double wanted = lowest.lift - share_at_place * options_.accuracy;
    if (known.lift.low < wanted) raise(bounds_.search(cell, wanted));
    if (!known.lift.witness) known.lift.witness = around.lift.witness;
    known.low = std::max(known.low, gap_->low(cell, bounds_.lift(cell, known.lift), enough()));
    if (known.low < enough() && place) {
      const double lift = lift_(*place).lift;
      if (gap_->estimate(*place, lift) < best_.high) take_gap(*place, lift);
    }
    return known.low >= enough();
  }

  /// Returns whether halves of the cell would hold the same places up to rounding.
  bool is_point(const PlaceCell& cell) const {
    return std::max({cell.box.width(), cell.box.height(), 2 * cell.half_turn * radius_}) <= rounding_;
  }

  /// From the best place on to the bottom next to it, by steps across and turns that are halved.
  void descend() {
    double step = std::max(options_.accuracy, rounding_);
    for (int level = 0; level < last_halvings && step > rounding_ && best_.high > bound() + rounding_;
         ++level) {
      for (int trial = 0; trial < trials_per_step; ++trial) {
        const double before = best_.high;
        const LocalPlace from = best_place_;
        const double turn = options_.turn && radius_ > 0 ? step / radius_ : 0;
        for (const LocalPlace& place :
             {LocalPlace{from.x + step, from.y, from.yaw}, LocalPlace{from.x - step, from.y, from.yaw},
              LocalPlace{from.x, from.y + step, from.yaw}, LocalPlace{from.x, from.y - step, from.yaw},
              LocalPlace{from.x, from.y, from.yaw + turn}, LocalPlace{from.x, from.y, from.yaw - turn}}) {
          const PlaceCell cell{{place.x, place.x, place.y, place.y}, place.yaw, 0};
          if ((place.yaw != from.yaw || turn == 0 || place.x != from.x || place.y != from.y) &&
              region_.place_in(cell))
            try_place(place);
        }
        if (best_.high >= before) break;
      }
      step /= 2;
    }
  }

  const PlaceOptions& options_;
  detail::PlaceRegion region_;
  LocalLift lift_;
  detail::PlaceBounds bounds_;
  double rounding_, radius_;
  std::vector<LocalPlace> starts_;
  std::optional<detail::PlaceGap> gap_;  ///< unless the goal is the height
  Range footprint_{0, 0};
  double least_ = 0;  ///< value that no place has less of, whatever the shapes
  LocalPlace best_place_;
  Range best_{infinity, infinity};
  double closed_low_ = infinity;  ///< lowest bound of the closed cells
  std::priority_queue<OpenCell> open_;
  std::int64_t cells_ = 0;
  bool cancelled_ = false;
};

}  // namespace

BestPlace best_place(const Shape& base, const Shape& shape, const Direction& direction,
                     const PlaceOptions& options) {
  validate(base);
  validate(shape);
  if (!(options.accuracy > 0)) throw UsageError("the accuracy of a place must be a positive length");
  if (options.max_cells < 1) throw UsageError("a search for a place examines at least one cell");
  if (!(options.min_overlap >= 0 && options.min_overlap <= 1))
    throw UsageError("the least overlap must be a share between 0 and 1");
  const detail::LocalShapes shapes(base, shape, direction);
  PlaceSearch search(shapes, options);
  search.run();
  const std::optional<LocalPlace> found = search.best_place();
  if (!found)
    throw UsageError(
        "at no place that was tried does one lie above the other over as large an area as the mean gap is to "
        "have");
  BestPlace best;
  best.drop =
      drop_at(base, shape, direction,
              {found->x, found->y, reduced_degrees(found->yaw * 180 / std::numbers::pi)}, options.semantics);
  if (options.goal == PlaceGoal::height) {
    best.value = {best.drop.height, best.drop.height};
    best.bound = std::min(search.bound() - search.floor(), best.drop.height);
  } else {
    best.value = search.best();
    best.bound = search.bound();
    best.footprint = search.footprint();
  }
  best.proven = best.value.high - best.bound <= options.accuracy;
  best.cells = search.cells();
  best.open = search.open_cells();
  best.cancelled = search.cancelled();
  return best;
}

}  // namespace stackabilization
