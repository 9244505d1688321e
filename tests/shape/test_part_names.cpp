#include "shape/meshes.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/part_names.h"
#include "support/catch.h"

using namespace stackabilization;

TEST_CASE("parts are found by their names, in order and each once", "[part_names]") {
  Shape shape = test::two_tetrahedra();
  shape.part_names = {"leg", "seat", "back"};
  CHECK(parts_named(shape, {"back", "leg", "back"}) == std::vector{0, 2});
  CHECK(parts_named(shape, {}).empty());
}

TEST_CASE("the name that no part has is named", "[part_names]") {
  Shape shape = test::two_tetrahedra();
  shape.part_names = {"leg", "seat"};
  std::string refusal;
  try {
    parts_named(shape, {"seat", "Leg"});
  } catch (const InputError& error) {
    refusal = error.what();
  }
  CHECK(refusal == "there is no part 'Leg'");
}
