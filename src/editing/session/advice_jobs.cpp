// Jobs that find out about the current design.
#include <algorithm>
#include <utility>

#include "editing/session/session_implementation.h"
#include "stackabilization/deformation/rebase.h"
#include "stackabilization/stacking/search.h"

namespace stackabilization::editing {

namespace {

/// Of a map of directions.
constexpr double map_step_degrees = 5;
constexpr std::int64_t max_map_directions = 4000;

/// Samples of envelopes along the longer side.
constexpr int envelope_resolution = 160;

/// Gain of S below which a suggestion is no answer, and the work that goes into a diagnosis then.
constexpr double min_gain = 0.005;
constexpr double max_diagnosis_designs = 200;

std::size_t possible_of(const std::vector<Suggestion>& list) {
  return static_cast<std::size_t>(
      std::count_if(list.begin(), list.end(), [](const Suggestion& one) { return !one.refusal; }));
}

std::vector<ObstacleCount> refusals_of(const std::vector<Suggestion>& list, const Structure& structure) {
  std::vector<ObstacleCount> counts;
  for (const Suggestion& one : list) {
    if (!one.refusal) continue;
    const Obstacle obstacle = without_amounts(*one.refusal);
    const auto known = std::find_if(counts.begin(), counts.end(),
                                    [&](const ObstacleCount& count) { return count.obstacle == obstacle; });
    if (known == counts.end())
      counts.push_back({obstacle, 1});
    else
      ++known->count;
  }
  sort_by_count(counts, structure);
  return counts;
}

std::vector<OfferedEdit> offers(const EditedFrom& from, const std::vector<Suggestion>& list, int limit) {
  const DeformationModel& space = from.workspace->space();
  const StructuredShape before = rebase(space.rest(), *from.design);
  std::vector<OfferedEdit> result;
  for (const Suggestion& one : list) {
    if (one.refusal || result.size() == static_cast<std::size_t>(limit)) break;
    OfferedEdit offered;
    offered.suggestion = one;
    offered.design = std::make_shared<const Design>(
        space.edited(*from.design, one.edit.edit, from.workspace->constraints(from.direction)).design);
    offered.explanation =
        explain(before, offered.design->shape, {.edits = {one.edit.edit}, .reasons = {one.edit.reason}});
    offered.gain = one.measured.value - from.now;
    offered.change = shape_change(space.rest().shape, offered.design->shape);
    result.push_back(std::move(offered));
  }
  return result;
}

/// Returns what blocks and what would help, where no suggestion raises S.
std::optional<Diagnosis> diagnosis_without_gain(const EditedFrom& from, const std::vector<Suggestion>& list,
                                                const Cancelled& cancelled) {
  for (const Suggestion& one : list)
    if (!one.refusal && one.measured.value > from.now + min_gain) return std::nullopt;
  BestFirstResult stuck;
  Candidate& candidate = stuck.nearest.emplace_back();
  candidate.design = *from.design;
  candidate.reasons.resize(candidate.design.edits.size());
  candidate.direction = from.direction.vector();
  const MeasuredDesign measured = from.workspace->measured(from.design, from.direction, from.at_rest);
  candidate.measured = measured.assessment.measured;
  candidate.energy = measured.energy;
  DiagnosisOptions how;
  how.designs = max_diagnosis_designs;
  how.cancelled = [&] { return cancelled->load(); };
  return diagnose(from.workspace->checker(), stuck, how);
}

SuggestionOptions smooth_suggestions(double alpha) {
  SuggestionOptions how;
  how.alpha = alpha;
  how.edits.family = EditFamily::smooth;
  how.only_helpful = true;
  return how;
}

}  // namespace

JobWork EditingSession::Implementation::review_work() {
  return [this, from = from_current()](const Cancelled& cancelled, const Deliver& deliver) {
    Review review;
    const RequirementChecker& checker = from.workspace->checker();
    review.contacts = situation(checker, *from.design, from.direction).contacts;
    const StructuredShape& rest = from.workspace->space().rest();
    review.explanation = explain(rest, from.design->shape, {.edits = from.design->edits, .reasons = {}});
    review.assessment = checker.check(*from.design, from.direction);
    deliver(unless(cancelled, [this, review] {
      advice_.review = review;
      emit(Changed{Change::review});
    }));
  };
}

JobWork EditingSession::Implementation::suggestion_work() {
  return [this, from = from_current(), alpha = options_.alpha, limit = options_.max_suggestions](
             const Cancelled& cancelled, const Deliver& deliver) {
    SuggestionOptions how = smooth_suggestions(alpha);
    std::size_t shown = 0;
    how.found = [&](const std::vector<Suggestion>& list) {
      const std::size_t possible = possible_of(list);
      if (possible > shown) deliver_suggestions(offers(from, list, limit), cancelled, deliver);
      shown = possible;
    };
    how.cancelled = [&] { return cancelled->load(); };
    how.progress = [&](double fraction) {
      deliver(unless(cancelled, [this, fraction] { emit(Progress{Work::suggestions, fraction}); }));
    };
    const std::vector<Suggestion> list =
        stackabilization::suggestions(from.workspace->checker(), *from.design, from.direction, how);
    std::vector<ObstacleCount> refusals = refusals_of(list, from.workspace->space().rest().structure);
    const std::optional<Diagnosis> diagnosis = diagnosis_without_gain(from, list, cancelled);
    deliver(unless(cancelled, [this, refusals, diagnosis] {
      advice_.refused = refusals;
      advice_.diagnosis = diagnosis;
      advice_.complete = true;
      emit(Changed{Change::suggestions});
      emit(Progress{Work::suggestions, 1});
    }));
  };
}

void EditingSession::Implementation::deliver_suggestions(std::vector<OfferedEdit> offered,
                                                         const Cancelled& cancelled, const Deliver& deliver) {
  const auto shared = std::make_shared<const std::vector<OfferedEdit>>(std::move(offered));
  deliver(unless(cancelled, [this, shared] {
    advice_.suggestions = *shared;
    emit(Changed{Change::suggestions});
  }));
}

JobWork EditingSession::Implementation::range_work() {
  return [this, from = from_current(), edit = *std::exchange(wanted_range_, std::nullopt)](
             const Cancelled& cancelled, const Deliver& deliver) {
    HandleRange range = handle_range(from, edit, [&] { return cancelled->load(); });
    deliver(unless(cancelled, [this, range] {
      advice_.range = range;
      emit(Changed{Change::range});
    }));
  };
}

JobWork EditingSession::Implementation::envelope_work() {
  return [this, from = from_current()](const Cancelled& cancelled, const Deliver& deliver) {
    const Shape& shape = from.design->shape;
    const auto field = std::make_shared<const HeightField>(height_field_by_rays(
        shape, from.direction, window_around(shape, from.direction, envelope_resolution)));
    deliver(unless(cancelled, [this, field] {
      envelopes_wanted_ = false;
      advice_.envelopes = *field;
      emit(Changed{Change::envelopes});
    }));
  };
}

JobWork EditingSession::Implementation::map_work() {
  map_wanted_ = false;
  return [this, from = from_current()](const Cancelled& cancelled, const Deliver& deliver) {
    const StackabilitySolver solver(from.design->shape, from.workspace->checker().requirements().measure);
    DirectionMap map;
    MapOptions how;
    how.step_degrees = map_step_degrees;
    how.cancelled = [&] { return cancelled->load(); };
    map.map = stackability_map(solver, how);
    SearchOptions search;
    search.candidates = {from.direction.vector()};
    search.max_directions = max_map_directions;
    search.cancelled = how.cancelled;
    const SearchResult found = best_direction(solver, search);
    map.best_direction = found.optima.front().direction;
    map.best = found.optima.front().stackability;
    deliver(unless(cancelled, [this, map, design = from.design] {
      if (current_.design != design) return;
      advice_.map = map;
      emit(Changed{Change::map});
    }));
  };
}

}  // namespace stackabilization::editing
