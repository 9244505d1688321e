#include "stackabilization/stacking/search.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/bundle_ascent.h"
#include "stackabilization/stacking/tolerances.h"
#include "stacking/direction/candidates.h"

namespace stackabilization {

namespace {

/// Number of directions measured between two updates of the threshold. It is fixed, so that the abandoned
/// directions do not depend on the number of threads.
constexpr std::size_t trials_per_batch = 256;

/// Largest difference of a sample's S from the best S at which its neighbourhood is refined; halved with the
/// spacing.
constexpr double promising_range = 0.2;

/// Number of halvings of the spacing around promising samples, and limit of the number of such samples: no
/// halving costs more than the even samples.
constexpr int halvings = 3;
constexpr std::size_t max_promising = 400;
constexpr std::size_t trials_per_promising = 6;

/// Largest difference of a peak's S from the best S at which a climb starts.
constexpr double climbing_range = 0.05;

/// Search around the best direction: limit of the number of new climbs, and directions of each circle.
constexpr int max_new_climbs = 20;
constexpr int circle_points = 24;
constexpr int circle_halvings = 10;
constexpr std::int64_t max_circle_trials = circle_points + 4 * circle_halvings;  ///< two peaks, two sides

/// A direction to try, with the normal of the great circle it was taken from, or zero.
struct Trial {
  Eigen::Vector3d direction, circle_normal;
};

/// A trial that was measured.
struct Sample {
  Stackability at;
  Eigen::Vector3d circle_normal;
};

/// Returns the two largest local maxima of the values on a circle.
std::vector<int> circle_peaks(const std::vector<double>& values) {
  const auto count = static_cast<int>(values.size());
  const auto at = [&](int i) { return values[static_cast<std::size_t>((i + count) % count)]; };
  std::vector<int> peaks;
  for (int i = 0; i < count; ++i)
    if (at(i) > at(i - 1) && at(i) >= at(i + 1)) peaks.push_back(i);
  std::stable_sort(peaks.begin(), peaks.end(), [&](int a, int b) { return at(a) > at(b); });
  if (peaks.size() > 2) peaks.erase(peaks.begin() + 2, peaks.end());
  return peaks;
}

/// Returns the requested spacing or, over the whole sphere, one that leaves half of the directions for
/// refinement.
double affordable_spacing(const SearchOptions& options) {
  if (options.cone || options.plane_normal) return options.spacing;
  // The hemisphere has 2 pi square radians.
  const double least = std::sqrt(4 * std::numbers::pi / static_cast<double>(options.max_directions));
  return std::max(options.spacing, std::min(1.0, least));
}

class DirectionSearch {
 public:
  DirectionSearch(const StackabilitySolver& solver, const SearchOptions& options)
      : solver_(solver),
        options_(options),
        region_(options.cone, options.plane_normal),
        spacing_(affordable_spacing(options)) {
    if (!(options.spacing > 0) || options.spacing > 1)
      throw UsageError("the spacing of sampled directions must be above 0 and at most 1 radian");
    if (options.climbs < 1) throw UsageError("a search needs at least one climb");
    if (options.max_directions < 1) throw UsageError("a search tries at least one direction");
    if (!(solver.box_volume() > 0)) throw UsageError("a search needs a shape whose stackability is defined");
  }

  SearchResult run() {
    const std::vector<Trial> evenly = trials();
    first_trials_ = evenly.size();
    measure(evenly, promising_range);
    if (!perfect()) look_closer();
    climb_to_peaks();
    result_.limited = left() == 0;
    if (options_.certify && !result_.cancelled) prove();
    report(1);
    result_.separation = solver_.separation(Direction(result_.best.direction));
    return result_;
  }

