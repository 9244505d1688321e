#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/segmentation.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

SegmentationOptions by(SegmentationMethod method, int parts = 0) {
  SegmentationOptions options;
  options.method = method;
  options.parts = parts;
  return options;
}

std::vector<double> part_areas(const Shape& shape) {
  std::vector<double> areas;
  for (Eigen::Index p = 0; p < shape.part_count(); ++p)
    areas.push_back(solids::surface_area(extract_part(shape, p)));
  return areas;
}

void check_same_triangles(const Shape& before, const Shape& after) {
  CHECK(before.vertices == after.vertices);
  CHECK(before.triangles == after.triangles);
  CHECK_NOTHROW(validate(after));
  std::set<std::int32_t> used(after.triangle_part.begin(), after.triangle_part.end());
  CHECK(used.size() == static_cast<std::size_t>(after.part_count()));
}

}  // namespace

TEST_CASE("given parts stay as they are") {
  const Shape table = solids::table({});
  for (const auto method : {SegmentationMethod::given, SegmentationMethod::automatic}) {
    const Shape same = segment(table, by(method));
    CHECK(same.part_names == table.part_names);
    CHECK(same.triangle_part == table.triangle_part);
  }
}

TEST_CASE("options outside their ranges are refused") {
  const Shape box = solids::box({1, 1, 1});
  CHECK_THROWS_AS(segment(box, by(SegmentationMethod::primitives, -1)), UsageError);
  for (const double share : {-0.1, 1.0, std::nan("")}) {
    SegmentationOptions options;
    options.min_part_area = share;
    CHECK_THROWS_AS(segment(box, options), UsageError);
  }
  CHECK_THROWS_AS(segment(Shape{}, SegmentationOptions{}), InputError);
}

TEST_CASE("separate components are parts, by falling area") {
  const Shape shape = concatenate(solids::box({1, 1, 1}), solids::box({5, 5, 5}, {8, 7, 6}));
  const Shape parts = segment(shape, by(SegmentationMethod::components));
  check_same_triangles(shape, parts);
  CHECK(parts.part_names == std::vector<std::string>{"part_1", "part_2"});
  const std::vector<double> areas = part_areas(parts);
  CHECK(areas[0] == Approx(2 * (6 + 3 + 2)));
  CHECK(areas[1] == Approx(6));
}

TEST_CASE("a leg that stands under a top stays apart, a veneer glued on it does not") {
  const Shape top = solids::box({0, 0, 10}, {10, 10, 11});
  const Shape leg = solids::box({1, 1, 0}, {2, 2, 10});
  const Shape veneer = solids::box({0, 0, 11}, {10, 10, 11.1});
  const Shape parts = segment(concatenate(concatenate(top, leg), veneer), by(SegmentationMethod::components));
  REQUIRE(parts.part_count() == 2);
  CHECK(part_areas(parts)[1] == Approx(solids::surface_area(leg)));
}

TEST_CASE("a box, a cylinder, a vessel and a ring are one part each") {
  for (const Shape& solid :
       {solids::subdivided(solids::box({1, 2, 3})), solids::box({1, 1, 1}), solids::cylinder(1, 5, 48),
        solids::frustum_shell({}), solids::torus({}), solids::sphere(1, 3)}) {
    const Shape parts = segment(solid, by(SegmentationMethod::primitives));
    check_same_triangles(solid, parts);
    CHECK(parts.part_count() == 1);
  }
}

TEST_CASE("seeds: what is refused") {
  const Shape box = solids::box({1, 1, 1});
  const auto seeds = [](std::vector<PartSeeds> list) { return list; };
  CHECK_THROWS_AS(segment(box, seeds({})), UsageError);
  CHECK_THROWS_AS(segment(box, seeds({{"a", {0}}, {"b", {}}})), UsageError);
  CHECK_THROWS_AS(segment(box, seeds({{"a", {0}}, {"b", {12}}})), UsageError);
  CHECK_THROWS_AS(segment(box, seeds({{"a", {0}}, {"b", {-1}}})), UsageError);
  CHECK_THROWS_AS(segment(box, seeds({{"a", {0, 3}}, {"b", {3}}})), UsageError);
}
