#include <sstream>
#include <string>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/validation.h"
#include "stacking/validation/report_rows.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/messages.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

ValidationOptions coarse() {
  ValidationOptions options;
  options.resolutions = {16, 64, 256};
  return options;
}

}  // namespace

TEST_CASE("every check agrees on a small solid", "[validation]") {
  const Shape wedge = solids::extruded_profile({{0, 0}, {3, 0}, {0, 0.7}}, 1.5);
  const Direction direction(0.3, -0.2, 2);
  const ValidationReport report = validate_translation(wedge, direction, coarse());
  CAPTURE(table(report));
  CHECK(report.passed);
  for (const ValidationRow& row : report.rows) {
    CAPTURE(row.name);
    CHECK(row.verdict != Verdict::disagrees);
    CHECK(row.verdict != Verdict::skipped);
  }
  CHECK(row_of(report, "Minkowski sum").note == "the same rational number");
  CHECK(row_of(report, "rays, zoomed in on the witness").verdict == Verdict::agrees);
}

TEST_CASE("sampled values close in on the exact one from below", "[validation]") {
  const ValidationReport report = validate_translation(solids::torus({}), Direction(0.3, -0.2, 1), coarse());
  CAPTURE(table(report));
  CHECK(report.passed);
  for (const std::string method : {"rays", "scanline"}) {
    const double coarsest = *row_of(report, method + " 16").error,
                 finest = *row_of(report, method + " 256").error;
    CHECK(coarsest < 0);
    CHECK(finest <= 1e-12);
    CHECK(finest > coarsest / 4);
  }
  CHECK(row_of(report, "Minkowski sum").verdict == Verdict::skipped);
}

TEST_CASE("a part thinner than a pixel is told of", "[validation]") {
  // A flat slab with a needle that no sample of these grids meets.
  const Shape slab = solids::box({0, 0, 0}, {4, 4, 1});
  const Shape needle = solids::box({1.0003, 1.0003, 1}, {1.0004, 1.0004, 3});
  const ValidationReport report = validate_translation(concatenate(slab, needle), upwards, coarse());
  CAPTURE(table(report));
  CHECK(report.passed);
  CHECK(report.solid.value == Rational(3));
  const ValidationRow& finest = row_of(report, "scanline 256");
  CHECK(finest.value == Approx(1));
  CHECK(finest.verdict == Verdict::within_sampling);
  CHECK(mentions(finest.note, "the error does not shrink"));
  CHECK(mentions(finest.note, "thinner than the pixel"));
  CHECK(row_of(report, "rays, zoomed in on the witness").value == Approx(3));
}

TEST_CASE("hooks pass: the search starts at the top", "[validation]") {
  const ValidationReport report = validate_translation(solids::hook({}), upwards, coarse());
  CAPTURE(table(report));
  CHECK(report.passed);
  CHECK(*row_of(report, "collision search from the top, solid").value == Approx(6).epsilon(1e-8));
}

TEST_CASE("walls along the direction count in closed semantics only", "[validation]") {
  const ValidationReport report = validate_translation(solids::boxes_sharing_wall(), upwards, coarse());
  CAPTURE(table(report));
  CHECK(report.passed);
  CHECK(report.solid.value == Rational(1));
  CHECK(report.closed.value == Rational(3));
  // An odd number of columns puts samples on the common wall.
  ValidationOptions odd;
  odd.resolutions = {31};
  const ValidationReport on_the_wall = validate_translation(solids::boxes_sharing_wall(), upwards, odd);
  CHECK(on_the_wall.passed);
  CHECK(row_of(on_the_wall, "scanline 31").value == Approx(3));
  CHECK(mentions(row_of(on_the_wall, "scanline 31").note, "wall along the direction"));
}

TEST_CASE("open shapes skip what needs an interior, and say so", "[validation]") {
  const ValidationReport report =
      validate_translation(solids::open_box({2, 2, 1}), Direction(0.1, 0, 1), coarse());
  CAPTURE(table(report));
  CHECK(report.passed);
  CHECK(row_of(report, "overlap of interiors").verdict == Verdict::skipped);
  CHECK(mentions(row_of(report, "overlap of interiors").note, "open"));
  CHECK(row_of(report, "no contact above closed f_max").verdict == Verdict::agrees);
  CHECK(row_of(report, "Minkowski sum").verdict == Verdict::skipped);
}

TEST_CASE("a projection without area is checked as far as it can be", "[validation]") {
  Points points(3, 3);
  points << 0, 0, 0, 2, 0, 0, 2, 0, 6;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const ValidationReport report = validate_translation(make_shape(points, triangles), upwards, coarse());
  CAPTURE(table(report));
  CHECK(report.passed);
  CHECK_FALSE(report.solid.blocked);
  CHECK(report.closed.value == Rational(6));
  CHECK(row_of(report, "exact, solid").verdict == Verdict::skipped);
}

TEST_CASE("a flat sheet across the direction is free as soon as it is lifted", "[validation]") {
  Points points(4, 3);
  points << 0, 0, 1, 8, 0, 1, 8, 8, 1, 0, 8, 1;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const ValidationReport report = validate_translation(make_shape(points, triangles), upwards, coarse());
  CAPTURE(table(report));
  CHECK(report.passed);
  CHECK(report.extent == 0);
  CHECK(row_of(report, "no contact above closed f_max").verdict == Verdict::agrees);
  CHECK(*row_of(report, "no contact above closed f_max").value > 0);
  CHECK(row_of(report, "contact at closed f_max").verdict == Verdict::agrees);
}

