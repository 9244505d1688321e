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
#include "stacking/direction/circle_peak.h"
#include "stacking/direction/trials.h"

namespace stackabilization {

namespace {

using namespace detail;

/// Number of directions measured between two updates of the threshold. It is fixed, so that the abandoned
/// directions do not depend on the number of threads.
constexpr std::size_t trials_per_batch = 256;

/// Largest difference of a sample's S from the best S at which its neighbourhood is refined; halved with the
/// spacing.
constexpr double promising_range = 0.2;

/// Number of halvings of the spacing around promising samples, and limit of the number of such samples: no
/// halving tries more directions than the even samples.
constexpr int halvings = 3;
constexpr std::size_t max_promising = 400;
constexpr std::size_t trials_per_promising = 6;

/// Limit of the work of one halving, as a multiple of that of the even samples. It matters for round bodies:
/// all around their axis, walls slide, and a direction takes a hundred times as long as an even sample.
constexpr std::int64_t work_per_even_work = 2;

/// Largest difference of a peak's S from the best S at which a climb starts.
constexpr double climbing_range = 0.05;

/// Largest number of new climbs from circles around the best direction.
constexpr int max_new_climbs = 20;

/// A trial that was measured.
struct Sample {
  Stackability at;
  Eigen::Vector3d circle_normal;
};

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
    const std::vector<DirectionTrial> evenly = even_trials(solver_, options_, region_, spacing_);
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
  void measure(const std::vector<DirectionTrial>& trials, double range,
               std::int64_t max_work = std::numeric_limits<std::int64_t>::max());
  void look_closer();
  std::vector<DirectionTrial> promising(std::size_t begin, double spacing, double range) const;
  std::vector<DirectionTrial> around(const Sample& sample, double distance) const;
  std::vector<Sample> peaks(const std::vector<Sample>& samples, double distance) const;
  void climb_to_peaks();
  std::vector<Sample> climb_from(std::vector<Sample> starts, double first_step, double last_step);
  void look_around(Sample& top);
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
  std::int64_t work_ = 0;  ///< pairs of nodes that the samples took
  SearchResult result_;
};

/// Measures trials that may come within `range` of the best, until the samples have taken `max_work`.
void DirectionSearch::measure(const std::vector<DirectionTrial>& trials, double range,
                              std::int64_t max_work) {
  for (std::size_t begin = 0; begin < trials.size(); begin += trials_per_batch) {
    if (!samples_.empty() && (ended() || perfect() || work_ >= max_work)) return;
    const std::size_t count =
        std::min({trials_per_batch, trials.size() - begin, static_cast<std::size_t>(left())});
    std::vector<std::optional<Stackability>> measured(count);
    std::vector<std::int64_t> work(count, 0);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      measured[i] = solver_.measure_if_above(Direction(trials[begin + i].direction), best_ - range, work[i]);
    });
    for (std::size_t i = 0; i < count; ++i) {
      ++result_.evaluated;
      work_ += work[i];
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
  const std::int64_t work_per_level = work_per_even_work * work_;
  std::size_t begin = 0;
  for (int level = 0; level < halvings; ++level) {
    report_search(0.3 + 0.2 * level);
    const std::vector<DirectionTrial> closer = promising(begin, spacing, range);
    begin = samples_.size();
    measure(closer, range / 2, work_ + work_per_level);
    spacing /= 2;
    range /= 2;
  }
}

/// Trials between the samples from `begin` on that are within `range` of the best.
std::vector<DirectionTrial> DirectionSearch::promising(std::size_t begin, double spacing,
                                                       double range) const {
  std::vector<Sample> candidates(samples_.begin() + static_cast<std::ptrdiff_t>(begin), samples_.end());
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Sample& a, const Sample& b) { return a.at.value > b.at.value; });
  candidates.resize(std::min({candidates.size(), max_promising, first_trials_ / trials_per_promising}));
  std::vector<DirectionTrial> trials;
  for (const Sample& sample : candidates) {
    if (sample.at.value < best_ - range) break;
    const std::vector<DirectionTrial> near = around(sample, spacing / 4);
    trials.insert(trials.end(), near.begin(), near.end());
  }
  return trials;
}

/// Centres of the quarters of a sample's square, and two neighbours on its great circle.
std::vector<DirectionTrial> DirectionSearch::around(const Sample& sample, double distance) const {
  const Frame frame = frame_of(Direction(sample.at.direction));
  const Eigen::Vector3d along = sample.circle_normal.cross(frame.w).normalized() * distance;
  std::vector<DirectionTrial> trials;
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
       radius > tolerance::direction_step && !ended() && left() >= max_circle_directions;) {
    const CirclePeak peak = circle_peak(solver_, region_, top.at.direction, radius);
    result_.evaluated += peak.evaluated;
    const Sample best{peak.best, top.circle_normal};
    if (best.at.value <= top.at.value + tolerance::stackability || climbs_left == 0) {
      radius /= 4;
      continue;
    }
    --climbs_left;
    top = climb_from({best}, radius, tolerance::direction_step).front();
    radius = std::min(widest, 4 * radius);
  }
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