 private:
  std::vector<Trial> trials() const;
  void measure(const std::vector<Trial>& trials, double range);
  void look_closer();
  std::vector<Trial> promising(std::size_t begin, double spacing, double range) const;
  std::vector<Trial> around(const Sample& sample, double distance) const;
  std::vector<Sample> peaks(const std::vector<Sample>& samples, double distance) const;
  void climb_to_peaks();
  std::vector<Sample> climb_from(std::vector<Sample> starts, double first_step, double last_step);
  void look_around(Sample& top);
  Sample best_on_circle(const Sample& top, double radius);
  void prove();
  /// Reports a fraction of the search without its proof, which counts as much.
  void report_search(double fraction) const { report(options_.certify ? fraction / 2 : fraction); }
  void report(double fraction) const {
    if (options_.progress) options_.progress(fraction);
  }
  /// f_max is not negative, so S is at most 1. Sheets reach it in many directions.
  bool perfect() const { return best_ >= 1 - tolerance::stackability; }
  /// Returns the number of directions that may still be tried.
  std::int64_t left() const { return std::max<std::int64_t>(0, options_.max_directions - result_.evaluated); }
  bool ended() {
    if (left() == 0) return true;
    if (!result_.cancelled && options_.cancelled) result_.cancelled = options_.cancelled();
    return result_.cancelled;
  }

  const StackabilitySolver& solver_;
  const SearchOptions& options_;
  DirectionRegion region_;
  double spacing_;               ///< of even samples, radians
  std::vector<Sample> samples_;  ///< measured trials in their order
  std::size_t first_trials_ = 0;
  double best_ = -std::numeric_limits<double>::infinity();
  SearchResult result_;
};

/// Directions in a plane that belong to a candidate: the intersection with the plane orthogonal to the
/// candidate, and the direction nearest to the candidate.
std::vector<Eigen::Vector3d> lines_in_plane(const Eigen::Vector3d& plane_normal,
                                            const Eigen::Vector3d& candidate) {
  const Eigen::Vector3d normal = plane_normal.normalized(), unit = candidate.normalized();
  const Eigen::Vector3d across = normal.cross(unit);
  if (across.norm() <= tolerance::relative) return {};
  return {across.normalized(), across.cross(normal).normalized()};
}

std::vector<Trial> DirectionSearch::trials() const {
  CandidateDirections candidates = candidate_directions(solver_);
  candidates.main.insert(candidates.main.begin(), options_.candidates.begin(), options_.candidates.end());
  const Eigen::Vector3d none = options_.plane_normal.value_or(Eigen::Vector3d::Zero());
  std::vector<Trial> trials;
  if (options_.cone)
    if (const auto axis = region_.member(options_.cone->axis)) trials.push_back({*axis, none});
  for (const auto* directions : {&candidates.main, &candidates.others})
    for (const Eigen::Vector3d& direction : *directions)
      if (const auto member = region_.member(direction)) trials.push_back({*member, none});
  if (options_.plane_normal)
    for (const auto* directions : {&candidates.main, &candidates.others})
      for (const Eigen::Vector3d& direction : *directions)
        for (const Eigen::Vector3d& line : lines_in_plane(*options_.plane_normal, direction))
          if (const auto member = region_.member(line)) trials.push_back({*member, none});
  for (const Eigen::Vector3d& direction : region_.samples(spacing_)) trials.push_back({direction, none});
  if (!options_.plane_normal)
    for (const Eigen::Vector3d& normal : candidates.main)
      for (const Eigen::Vector3d& direction : half_circle(normal, spacing_ / 2))
        if (const auto member = region_.member(direction)) trials.push_back({*member, normal});
  if (trials.empty()) throw UsageError("the cone and the plane of directions have no direction in common");
  return trials;
}

/// Measures trials that may come within `range` of the best.
void DirectionSearch::measure(const std::vector<Trial>& trials, double range) {
  for (std::size_t begin = 0; begin < trials.size(); begin += trials_per_batch) {
    if (!samples_.empty() && (ended() || perfect())) return;
    const std::size_t count =
        std::min({trials_per_batch, trials.size() - begin, static_cast<std::size_t>(left())});
    std::vector<std::optional<Stackability>> measured(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      measured[i] = solver_.measure_if_above(Direction(trials[begin + i].direction), best_ - range);
    });
    for (std::size_t i = 0; i < count; ++i) {
      ++result_.evaluated;
      if (measured[i]) {
        samples_.push_back({*measured[i], trials[begin + i].circle_normal});
        best_ = std::max(best_, measured[i]->value);
      } else {
        ++result_.abandoned;
      }
    }
  }
}

void DirectionSearch::look_closer() {
  double spacing = spacing_, range = promising_range;
  std::size_t begin = 0;
  for (int level = 0; level < halvings; ++level) {
    report_search(0.3 + 0.2 * level);
    const std::vector<Trial> closer = promising(begin, spacing, range);
    begin = samples_.size();
    measure(closer, range / 2);
    spacing /= 2;
    range /= 2;
  }
}

/// Trials between the samples from `begin` on that are within `range` of the best.
std::vector<Trial> DirectionSearch::promising(std::size_t begin, double spacing, double range) const {
  std::vector<Sample> candidates(samples_.begin() + static_cast<std::ptrdiff_t>(begin), samples_.end());
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Sample& a, const Sample& b) { return a.at.value > b.at.value; });
  candidates.resize(std::min({candidates.size(), max_promising, first_trials_ / trials_per_promising}));
  std::vector<Trial> trials;
  for (const Sample& sample : candidates) {
    if (sample.at.value < best_ - range) break;
    const std::vector<Trial> near = around(sample, spacing / 4);
    trials.insert(trials.end(), near.begin(), near.end());
  }
  return trials;
}

