#include "improvement/search/gap_descent.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <compare>
#include <optional>
#include <utility>
#include <vector>

#include "improvement/contacts/design_contacts.h"
#include "improvement/contacts/gap_excess.h"
#include "improvement/search/follower_slide.h"
#include "stackabilization/improvement/energy.h"

namespace stackabilization {

namespace {

/// Least decrease of the merit that makes an edit worthwhile.
constexpr double min_merit_gain = 0.01;

/// With limits of quality: largest number of designs that are held against all of them in a step, and how
/// many of them at once, whatever the number of threads.
constexpr std::int64_t max_checked = 16;
constexpr std::size_t checked_at_once = 4;
/// Number of designs that are made and measured in the time of such a check.
constexpr std::int64_t check_cost = 2;

/// The number of triangle pairs in a contact band grows with the width of the band and with the square of the
/// number of triangles. Beyond this number of triangles the band is narrower.
constexpr double many_triangles = 20000;

/// The greedy descent of `descend_gaps`.
class Pursuit {
 public:
  Pursuit(const RequirementChecker& checker, const Candidate& start, const GapDescentOptions& options)
      : checker_(checker),
        options_(options),
        direction_(start.direction),
        constraints_(deformation_constraints(checker.requirements(), checker.space().rest(), direction_)),
        meter_(checker.rest_shape().energy_meter().with_alpha(options.alpha)),
        handles_(checker.space().handles()),
        centres_(checker.space().centres()),
        gap_(checker, direction_),
        at_rest_(start.measured.value - start.energy.gain) {
    now_.candidate = start;
    now_.excess = gap_.of(start.design.shape, start.measured);
  }

  GapDescentResult run() {
    for (int step = 0; step < options_.steps && excess(now_) > 0; ++step)
      if (stopped_here() || !advance()) break;
    return {std::move(now_.candidate), now_.excess.equal, stuck_, evaluations_};
  }

 private:
  struct State {
    Candidate candidate;
    detail::SummedExcess excess;
    bool slid = false;  ///< whether another part slides out of the way of the last edit
  };

  /// Returns the excess that is made small.
  double excess(const State& state) const {
    return options_.measure == GapMeasure::equal ? state.excess.equal : state.excess.by_overlap;
  }

  /// Designs without a slide come first: one edit is better than two.
  struct Choice {
    bool slid;
    double merit;
    std::size_t row;

    auto operator<=>(const Choice&) const = default;
  };

  /// Returns D + F / F_now, see `descend_gaps`.
  double merit(const State& state) const {
    return state.candidate.energy.distortion.total() + excess(state) / excess(now_);
  }

  /// Returns the edits that regions with f above the allowed separation suggest.
  std::vector<ContactEdit> suggestions() const {
    const Candidate& from = now_.candidate;
    ContactOptions contacts = options_.edits.contacts;
    const double lack = (from.measured.f_max - gap_.allowed_separation(from.measured)) / from.measured.extent;
    const double density = static_cast<double>(from.design.shape.triangle_count()) / many_triangles;
    contacts.band = std::max(contacts.band, std::min({lack, 1.0, 1 / (density * density)}));
    const std::vector<ContactRegion> regions =
        detail::contacts_of(checker_, from.design.shape, direction_, contacts);
    return contact_edits({checker_.space().rest(), checker_.space().capabilities(), handles_, from.design,
                          regions, direction_, centres_},
                         options_.edits);
  }

