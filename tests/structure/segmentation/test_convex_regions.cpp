#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "stackabilization/structure/segmentation.h"
#include "structure/segmentation/chords.h"
#include "structure/segmentation/convex_regions.h"
#include "structure/segmentation/members.h"
#include "structure/segmentation/surface_graph.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/voxels.h"

using namespace stackabilization;

namespace {

using Pieces = std::vector<std::int32_t>;

/// Returns the pieces of the triangles of each box of a union.
std::vector<std::set<std::int32_t>> pieces_of_boxes(const Shape& boxes, const Pieces& pieces) {
  std::vector<std::set<std::int32_t>> found(static_cast<std::size_t>(boxes.part_count()));
  for (std::size_t t = 0; t < pieces.size(); ++t)
    found[static_cast<std::size_t>(boxes.triangle_part[t])].insert(pieces[t]);
  return found;
}

/// Checks that the triangles of every box of a union are one part, and one of their own.
void check_cut_into_boxes(const std::vector<solids::GridBox>& boxes) {
  const Shape shape = solids::grid_union(boxes);
  Shape whole = shape;
  whole.part_names = {"whole"};
  whole.triangle_part.assign(whole.triangle_part.size(), 0);
  const Shape found = segment(whole);
  CHECK(found.part_count() == shape.part_count());
  std::set<std::int32_t> seen;
  for (const std::set<std::int32_t>& pieces : pieces_of_boxes(shape, found.triangle_part)) {
    CHECK(pieces.size() == 1);
    seen.insert(pieces.begin(), pieces.end());
  }
  CHECK(seen.size() == boxes.size());
}

/// A table whose rails hide its underside from the rim of its top.
const std::vector<solids::GridBox> railed_table{
    {{0, 0, 20}, {32, 24, 22}},  {{4, 4, 0}, {7, 7, 20}},     {{25, 4, 0}, {28, 7, 20}},
    {{4, 17, 0}, {7, 20, 20}},   {{25, 17, 0}, {28, 20, 20}}, {{7, 5, 15}, {25, 6, 20}},
    {{7, 18, 15}, {25, 19, 20}}, {{5, 7, 15}, {6, 17, 20}},   {{26, 7, 15}, {27, 17, 20}}};

/// Thick walls and a floor without a lid.
Shape open_box() {
  return solids::grid_union({{{0, 0, 0}, {20, 14, 2}},
                             {{0, 0, 2}, {2, 14, 10}},
                             {{18, 0, 2}, {20, 14, 10}},
                             {{2, 0, 2}, {18, 2, 10}},
                             {{2, 12, 2}, {18, 14, 10}}});
}

}  // namespace

TEST_CASE("a union of bars is cut along its concave edges into the bars") {
  // One lies across the other.
  check_cut_into_boxes({{{0, 8, 10}, {40, 11, 13}}, {{18, 0, 7}, {22, 20, 10}}});
  check_cut_into_boxes(railed_table);
}

TEST_CASE("a union of bars is cut where another shell stands apart from it, too") {
  // A chair: four posts, two rails, slats on these and between the posts at the back.
  std::vector<solids::GridBox> chair{{{0, 0, 0}, {3, 3, 20}},   {{30, 0, 0}, {33, 3, 20}},
                                     {{0, 40, 0}, {3, 43, 60}}, {{30, 40, 0}, {33, 43, 60}},
                                     {{1, 3, 14}, {2, 40, 18}}, {{31, 3, 14}, {32, 40, 18}}};
  for (int k = 0; k < 8; ++k) chair.push_back({{0, 4 + 4 * k, 18}, {33, 7 + 4 * k, 19}});
  for (int k = 0; k < 4; ++k) chair.push_back({{3, 41, 35 + 6 * k}, {30, 42, 39 + 6 * k}});
  Shape shape = concatenate(solids::grid_union(chair), solids::box({0, 30, 0}, {22, 32, 2}));
  shape.part_names = {"whole"};
  shape.triangle_part.assign(shape.triangle_part.size(), 0);
  CHECK(segment(shape).part_count() == static_cast<Eigen::Index>(chair.size()) + 1);
  SegmentationOptions options;
  options.method = SegmentationMethod::components;
  CHECK(segment(shape, options).part_count() == 2);
}

TEST_CASE("a shell without area far from the rest is no part") {
  const Shape one = solids::box({0, 0, 0}, {1, 2, 3}),
              union_of_bars = solids::grid_union({{{0, 8, 10}, {40, 11, 13}}, {{18, 0, 7}, {22, 20, 10}}});
  for (const Shape& solid : {one, union_of_bars}) {
    Shape flat;
    flat.vertices.resize(3, 3);
    flat.vertices << 50, 50, 50, 51, 51, 51, 52, 52, 52;
    flat.triangles.resize(1, 3);
    flat.triangles << 0, 1, 2;
    flat.triangle_part = {0};
    flat.part_names = {"flat"};
    Shape shape = concatenate(solid, flat);
    shape.part_names = {"whole"};
    shape.triangle_part.assign(shape.triangle_part.size(), 0);
    CHECK(segment(shape).part_count() == solid.part_count());
  }
}

