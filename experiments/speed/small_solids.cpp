#include "speed/small_solids.h"

#include <array>
#include <cmath>
#include <numbers>

namespace stackabilization::experiments {
namespace {

struct Box {
  Eigen::Vector3d low, high;
};

/// Boxes side by side: closed surfaces that may overlap.
Shape of_boxes(const std::vector<Box>& boxes) {
  constexpr std::array<std::array<int, 3>, 12> faces{{{0, 2, 3},
                                                      {0, 3, 1},
                                                      {4, 5, 7},
                                                      {4, 7, 6},
                                                      {0, 1, 5},
                                                      {0, 5, 4},
                                                      {2, 6, 7},
                                                      {2, 7, 3},
                                                      {0, 4, 6},
                                                      {0, 6, 2},
                                                      {1, 3, 7},
                                                      {1, 7, 5}}};
  const auto count = static_cast<Eigen::Index>(boxes.size());
  Points vertices(8 * count, 3);
  Triangles triangles(12 * count, 3);
  for (Eigen::Index b = 0; b < count; ++b) {
    const Box& box = boxes[static_cast<std::size_t>(b)];
    for (int v = 0; v < 8; ++v)
      for (int axis = 0; axis < 3; ++axis)
        vertices(8 * b + v, axis) = (v >> axis & 1) != 0 ? box.high[axis] : box.low[axis];
    for (int f = 0; f < 12; ++f)
      for (int k = 0; k < 3; ++k)
        triangles(12 * b + f, k) = static_cast<std::int32_t>(8 * b) +
                                   faces[static_cast<std::size_t>(f)][static_cast<std::size_t>(k)];
  }
  return make_shape(vertices, triangles);
}

/// A cup with flat sides: a closed profile of four rings - foot, rim, inner rim, inner floor - with both
/// floors as fans.
Shape cup(int sides) {
  const std::array<Eigen::Vector2d, 4> profile{{{30, 0}, {40, 90}, {37, 90}, {27, 4}}};
  const auto ring = [&](int i, int k) { return i * sides + k % sides; };
  Points vertices(4 * sides + 2, 3);
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      const Eigen::Vector2d& at = profile[static_cast<std::size_t>(i)];
      vertices.row(ring(i, k)) << at.x() * std::cos(angle), at.x() * std::sin(angle), at.y();
    }
  const int under = 4 * sides, floor = under + 1;
  vertices.row(under) << 0, 0, 0;
  vertices.row(floor) << 0, 0, 4;
  Triangles triangles(8 * sides, 3);
  Eigen::Index t = 0;
  for (int k = 0; k < sides; ++k) {
    triangles.row(t++) << under, ring(0, k + 1), ring(0, k);
    triangles.row(t++) << floor, ring(3, k), ring(3, k + 1);
    for (int i = 0; i < 3; ++i) {
      triangles.row(t++) << ring(i, k), ring(i, k + 1), ring(i + 1, k + 1);
      triangles.row(t++) << ring(i, k), ring(i + 1, k + 1), ring(i + 1, k);
    }
  }
  return make_shape(vertices, triangles);
}

}  // namespace

std::vector<std::pair<std::string, Shape>> small_solids() {
  const Box top{{0, 0, 70}, {120, 80, 74}};
  const auto leg = [](double x, double y) { return Box{{x, y, 0}, {x + 5, y + 5, 70.5}}; };
  return {
      {"small brick", of_boxes({{{0, 0, 0}, {3, 2, 1}}})},
      {"small table", of_boxes({top, leg(2, 2), leg(113, 2), leg(2, 73), leg(113, 73)})},
      {"small corner", of_boxes({{{0, 0, 0}, {4, 1, 1}}, {{0, 0, 0}, {1, 4, 1}}, {{0, 0, 0}, {1, 1, 4}}})},
      {"small cup", cup(6)}};
}

}  // namespace stackabilization::experiments
