#include <algorithm>
#include <string>

#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/diagnosis.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/still_designs.h"

namespace stackabilization {
namespace {

StructuredShape shipped(const std::string& name) {
  return analyse_structure(read_shape(STACKABILIZATION_SOURCE_DIR "/data/models/" + name));
}

/// A search that made nothing better than the shape at rest.
BestFirstResult nothing_found(const RequirementChecker& checker, const Shape& rest) {
  BestFirstResult result;
  result.nearest.resize(1);
  result.nearest[0].design = checker.space().at_rest();
  result.nearest[0].measured = checker.measure(rest, Direction(0, 0, 1));
  return result;
}

/// The failure case of the paper (Fig. 12).
TEST_CASE("the swivel chair is kept apart by its base under the back") {
  const StructuredShape chair = shipped("swivel_chair.obj");
  const auto space = deformation_model(chair);
  const RequirementChecker checker(*space, designs::frame_requirements(0.8));
  const BestFirstResult result = nothing_found(checker, chair.shape);
  const Diagnosis diagnosis = diagnose(checker, result);
  REQUIRE_FALSE(diagnosis.blockers.empty());
  const Blocker& blocker = diagnosis.blockers.front();
  const auto name = [&](int part) { return chair.shape.part_names[static_cast<std::size_t>(part)]; };
  CHECK(name(blocker.upper_part) == "back");
  CHECK(mentions(name(blocker.lower_part), "castor_"));
  CHECK(blocker.f == Approx(result.nearest[0].measured.f_max));
  CHECK(blocker.edits != Blocker::Edits::untried);
  const std::string text = stackabilization::text(diagnosis, chair.structure);
  CHECK(mentions(text, "of each copy comes down on 'back' of the copy below"));
  CHECK(mentions(text, "What would help:"));
  for (const Remedy& remedy : diagnosis.remedies) CHECK(remedy.stackability > diagnosis.reached + 0.01);
}

TEST_CASE("a basket may lose its handle, but not its body") {
  const StructuredShape basket = shipped("basket.obj");
  const auto space = deformation_model(basket);
  const RequirementChecker checker(*space, designs::frame_requirements(0.9));
  const Diagnosis diagnosis = diagnose(checker, nothing_found(checker, basket.shape));
  const auto offered = [&](const Removal& removal) {
    return std::any_of(diagnosis.remedies.begin(), diagnosis.remedies.end(), [&](const Remedy& remedy) {
      return remedy.kind == Remedy::Kind::remove_part && remedy.parts == removal.parts;
    });
  };
  bool body = false;
  for (const Removal& removal : removals(basket)) {
    const bool helps = removal.stackability > diagnosis.reached + 0.01;
    CHECK(offered(removal) == (helps && removal.area <= 0.5));
    body = body || (helps && removal.area > 0.5);
  }
  CHECK(body);
}

}  // namespace
}  // namespace stackabilization
