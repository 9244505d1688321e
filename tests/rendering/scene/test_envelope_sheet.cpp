#include <Eigen/Geometry>

#include "rendering/scene/envelope_sheet.h"
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

/// The walls of the unit cube without thickness, and a floor at this height.
Shape sheet_bin(double height) {
  Points points(12, 3);
  points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0, 0, height, 1, 0,
      height, 1, 1, height, 0, 1, height;
  Triangles triangles(10, 3);
  triangles << 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7, 8, 9, 10, 8, 10, 11;
  return make_shape(points, triangles);
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
  CHECK(envelope_sheet(box, aside, EnvelopeSide::upper).triangle_count() == 0);
}

TEST_CASE("a floor between vertical walls is seen whatever rounding its samples carry") {
  for (const double height : {0.0, 0.3, 1.0}) {
    const Shape bin = sheet_bin(height);
    const Window window = window_around(bin, Direction(0, 0, 1), 100);
    for (const double noise : {0.0, 1e-7}) {
      HeightField field = height_field_by_scanline(bin, Direction(0, 0, 1), window);
      field.upper.array() += noise;
      field.lower.array() -= noise;
      for (const EnvelopeSide side : {EnvelopeSide::upper, EnvelopeSide::lower}) {
        const Shape floor = envelope_sheet(bin, field, side);
        CHECK(area(floor) == Approx(1));
        CHECK(floor.vertices.col(2).minCoeff() == Approx(height).margin(1e-12));
      }
    }
  }
}
