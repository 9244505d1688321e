#include "improvement/advice/edit_trials.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace stackabilization::detail {

namespace {

/// So many edits of largest S have all their checks made, which take longer than an edit, until one passes.
constexpr std::size_t max_checked = 8;

/// Returns the rows of the largest values above `least`, the largest first.
std::vector<std::size_t> best_rows(const std::vector<double>& values, double least) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k] > least) rows.push_back(k);
  std::stable_sort(rows.begin(), rows.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  rows.resize(std::min(rows.size(), max_checked));
  return rows;
}

}  // namespace

EditTrials::EditTrials(const DeformationModel& space, const Candidate& design,
                       const DiagnosisOptions& options)
    : space_(space),
      design_(design),
      options_(options),
      handles_(space_.handles()),
      centres_(space_.centres()) {}

std::optional<EditTrial> EditTrials::tried(const std::vector<ContactRegion>& regions,
                                           const RequirementChecker& checker) {
  if (stopped()) return std::nullopt;
  const Direction direction(design_.direction);
  const DeformationConstraints constraints =
      deformation_constraints(checker.requirements(), space_.rest(), direction);
  ContactEditOptions kinds;
  if (space_.following() == Following::smooth) kinds.family = EditFamily::smooth;
  const std::vector<ContactEdit> edits = contact_edits(
      {space_.rest(), space_.capabilities(), handles_, design_.design, regions, direction, centres_}, kinds);
  if (static_cast<double>(edits.size()) > designs_left()) return std::nullopt;
  designs_ += static_cast<std::int64_t>(edits.size());
  std::vector<std::optional<Obstacle>> refusals(edits.size());
  std::vector<double> reached(edits.size(), design_.measured.value);
  std::atomic<bool> cut_short = false;
  tbb::parallel_for(std::size_t{0}, edits.size(), [&](std::size_t k) {
    if (cut_short || stopped()) {
      cut_short = true;
      return;
    }
    const DeformationResult outcome = space_.edited(design_.design, edits[k].edit, constraints);
    if (outcome.refusal)
      refusals[k] = without_amounts(*outcome.refusal);
    else if (const auto obstacle = checker.form_obstacle(outcome.design))
      refusals[k] = without_amounts(*obstacle);
    else if (const auto better = checker.measure_if_above(outcome.design.shape, direction, reached[k]))
      reached[k] = std::max(reached[k], better->value);
  });
  EditTrial trial;
  trial.stopped = cut_short;
  trial.best = design_.measured.value;
  for (const std::size_t k : best_rows(reached, trial.best)) {
    if (cancelled()) {
      trial.stopped = true;
      break;
    }
    const DeformationResult outcome = space_.edited(design_.design, edits[k].edit, constraints);
    if (const auto check = checker.obstacle(outcome.design, direction)) {
      refusals[k] = without_amounts(*check);
      continue;
    }
    trial.best = reached[k];
    trial.best_edit = edits[k].edit;
    break;
  }
  for (std::size_t k = 0; k < edits.size(); ++k) {
    if (refusals[k])
      ++trial.refusals[*refusals[k]];
    else
      ++trial.made;
  }
  return trial;
}

}  // namespace stackabilization::detail