TEST_CASE("contact is not asked for where triangles without area attain f_max", "[validation]") {
  Triangles triangle(1, 3);
  triangle << 0, 1, 2;
  Points line(3, 3), point(3, 3);
  line << 0, 0, 0, 1, 1, 1, 2, 2, 2;
  point << 1, 1, 1, 1, 1, 1, 1, 1, 1;
  const Shape needle =
      make_shape((Points(3, 3) << 0.5, 0.5, 0, 0.5, 0.5, 3, 0.5, 0.5, 7).finished(), triangle);
  for (const Shape& shape : {make_shape(line, triangle), make_shape(point, triangle),
                             concatenate(solids::box({1, 1, 1}), needle)}) {
    const ValidationReport report = validate_translation(shape, upwards, coarse());
    CAPTURE(table(report));
    CHECK(report.passed);
    CHECK(row_of(report, "contact at closed f_max").verdict == Verdict::skipped);
    CHECK(mentions(row_of(report, "contact at closed f_max").note, "without area"));
  }
}

TEST_CASE("a height field maker that exceeds the exact value is caught", "[validation]") {
  ValidationOptions options;
  options.resolutions = {8};
  options.further_rasters.push_back(
      {"too high", [](const Shape& shape, const Direction& direction, const Window& window) {
         HeightField field = height_field_by_scanline(shape, direction, window);
         field.upper.array() += 0.01;
         return field;
       }});
  options.further_rasters.push_back({"coarse heights", options.further_rasters[0].make, 0.02});
  const ValidationReport report = validate_translation(solids::box({1, 1, 1}), upwards, options);
  CHECK_FALSE(report.passed);
  CHECK(row_of(report, "too high 8").verdict == Verdict::disagrees);
  CHECK(row_of(report, "too high 8").error == Approx(0.01));
  CHECK(row_of(report, "coarse heights 8").verdict == Verdict::agrees);
  const std::string text = table(report);
  CHECK(mentions(text, "1 of "));
  CHECK(mentions(text, "DISAGREES"));
}

TEST_CASE("a height field maker that says why may exceed the exact value, and no other", "[validation]") {
  ValidationOptions options;
  options.resolutions = {8, 16};
  const auto too_high = [](const Shape& shape, const Direction& direction, const Window& window) {
    HeightField field = height_field_by_scanline(shape, direction, window);
    field.upper.array() += 0.01;
    return field;
  };
  options.further_rasters.push_back({"tilted", too_high, 1e-5, "corners move"});
  const ValidationReport report = validate_translation(solids::box({1, 1, 1}), upwards, options);
  CAPTURE(table(report));
  CHECK(report.passed);
  for (const std::string name : {"tilted 8", "tilted 16"}) {
    CHECK(row_of(report, name).verdict == Verdict::within_sampling);
    CHECK(row_of(report, name).note == "above the exact value: corners move");
  }
  options.further_rasters.push_back({"bound", too_high, 1e-5, ""});
  CHECK_FALSE(validate_translation(solids::box({1, 1, 1}), upwards, options).passed);
}

TEST_CASE("a table has one line per check between heading and verdict", "[validation]") {
  ValidationOptions options;
  options.resolutions = {8};
  const ValidationReport report = validate_translation(solids::box({1, 1, 0.1}), upwards, options);
  std::istringstream lines(table(report));
  std::size_t count = 0;
  std::string line, last;
  while (std::getline(lines, line)) {
    if (++count == 1) CHECK(line.rfind("check ", 0) == 0);
    if (count == 2) CHECK(mentions(line, " 0.10000000000000001 "));
    CHECK(line.find_last_not_of(' ') + 1 == line.size());
    last = line;
  }
  CHECK(count == report.rows.size() + 2);
  CHECK(last == "every check agrees with the exact value");
}

TEST_CASE("checks that would look at too many triangles are skipped with the reason", "[validation]") {
  const Shape box = solids::box({1, 2, 1});
  ValidationOptions options;
  options.resolutions = {8, 16, 32};
  options.max_ray_hits = 2 * 8 * 16;  // two for each ray of 16 samples along the longer side
  const ValidationReport report = validate_translation(box, upwards, options);
  CHECK(report.passed);
  CHECK(row_of(report, "rays 8").verdict == Verdict::agrees);
  CHECK(row_of(report, "rays 16").verdict != Verdict::skipped);
  CHECK(row_of(report, "rays 32").verdict == Verdict::skipped);
  CHECK(mentions(row_of(report, "rays 32").note, "more than 256 triangles"));
  CHECK(row_of(report, "scanline 32").verdict == Verdict::agrees);
}

TEST_CASE("impossible validations are refused", "[validation]") {
  const Shape box = solids::box({1, 1, 1});
  ValidationOptions none, unsorted, no_margin;
  none.resolutions = {};
  unsorted.resolutions = {64, 32};
  no_margin.collision_margin = 0;
  CHECK_THROWS_AS(validate_translation(box, upwards, none), UsageError);
  CHECK_THROWS_AS(validate_translation(box, upwards, unsorted), UsageError);
  CHECK_THROWS_AS(validate_translation(box, upwards, no_margin), UsageError);
  CHECK_THROWS_AS(validate_translation(Shape{}, upwards), InputError);
}