/// Centres of the quarters of a sample's square, and two neighbours on its great circle.
std::vector<Trial> DirectionSearch::around(const Sample& sample, double distance) const {
  const Frame frame = frame_of(Direction(sample.at.direction));
  const Eigen::Vector3d along = sample.circle_normal.cross(frame.w).normalized() * distance;
  std::vector<Trial> trials;
  if (!along.isZero(0))
    for (const double sign : {-1.0, 1.0})
      if (const auto direction = region_.nearest(frame.w + sign * along))
        trials.push_back({*direction, sample.circle_normal});
  if (options_.plane_normal) return trials;
  for (const double x : {-distance, distance})
    for (const double y : {-distance, distance})
      if (const auto direction = region_.nearest(frame.to_world({x, y, 1})))
        trials.push_back({*direction, Eigen::Vector3d::Zero()});
  return trials;
}

/// Returns the best samples without a better one within `distance`: peaks, not the slopes beside them. Of
/// equally good samples the earliest one comes first.
std::vector<Sample> DirectionSearch::peaks(const std::vector<Sample>& samples, double distance) const {
  const auto level = [](const Sample& sample) {
    return std::round(sample.at.value / tolerance::stackability);
  };
  std::vector<Sample> sorted = samples;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Sample& a, const Sample& b) { return level(a) > level(b); });
  std::vector<Eigen::Vector3d> better;  // and equal ones that were kept
  std::vector<Sample> kept, equal;
  for (const Sample& sample : sorted) {
    if (static_cast<int>(kept.size()) == options_.climbs) break;
    if (!equal.empty() && level(equal.front()) > level(sample)) {
      for (const Sample& passed : equal) better.push_back(passed.at.direction.normalized());
      equal.clear();
    }
    equal.push_back(sample);
    const Eigen::Vector3d unit = sample.at.direction.normalized();
    const auto near = [&](const Eigen::Vector3d& other) {
      return std::abs(other.dot(unit)) >= std::cos(distance);
    };
    if (std::any_of(better.begin(), better.end(), near)) continue;
    kept.push_back(sample);
    better.push_back(unit);
  }
  return kept;
}

/// Climbs in two rounds. Many starts lead to the same peak: after a short climb from every start, starts that
/// have met continue as one.
void DirectionSearch::climb_to_peaks() {
  const double step = spacing_ / (1 << halvings), small_step = step / 32;
  std::vector<Sample> tops = peaks(samples_, spacing_ / 2);
  std::erase_if(tops, [&](const Sample& top) { return top.at.value < best_ - climbing_range; });
  if (!perfect()) {
    tops = peaks(climb_from(std::move(tops), step, small_step), step);
    report_search(0.95);
    tops = peaks(climb_from(std::move(tops), small_step, tolerance::direction_step), step);
    look_around(tops.front());
  }
  result_.best = tops.front().at;
  for (const Sample& top : tops) result_.optima.push_back({top.at.direction, top.at.value});
}

/// Asks whether to end from the calling thread only; climbs in other threads use its last answer.
std::vector<Sample> DirectionSearch::climb_from(std::vector<Sample> starts, double first_step,
                                                double last_step) {
  std::atomic<bool> end_climbs = ended();
  // Every climb gets the same share of the remaining directions, so that none depends on the others.
  const std::int64_t each = left() / static_cast<std::int64_t>(std::max<std::size_t>(1, starts.size()));
  const AscentOptions climbing{first_step, last_step,
                               [&, caller = std::this_thread::get_id()] {
                                 if (std::this_thread::get_id() == caller && ended()) end_climbs = true;
                                 return end_climbs.load();
                               },
                               each};
  std::vector<std::int64_t> evaluated(starts.size(), 0);
  tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) {
    const LocalOptimum end = bundle_ascent(solver_, region_, starts[i].at, climbing);
    starts[i].at = end.at;
    evaluated[i] = end.evaluated;
  });
  result_.evaluated = std::accumulate(evaluated.begin(), evaluated.end(), result_.evaluated);
  return starts;
}

