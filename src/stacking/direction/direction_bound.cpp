#include "stackabilization/stacking/direction_bound.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "core/angles.h"
#include "envelope/separation/separation_over_cone.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/bundle_ascent.h"
#include "stackabilization/stacking/tolerances.h"
#include "stacking/direction/base_bound.h"
#include "stacking/direction/direction_cell.h"

namespace stackabilization {

namespace {

using detail::DirectionCell;

/// Cells examined between two updates of the best direction: fixed, so that the number of threads has no
/// influence.
constexpr std::size_t cells_per_batch = 256;
/// Pairs of nodes examined for one cell and one demand: the first number over the square root of the cell's
/// radius, for a pair that is found late in a large cell is found as late in all the small ones inside.
constexpr double node_pairs_at_radius_one = 1000;
constexpr double max_node_pairs_per_cell = 64000;
/// Where the bound that closes a cell is not found, this part of the way to it is asked for.
constexpr double second_demand = 0.5;

/// A cell with what is known of it.
struct OpenCell {
  DirectionCell cell;
  double translation = 0;   ///< lower bound of f_max, units of the vectors of the cell
  double bound = 1;         ///< upper bound of S
  std::int64_t number = 0;  ///< in the order of creation

  /// Heap order: the largest bound first, then the first one made.
  friend bool operator<(const OpenCell& a, const OpenCell& b) {
    return a.bound != b.bound ? a.bound < b.bound : a.number > b.number;
  }
};

class BranchAndBound {
 public:
  BranchAndBound(const StackabilitySolver& solver, const Stackability& best,
                 const DirectionBoundOptions& options)
      : solver_(solver), options_(options), region_(options.cone, options.plane_normal), best_(best) {
    if (!(options.accuracy > 0) || options.accuracy > 1)
      throw UsageError("the accuracy of a bound must be above 0 and at most 1");
    if (options.max_cells < 1) throw UsageError("a bound examines at least one cell of directions");
    if (!(solver.box_volume() > 0)) throw UsageError("a bound needs a shape whose stackability is defined");
    if (solver.options().boxes != BoxModel::oriented)
      throw UsageError("a bound over directions is known for oriented boxes only");
    if (solver.options().play > 0) throw UsageError("a bound over directions is known without play only");
    if (options.cone) axis_ = Direction(options.cone->axis).unit();
    if (options.plane_normal) normal_ = Direction(*options.plane_normal).unit();
  }

  BoundedStackability run() {
    std::vector<OpenCell> batch;
    for (const int axis : {2, 0, 1}) add(DirectionCell{axis}, {}, batch);
    const double first_gap = 1 - best_.value;
    for (;;) {
      examine(batch);
      report(first_gap);
      if (open_.empty() || ended()) break;
      batch = next_batch();
    }
    return result();
  }

 private:
  double enough() const { return best_.value + options_.accuracy; }

  bool ended() {
    if (cells_ >= options_.max_cells) return true;
    if (options_.cancelled && !cancelled_) cancelled_ = options_.cancelled();
    return cancelled_;
  }

  /// Whether no direction of the cell, and no opposite of one, is in the region.
  bool outside(const DirectionCell& cell) const {
    const Eigen::Vector3d middle = cell.middle();
    const double margin = cell.radius() + tolerance::relative;
    const auto angle = [&](const Eigen::Vector3d& a) { return detail::angle_between_lines(middle, a); };
    if (options_.cone && angle(axis_) > options_.cone->half_angle + margin) return true;
    return options_.plane_normal && std::numbers::pi / 2 - angle(normal_) > margin;
  }

  void add(const DirectionCell& cell, const OpenCell& around, std::vector<OpenCell>& batch) {
    if (!outside(cell)) batch.push_back({cell, around.translation, around.bound, ++numbered_});
  }

  std::vector<OpenCell> next_batch() {
    std::vector<OpenCell> batch;
    while (!open_.empty() && batch.size() < cells_per_batch) {
      const OpenCell whole = open_.top();
      open_.pop();
      if (whole.bound <= enough())
        closed_bound_ = std::max(closed_bound_, whole.bound);
      else
        for (const DirectionCell& half : whole.cell.halves()) add(half, whole, batch);
    }
    return batch;
  }

