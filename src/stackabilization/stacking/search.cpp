#include "stackabilization/stacking/search.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/tolerances.h"
#include "stackabilization/stacking/candidates.h"
#include "stackabilization/stacking/climb.h"

namespace stackabilization {

namespace {

/// Directions measured between two updates of the threshold; fixed, so that what is abandoned does not depend on the
/// number of threads.
constexpr std::size_t batch_size = 256;

/// A sample whose S is this much below the best is not near the best peak.
constexpr double climbing_range = 0.2;

/// Starting points of short climbs per refined one.
constexpr int starts_per_climb = 4;

/// A direction to try, with the normal of the great circle it was taken from, or zero.
struct Trial {
  Eigen::Vector3d direction, circle_normal;
};

double line_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.cross(b).norm(); }

class DirectionSearch {
 public:
  DirectionSearch(const StackabilitySolver& solver, const SearchOptions& options)
      : solver_(solver), options_(options), region_(options.cone, options.plane_normal) {
    if (!(options.spacing > 0) || options.spacing > 1)
      throw UsageError("the spacing of sampled directions must be above 0 and at most 1 radian");
    if (options.climbs < 1) throw UsageError("a search needs at least one climb");
  }

  SearchResult run() {
    sample();
    std::vector<Climb> peaks = distinct(samples_, starts_per_climb * options_.climbs, options_.spacing);
    peaks = climb_from(std::move(peaks), {options_.spacing / 2, options_.spacing / 64, false});
    peaks = distinct(peaks, options_.climbs, options_.spacing / 4);
    peaks = climb_from(std::move(peaks), {options_.spacing / 64, tolerance::direction_step, true});
    peaks = distinct(peaks, options_.climbs, options_.spacing / 64);
    report(1);

    for (const Climb& peak : peaks) result_.optima.push_back({peak.at.direction, peak.at.value});
    result_.best = peaks.front().at;
    result_.separation = solver_.separation(Direction(result_.best.direction));
    return result_;
  }

 private:
  std::vector<Trial> trials() const;
  void sample();
  void measure(const std::vector<Trial>& trials, std::size_t begin, double threshold);
  std::vector<Climb> distinct(const std::vector<Climb>& climbs, int limit, double distance) const;
  std::vector<Climb> climb_from(std::vector<Climb> starts, const ClimbOptions& climbing);
  void report(double fraction) const {
    if (options_.progress) options_.progress(fraction);
  }
  bool ended() {
    if (!result_.cancelled && options_.cancelled) result_.cancelled = options_.cancelled();
    return result_.cancelled;
  }

  const StackabilitySolver& solver_;
  const SearchOptions& options_;
  DirectionRegion region_;
  std::vector<Climb> samples_;  ///< measured trials in their order
  SearchResult result_;
};

std::vector<Trial> DirectionSearch::trials() const {
  CandidateDirections candidates = candidate_directions(solver_);
  candidates.main.insert(candidates.main.end(), options_.candidates.begin(), options_.candidates.end());
  const Eigen::Vector3d none = options_.plane_normal.value_or(Eigen::Vector3d::Zero());
  std::vector<Trial> trials;
  for (const auto* directions : {&candidates.main, &candidates.others})
    for (const Eigen::Vector3d& direction : *directions)
      if (const auto member = region_.member(direction)) trials.push_back({*member, none});
  for (const Eigen::Vector3d& direction : region_.samples(options_.spacing)) trials.push_back({direction, none});
  if (!options_.plane_normal)
    for (const Eigen::Vector3d& normal : candidates.main)
      for (const Eigen::Vector3d& direction : half_circle(normal, options_.spacing / 2))
        if (const auto member = region_.member(direction)) trials.push_back({*member, normal});
  if (trials.empty()) throw UsageError("the cone and the plane of directions have no direction in common");
  return trials;
}

void DirectionSearch::sample() {
  const std::vector<Trial> all = trials();
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t begin = 0; begin < all.size(); begin += batch_size) {
    if (begin > 0 && ended()) return;
    measure(all, begin, best - climbing_range);
    for (const Climb& sample : samples_) best = std::max(best, sample.at.value);
    report(0.5 * static_cast<double>(begin) / static_cast<double>(all.size()));
  }
}

void DirectionSearch::measure(const std::vector<Trial>& trials, std::size_t begin, double threshold) {
  const std::size_t count = std::min(batch_size, trials.size() - begin);
  std::vector<std::optional<Stackability>> measured(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    measured[i] = solver_.measure_if_above(Direction(trials[begin + i].direction), threshold);
  });
  for (std::size_t i = 0; i < count; ++i) {
    ++result_.evaluated;
    if (measured[i])
      samples_.push_back({*measured[i], trials[begin + i].circle_normal});
    else
      ++result_.abandoned;
  }
}

/// The best ones that are farther than `distance` from every better one. Of those equally good the earliest leads.
std::vector<Climb> DirectionSearch::distinct(const std::vector<Climb>& climbs, int limit, double distance) const {
  std::vector<Climb> sorted = climbs;
  const auto level = [](const Climb& climb) { return std::round(climb.at.value / tolerance::stackability); };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Climb& a, const Climb& b) { return level(a) > level(b); });
  std::vector<Climb> kept;
  for (const Climb& climb : sorted) {
    if (static_cast<int>(kept.size()) == limit) break;
    if (std::none_of(kept.begin(), kept.end(), [&](const Climb& better) {
          return line_distance(better.at.direction, climb.at.direction) <= distance;
        }))
      kept.push_back(climb);
  }
  return kept;
}

std::vector<Climb> DirectionSearch::climb_from(std::vector<Climb> starts, const ClimbOptions& climbing) {
  if (ended()) return starts;
  tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) {
    starts[i].evaluated = starts[i].abandoned = 0;
    starts[i] = climb(solver_, region_, starts[i], climbing);
  });
  for (const Climb& end : starts) {
    result_.evaluated += end.evaluated;
    result_.abandoned += end.abandoned;
  }
  report(climbing.follow_crests ? 0.99 : 0.7);
  return starts;
}

}  // namespace

SearchResult best_direction(const StackabilitySolver& solver, const SearchOptions& options) {
  return DirectionSearch(solver, options).run();
}

}  // namespace stackabilization