/// Climbs again from better directions around the best one, at all distances down to the last step. S is
/// discontinuous where walls begin to pass each other, and has creases; a climb may end there before the
/// peak.
void DirectionSearch::look_around(Sample& top) {
  const double widest = spacing_ / (1 << halvings);
  int climbs_left = max_new_climbs;
  for (double radius = widest;
       radius > tolerance::direction_step && !ended() && left() >= max_circle_trials;) {
    const Sample best = best_on_circle(top, radius);
    if (best.at.value <= top.at.value + tolerance::stackability || climbs_left == 0) {
      radius /= 4;
      continue;
    }
    --climbs_left;
    top = climb_from({best}, radius, tolerance::direction_step).front();
    radius = std::min(widest, 4 * radius);
  }
}

/// Returns the best direction of a circle around `top`: first of even samples, then by bisection between the
/// best two peaks and their neighbours. Along a discontinuity, only a narrow part of the circle next to one
/// of the two jumps is better than the centre.
Sample DirectionSearch::best_on_circle(const Sample& top, double radius) {
  const Frame frame = frame_of(Direction(top.at.direction));
  Sample best = top;
  best.at.value = -std::numeric_limits<double>::infinity();
  const auto measure_at = [&](const std::vector<double>& angles) {
    std::vector<double> values(angles.size(), -std::numeric_limits<double>::infinity());
    std::vector<Stackability> measured(angles.size());
    tbb::parallel_for(std::size_t{0}, angles.size(), [&](std::size_t i) {
      const Eigen::Vector3d local(radius * std::cos(angles[i]), radius * std::sin(angles[i]), 1);
      const auto direction = region_.nearest(frame.to_world(local));
      if (!direction) return;
      measured[i] = solver_.measure(Direction(*direction));
      values[i] = measured[i].value;
    });
    result_.evaluated += static_cast<std::int64_t>(angles.size());
    for (std::size_t i = 0; i < angles.size(); ++i)
      if (values[i] > best.at.value) best.at = measured[i];
    return values;
  };
  const double even_step = 2 * std::numbers::pi / circle_points;
  std::vector<double> angles;
  for (int i = 0; i < circle_points; ++i) angles.push_back(i * even_step);
  const std::vector<double> values = measure_at(angles);
  for (const int peak : circle_peaks(values)) {
    double middle = angles[static_cast<std::size_t>(peak)], value = values[static_cast<std::size_t>(peak)],
           step = even_step;
    for (int halving = 0; halving < circle_halvings; ++halving) {
      step /= 2;
      const std::vector<double> sides = measure_at({middle - step, middle + step});
      const int better = sides[0] >= sides[1] ? 0 : 1;
      if (sides[static_cast<std::size_t>(better)] <= value) continue;
      value = sides[static_cast<std::size_t>(better)];
      middle += better == 0 ? -step : step;
    }
  }
  return best;
}

void DirectionSearch::prove() {
  DirectionBoundOptions proof;
  proof.cone = options_.cone;
  proof.plane_normal = options_.plane_normal;
  proof.accuracy = *options_.certify;
  proof.max_cells = options_.max_cells;
  proof.cancelled = options_.cancelled;
  proof.progress = [this](double fraction) { report(0.5 + fraction / 2); };
  const BoundedStackability bounded = stackability_bound(solver_, result_.best, proof);
  result_.bound = bounded.bound;
  result_.evaluated += bounded.evaluated;
  result_.cancelled = bounded.bound.cancelled;
  if (bounded.best.value <= result_.best.value) return;
  result_.best = bounded.best;
  result_.optima.insert(result_.optima.begin(), {bounded.best.direction, bounded.best.value});
}

}  // namespace

SearchResult best_direction(const StackabilitySolver& solver, const SearchOptions& options) {
  return DirectionSearch(solver, options).run();
}

}  // namespace stackabilization
