#include "apps/improve/improve_solution.h"

#include <algorithm>
#include <cmath>

#include "apps/common/text.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/deformation/relation_residual.h"
#include "stackabilization/stacking/collision_probes.h"

namespace stackabilization::apps {

namespace {

using Verdict = WrittenCheck::Verdict;

/// Collision tests take seconds beyond this many triangles.
constexpr Eigen::Index max_collision_triangles = 50000;

StackHeights stack_heights(const ImproveCommandOptions& options, const ImproveTask& task,
                           const SolutionReport& report) {
  const int copies = options.shown_copies();
  return {copies, report.before.stack_height(copies), report.assessment.measured.stack_height(copies),
          task.length_limit()};
}

TwistResult twisted(const ImproveTask& task, const SolutionReport& report) {
  const Requirements& asked = task.checker().requirements();
  TwistOptions search;
  search.stack.copies = report.stack.copies;
  search.stack.semantics = asked.measure.semantics;
  search.stack.boxes = asked.measure.boxes;
  search.stack.clearance = asked.measure.clearance;
  search.stack.play = asked.measure.play;
  return best_twist(report.candidate.design.shape, report.direction(), search);
}

WrittenCheck compared(const std::string& name, double found, double said) {
  const bool same = std::abs(found - said) <= tolerance::relative * std::max(1.0, std::abs(said));
  return {same ? Verdict::agrees : Verdict::disagrees, name,
          exact_digits(found) + (same ? "" : " instead of " + exact_digits(said))};
}

WrittenCheck same_lift(const Separation& found, const Separation& said) {
  const bool same = found.blocked == said.blocked && (!found.blocked || found.value == said.value);
  return {same ? Verdict::agrees : Verdict::disagrees, "exact f_max",
          same ? "the same rational number" : "another rational number"};
}

/// Collision tests around f_max of one mesh along one direction.
class CollisionChecks {
 public:
  CollisionChecks(const Shape& shape, const Direction& direction)
      : shape_(shape), direction_(direction), tree_(shape), tester_(shape, shape) {}

  std::vector<WrittenCheck> run(ContactSemantics semantics) const {
    if (semantics == ContactSemantics::solid && !tester_.interior_defect())
      return around(ContactSemantics::solid);
    std::vector<WrittenCheck> checks = around(ContactSemantics::closed);
    if (semantics == ContactSemantics::solid)
      for (WrittenCheck& check : checks)
        check.note += tester_.solids() ? ", of surfaces: it is partly inside out or without volume"
                                       : ", of surfaces: an open mesh has no interior";
    return checks;
  }

 private:
  std::vector<WrittenCheck> around(ContactSemantics semantics) const {
    SeparationOptions options;
    options.semantics = semantics;
    const Separation answer = separation(tree_, tree_, direction_, options);
    if (!answer.blocked)
      return {{Verdict::skipped, "collision", "nothing is in the way along the direction"}};
    std::vector<WrittenCheck> checks;
    for (const CollisionProbe& probe : collision_probes(shape_, direction_, answer, {semantics})) {
      const bool found = collides(tester_, direction_, probe);
      checks.push_back({found == probe.collides ? Verdict::agrees : Verdict::disagrees,
                        "collision " + to_string(probe.place) + " f_max", found ? "colliding" : "free"});
    }
    return checks;
  }

  const Shape& shape_;
  const Direction& direction_;
  SeparationTree tree_;
  CollisionTester tester_;
};

}  // namespace

bool SolutionReport::confirmed() const {
  return std::none_of(written.begin(), written.end(),
                      [](const WrittenCheck& check) { return check.verdict == Verdict::disagrees; });
}

bool SolutionReport::good() const {
  return assessment.passed() && stack.fits() && confirmed();
}

SolutionReport solution_report(const ImproveCommandOptions& options, const ImproveTask& task,
                               const Candidate& candidate, const Assessment& assessment) {
  SolutionReport report;
  report.target = task.target();
  report.candidate = candidate;
  report.assessment = assessment;
  const Direction direction = report.direction();
  const StructuredShape& rest = task.rest();
  report.before = task.checker().rest_shape().measure(direction);
  report.change = shape_change(rest.shape, candidate.design.shape);
  report.explanation = explain(rest, candidate.design.shape,
                               {Eigen::Vector3d::UnitZ(), candidate.design.edits, candidate.reasons});
  report.residuals = relation_residuals(rest.structure, candidate.design.primitives);
  report.stack = stack_heights(options, task, report);
  if (options.twist) report.twist = twisted(task, report);
  return report;
}

std::vector<WrittenCheck> check_written(const Shape& shape, const ImproveTask& task,
                                        const SolutionReport& report) {
  const Direction direction = report.direction();
  const Requirements& asked = task.checker().requirements();
  const Stackability measured = task.checker().measure(shape, direction);
  SeparationOptions options;
  options.semantics = asked.measure.semantics;
  std::vector<WrittenCheck> checks = {
      compared("stackability", measured.value, report.assessment.measured.value),
      same_lift(minimal_stacking_translation(shape, direction, options), report.assessment.separation)};
  if (asked.keep_height)
    checks.push_back(compared("height over that at rest", measured.extent / report.before.extent, 1));
  if (shape.triangle_count() > max_collision_triangles) {
    checks.push_back({Verdict::skipped, "collision",
                      "more than " + std::to_string(max_collision_triangles) + " triangles"});
    return checks;
  }
  for (WrittenCheck& check : CollisionChecks(shape, direction).run(asked.measure.semantics))
    checks.push_back(std::move(check));
  return checks;
}

std::vector<ContactRegion> contacts_along(const Shape& shape, const Direction& direction,
                                          ContactSemantics semantics) {
  const SeparationTree tree(shape);
  SeparationOptions options;
  options.semantics = semantics;
  const Separation answer = separation(tree, tree, direction, options);
  if (!answer.blocked) return {};
  ContactOptions contacts;
  contacts.semantics = semantics;
  return contact_regions({shape, tree, direction, answer}, contacts).regions;
}

}  // namespace stackabilization::apps
