#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/part_names.h"
#include "stackabilization/structure/segmentation.h"
#include "structure/segmentation/members.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

Shape named(Shape shape, const std::string& name) {
  shape.part_names = {name};
  std::fill(shape.triangle_part.begin(), shape.triangle_part.end(), 0);
  return shape;
}

/// A seat on a frame: the frame is one part of the file, an upright U, 10 x 10, of three straight members.
Shape bench() {
  return concatenate(named(solids::subdivided(solids::subdivided(solids::u_shape(10, 1))), "frame"),
                     named(solids::box({0, 0, 10}, {10, 4, 10.5}), "seat"));
}

/// The side of a chair, one part of the file: a post, a leg and two rails between them, each a solid of its
/// own. The rails end `deep` inside the leg.
Shape side(double x, double deep, const std::string& name) {
  const auto bar = [&](double low_y, double low_z, double high_y, double high_z, double width) {
    return solids::subdivided(solids::box({x - width / 2, low_y, low_z}, {x + width / 2, high_y, high_z}));
  };
  return named(
      concatenate(concatenate(bar(0, 0, 0.9, 16, 0.9), bar(7.4, 0, 8.3, 8.2, 0.9)),
                  concatenate(bar(0.9, 6.8, 7.4 + deep, 8.2, 0.6), bar(0.9, 2, 7.4 + deep, 2.6, 0.6))),
      name);
}

/// Returns the triangles of a shape whose centres are `wanted`, as one part.
template <typename Wanted>
Shape triangles_where(const Shape& shape, const Wanted& wanted) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    if (wanted(Eigen::RowVector3d((shape.corner(t, 0) + shape.corner(t, 1) + shape.corner(t, 2)) / 3)))
      rows.push_back(t);
  Shape chosen = shape;
  chosen.triangles = shape.triangles(rows, Eigen::all);
  chosen.triangle_part.assign(rows.size(), 0);
  return chosen;
}