  std::optional<State> after(const ContactEdit& suggestion) const {
    const Design& from = now_.candidate.design;
    DeformationResult outcome = checker_.space().edited(from, suggestion.edit, constraints_);
    if (outcome.refusal) return std::nullopt;
    State state;
    if (const std::optional<Obstacle> refused = checker_.form_obstacle(outcome.design)) {
      const std::optional<Edit> slide =
          detail::follower_slide(suggestion, *refused, checker_.space().rest(), from, direction_);
      if (!slide) return std::nullopt;
      outcome = checker_.space().edited(from, *slide, constraints_);
      if (outcome.refusal) return std::nullopt;
      outcome = checker_.space().edited(outcome.design, suggestion.edit, constraints_);
      if (outcome.refusal || checker_.form_obstacle(outcome.design)) return std::nullopt;
      state.slid = true;
    }
    state.candidate.measured = checker_.measure(outcome.design.shape, direction_);
    state.candidate.energy = meter_.energy(outcome.design, state.candidate.measured.value - at_rest_);
    state.candidate.design = std::move(outcome.design);
    state.excess = gap_.of(state.candidate.design.shape, state.candidate.measured);
    return state;
  }

  bool advance() {
    const std::vector<ContactEdit> edits = suggestions();
    if (static_cast<std::int64_t>(edits.size()) > options_.evaluations - evaluations_) return false;
    evaluations_ += static_cast<std::int64_t>(edits.size());
    std::vector<std::optional<State>> made(edits.size());
    tbb::parallel_for(std::size_t{0}, edits.size(), [&](std::size_t k) {
      if (!stopped_here()) made[k] = after(edits[k]);
    });
    if (stopped_here()) return false;
    const std::optional<std::size_t> best = choice(made);
    stuck_ = !best;
    if (stuck_ || stopped_here()) return false;
    Candidate& next = made[*best]->candidate;
    next.direction = now_.candidate.direction;
    next.reasons = now_.candidate.reasons;
    if (made[*best]->slid) next.reasons.push_back({EditEffect::compensation});
    next.reasons.push_back(edits[*best].reason);
    now_ = std::move(*made[*best]);
    return true;
  }

  /// Returns how many designs may be held against all limits of quality in this step.
  std::size_t max_checks() const {
    if (!checker_.requirements().quality) return 0;
    const std::int64_t left = (options_.evaluations - evaluations_) / check_cost;
    return static_cast<std::size_t>(std::min<std::int64_t>(left, max_checked));
  }

  /// Returns the design of least merit; with limits of quality, of those worthwhile that keep all
  /// requirements but the target, if any does.
  std::optional<std::size_t> choice(const std::vector<std::optional<State>>& made) {
    const double before = merit(now_) - min_merit_gain;
    std::vector<Choice> worthwhile;
    for (std::size_t k = 0; k < made.size(); ++k)
      if (made[k] && merit(*made[k]) < before) worthwhile.push_back({made[k]->slid, merit(*made[k]), k});
    if (worthwhile.empty()) return std::nullopt;
    std::sort(worthwhile.begin(), worthwhile.end());
    const std::size_t checked = std::min(worthwhile.size(), max_checks());
    for (std::size_t first = 0; first < checked; first += checked_at_once) {
      const std::size_t count = std::min(checked_at_once, checked - first);
      std::array<bool, checked_at_once> kept{};
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        const Design& design = made[worthwhile[first + k].row]->candidate.design;
        kept[k] = !stopped_here() && !checker_.obstacle(design, direction_);
      });
      evaluations_ += check_cost * static_cast<std::int64_t>(count);
      for (std::size_t k = 0; k < count; ++k)
        if (kept[k]) return worthwhile[first + k].row;
    }
    return worthwhile.front().row;
  }

  bool stopped_here() const { return options_.cancelled && options_.cancelled(); }

  const RequirementChecker& checker_;
  const GapDescentOptions& options_;
  Direction direction_;
  DeformationConstraints constraints_;
  EnergyMeter meter_;
  std::vector<Handle> handles_;
  std::vector<Eigen::Vector3d> centres_;  ///< of the handles, at rest
  detail::GapExcess gap_;
  double at_rest_;
  State now_;
  bool stuck_ = false;
  std::int64_t evaluations_ = 0;
};

}  // namespace

GapDescentResult descend_gaps(const RequirementChecker& checker, const Candidate& start,
                              const GapDescentOptions& options) {
  return Pursuit(checker, start, options).run();
}

}  // namespace stackabilization
