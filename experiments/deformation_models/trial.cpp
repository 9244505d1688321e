#include "deformation_models/trial.h"

#include <algorithm>
#include <limits>

#include "common/clock.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/carried_design.h"
#include "stackabilization/structure/analysis.h"

namespace stackabilization::experiments {
namespace {

constexpr StackabilityOptions frame_measure{ContactSemantics::solid, BoxModel::frame};
const Direction upwards(0, 0, 1);

StructuredShape analysed(const Shape& shape, const std::optional<PrimitiveKind>& kind) {
  AnalysisOptions options;
  options.fit.kind = kind;
  return analyse_structure(shape, options);
}

const Candidate& best_of(const Improvement& improvement) {
  if (!improvement.solutions.empty()) return improvement.solutions.front();
  return improvement.nearest ? *improvement.nearest : improvement.before;
}

std::string text_of(SearchEnd end) {
  switch (end) {
    case SearchEnd::solved:
      return "solutions fail a check";
    case SearchEnd::exhausted:
      return "no edits left";
    case SearchEnd::expansion_limit:
      return "limit of expansions";
    case SearchEnd::trial_limit:
      return "limit of work";
    case SearchEnd::time_limit:
      return "limit of time";
    case SearchEnd::cancelled:
      return "cancelled";
  }
  return {};
}

/// How the search ended, and what refused most of the edits.
std::string reason_of(const Improvement& improvement, const Structure& rest) {
  if (!improvement.solutions.empty()) return {};
  std::string reason = text_of(improvement.end);
  if (improvement.diagnosis && !improvement.diagnosis->constraints.empty())
    reason += "; " + describe(improvement.diagnosis->constraints.front(), rest);
  return reason;
}

ImprovementOptions options_of(const Task& task, const Limits& limits) {
  ImprovementOptions options;
  options.preset = task.preset;
  options.refinement.evaluations = limits.evaluations;
  options.search.alpha = task.alpha;
  options.search.expansions = limits.expansions;
  options.search.seconds = limits.seconds;
  options.effort = std::numeric_limits<double>::infinity();
  options.search.directions = {upwards.vector()};
  return options;
}

Requirements requirements_of(const Variant& variant, double target) {
  Requirements requirements;
  requirements.target = target;
  requirements.measure = frame_measure;
  requirements.keep_height = variant.keep_height;
  return requirements;
}

}  // namespace

const std::vector<Variant>& variants() {
  static const std::vector<Variant> all = {
      {"cuboids", DeformationKind::controllers, PrimitiveKind::cuboid},
      {"cylinders", DeformationKind::controllers, PrimitiveKind::cylinder},
      {"mixed", DeformationKind::controllers},
      {"surface", DeformationKind::surface},
      {"iwires", DeformationKind::iwires},
      {"gap-scaling", DeformationKind::gap_scaling},
      {"gap-scaling-height-free", DeformationKind::gap_scaling, {}, false},
  };
  return all;
}

const Variant& mixed_variant() {
  return *std::find_if(variants().begin(), variants().end(), [](const Variant& variant) {
    return capabilities_of(variant.kind).edits_primitives && !variant.primitives;
  });
}

Subject::Subject(const Shape& shape)
    : rest_(analysed(shape, {})),
      meter_(rest_, frame_measure.boxes),
      at_rest_(stackability(rest_.shape, upwards, frame_measure).value) {}

bool Subject::consists_of(PrimitiveKind kind) const {
  return std::all_of(rest_.structure.parts.begin(), rest_.structure.parts.end(), [&](const Part& part) {
    return std::holds_alternative<Cuboid>(part.primitive) == (kind == PrimitiveKind::cuboid);
  });
}

Measures Subject::measured(const Candidate& candidate) const {
  return {candidate.measured.value, meter_.distortion(carried_design(rest_, candidate.design.shape)),
          candidate.energy.distortion.total(), shape_change(rest_.shape, candidate.design.shape),
          static_cast<std::int64_t>(candidate.design.edits.size())};
}

Trial Subject::trial(const RequirementChecker& checker, const Task& task, const Limits& limits) const {
  const Stopwatch watch;
  const Improvement improvement = improve(checker, options_of(task, limits));
  Trial trial;
  trial.task = task;
  trial.reached = !improvement.solutions.empty();
  trial.best = measured(best_of(improvement));
  trial.shape = best_of(improvement).design.shape;
  trial.evaluated = improvement.progress.evaluated;
  trial.reason = reason_of(improvement, rest_.structure);
  trial.seconds = watch.seconds();
  trial.processor_seconds = watch.processor_seconds();
  return trial;
}

std::vector<Trial> Subject::trials(const Variant& variant, const std::vector<Task>& tasks,
                                   const Limits& limits) const {
  std::vector<Trial> trials;
  try {
    const auto space = deformation_model(
        variant.primitives ? analysed(rest_.shape, variant.primitives) : rest_, {variant.kind, upwards});
    for (const Task& task : tasks)
      trials.push_back(trial({*space, requirements_of(variant, task.target)}, task, limits));
  } catch (const Error& error) {
    trials.clear();
    for (const Task& task : tasks) {
      trials.emplace_back();
      trials.back().task = task;
      trials.back().reason = error.what();
    }
  }
  for (Trial& trial : trials) trial.variant = variant.name;
  return trials;
}

}  // namespace stackabilization::experiments
