#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/diagnosis.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/still_designs.h"

namespace stackabilization {
namespace {

/// The failure case of the paper (Fig. 12).
TEST_CASE("the swivel chair is kept apart by its base under the back") {
  const StructuredShape chair =
      analyse_structure(read_shape(STACKABILIZATION_SOURCE_DIR "/data/models/swivel_chair.obj"));
  const auto space = deformation_model(chair);
  const RequirementChecker checker(*space, designs::frame_requirements(0.8));
  BestFirstResult result;
  result.nearest.resize(1);
  result.nearest[0].design = space->at_rest();
  result.nearest[0].measured = checker.measure(chair.shape, Direction(0, 0, 1));
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

}  // namespace
}  // namespace stackabilization
