#include "common/generated_models.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace stackabilization::experiments {

namespace {

/// Boxes along the axes, each a part of its own.
class Boxes {
 public:
  explicit Boxes(int count) {
    shape_.vertices.resize(8 * count, 3);
    shape_.triangles.resize(12 * count, 3);
  }

  void add(const std::string& name, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    constexpr int faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const auto box = static_cast<int>(shape_.part_names.size());
    for (int v = 0; v < 8; ++v)
      for (int axis = 0; axis < 3; ++axis)
        shape_.vertices(8 * box + v, axis) = (v >> axis & 1 ? high : low)[axis];
    for (int f = 0; f < 12; ++f)
      for (int k = 0; k < 3; ++k) shape_.triangles(12 * box + f, k) = 8 * box + faces[f][k];
    shape_.triangle_part.insert(shape_.triangle_part.end(), 12, box);
    shape_.part_names.push_back(name + "_" + std::to_string(box));
  }

  Shape shape() && {
    validate(shape_);
    return std::move(shape_);
  }

 private:
  Shape shape_;
};

/// The triangles of a grid of points in rows of `columns`, each cell cut in two. `closed`: each row goes on
/// from its last point to its first.
Triangles grid_faces(int rows, int columns, bool closed) {
  const int cells = closed ? columns : columns - 1;
  Triangles faces(2 * (rows - 1) * cells, 3);
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j < cells; ++j) {
      const int a = i * columns + j, b = i * columns + (j + 1) % columns;
      faces.row(2 * (i * cells + j)) << a, b, b + columns;
      faces.row(2 * (i * cells + j) + 1) << a, b + columns, a + columns;
    }
  return faces;
}

}  // namespace

Shape wavy_cup(int triangles) {
  const int rows = static_cast<int>(std::sqrt(triangles / 2.0)), columns = rows;
  Points vertices(rows * columns, 3);
  // The profile runs along a closed curve: up the outer wall, over the rim, down the inner one; a small hole
  // stays at the axis.
  for (int i = 0; i < rows; ++i) {
    const double t = 2.0 * i / rows;
    const bool outside = t < 1;
    const double s = outside ? t : 2 - t;  // 0 at the hole, 1 at the rim
    const double wall = std::clamp((s - 0.25) / 0.75, 0.0, 1.0);
    const double z = (outside ? 0 : 2 * (1 - wall)) + 90 * wall;
    const double mean = (s < 0.25 ? 30 * (s + 0.01) / 0.26 : 30 + 10 * wall) - (outside || s < 0.25 ? 0 : 2);
    for (int j = 0; j < columns; ++j) {
      const double angle = 2 * std::numbers::pi * j / columns;
      const double wave = 1 + 0.02 * wall * std::sin(12 * angle) * std::sin(5 * std::numbers::pi * wall);
      vertices.row(i * columns + j) << mean * wave * std::cos(angle), mean * wave * std::sin(angle), z;
    }
  }
  Triangles faces(2 * rows * columns, 3);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const int next = (i + 1) % rows * columns, right = (j + 1) % columns, row = i * columns;
      faces.row(2 * (row + j)) << row + j, row + right, next + right;
      faces.row(2 * (row + j) + 1) << row + j, next + right, next + j;
    }
  return make_shape(vertices, faces);
}

Shape bumpy_bowl(int triangles) {
  const int cells = static_cast<int>(std::sqrt(triangles / 2.0)), corners = cells + 1;
  Points points(corners * corners, 3);
  for (int i = 0; i < corners; ++i)
    for (int j = 0; j < corners; ++j) {
      const double x = 2.0 * i / cells - 1, y = 2.0 * j / cells - 1;
      points.row(i * corners + j) << x, y, 0.6 * (x * x + y * y) + 0.02 * std::sin(40 * x) * std::cos(37 * y);
    }
  return make_shape(points, grid_faces(corners, corners, false));
}

Shape oval_tube(int triangles) {
  constexpr int rings = 11;
  const int columns = std::max(3, triangles / (2 * (rings - 1)));
  Points points(rings * columns, 3);
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < columns; ++j) {
      const double angle = 2 * std::numbers::pi * j / columns;
      points.row(i * columns + j) << std::cos(angle), 0.7 * std::sin(angle), 0.1 * i;
    }
  return make_shape(points, grid_faces(rings, columns, true));
}

Shape rack(int count) {
  Boxes boxes(count);
  const double height = 10.0 * count;
  boxes.add("post", {0, 0, 0}, {4, 4, height});
  boxes.add("post", {100, 0, 0}, {104, 4, height});
  for (int b = 2; b < count; ++b) boxes.add("bar", {4, 1, 10.0 * b - 8}, {100, 3, 10.0 * b - 5});
  return std::move(boxes).shape();
}

Shape cube_grid(int count) {
  int side = 1;
  while (side * side * side < count) ++side;
  Boxes boxes(count);
  for (int c = 0; c < count; ++c) {
    const Eigen::Vector3d low(c % side, c / side % side, c / (side * side));
    boxes.add("cube", low, low.array() + 1);
  }
  return std::move(boxes).shape();
}

Shape coincident_cubes(int count) {
  Boxes boxes(count);
  for (int c = 0; c < count; ++c) boxes.add("cube", {0, 0, 0}, {1, 1, 1});
  return std::move(boxes).shape();
}

}  // namespace stackabilization::experiments
