#include <algorithm>
#include <string>
#include <vector>

#include "stackabilization/core/number_text.h"
#include "stackabilization/improvement/confirmation.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/still_designs.h"

using namespace stackabilization;
using designs::frame_requirements;

namespace {

/// Names of the questions that were not answered as said.
std::vector<std::string> denied(const std::vector<Confirmation>& answers) {
  std::vector<std::string> names;
  for (const Confirmation& answer : answers)
    if (answer.verdict == Verdict::disagrees) names.push_back(answer.name);
  return names;
}

std::vector<std::string> names_of(const std::vector<Confirmation>& answers) {
  std::vector<std::string> names;
  for (const Confirmation& answer : answers) names.push_back(answer.name);
  return names;
}

}  // namespace

TEST_CASE("a mesh confirms what was measured on it, by arithmetic and by collision tests") {
  const designs::Still space(designs::cup());
  const RequirementChecker checker(space, frame_requirements());
  const Shape& cup = space.rest().shape;
  const Assessment said = checker.check(space.at_rest(), upwards);
  const std::vector<Confirmation> answers = confirm(checker, cup, upwards, said);
  CHECK(names_of(answers) == std::vector<std::string>{"stackability", "exact f_max",
                                                      "height over that at rest", "collision above f_max",
                                                      "collision at f_max", "collision below f_max"});
  CHECK(denied(answers).empty());
  CHECK(std::stod(answers[0].note) == Approx(0.5));
  CHECK(answers[3].note == "free");
  CHECK(answers[5].note == "colliding");
}

TEST_CASE("a mesh denies what is not true of it") {
  const designs::Still space(designs::cup());
  const RequirementChecker checker(space, frame_requirements());
  const Shape cup = space.rest().shape;
  const Assessment said = checker.check(space.at_rest(), upwards);

  Shape taller = cup;
  taller.vertices.col(2) *= 1 + 1e-6;
  CHECK(denied(confirm(checker, taller, upwards, said)) ==
        std::vector<std::string>{"exact f_max", "height over that at rest"});
  CHECK(denied(confirm(checker, solids::box({1, 1, 8}), upwards, said)) ==
        std::vector<std::string>{"stackability", "exact f_max"});

  Assessment lie = said;
  lie.separation.value = lie.separation.value + Rational(1e-15);
  CHECK(denied(confirm(checker, cup, upwards, lie)) == std::vector<std::string>{"exact f_max"});
  lie = said;
  lie.measured.value += 1e-6;
  const std::vector<Confirmation> answers = confirm(checker, cup, upwards, lie);
  CHECK(denied(answers) == std::vector<std::string>{"stackability"});
  CHECK(answers[0].note ==
        shortest_text(said.measured.value) + " instead of " + shortest_text(lie.measured.value));
}

TEST_CASE("an open mesh is asked about its surfaces, and a height that may change is not asked about") {
  StructuredShape open = designs::cup();
  const Eigen::Index kept = open.shape.triangle_count() - 1;
  open.shape.triangles.conservativeResize(kept, 3);
  open.shape.triangle_part.resize(static_cast<std::size_t>(kept));
  const designs::Still space(open);
  Requirements requirements = frame_requirements();
  requirements.keep_height = false;
  const RequirementChecker checker(space, requirements);
  const std::vector<Confirmation> answers =
      confirm(checker, open.shape, upwards, checker.check(space.at_rest(), upwards));
  CHECK(denied(answers).empty());
  REQUIRE(answers.size() > 2);
  CHECK(std::none_of(answers.begin(), answers.end(),
                     [](const Confirmation& one) { return one.name.find("height") == 0; }));
  CHECK(answers[2].note.find(", of surfaces: an open mesh has no interior") != std::string::npos);
}
