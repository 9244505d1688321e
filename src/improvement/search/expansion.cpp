#include "improvement/search/expansion.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "improvement/contacts/design_contacts.h"
#include "stackabilization/structure/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Returns whether the translations `a` and `b` point to opposite sides.
bool against(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.dot(b) < -tolerance::same_symmetry * a.norm() * b.norm();
}

void make(SuccessorNode& successor, const SearchTools& tools, const ExpandedNode& from,
          const SearchTree& tree) {
  const DeformationModel& space = tools.checker.space();
  const Direction direction(from.direction);
  const auto constraints = deformation_constraints(tools.checker.requirements(), space.rest(), direction);
  DeformationResult outcome = space.edited(from.design, successor.suggestion.edit, constraints);
  if (outcome.refusal) {
    successor.refusal = std::move(outcome.refusal);
    return;
  }
  successor.refusal = tools.checker.form_obstacle(outcome.design);
  if (successor.refusal) return;
  successor.key = tools.keys.key(outcome.design);
  successor.known = tree.knows(from.queue, successor.key);
  if (successor.known) return;
  successor.measured = tools.checker.measure(outcome.design.shape, direction);
  successor.energy = tools.energy(outcome.design, successor.measured);
  if (!std::isfinite(successor.energy.value)) successor.refusal = Refusal{RefusalCause::undefined};
  successor.design = std::move(outcome.design);
}

}  // namespace

bool takes_back(const Edit& edit, const Edit& earlier) {
  if (!(edit.handle == earlier.handle) || edit.operation.index() != earlier.operation.index()) return false;
  if (const auto* move = std::get_if<Move>(&edit.operation))
    return against(move->by, std::get<Move>(earlier.operation).by);
  if (const auto* lean = std::get_if<Lean>(&edit.operation)) {
    const auto& before = std::get<Lean>(earlier.operation);
    return against(lean->by, lean->axis.dot(before.axis) < 0 ? Eigen::Vector3d(-before.by) : before.by);
  }
  if (const auto* taper = std::get_if<Taper>(&edit.operation)) {
    const auto& before = std::get<Taper>(earlier.operation);
    return (taper->factor > 1) != (before.factor > 1) && taper->axis.dot(before.axis) > 0 &&
           taper->along == before.along;
  }
  const auto *scale = std::get_if<Scale>(&edit.operation), *before = std::get_if<Scale>(&earlier.operation);
  if (scale == nullptr || (scale->factor > 1) == (before->factor > 1)) return false;
  if (scale->along.has_value() != before->along.has_value()) return false;
  return !scale->along || scale->along->cross(*before->along).norm() <
                              tolerance::same_symmetry * scale->along->norm() * before->along->norm();
}

SearchTools::SearchTools(const RequirementChecker& the_checker, const BestFirstOptions& the_options)
    : checker(the_checker),
      options(the_options),
      meter(the_checker.rest_shape().energy_meter().with_alpha(the_options.alpha)),
      keys(the_checker.space()),
      handles(the_checker.space().handles()),
      centres(the_checker.space().centres()),
      at_rest(the_checker.rest_shape().measure(Direction(the_options.directions.front())).value) {}

std::vector<ContactEdit> suggested_edits(const SearchTools& tools, const ExpandedNode& from) {
  const DeformationModel& space = tools.checker.space();
  const Direction direction(from.direction);
  const std::vector<ContactRegion> regions =
      contacts_of(tools.checker, from.design.shape, direction, tools.options.edits.contacts);
  std::vector<ContactEdit> edits = contact_edits(
      {space.rest(), space.capabilities(), tools.handles, from.design, regions, direction, tools.centres},
      tools.options.edits);
  // Undoing an edit leads to designs that steps of the same kind reach as well, or come near to.
  std::erase_if(edits, [&](const ContactEdit& suggestion) {
    return std::any_of(from.design.edits.begin(), from.design.edits.end(),
                       [&](const Edit& earlier) { return takes_back(suggestion.edit, earlier); });
  });
  return edits;
}

std::vector<SuccessorNode> successors(const SearchTools& tools, const ExpandedNode& from,
                                      std::vector<ContactEdit> edits, const SearchTree& tree,
                                      Interruption& interruption) {
  std::vector<SuccessorNode> made(edits.size());
  for (std::size_t k = 0; k < made.size(); ++k) made[k].suggestion = std::move(edits[k]);
  tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t k) {
    if (!interruption.now()) make(made[k], tools, from, tree);
  });
  return made;
}

}  // namespace stackabilization::detail
