#include <array>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/units.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

constexpr std::array all_units = {Unit::micrometre, Unit::millimetre, Unit::centimetre,
                                  Unit::inch,       Unit::foot,       Unit::metre};

}  // namespace

TEST_CASE("lengths in other units are what their definitions say") {
  CHECK(convert_length(1, Unit::metre, Unit::millimetre) == 1000);
  CHECK(convert_length(0.099, Unit::metre, Unit::millimetre) == 99);
  CHECK(convert_length(250, Unit::centimetre, Unit::millimetre) == 2500);
  CHECK(convert_length(1, Unit::inch, Unit::millimetre) == 25.4);
  CHECK(convert_length(1, Unit::foot, Unit::inch) == 12);
  CHECK(convert_length(3, Unit::millimetre, Unit::micrometre) == 3000);
}

TEST_CASE("a length keeps its bits in its own unit, and comes back from every other") {
  for (const Unit from : all_units) {
    CHECK(convert_length(1.0 / 3, from, from) == 1.0 / 3);
    for (const Unit to : all_units) {
      const double back = convert_length(convert_length(0.7, from, to), to, from);
      CHECK(std::abs(back - 0.7) <= 4 * 0x1p-53 * 0.7);
    }
  }
}

TEST_CASE("a length is read in the largest unit of its system, up to its own, in which it is 1 or more") {
  CHECK(readable_unit(1, Unit::metre) == Unit::metre);
  CHECK(readable_unit(0.999, Unit::metre) == Unit::centimetre);
  CHECK(readable_unit(0.01, Unit::metre) == Unit::centimetre);
  CHECK(readable_unit(-0.0049, Unit::metre) == Unit::millimetre);
  CHECK(readable_unit(1e-6, Unit::metre) == Unit::millimetre);
  CHECK(readable_unit(0.3, Unit::centimetre) == Unit::millimetre);
  CHECK(readable_unit(0.5, Unit::foot) == Unit::inch);
  for (const Unit unit : all_units) {
    CHECK(readable_unit(0, unit) == unit);
    CHECK(readable_unit(5000, unit) == unit);
  }
  for (const Unit unit : {Unit::micrometre, Unit::millimetre, Unit::inch, Unit::unknown})
    CHECK(readable_unit(0.02, unit) == unit);
}

TEST_CASE("shapes and copies in another unit are the same things") {
  Shape shape = cube(2);
  shape.unit = Unit::inch;
  const Shape converted = in_unit(shape, Unit::millimetre);
  CHECK(converted.unit == Unit::millimetre);
  CHECK(converted.vertices == Points(shape.vertices * 127 / 5));
  CHECK(converted.triangles == shape.triangles);
  CHECK(in_unit(shape, Unit::inch).vertices == shape.vertices);

  PlacedCopy copy;
  copy.name = "copy";
  copy.translation = Eigen::Vector3d(0, 0, 3);
  const Copies copies{{shape}, {copy}};
  const Shape once = as_one_shape(in_unit(copies, Unit::centimetre));
  const Shape other = in_unit(as_one_shape(copies), Unit::centimetre);
  CHECK((once.vertices - other.vertices).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(once.unit == Unit::centimetre);
}

TEST_CASE("what has no unit cannot be given another one") {
  Shape shape = cube();
  CHECK_THROWS_AS(in_unit(shape, Unit::metre), UsageError);
  shape.unit = Unit::metre;
  CHECK_THROWS_AS(in_unit(shape, Unit::unknown), UsageError);
}