  /// Bounds S over the cells, and measures it at the middle of those that stay open.
  void examine(std::vector<OpenCell>& batch) {
    std::vector<std::optional<Stackability>> met(batch.size());
    tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t i) {
      bound(batch[i]);
      if (batch[i].bound <= enough()) return;
      if (const auto direction = region_.nearest(batch[i].cell.middle()))
        met[i] = solver_.measure_if_above(Direction(*direction), best_.value + tolerance::stackability);
    });
    for (std::size_t i = 0; i < batch.size(); ++i) {
      ++cells_;
      if (batch[i].bound > enough()) ++evaluated_;
      if (met[i] && met[i]->value > best_.value + tolerance::stackability)
        climb(*met[i], batch[i].cell.radius());
    }
    for (const OpenCell& cell : batch) {
      if (cell.bound <= enough())
        closed_bound_ = std::max(closed_bound_, cell.bound);
      else if (cell.cell.radius() <= tolerance::direction_cell)
        smallest_.push_back(cell);
      else
        open_.push(cell);
    }
  }

  void climb(const Stackability& start, double step) {
    const LocalOptimum top = bundle_ascent(solver_, region_, start, {step, tolerance::direction_step});
    evaluated_ += top.evaluated;
    best_ = top.at;
  }

  void bound(OpenCell& open) const {
    const DirectionCell& cell = open.cell;
    const double length = cell.min_length(), air = solver_.options().clearance;
    Stackability terms;  // with the least base of the cell, so that its S is the largest
    terms.box_volume = solver_.box_volume();
    terms.base = detail::min_base(solver_.hull(), Direction(cell.middle()), cell.radius());
    if (terms.base <= 0) return;
    const auto bound_for = [&](double translation) {
      return terms.value_at(translation * length * (1 - tolerance::rounding) + air) + tolerance::rounding;
    };
    // The translation for which the bound is `stackability`, rounded up.
    const auto translation_for = [&](double stackability) {
      return (terms.translation_for(stackability - tolerance::rounding) - air) / length *
             (1 + 4 * tolerance::rounding);
    };
    open.bound = std::min(open.bound, bound_for(open.translation));
    if (open.bound <= enough()) return;
    std::vector<Direction> corners;
    for (const Eigen::Vector3d& corner : cell.corners()) corners.emplace_back(corner);
    detail::SeparationOverCone separation(solver_.tree(), corners, solver_.options().semantics);
    const auto max_node_pairs = static_cast<std::int64_t>(
        std::min(max_node_pairs_per_cell, node_pairs_at_radius_one / std::sqrt(cell.radius())));
    for (const double part : {1.0, second_demand}) {
      const double demand = translation_for(open.bound + part * (enough() - open.bound));
      if (!(demand > open.translation)) continue;
      if (const auto shown = separation.at_least(demand, max_node_pairs)) {
        open.translation = *shown;
        open.bound = std::min(open.bound, bound_for(*shown));
        return;
      }
    }
  }

  /// Largest bound of a cell that is not closed; -inf where all are.
  double open_bound() const {
    double bound = open_.empty() ? -std::numeric_limits<double>::infinity() : open_.top().bound;
    for (const OpenCell& cell : smallest_) bound = std::max(bound, cell.bound);
    return bound;
  }

  /// Cells are halved until the bound is close: a logarithm of what is left.
  void report(double first_gap) const {
    if (!options_.progress) return;
    const double gap = std::clamp(open_bound() - best_.value, options_.accuracy, 1.0);
    if (first_gap <= options_.accuracy || gap <= options_.accuracy)
      options_.progress(1);
    else
      options_.progress(
          std::clamp(std::log(first_gap / gap) / std::log(first_gap / options_.accuracy), 0.0, 1.0));
  }

  BoundedStackability result() {
    BoundedStackability result;
    result.best = best_;
    result.evaluated = evaluated_;
    DirectionBound& bound = result.bound;
    bound.bound = std::min(1.0, std::max({best_.value, closed_bound_, open_bound()}));
    bound.accuracy = options_.accuracy;
    bound.proven = bound.bound <= enough();
    bound.cells = cells_;
    bound.open = std::count_if(smallest_.begin(), smallest_.end(),
                               [this](const OpenCell& cell) { return cell.bound > enough(); });
    for (; !open_.empty() && open_.top().bound > enough(); open_.pop()) ++bound.open;
    bound.cancelled = cancelled_;
    return result;
  }

  const StackabilitySolver& solver_;
  const DirectionBoundOptions& options_;
  DirectionRegion region_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero(), normal_ = Eigen::Vector3d::Zero();
  Stackability best_;
  double closed_bound_ = -std::numeric_limits<double>::infinity();  ///< largest bound of the closed cells
  std::priority_queue<OpenCell> open_;
  std::vector<OpenCell> smallest_;  ///< not closed, not cut any more
  std::int64_t numbered_ = 0, cells_ = 0, evaluated_ = 0;
  bool cancelled_ = false;
};

}  // namespace

BoundedStackability stackability_bound(const StackabilitySolver& solver, const Stackability& best,
                                       const DirectionBoundOptions& options) {
  return BranchAndBound(solver, best, options).run();
}

}  // namespace stackabilization
