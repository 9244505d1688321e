#include "support/voxels.h"

#include <map>

namespace stackabilization::solids {

namespace {

using Cell = std::array<int, 3>;

int box_at(const std::vector<GridBox>& boxes, const Cell& cell) {
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k)
      inside = inside && cell[k] >= boxes[b].low[k] && cell[k] < boxes[b].high[k];
    if (inside) return static_cast<int>(b);
  }
  return -1;
}

}  // namespace

Shape grid_union(const std::vector<GridBox>& boxes) {
  Cell low = boxes.front().low, high = boxes.front().high;
  for (const GridBox& box : boxes)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], box.low[k]);
      high[k] = std::max(high[k], box.high[k]);
    }
  std::map<Cell, int> rows;
  std::vector<Cell> corners;
  const auto row = [&](const Cell& place) {
    const auto [known, fresh] = rows.try_emplace(place, static_cast<int>(corners.size()));
    if (fresh) corners.push_back(place);
    return known->second;
  };
  std::vector<std::array<int, 3>> triangles;
  Shape shape;
  for (int x = low[0]; x < high[0]; ++x)
    for (int y = low[1]; y < high[1]; ++y)
      for (int z = low[2]; z < high[2]; ++z) {
        const Cell cell{x, y, z};
        const int box = box_at(boxes, cell);
        if (box < 0) continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (int side = 0; side < 2; ++side) {
            Cell beside = cell;
            beside[axis] += side ? 1 : -1;
            if (box_at(boxes, beside) >= 0) continue;
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            std::array<Cell, 4> square;
            for (std::size_t k = 0; k < 4; ++k) {
              square[k] = cell;
              square[k][axis] += side;
              square[k][u] += k == 1 || k == 2;
              square[k][v] += k >= 2;
            }
            if (!side) std::swap(square[1], square[3]);
            for (std::size_t k = 1; k < 3; ++k) {
              triangles.push_back({row(square[0]), row(square[k]), row(square[k + 1])});
              shape.triangle_part.push_back(box);
            }
          }
      }
  shape.vertices.resize(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t c = 0; c < corners.size(); ++c)
    for (int k = 0; k < 3; ++k)
      shape.vertices(static_cast<Eigen::Index>(c), k) = corners[c][static_cast<std::size_t>(k)];
  shape.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      shape.triangles(static_cast<Eigen::Index>(t), k) = triangles[t][static_cast<std::size_t>(k)];
  for (std::size_t b = 0; b < boxes.size(); ++b) shape.part_names.push_back("box_" + std::to_string(b));
  validate(shape);
  return shape;
}

}  // namespace stackabilization::solids
