#include <memory>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/requirements.h"
#include "stackabilization/improvement/rest_shape.h"
#include "support/catch.h"
#include "support/cups.h"
#include "support/directions.h"

using namespace stackabilization;

namespace {

const StructuredShape& cup() {
  return cups::space.rest();
}

Design wider_cup() {
  return cups::space.edited(cups::space.at_rest(), cups::scale(1, 1.25), {}).design;
}

}  // namespace

TEST_CASE("S at rest is that of a shape measured on its own, to the bit", "[rest_shape]") {
  for (const BoxModel boxes : {BoxModel::oriented, BoxModel::frame})
    for (const double play : {0.0, 0.02}) {
      StackabilityOptions measure;
      measure.boxes = boxes;
      measure.clearance = 0.125;
      measure.play = play;
      const RestShape rest(cup(), measure);
      for (const Direction& direction : {upwards, Direction(0.1, 0.2, 1), Direction(1, -0.3, 0.2)}) {
        CAPTURE(boxes == BoxModel::frame, play, direction.vector().transpose());
        const Stackability known = rest.measure(direction);
        const Stackability alone = stackability(cup().shape, direction, measure);
        CHECK(known.value == alone.value);
        CHECK(known.f_max == alone.f_max);
        CHECK(known.extent == alone.extent);
        CHECK(known.base == alone.base);
        CHECK(known.box_volume == alone.box_volume);
        const Stackability without = rest.solver_without_play().measure(direction);
        CHECK((play > 0 ? without.f_max <= known.f_max : without.f_max == known.f_max));
      }
    }
}

TEST_CASE("distortions from rest are those of a meter of its own, to the bit", "[rest_shape]") {
  const Design design = wider_cup();
  for (const BoxModel boxes : {BoxModel::oriented, BoxModel::frame})
    for (const double alpha : {0.2, 0.7}) {
      StackabilityOptions measure;
      measure.boxes = boxes;
      const RestShape rest(cup(), measure);
      const Energy known = rest.energy_meter().with_alpha(alpha).energy(design, 0.3);
      const Energy alone = EnergyMeter(cup(), boxes, alpha).energy(design, 0.3);
      CHECK(known.value == alone.value);
      CHECK(known.distortion.box == alone.distortion.box);
      CHECK(known.distortion.total() > 0);
    }
  CHECK(RestShape(cup(), {}).energy_meter().alpha() == EnergyMeter(cup(), BoxModel::frame).alpha());
  CHECK_THROWS_AS(RestShape(cup(), {}).energy_meter().with_alpha(1.1), UsageError);
}

TEST_CASE("a checker makes what is known of the shape at rest once, or takes it", "[rest_shape]") {
  const RequirementChecker made(cups::space, {}), copy = made;
  CHECK(&copy.rest_shape() == &made.rest_shape());
  CHECK(made.rest_shape().measure(upwards).value == made.measure(cup().shape, upwards).value);
  const auto known = std::make_shared<const RestShape>(cup(), StackabilityOptions());
  CHECK(&RequirementChecker(cups::space, {}, known).rest_shape() == known.get());
}

TEST_CASE("a shape without stackability is refused at rest", "[rest_shape]") {
  StructuredShape flat = cup();
  flat.shape.vertices.col(2).setZero();
  CHECK_THROWS_AS(RestShape(flat, {}), InputError);
  StackabilityOptions measure;
  measure.play = -1;
  CHECK_THROWS_AS(RestShape(cup(), measure), UsageError);
}