/// Every triangle twice, as programs that draw surfaces on both sides write them.
Shape on_both_sides(const Shape& shape) {
  Shape back = shape;
  back.triangles.col(1).swap(back.triangles.col(2));
  Shape both = concatenate(shape, back);
  both.part_names.resize(static_cast<std::size_t>(shape.part_count()));
  for (std::int32_t& part : both.triangle_part) part %= static_cast<std::int32_t>(shape.part_count());
  return both;
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

TEST_CASE("A ring of solids is cut into these, alike on both sides although its rails are not", "[members]") {
  const Shape before = concatenate(concatenate(side(-3.5, 0, "left"), side(3.5, 0.05, "right")),
                                   named(solids::box({-4, 0, 8.2}, {4, 8.3, 8.5}), "seat"));
  const Shape after = segment(before);
  REQUIRE(after.part_count() == 9);
  std::vector<int> counts(9);
  for (const std::int32_t part : after.triangle_part) ++counts[static_cast<std::size_t>(part)];
  CHECK(counts == std::vector<int>{48, 48, 48, 48, 48, 48, 48, 48, 12});
  for (int part = 0; part < 8; ++part) {  // a box each
    const Shape member = extract_part(after, part);
    double volume = 1;
    for (int axis = 0; axis < 3; ++axis)
      volume *= range_along(member, Eigen::Vector3d(Eigen::Vector3d::Unit(axis))).length();
    CHECK(solids::signed_volume(member) == Approx(volume).epsilon(1e-12));
  }
}

TEST_CASE("A square ring is cut into its four bars, however well one curve follows it", "[members]") {
  using solids::box;
  const Shape ring =
      named(concatenate(concatenate(box({0, 0, 0}, {0.6, 0.6, 8}), box({0, 7.4, 0}, {0.6, 8, 8})),
                        concatenate(box({0, 0.6, 0}, {0.6, 7.4, 0.6}), box({0, 0.6, 7.4}, {0.6, 7.4, 8}))),
            "ring");
  const Shape after = segment(concatenate(ring, named(box({-4, 0, 8}, {4, 8, 8.3}), "seat")));
  CHECK(after.part_names == std::vector<std::string>{"ring.1", "ring.2", "ring.3", "ring.4", "seat"});
}

TEST_CASE("A cap that is too small for a part belongs to the member that it is nearest to", "[members]") {
  // Below the left leg, and outside of its convex hull.
  const Shape cap = solids::box({-3.7, 7.6, -0.2}, {-3.3, 8, -0.1});
  const Shape left = side(-3.5, 0, "left");
  const Shape rest =
      concatenate(side(3.5, 0, "right"), named(solids::box({-4, 0, 8.2}, {4, 8.3, 8.5}), "seat"));
  const Shape without = segment(concatenate(left, rest));
  const Shape with = segment(concatenate(named(concatenate(left, cap), "left"), rest));
  REQUIRE(without.part_count() == 9);
  CHECK(with.part_names == without.part_names);
  const std::size_t count = left.triangle_part.size();
  const std::int32_t leg = with.triangle_part[count / 4];  // after the post
  for (std::size_t t = count; t < count + cap.triangle_part.size(); ++t) CHECK(with.triangle_part[t] == leg);
}

TEST_CASE("A face that closes a bar belongs to it, one that closes nothing is a member", "[members]") {
  using solids::box;
  // A gate: its rail lacks the front, a face with other vertices along its sides. A flag stands on a post.
  const Shape posts = concatenate(box({0, 0, 0}, {1, 1, 10}), box({9, 0, 0}, {10, 1, 10}));
  const Shape rail = box({1, 0.2, 1}, {9, 0.8, 2});
  const auto is_front = [](const Eigen::RowVector3d& centre) { return centre.y() < 0.2 + 1e-9; };
  const Shape open_rail = triangles_where(rail, [&](const auto& centre) { return !is_front(centre); });
  const Shape front = triangles_where(solids::subdivided(solids::subdivided(rail)), is_front);
  const Shape flag = triangles_where(solids::subdivided(box({0, 0, 10}, {1, 1, 14})),
                                     [](const auto& centre) { return centre.x() > 1 - 1e-9; });
  const std::vector<Shape> pieces = {posts, open_rail, front, flag};
  Shape gate = posts;
  std::vector<std::int32_t> cut(posts.triangle_part.size() / 2, 0);
  cut.resize(posts.triangle_part.size(), 1);
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    gate = concatenate(gate, pieces[k]);
    cut.resize(gate.triangle_part.size(), static_cast<std::int32_t>(k) + 1);
  }
  gate = named(std::move(gate), "gate");
  const std::vector<std::int32_t> found = detail::members(gate, [&](const Shape& part) {
    REQUIRE(part.triangle_count() == gate.triangle_count());
    return cut;
  });
  std::vector<std::int32_t> expected = cut;
  for (std::int32_t& piece : expected) piece -= piece > 2 ? 1 : 0;
  CHECK(found == expected);
}

TEST_CASE("Bars that meet at a mitre close each other, and stay two members", "[members]") {
  const auto opened = [](Shape bar, const Eigen::RowVector3d& end) {
    return triangles_where(
        bar, [&](const Eigen::RowVector3d& centre) { return (centre - end).cwiseAbs().minCoeff() > 1e-9; });
  };
  Shape lying = opened(solids::box({0, 0, 0}, {10, 1, 1}), {10, 9, 9});
  for (auto corner : lying.vertices.rowwise())
    if (corner.x() == 10 && corner.z() == 1) corner.x() = 9;
  Shape standing = opened(solids::box({9, 0, 0}, {10, 1, 10}), {8, 8, 0});
  for (auto corner : standing.vertices.rowwise())
    if (corner.x() == 9 && corner.z() == 0) corner.z() = 1;
  const Shape angle = named(concatenate(lying, standing), "angle");
  std::vector<std::int32_t> cut(lying.triangle_part.size(), 0);
  cut.resize(angle.triangle_part.size(), 1);
  CHECK(detail::members(angle, [&](const Shape&) { return cut; }) == cut);
}

TEST_CASE("Surfaces that are drawn on both sides are cut as those drawn once", "[members]") {
  const Shape once = segment(bench()), twice = segment(on_both_sides(bench()));
  CHECK(twice.part_names == once.part_names);
  std::vector<std::int32_t> expected = once.triangle_part;
  expected.insert(expected.end(), once.triangle_part.begin(), once.triangle_part.end());
  CHECK(twice.triangle_part == expected);
}