TEST_CASE("the underside of a table belongs to its top, wherever rails surround it") {
  const Shape shape = solids::grid_union(railed_table);
  const detail::SurfaceGraph graph = detail::surface_graph(shape);
  const Pieces regions = detail::convex_regions(graph);
  CHECK(pieces_of_boxes(shape, regions).front().size() == 2);
  const std::vector<detail::SurfaceLink> walls = detail::wall_links(shape, graph);
  CHECK(walls.size() == detail::wall_places);
  const Pieces bodies = detail::joined_across_walls(graph, regions, walls, 0);
  CHECK(pieces_of_boxes(shape, bodies).front().size() == 1);
  detail::ConvexRegionRule never;
  never.min_shared_wall = 1.01;
  const Pieces apart = detail::joined_across_walls(graph, regions, walls, 0, never);
  CHECK(pieces_of_boxes(shape, apart).front().size() == 2);
}

TEST_CASE("an open box keeps its floor: it is one body on both sides of the wall") {
  const Shape shape = open_box();
  const detail::SurfaceGraph graph = detail::surface_graph(shape);
  const Pieces regions = detail::convex_regions(graph);
  CHECK(*std::max_element(regions.begin(), regions.end()) == 1);
  const std::vector<detail::SurfaceLink> walls = detail::wall_links(shape, graph);
  const Pieces bodies = detail::joined_across_walls(graph, regions, walls, 0);
  CHECK(std::all_of(bodies.begin(), bodies.end(), [](std::int32_t body) { return body == 0; }));
  // Whatever else cuts it, the floor goes with what is below it.
  const std::vector<detail::SurfaceLink> inner = detail::inner_walls(graph, regions, walls, 0);
  Pieces pieces(regions.size());
  for (std::size_t t = 0; t < pieces.size(); ++t) {
    const Eigen::Vector3d centre = graph.centres.row(static_cast<Eigen::Index>(t));
    pieces[t] = centre.z() == 0 ? 7 : 3;
  }
  const Pieces placed = detail::with_inner_sides(pieces, regions, inner);
  for (std::size_t t = 0; t < pieces.size(); ++t) {
    const Eigen::Vector3d centre = graph.centres.row(static_cast<Eigen::Index>(t));
    CHECK(placed[t] == (centre.z() == 0 || centre.z() == 2 ? 7 : 3));
  }
  CHECK(detail::inner_walls(graph, regions, walls, graph.areas.sum()).empty());
}

TEST_CASE("sheets and rough surfaces have no bodies between concave edges") {
  const Shape solid = solids::grid_union(railed_table);
  Shape rough = solid;
  solids::Random random(4);
  for (Eigen::Index v = 0; v < rough.vertex_count(); ++v)
    rough.vertices.row(v) += 0.45 * random.in_cube().transpose();
  const Pieces regions = detail::convex_regions(detail::surface_graph(rough));
  CHECK(*std::max_element(regions.begin(), regions.end()) == 0);

  const detail::SurfaceGraph graph = detail::surface_graph(solid);
  const Pieces bodies = detail::joined_across_walls(graph, detail::convex_regions(graph), {}, 0);
  CHECK(*std::max_element(bodies.begin(), bodies.end()) == 0);
}

TEST_CASE("a frame with flush faces is cut into a rail and two equal legs") {
  check_cut_into_boxes({{{0, 0, 30}, {40, 8, 33}},
                        {{2, 0, 27}, {5, 24, 30}},
                        {{2, 2, 0}, {5, 6, 27}},
                        {{2, 18, 0}, {5, 22, 27}},
                        {{35, 0, 27}, {38, 24, 30}},
                        {{35, 2, 0}, {38, 6, 27}},
                        {{35, 18, 0}, {38, 22, 27}}});
}

TEST_CASE("bars with flush faces are cut where they bend inwards, however slender the whole is") {
  CHECK_FALSE(detail::has_sharp_concave_edges(detail::surface_graph(solids::box({0, 0, 0}, {9, 2, 1}))));
  CHECK(detail::has_sharp_concave_edges(detail::surface_graph(open_box())));
  // A long bar with a short one at each end is a cuboid to 3 % of its diagonal. It lies on two blocks.
  check_cut_into_boxes({{{4, 8, 4}, {76, 10, 6}},
                        {{0, 2, 4}, {4, 16, 6}},
                        {{76, 2, 4}, {80, 16, 6}},
                        {{1, 4, 0}, {3, 14, 4}},
                        {{77, 4, 0}, {79, 14, 4}}});
}

