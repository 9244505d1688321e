#include "stackabilization/improvement/confirmation.h"

#include <algorithm>
#include <cmath>

#include "stackabilization/core/number_text.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/collision.h"
#include "stackabilization/stacking/collision_probes.h"

namespace stackabilization {

namespace {

Confirmation compared(const std::string& name, double found, double said) {
  const bool same = std::abs(found - said) <= tolerance::relative * std::max(1.0, std::abs(said));
  return {same ? Verdict::agrees : Verdict::disagrees, name,
          shortest_text(found) + (same ? "" : " instead of " + shortest_text(said))};
}

Confirmation same_lift(const Separation& found, const Separation& said) {
  const bool same = found.blocked == said.blocked && (!found.blocked || found.value == said.value);
  return {same ? Verdict::agrees : Verdict::disagrees, "exact f_max",
          same ? "the same rational number" : "another rational number"};
}

/// Returns a confirmation per collision test around the lift at which copies of a shape touch.
std::vector<Confirmation> collision_tests(const CollisionTester& tester, const Shape& shape,
                                          const Direction& direction, const Separation& lift,
                                          ContactSemantics semantics) {
  if (!lift.blocked) return {{Verdict::skipped, "collision", "nothing is in the way along the direction"}};
  std::vector<Confirmation> tests;
  for (const CollisionProbe& probe : collision_probes(shape, direction, lift, {semantics})) {
    const bool found = collides(tester, direction, probe);
    tests.push_back({found == probe.collides ? Verdict::agrees : Verdict::disagrees,
                     "collision " + to_string(probe.place) + " f_max", found ? "colliding" : "free"});
  }
  return tests;
}

/// As above, for the lift in the semantics in which S is measured; of surfaces where the shape has no
/// interior.
std::vector<Confirmation> collision_tests(const Shape& shape, const SeparationTree& tree,
                                          const Direction& direction, const Separation& lift,
                                          ContactSemantics semantics) {
  const CollisionTester tester(shape, shape);
  if (semantics == ContactSemantics::closed || !tester.interior_defect())
    return collision_tests(tester, shape, direction, lift, semantics);
  const ContactSemantics closed = ContactSemantics::closed;
  std::vector<Confirmation> tests = collision_tests(
      tester, shape, direction, separation(tree, tree, direction, {closed, std::nullopt}), closed);
  for (Confirmation& test : tests)
    test.note += tester.solids() ? ", of surfaces: it is partly inside out or without volume"
                                 : ", of surfaces: an open mesh has no interior";
  return tests;
}

}  // namespace

std::vector<Confirmation> confirm(const RequirementChecker& checker, const Shape& mesh,
                                  const Direction& direction, const Assessment& said) {
  const Requirements& asked = checker.requirements();
  const SeparationTree tree(mesh);
  const ExactStackability found = measure_exact(mesh, tree, direction, asked.measure);
  std::vector<Confirmation> answers = {
      compared("stackability", found.stackability.value, said.measured.value),
      same_lift(found.separation, said.separation)};
  if (asked.keep_height)
    answers.push_back(compared("height over that at rest",
                               found.stackability.extent / checker.rest_shape().measure(direction).extent,
                               1));
  const Eigen::Index max_triangles = ValidationOptions().max_collision_triangles;
  if (mesh.triangle_count() > max_triangles) {
    answers.push_back(
        {Verdict::skipped, "collision", "more than " + std::to_string(max_triangles) + " triangles"});
    return answers;
  }
  for (Confirmation& test : collision_tests(mesh, tree, direction, found.separation, asked.measure.semantics))
    answers.push_back(std::move(test));
  return answers;
}

}  // namespace stackabilization
