#include <algorithm>
#include <string>
#include <vector>

#include "stackabilization/core/part_names.h"
#include "stackabilization/structure/segmentation.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

Shape named(Shape shape, const std::string& name) {
  shape.part_names = {name};
  return shape;
}

/// A seat on a frame: the frame is one part of the file, an upright U, 10 x 10, of three straight members.
Shape bench() {
  return concatenate(named(solids::subdivided(solids::subdivided(solids::u_shape(10, 1))), "frame"),
                     named(solids::box({0, 0, 10}, {10, 4, 10.5}), "seat"));
}

}  // namespace

TEST_CASE("A frame that is one part of the file is cut into its members", "[members]") {
  const Shape before = bench(), after = segment(before);
  CHECK(after.part_names == std::vector<std::string>{"frame.1", "frame.2", "frame.3", "seat"});
  CHECK(after.vertices == before.vertices);
  CHECK(after.triangles == before.triangles);
  CHECK(parts_named(after, {"frame"}) == std::vector{0, 1, 2});
  CHECK(parts_named(after, {"frame.2", "seat"}) == std::vector{1, 3});
  // Two members are the arms above the bottom, or with its ends: each lies within 1 of a side.
  for (const int arm : {0, 1, 2}) {
    const Range across = range_along(extract_part(after, arm), Eigen::Vector3d::UnitX());
    const Range up = range_along(extract_part(after, arm), Eigen::Vector3d::UnitZ());
    CHECK(std::min(across.length(), up.length()) <= 1.5);
    CHECK(std::max(across.length(), up.length()) >= 8);
  }
  SegmentationOptions given;
  given.method = SegmentationMethod::given;
  CHECK(segment(before, given).part_names == before.part_names);
}

TEST_CASE("Parts that one primitive represents are not cut", "[members]") {
  for (const Shape& part : {solids::cylinder(1, 5, 48), solids::frustum_shell({}), solids::torus({}),
                            solids::box({1, 2, 3}), solids::subdivided(solids::box({9, 8, 0.5}))}) {
    const Shape shape = concatenate(named(part, "one"), named(solids::box({90, 90, 90}), "other"));
    CHECK(segment(shape).part_names == shape.part_names);
  }
}
