#include "stacking/stacks/stack_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

constexpr std::size_t max_poses_for_chains = 64;

int pose_of(const std::vector<int>& sequence, int copy) {
  return sequence[static_cast<std::size_t>(copy) % sequence.size()];
}

/// Level at which a copy stops on its way down, and the copy that stops it.
struct Stop {
  Rational lift;
  double approximate = 0;
  int rests_on = -1;
};

/// Finds the copy that stops another copy. Doubles exclude pairs that are clearly not the highest; rationals
/// decide the rest.
class StackDescent {
 public:
  StackDescent(StackPairs& pairs, const std::vector<int>& sequence) : pairs_(pairs), sequence_(sequence) {}

  /// Returns the highest level that the placed copies first, first - 1, ..., last require of copy `k`, or
  /// `stop` when none is higher.
  Stop lowest_position(int k, std::pair<int, int> first_to_last, Stop stop) {
    const int pose = pose_of(sequence_, k);
    for (int j = first_to_last.first; j >= first_to_last.second; --j) {
      const auto lower = static_cast<std::size_t>(j);
      const double bound = levels_[lower] - pairs_.span(pose).approximate_bottom + pairs_.max_gap();
      if (bound < stop.approximate - slack(levels_[lower], stop.approximate)) break;
      const Demand& demand = pairs_.demand(pose_of(sequence_, j), pose, k - j);
      if (!demand.blocked) continue;
      const double guess = placed_[lower].approximate + demand.approximate;
      if (guess < stop.approximate - slack(placed_[lower].approximate, demand.approximate)) continue;
      Rational wanted = placed_[lower].lift + demand.lift;
      const auto order = wanted <=> stop.lift;
      if (order < 0 || (order == 0 && stop.rests_on >= 0)) continue;
      const double approximate = wanted.to_double();
      stop = {std::move(wanted), approximate, j};
    }
    return stop;
  }

  void push(Stop stop) {
    const int k = static_cast<int>(placed_.size());
    const double top = stop.approximate + pairs_.span(pose_of(sequence_, k)).approximate_top;
    levels_.push_back(levels_.empty() ? top : std::max(levels_.back(), top));
    placed_.push_back(std::move(stop));
  }

 private:
  static double slack(double a, double b) { return tolerance::relative * (std::abs(a) + std::abs(b)); }

  StackPairs& pairs_;
  const std::vector<int>& sequence_;
  std::vector<Stop> placed_;
  std::vector<double> levels_;  ///< highest level that any of the copies 0 ... j reaches
};

}  // namespace

Placement place(StackPairs& pairs, const std::vector<int>& sequence, int copies, Reach reach) {
  Placement placed;
  StackDescent descent(pairs, sequence);
  const Rational& floor = pairs.span(sequence.front()).bottom;
  for (int k = 0; k < copies; ++k) {
    Stop start;
    start.lift = floor - pairs.span(pose_of(sequence, k)).bottom;
    start.approximate = start.lift.to_double();
    const int last = reach == Reach::all ? 0 : std::max(0, k - 1);
    Stop stop = descent.lowest_position(k, {k - 1, last}, std::move(start));
    placed.lifts.push_back(stop.lift);
    placed.approximate.push_back(stop.approximate);
    placed.rests_on.push_back(stop.rests_on);
    descent.push(std::move(stop));
  }
  return placed;
}

double placed_height(const StackPairs& pairs, const std::vector<int>& sequence, const Placement& placement) {
  const Span& first = pairs.span(sequence.front());
  double top = first.approximate_top;
  for (std::size_t k = 0; k < placement.approximate.size(); ++k)
    top = std::max(
        top, placement.approximate[k] + pairs.span(pose_of(sequence, static_cast<int>(k))).approximate_top);
  return top - first.approximate_bottom;
}

std::vector<StackConflict> find_conflicts(StackPairs& pairs, const std::vector<int>& sequence,
                                          const Placement& neighbours) {
  std::vector<StackConflict> conflicts;
  StackDescent descent(pairs, sequence);
  for (int k = 0; k < static_cast<int>(neighbours.lifts.size()); ++k) {
    const auto copy = static_cast<std::size_t>(k);
    const Stop by_neighbour{neighbours.lifts[copy], neighbours.approximate[copy], k - 1};
    const Stop stop = k < 2 ? by_neighbour : descent.lowest_position(k, {k - 2, 0}, by_neighbour);
    const double overlap = (stop.lift - neighbours.lifts[copy]).to_double();
    const Span& span = pairs.span(pose_of(sequence, k));
    if (overlap > tolerance::relative * (span.approximate_top - span.approximate_bottom))
      conflicts.push_back({stop.rests_on, k, overlap});
    descent.push(by_neighbour);
  }
  return conflicts;
}

