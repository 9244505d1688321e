#include <cmath>
#include <cstdint>

#include "stackabilization/structure/segmentation.h"
#include "structure/segmentation/flat_triangles.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using detail::with_flat_triangles_at_their_edges;

namespace {

constexpr std::int32_t of_top = 0, of_leg = 1;

/// A top on a leg from z = 0 to 10 with an edge at x = y = 0; flat triangles along that edge are added.
Shape top_on_leg() {
  Shape shape = concatenate(solids::box({0, 0, 10}, {8, 8, 11}), solids::box({0, 0, 0}, {1, 1, 10}));
  shape.part_names = {"top", "leg"};
  return shape;
}

/// Adds a triangle with corners on the line x = 0, `off` = y, at these heights, and returns its row.
std::size_t add_flat(Shape& shape, double low, double middle, double high, std::int32_t part,
                     double off = 0) {
  const Eigen::Index v = shape.vertices.rows(), t = shape.triangles.rows();
  shape.vertices.conservativeResize(v + 3, 3);
  shape.vertices.row(v) << 0, 0, low;
  shape.vertices.row(v + 1) << 0, off, middle;
  shape.vertices.row(v + 2) << 0, 0, high;
  shape.triangles.conservativeResize(t + 1, 3);
  shape.triangles.row(t) << static_cast<int>(v), static_cast<int>(v + 1), static_cast<int>(v + 2);
  shape.triangle_part.push_back(part);
  return static_cast<std::size_t>(t);
}

}  // namespace

TEST_CASE("a flat triangle along a leg belongs to the leg, whatever its label") {
  Shape shape = top_on_leg();
  const std::size_t along = add_flat(shape, 0, 9, 10, of_top);
  // On the edges of the first one, and collapsed to its edge.
  const std::size_t on_it = add_flat(shape, 0, 3, 9, of_top), on_that = add_flat(shape, 3, 3, 9, of_top);
  const Shape placed = with_flat_triangles_at_their_edges(shape);
  for (const std::size_t row : {along, on_it, on_that}) CHECK(placed.triangle_part[row] == of_leg);
  for (std::size_t t = 0; t < along; ++t) CHECK(placed.triangle_part[t] == shape.triangle_part[t]);
  CHECK(placed.vertices == shape.vertices);
  CHECK(placed.triangles == shape.triangles);

  // Parts and their members have them so, and parts that are kept as they are do not.
  for (const SegmentationMethod method : {SegmentationMethod::members, SegmentationMethod::automatic}) {
    SegmentationOptions options;
    options.method = method;
    const Shape parts = segment(shape, options);
    REQUIRE(parts.part_names == shape.part_names);
    CHECK(parts.triangle_part == placed.triangle_part);
  }
  SegmentationOptions options;
  options.method = SegmentationMethod::given;
  CHECK(segment(shape, options).triangle_part == shape.triangle_part);
}

TEST_CASE("a triangle keeps its label where it is not flat, lies at its own part, or lies nowhere") {
  Shape shape = top_on_leg();
  const double height = 1e-5 * std::sqrt(8 * 8 + 8 * 8 + 11 * 11);  // of the diagonal
  const std::size_t high = add_flat(shape, 0, 5, 10, of_top, 1.01 * height);
  const std::size_t alone = add_flat(shape, 2, 4, 7, of_top);
  CHECK(with_flat_triangles_at_their_edges(shape).triangle_part == shape.triangle_part);
  // A little lower, the first one is flat.
  shape.vertices(shape.triangles(static_cast<Eigen::Index>(high), 1), 1) = 0.99 * height;
  CHECK(with_flat_triangles_at_their_edges(shape).triangle_part[high] == of_leg);
  CHECK(with_flat_triangles_at_their_edges(shape).triangle_part[alone] == of_top);

  // The edge from (0, 0, 10) to (0, 0, 11) is one of the top.
  Shape beside = top_on_leg();
  const std::size_t own = add_flat(beside, 10, 10.5, 11, of_top),
                    other = add_flat(beside, 10, 10.5, 11, of_leg);
  CHECK(with_flat_triangles_at_their_edges(beside).triangle_part[own] == of_top);
  CHECK(with_flat_triangles_at_their_edges(beside).triangle_part[other] == of_top);
}

TEST_CASE("a flat triangle on an edge of several parts keeps its label if it is one of theirs") {
  Shape shape = concatenate(top_on_leg(), solids::box({-1, -1, 0}, {0, 0, 10}));
  shape.part_names = {"top", "leg", "post"};
  const std::size_t post = add_flat(shape, 0, 9, 10, 2), leg = add_flat(shape, 0, 9, 10, of_leg),
                    top = add_flat(shape, 0, 9, 10, of_top);
  const Shape placed = with_flat_triangles_at_their_edges(shape);
  CHECK(placed.triangle_part[post] == 2);
  CHECK(placed.triangle_part[leg] == of_leg);
  CHECK(placed.triangle_part[top] != of_top);
}

TEST_CASE("a part of flat triangles only keeps them") {
  Shape shape = top_on_leg();
  shape.part_names.emplace_back("line");
  add_flat(shape, 0, 5, 10, 2);
  add_flat(shape, 0, 2, 5, 2);
  CHECK(with_flat_triangles_at_their_edges(shape).triangle_part == shape.triangle_part);
}