TEST_CASE("the solid behind a place does not end where another shell begins") {
  const Shape nested = concatenate(solids::box({0, 0, 0}, {4, 4, 4}), solids::box({1, 1, 1}, {3, 3, 3}));
  const detail::SurfaceGraph graph = detail::surface_graph(nested);
  const std::vector<detail::SurfaceLink> walls = detail::wall_links(nested, graph);
  // Rays from a quarter of each outer face meet the inner box, of a fifth of the area.
  CHECK(static_cast<double>(walls.size()) == Approx(detail::wall_places * (0.8 * 0.75 + 0.2)).epsilon(0.02));
  for (const detail::SurfaceLink& wall : walls)
    CHECK(nested.triangle_part[static_cast<std::size_t>(wall.a)] ==
          nested.triangle_part[static_cast<std::size_t>(wall.b)]);
}

TEST_CASE("two feet whose faces are flush for a little below a column are two members") {
  const std::vector<solids::GridBox> boxes{
      {{4, 7, 1}, {16, 11, 30}}, {{0, 8, 0}, {10, 10, 2}}, {{10, 8, 0}, {20, 10, 2}}};
  const Shape feet = solids::grid_union(boxes);
  Shape whole = feet;
  whole.part_names = {"whole"};
  whole.triangle_part.assign(whole.triangle_part.size(), 0);
  const auto into_boxes = [&](const Shape&) { return feet.triangle_part; };
  CHECK(pieces_of_boxes(feet, detail::members(whole, into_boxes)) ==
        std::vector<std::set<std::int32_t>>{{0}, {1}, {2}});
  detail::MemberRule any;
  any.little_border = 0;
  CHECK(pieces_of_boxes(feet, detail::members(whole, into_boxes, any)) ==
        std::vector<std::set<std::int32_t>>{{0}, {1}, {1}});
}

TEST_CASE("a part with more bodies than members is cut by fitting alone") {
  std::vector<solids::GridBox> boxes{{{0, 0, 0}, {40, 40, 2}}, {{0, 0, 2}, {40, 2, 40}}};
  for (int k = 0; k < 18; ++k) {
    const int x = 2 + 6 * (k % 6), y = 8 + 10 * (k / 6);
    boxes.push_back({{x, y, 2}, {x + 3, y + 3, 5}});
  }
  Shape pegged = solids::grid_union(boxes);
  pegged.part_names = {"whole"};
  pegged.triangle_part.assign(pegged.triangle_part.size(), 0);
  SegmentationOptions options;
  options.method = SegmentationMethod::primitives;
  CHECK(segment(pegged, options).part_count() > detail::MemberRule().max_members);
  options.method = SegmentationMethod::members;
  const Shape found = segment(pegged, options);
  CHECK(found.part_count() > 1);
  CHECK(found.part_count() <= detail::MemberRule().max_members);
}

TEST_CASE("a triangle without height takes its normal from the surface beside it") {
  // The edge from (0, 0, 0) to (1, 0, 0) of a box has a third corner just off it, as rounding leaves it.
  Shape shape = solids::box({0, 0, 0}, {1, 1, 1});
  const auto is_edge = [&](Eigen::Index t, int k) {
    const Eigen::Vector3d a = shape.corner(t, k), b = shape.corner(t, (k + 1) % 3);
    return a.tail<2>().isZero(0) && b.tail<2>().isZero(0) && a != b;
  };
  Eigen::Index triangle = -1;
  int side = 0;
  for (Eigen::Index t = 0; t < shape.triangle_count() && triangle < 0; ++t)
    for (int k = 0; k < 3; ++k)
      if (is_edge(t, k)) triangle = t, side = k;
  REQUIRE(triangle >= 0);
  const Eigen::Index v = shape.vertices.rows(), t = shape.triangles.rows();
  shape.vertices.conservativeResize(v + 1, 3);
  shape.vertices.row(v) << 0.5, 1e-6, -1e-6;
  const Eigen::RowVector3i corners = shape.triangles.row(triangle);
  const auto add = [&](int a, int b, int c) {
    const Eigen::Index row = shape.triangles.rows();
    shape.triangles.conservativeResize(row + 1, 3);
    shape.triangles.row(row) << a, b, c;
    shape.triangle_part.push_back(0);
  };
  const int a = corners(side), b = corners((side + 1) % 3), c = corners((side + 2) % 3);
  const int mid = static_cast<int>(v);
  shape.triangles.row(triangle) << a, mid, c;
  add(mid, b, c);
  add(a, b, mid);
  const detail::SurfaceGraph graph = detail::surface_graph(shape);
  const Eigen::Index flat = t + 1;
  REQUIRE(graph.areas(flat) < 1e-6);
  bool beside = false;
  for (Eigen::Index other = 0; other < t; ++other)
    if (other != triangle)
      for (int k = 0; k < 3; ++k)
        if (is_edge(other, k)) beside |= graph.normals.row(other) == graph.normals.row(flat);
  CHECK(beside);
}