namespace {

/// A chain of contacts: its lift and the number of copies that it spans.
struct Chain {
  double lift = -std::numeric_limits<double>::infinity();
  double copies = 1;

  double gain(double per_copy) const { return lift - per_copy * copies; }
  double mean() const { return lift / copies; }
};

/// Computes the largest mean lift per copy over all closed chains by Newton's iteration. Floyd and Warshall's
/// algorithm finds chains with a larger mean than the current one. `contacts(a, b)` is the contact of a copy
/// with pose a and the next copy with pose b.
double largest_closed_mean(const Eigen::MatrixX<Chain>& contacts) {
  double most = 0;
  for (bool improved = true; improved;) {
    Eigen::MatrixX<Chain> best = contacts;
    const Eigen::Index count = best.rows();
    for (Eigen::Index via = 0; via < count; ++via)
      for (Eigen::Index a = 0; a < count; ++a)
        for (Eigen::Index b = 0; b < count; ++b) {
          const Chain detour{best(a, via).lift + best(via, b).lift,
                             best(a, via).copies + best(via, b).copies};
          if (detour.gain(most) > best(a, b).gain(most)) best(a, b) = detour;
        }
    improved = false;
    for (Eigen::Index a = 0; a < count; ++a)
      if (best(a, a).mean() > most * (1 + tolerance::relative)) {
        most = best(a, a).mean();
        improved = true;
      }
  }
  return most;
}

double repeating_increment(StackPairs& pairs, const std::vector<int>& sequence) {
  const auto period = static_cast<Eigen::Index>(sequence.size());
  Eigen::MatrixX<Chain> contacts(period, period);
  for (Eigen::Index a = 0; a < period; ++a)
    for (Eigen::Index b = 0; b < period; ++b) {
      const auto lag = static_cast<int>(b > a ? b - a : b - a + period);
      const Demand& demand =
          pairs.demand(sequence[static_cast<std::size_t>(a)], sequence[static_cast<std::size_t>(b)], lag);
      contacts(a, b).copies = lag;
      if (demand.blocked) contacts(a, b).lift = demand.approximate;
    }
  return largest_closed_mean(contacts);
}

/// One pose with twist: lifts depend on the lag alone, and their growth is the largest of sep(lag) / lag.
double twisted_increment(StackPairs& pairs, int pose, int copies) {
  const Span& span = pairs.span(pose);
  const double max_lift = span.approximate_top - span.approximate_bottom + pairs.max_gap();
  double most = 0;
  for (int lag = 1; lag == 1 || (lag < copies && max_lift / lag >= most); ++lag) {
    const Demand& demand = pairs.demand(pose, pose, lag);
    if (demand.blocked) most = std::max(most, demand.approximate / lag);
  }
  return most;
}

}  // namespace

double long_run_increment(StackPairs& pairs, const std::vector<int>& sequence, const Placement& placement) {
  const std::size_t copies = placement.approximate.size(), period = sequence.size();
  if (!pairs.twisted() && period <= max_poses_for_chains) return repeating_increment(pairs, sequence);
  if (period == 1) return twisted_increment(pairs, sequence.front(), static_cast<int>(copies));
  const std::size_t span = copies > period ? period : copies - 1;
  if (span == 0) return 0;
  return (placement.approximate.back() - placement.approximate[copies - 1 - span]) /
         static_cast<double>(span);
}

Points stack_hull_points(const StackPairs& pairs, const std::vector<int>& sequence,
                         const Placement& placement, const HullSupport& hull) {
  // Of copies that differ only by a lift, the hull needs the lowest and the highest.
  std::map<std::pair<int, double>, std::pair<std::size_t, std::size_t>> extremes;
  for (std::size_t k = 0; k < placement.approximate.size(); ++k) {
    const int copy = static_cast<int>(k);
    auto& [low, high] =
        extremes.try_emplace({pose_of(sequence, copy), pairs.turn_degrees(copy)}, k, k).first->second;
    if (placement.approximate[k] < placement.approximate[low]) low = k;
    if (placement.approximate[k] > placement.approximate[high]) high = k;
  }
  const Eigen::Index size = hull.points().rows();
  Points points(2 * size * static_cast<Eigen::Index>(extremes.size()), 3);
  Eigen::Index row = 0;
  for (const auto& [key, copies] : extremes)
    for (const std::size_t k : {copies.first, copies.second}) {
      const RigidTransform transform = pairs.transform(key.first, static_cast<int>(k));
      const Eigen::Vector3d shift =
          transform.translation + placement.approximate[k] * pairs.direction().vector();
      points.middleRows(row, size) =
          (hull.points() * transform.rotation.transpose()).rowwise() + shift.transpose();
      row += size;
    }
  return points;
}

}  // namespace stackabilization
