// Jobs that find out about the current design.
#include <algorithm>
#include <utility>

#include "editing/session/session_implementation.h"
#include "stackabilization/deformation/rebase.h"

namespace stackabilization::editing {

namespace {

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

std::vector<OfferedEdit> offers(const EditedFrom& from, const std::vector<Suggestion>& list,
                                const SessionOptions& options) {
  const DeformationModel& space = from.workspace->space();
  const StructuredShape before = rebase(space.rest(), *from.design);
  std::vector<OfferedEdit> result;
  for (const Suggestion& one : list) {
    if (one.refusal || result.size() == static_cast<std::size_t>(options.max_suggestions)) break;
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
  return [this, from = from_current()](const Cancelled& cancelled, const Deliver& deliver) {
    SuggestionOptions how = smooth_suggestions(options_.alpha);
    std::size_t shown = 0;
    how.found = [&](const std::vector<Suggestion>& list) {
      const std::size_t possible = possible_of(list);
      if (possible > shown) deliver_suggestions(from, list, cancelled, deliver);
      shown = possible;
    };
    how.cancelled = [&] { return cancelled->load(); };
    how.progress = [&](double fraction) {
      deliver(unless(cancelled, [this, fraction] { emit(Progress{Work::suggestions, fraction}); }));
    };
    const std::vector<Suggestion> list =
        stackabilization::suggestions(from.workspace->checker(), *from.design, from.direction, how);
    std::vector<ObstacleCount> refusals = refusals_of(list, from.workspace->space().rest().structure);
    deliver(unless(cancelled, [this, refusals] {
      advice_.refused = refusals;
      advice_.complete = true;
      emit(Changed{Change::suggestions});
      emit(Progress{Work::suggestions, 1});
    }));
  };
}

void EditingSession::Implementation::deliver_suggestions(const EditedFrom& from,
                                                         const std::vector<Suggestion>& list,
                                                         const Cancelled& cancelled, const Deliver& deliver) {
  auto offered = std::make_shared<const std::vector<OfferedEdit>>(offers(from, list, options_));
  deliver(unless(cancelled, [this, offered] {
    advice_.suggestions = *offered;
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

}  // namespace stackabilization::editing
