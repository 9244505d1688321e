#include "stackabilization/stacking/place.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <queue>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stacking/place/local_frame.h"
#include "stacking/place/place_bounds.h"
#include "stacking/place/place_region.h"

namespace stackabilization {

namespace {

using detail::CellBound;
using detail::LocalPlace;
using detail::PlaceCell;
using detail::PlanarBox;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Turned trees that are kept.
constexpr std::size_t max_trees = 64;
/// Halvings of the step at the end, and trials per step size: from the accuracy down to rounding.
constexpr int last_halvings = 30;
constexpr int trials_per_step = 4;

/// A lift, and the points across r that touch; those of the shape before it is turned and moved.
struct Touch {
  double lift = 0;
  bool on_floor = true;
  Eigen::Vector2d of_shape = Eigen::Vector2d::Zero(), of_base = Eigen::Vector2d::Zero();
};

/// Lifts of the local coordinates along the third axis, exact for these, rounded.
class LocalLift {
 public:
  LocalLift(const detail::LocalShapes& shapes, ContactSemantics semantics)
      : shapes_(shapes), semantics_(semantics), base_(shapes.base) {
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    floor_ = range_along(shapes.base, up).low - range_along(shapes.shape, up).low;
  }

  /// Returns the lift at which the shape stands on the floor.
  double floor() const { return floor_; }

  Touch operator()(const LocalPlace& place) {
    const SeparationTree moved = turned(place.yaw).translated({place.x, place.y, 0});
    const Separation found = separation(base_, moved, Direction(0, 0, 1), {semantics_, std::nullopt});
    if (!found.blocked || found.length < floor_) return {floor_};
    const Eigen::Vector2d touching = found.witness.lower_point.head<2>() - Eigen::Vector2d(place.x, place.y);
    return {found.length, false, Eigen::Rotation2Dd(-place.yaw) * touching,
            found.witness.upper_point.head<2>()};
  }

 private:
  const SeparationTree& turned(double yaw) {
    if (const auto known = trees_.find(yaw); known != trees_.end()) return known->second;
    if (trees_.size() == max_trees) trees_.clear();
    const Line axis;
    const RigidTransform turn = rotation_about(axis, yaw * 180 / std::numbers::pi);
    return trees_.emplace(yaw, SeparationTree(transformed(shapes_.shape, turn))).first->second;
  }

  const detail::LocalShapes& shapes_;
  ContactSemantics semantics_;
  SeparationTree base_;
  double floor_ = 0;
  std::map<double, SeparationTree> trees_;
};

/// A cell that is not closed, with what is known of it.
struct OpenCell {
  PlaceCell cell;
  CellBound bound;
  std::int64_t number = 0;  ///< in the order of creation

  /// Heap order: the lowest bound first, then the first one made.
  friend bool operator<(const OpenCell& a, const OpenCell& b) {
    return a.bound.low != b.bound.low ? a.bound.low > b.bound.low : a.number > b.number;
  }
};

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
  }

  void run() {
    try_starts();
    for (const PlaceCell& cell : first_cells()) examine(cell, {});
    while (!open_.empty() && !ended()) {
      const OpenCell next = open_.top();
      if (next.bound.low >= enough()) break;
      open_.pop();
      split(next);
      report(next.bound.low);
    }
    descend();
  }

  const LocalPlace& best_place() const { return best_; }
  /// Returns the lift that no place has less of.
  double bound() const {
    const double open = open_.empty() ? infinity : open_.top().bound.low;
    return std::max(lift_.floor(), std::min({best_lift_, closed_low_, open}));
  }
  std::int64_t cells() const { return cells_; }
  std::int64_t open_cells() const {
    auto left = open_;
    std::int64_t count = 0;
    for (; !left.empty() && left.top().bound.low < enough(); left.pop()) ++count;
    return count;
  }
  bool cancelled() const { return cancelled_; }
  double floor() const { return lift_.floor(); }

 private:
  double enough() const { return best_lift_ - options_.accuracy; }

  bool ended() {
    if (cells_ >= options_.max_cells) return true;
    if (options_.cancelled && !cancelled_) cancelled_ = options_.cancelled();
    return cancelled_;
  }

  /// Cells are halved until the bound is close: a logarithm of what is left.
  void report(double low) const {
    if (!options_.progress) return;
    const double gap = std::max(best_lift_ - std::max(low, lift_.floor()), options_.accuracy);
    const double first = std::max(best_lift_ - lift_.floor(), options_.accuracy);
    options_.progress(first > options_.accuracy ? std::log(first / gap) / std::log(first / options_.accuracy)
                                                : 1);
  }

  Touch try_place(const LocalPlace& place) {
    const Touch touch = lift_(place);
    if (touch.lift < best_lift_ - rounding_) {
      best_lift_ = touch.lift;
      best_ = place;
    }
    return touch;
  }

  /// The given place, the middle of the base, and the corners and the middle of the region.
  void try_starts() {
    const auto try_if_allowed = [this](const LocalPlace& place) {
      const PlaceCell cell{{place.x, place.x, place.y, place.y}, place.yaw, 0};
      if (region_.place_in(cell)) try_place(place);
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
    examine(first, open.bound);
    examine(second, open.bound);
  }

  /// Closes a cell whose bound is high enough. Of others it tries a place, whose contact may show more.
  void examine(const PlaceCell& cell, const CellBound& around) {
    if (region_.excludes(cell)) return;
    ++cells_;
    CellBound best{std::max(around.low, lift_.floor()), {}};
    const auto take = [&](const CellBound& bound) {
      if (bound.low > best.low) best = bound;
      return best.low >= enough();
    };
    bool closed = around.witness && take(bounds_.bound(cell, *around.witness));
    if (!closed) {
      const auto place = region_.place_in(cell);
      const Touch touch = place ? try_place(*place) : Touch{};
      closed = best.low >= enough() ||
               (!touch.on_floor && take(bounds_.bound_near(cell, touch.of_shape, touch.of_base)));
    }
    closed = closed || take(bounds_.search(cell, enough())) || is_point(cell);
    if (closed)
      closed_low_ = std::min(closed_low_, best.low);
    else
      open_.push({cell, best, cells_});
  }

  /// Returns whether halves of the cell would hold the same places up to rounding.
  bool is_point(const PlaceCell& cell) const {
    return std::max({cell.box.width(), cell.box.height(), 2 * cell.half_turn * radius_}) <= rounding_;
  }

  /// From the best place on to the bottom next to it, by steps across and turns that are halved.
  void descend() {
    double step = std::max(options_.accuracy, rounding_);
    for (int level = 0; level < last_halvings && step > rounding_ && best_lift_ > bound() + rounding_;
         ++level) {
      for (int trial = 0; trial < trials_per_step; ++trial) {
        const double before = best_lift_;
        const LocalPlace from = best_;
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
        if (best_lift_ >= before) break;
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
  LocalPlace best_;
  double best_lift_ = infinity;
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
  const detail::LocalShapes shapes(base, shape, direction);
  PlaceSearch search(shapes, options);
  search.run();
  const LocalPlace& found = search.best_place();
  BestPlace best;
  best.drop =
      drop_at(base, shape, direction, {found.x, found.y, reduced_degrees(found.yaw * 180 / std::numbers::pi)},
              options.semantics);
  best.bound = std::min(search.bound() - search.floor(), best.drop.height);
  best.proven = best.drop.height - best.bound <= options.accuracy;
  best.cells = search.cells();
  best.open = search.open_cells();
  best.cancelled = search.cancelled();
  return best;
}

}  // namespace stackabilization
