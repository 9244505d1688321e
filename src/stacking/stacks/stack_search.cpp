#include "stackabilization/stacking/stack_search.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stacking/stacks/stack_boxes.h"

namespace stackabilization {

namespace {

constexpr int max_symmetric_fraction = 12;
constexpr std::size_t finalists = 4;
constexpr int max_period = 5;
constexpr int box_poses = 8;

/// Indices of the best values, best (smallest cost) first, ties in the order given.
std::vector<std::size_t> best_first(const std::vector<double>& costs) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  order.resize(std::min(order.size(), finalists));
  return order;
}

class TwistSearch {
 public:
  TwistSearch(const Shape& shape, const Direction& direction, const TwistOptions& options)
      : pairs_(shape, direction, options.stack),
        boxes_(shape, direction, options.stack.boxes),
        options_(options) {}

  TwistResult run() const {
    const std::vector<double> samples = sampled_twists();
    std::vector<double> costs(samples.size());
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) { costs[i] = cost(samples[i]); });

    const std::vector<std::size_t> order = best_first(costs);
    // No twist, then the best samples, then their refinements.
    std::vector<double> candidates(1 + 2 * order.size(), 0.0);
    for (std::size_t i = 0; i < order.size(); ++i) candidates[1 + i] = samples[order[i]];
    tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t i) {
      candidates[1 + order.size() + i] = refined(samples[order[i]], costs[order[i]]);
    });
    return choose(candidates);
  }

 private:
  std::vector<double> sampled_twists() const {
    std::vector<double> twists{0, 180};
    const auto add_both_ways = [&](double twist) {
      if (std::find(twists.begin(), twists.end(), twist) == twists.end())
        twists.insert(twists.end(), {twist, -twist});
    };
    for (int k = 3; k <= max_symmetric_fraction; ++k) add_both_ways(360.0 / k);
    for (int i = 1; i * options_.step_degrees < 180; ++i) add_both_ways(i * options_.step_degrees);
    return twists;
  }

  /// Objective of the search: height, or volume of the stack's box with one axis along r.
  double cost(double twist) const {
    StackPairs pairs = pairs_.with_twist(twist);
    const Placement placed = place(pairs, pairs.sequence(), options_.stack.copies, Reach::all);
    if (options_.goal == TwistGoal::height) return placed_height(pairs, pairs.sequence(), placed);
    return boxes_.box_along(stack_hull_points(pairs, pairs.sequence(), placed, boxes_.hull())).volume();
  }

  double refined(double twist, double least) const {
    for (double step = options_.step_degrees / 2; step >= options_.finest_degrees; step /= 2) {
      const double right = cost(twist + step), left = cost(twist - step);
      if (std::min(right, left) >= least) continue;
      twist += right <= left ? step : -step;
      least = std::min(right, left);
    }
    return reduced_degrees(twist);
  }

  /// Returns the first candidate that no other one clearly exceeds; the first candidate is no twist.
  TwistResult choose(const std::vector<double>& candidates) const {
    std::vector<StackResult> stacks(candidates.size());
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
      StackPairs pairs = pairs_.with_twist(candidates[i]);
      stacks[i] = build_stack(pairs, pairs.sequence(), options_.stack.copies, boxes_);
    });
    const auto merit = [&](std::size_t i) {
      return options_.goal == TwistGoal::height ? -stacks[i].height / stacks[0].height
                                                : stacks[i].stackability;
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < candidates.size(); ++i)
      if (merit(i) > merit(best) + tolerance::relative) best = i;
    TwistResult result{candidates[best], {}, stacks[0].stackability, stacks[0].height};
    result.stack = std::move(stacks[best]);
    return result;
  }

  StackPairs pairs_;
  StackBoxes boxes_;
  const TwistOptions& options_;
};

/// The eight poses of best_period_stack, in its order.
std::vector<RigidTransform> poses_of_box(const OrientedBox& box, const Direction& direction) {
  Eigen::Index side = 0;  // the first side across r
  while (std::abs(box.axes.col(side).dot(direction.unit())) > 0.5) ++side;
  const Line upright{box.centre, direction}, across{box.centre, Direction(box.axes.col(side))};
  std::vector<RigidTransform> poses;
  for (const double flip : {0, 180})
    for (const double turn : {0, 90, 180, 270})
      poses.push_back(composed(rotation_about(upright, turn), rotation_about(across, flip)));
  return poses;
}

std::string pose_name(int pose) {
  const int turn = pose % 4 * 90;
  const std::string side = pose < 4 ? "upright" : "flipped";
  return turn == 0 ? side : side + " turned " + std::to_string(turn);
}

/// The digits of `choice` in base eight are the poses of copies 1, 2, ... of the period.
std::vector<int> sequence_of(std::size_t choice, int period) {
  std::vector<int> sequence(static_cast<std::size_t>(period), 0);
  for (int k = 1; k < period; ++k, choice /= box_poses)
    sequence[static_cast<std::size_t>(k)] = static_cast<int>(choice % box_poses);
  return sequence;
}

}  // namespace

TwistResult best_twist(const Shape& shape, const Direction& direction, const TwistOptions& options) {
  if (!(options.step_degrees >= 0.1 && options.step_degrees <= 180))
    throw UsageError("the step between sampled twists must lie between 0.1 and 180 degrees");
  if (!(options.finest_degrees > 0 && options.finest_degrees <= options.step_degrees))
    throw UsageError("the finest step between twists must be positive and at most the sampled step");
  return TwistSearch(shape, direction, options).run();
}

PeriodResult best_period_stack(const Shape& shape, const Direction& direction, const PeriodOptions& options) {
  if (options.period < 1 || options.period > max_period)
    throw UsageError("the period of a searched stack must lie between 1 and " + std::to_string(max_period));
  if (!options.stack.poses.empty()) throw UsageError("the poses of a searched stack cannot be given");
  validate(shape);
  const StackBoxes boxes(shape, direction, options.stack.boxes);
  StackOptions posed = options.stack;
  posed.poses = poses_of_box(boxes.box_along(boxes.hull().points()), direction);
  tbb::enumerable_thread_specific<StackPairs> pairs(StackPairs(shape, direction, posed));

  std::vector<double> volumes(static_cast<std::size_t>(std::pow(box_poses, options.period - 1)));
  tbb::parallel_for(std::size_t{0}, volumes.size(), [&](std::size_t choice) {
    const std::vector<int> sequence = sequence_of(choice, options.period);
    const Placement placed = place(pairs.local(), sequence, posed.copies, Reach::all);
    volumes[choice] =
        boxes.box_along(stack_hull_points(pairs.local(), sequence, placed, boxes.hull())).volume();
  });

  std::vector<std::size_t> candidates = best_first(volumes);
  candidates.push_back(0);
  std::sort(candidates.begin(), candidates.end());
  PeriodResult best;
  for (const std::size_t choice : candidates) {
    const std::vector<int> sequence = sequence_of(choice, options.period);
    StackResult stack = build_stack(pairs.local(), sequence, posed.copies, boxes);
    if (!best.poses.empty() && stack.stackability <= best.stack.stackability + tolerance::relative) continue;
    best.stack = std::move(stack);
    best.poses.clear();
    for (const int pose : sequence) best.poses.push_back(pose_name(pose));
  }
  return best;
}

}  // namespace stackabilization
