#include <Eigen/Geometry>

#include "stackabilization/rendering/envelope_sheet.h"
#include "stackabilization/shape/errors.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

double area(const Shape& shape) {
  double sum = 0;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    sum +=
        (shape.corner(t, 1) - shape.corner(t, 0)).cross(shape.corner(t, 2) - shape.corner(t, 0)).norm() / 2;
  return sum;
}

Shape sheet(const Shape& shape, const Direction& direction, EnvelopeSide side) {
  return envelope_sheet(
      shape, height_field_by_scanline(shape, direction, window_around(shape, direction, 200)), side);
}

}  // namespace

TEST_CASE("the envelopes of a box are its top and its bottom") {
  const Shape box = solids::box({2, 3, 4});
  const Shape upper = sheet(box, Direction(0, 0, 1), EnvelopeSide::upper);
  const Shape lower = sheet(box, Direction(0, 0, 1), EnvelopeSide::lower);
  CHECK(area(upper) == Approx(6));
  CHECK(upper.vertices.col(2).minCoeff() == Approx(4));
  CHECK(area(lower) == Approx(6));
  CHECK(lower.vertices.col(2).maxCoeff() == Approx(0).margin(1e-12));
  CHECK_NOTHROW(validate(upper));
}

TEST_CASE("along a slanted direction the sheet holds the faces that look that way") {
  const Shape upper = sheet(solids::box({2, 3, 4}), Direction(1, 1, 1), EnvelopeSide::upper);
  CHECK(area(upper) == Approx(2 * 3 + 3 * 4 + 2 * 4).epsilon(0.02));
}

TEST_CASE("what passes behind something else is cut away") {
  // A plate over one quarter of a larger one.
  const Shape plates = concatenate(solids::box({0, 0, 0}, {4, 4, 1}), solids::box({2, 2, 3}, {4, 4, 4}));
  const Shape upper = sheet(plates, Direction(0, 0, 1), EnvelopeSide::upper);
  CHECK(area(upper) == Approx(16).epsilon(0.02));
  CHECK(area(extract_part(upper, 0)) == Approx(12).epsilon(0.02));
  CHECK(area(extract_part(upper, 1)) == Approx(4));
  const Shape lower = sheet(plates, Direction(0, 0, 1), EnvelopeSide::lower);
  CHECK(area(lower) == Approx(16));
}

TEST_CASE("a field that sees nothing gives no sheet") {
  const Shape box = solids::box({2, 3, 4});
  const HeightField aside = height_field_by_scanline(box, Direction(0, 0, 1), {10, 10, 0.1, 20, 20});
  CHECK_THROWS_AS(envelope_sheet(box, aside, EnvelopeSide::upper), InputError);
}
