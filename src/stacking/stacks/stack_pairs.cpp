#include "stacking/stacks/stack_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/clearance.h"

namespace stackabilization {

namespace {

constexpr int largest_stack = 10000;
constexpr std::size_t max_poses = 1000;

void check(const StackOptions& options) {
  if (options.copies < 1 || options.copies > largest_stack)
    throw UsageError("a stack needs from 1 to " + std::to_string(largest_stack) + " copies");
  if (!(options.clearance >= 0 && options.clearance <= tolerance::max_coordinate))
    throw UsageError("the clearance must be a length from 0 to 10^60");
  if (!(options.layer >= 0 && options.layer <= tolerance::max_coordinate))
    throw UsageError("the thickness of a layer must be a length from 0 to 10^60");
  if (options.layer > 0 && (reduced_degrees(options.twist_degrees) != 0 || options.poses.size() > 1))
    throw UsageError("copies in whole layers can have neither a twist nor different poses");
  if (options.axis_point && !options.axis_point->allFinite())
    throw UsageError("the point of the twist axis needs three finite coordinates");
}

/// Returns the smallest multiple of `layer` that is no less than `separation`, and than `wanted` but for
/// rounding.
Rational whole_layers(const Rational& separation, const Rational& wanted, double layer) {
  constexpr double max_layers = 9007199254740992;  // 2^53: beyond, doubles skip whole numbers
  const double layers = wanted.to_double() / layer;
  if (!(layers <= max_layers)) throw UsageError("the layers are too thin for a lift of the shape");
  double count = std::ceil(layers - tolerance::relative * std::max(1.0, layers));
  while (Rational(count) * Rational(layer) < separation) ++count;
  return Rational(count) * Rational(layer);
}

std::optional<SeparationTree> dilated_tree(const Shape& shape, const Direction& direction,
                                           const StackOptions& options) {
  const DilationOptions dilation{options.play, options.play_corners, DilatedSide::upper};
  const DilatedShape dilated = dilate_laterally(shape, direction, dilation);
  if (options.play == 0) return std::nullopt;
  return SeparationTree(dilated.shape);
}

}  // namespace

StackPairs::StackPairs(const Shape& shape, const Direction& direction, const StackOptions& options)
    : direction_(direction),
      semantics_(options.semantics),
      twist_degrees_(reduced_degrees(options.twist_degrees)),
      clearance_(options.clearance / direction.length()),
      layer_(options.layer / direction.length()) {
  check(options);
  validate(shape);
  axis_ =
      options.axis_point ? Line{*options.axis_point, direction} : box_axis(shape, direction, options.boxes);

  const std::vector<RigidTransform> straight(1);
  std::vector<Pose> poses;
  std::map<std::array<double, 12>, int> known;
  for (const RigidTransform& transform : options.poses.empty() ? straight : options.poses) {
    validate(transform);
    std::array<double, 12> key;
    std::copy_n(transform.rotation.data(), 9, key.begin());
    std::copy_n(transform.translation.data(), 3, key.begin() + 9);
    const auto [entry, added] = known.try_emplace(key, static_cast<int>(known.size()));
    if (known.size() > max_poses)
      throw UsageError("a stack can use at most " + std::to_string(max_poses) + " different poses");
    sequence_.push_back(entry->second);
    if (!added) continue;
    Shape posed = transformed(shape, transform);
    const Span span = exact_span(posed, direction);
    SeparationTree tree(posed);
    std::optional<SeparationTree> dilated = dilated_tree(posed, direction, options);
    poses.push_back({transform, std::move(posed), span, std::move(tree), std::move(dilated)});
  }
  poses_ = std::make_shared<const std::vector<Pose>>(std::move(poses));
}

StackPairs StackPairs::with_twist(double degrees) const {
  StackPairs other = *this;
  other.twist_degrees_ = reduced_degrees(degrees);
  other.demands_.clear();
  return other;
}

RigidTransform StackPairs::transform(int pose, int copy) const {
  const RigidTransform& base = (*poses_)[static_cast<std::size_t>(pose)].transform;
  const double turn = turn_degrees(copy);
  return turn == 0 ? base : composed(rotation_about(axis_, turn), base);
}

const Demand& StackPairs::demand(int below, int above, int lag) {
  const double turn = turn_degrees(lag);
  const std::tuple key(turn, below, above);
  if (const auto known = demands_.find(key); known != demands_.end()) return known->second;

  const Pose& lower = (*poses_)[static_cast<std::size_t>(below)];
  const Pose& upper = (*poses_)[static_cast<std::size_t>(above)];
  const SeparationTree& lower_tree = lower.dilated_tree ? *lower.dilated_tree : lower.tree;
  std::optional<SeparationTree> turned;
  if (turn != 0) turned.emplace(transformed(upper.shape, rotation_about(axis_, turn)));
  const Separation found = separation(lower_tree, turned ? *turned : upper.tree, direction_,
                                      {.semantics = semantics_, .abandon_above = std::nullopt});
  Demand demand;
  demand.blocked = found.blocked;
  if (found.blocked) {
    demand.lift = found.value + Rational(clearance_);
    if (layer_ > 0) demand.lift = whole_layers(found.value, demand.lift, layer_);
    demand.approximate = demand.lift.to_double();
  }
  return demands_.emplace(key, std::move(demand)).first->second;
}

}  // namespace stackabilization
