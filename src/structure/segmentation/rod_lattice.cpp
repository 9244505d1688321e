#include "structure/segmentation/rod_lattice.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "mesh/surface_moments.h"
#include "structure/model/part_surface.h"

namespace stackabilization::detail {

namespace {

/// Largest number of samples along an edge: rods of few long triangles need no more.
constexpr int max_steps = 64;

using Cell = std::array<std::int64_t, 3>;

struct Sample {
  Cell cell;
  std::int32_t component;
  Eigen::Vector3d point;
};

/// Corners of the triangles of every component, and its area.
struct WirePieces {
  std::vector<std::vector<Eigen::Vector3d>> corners;
  std::vector<double> areas;
};

WirePieces pieces_of(const Shape& shape, const std::vector<std::int32_t>& component) {
  const auto count = static_cast<std::size_t>(*std::max_element(component.begin(), component.end())) + 1;
  WirePieces pieces{std::vector<std::vector<Eigen::Vector3d>>(count), std::vector<double>(count, 0)};
  for (std::size_t t = 0; t < component.size(); ++t) {
    const auto c = static_cast<std::size_t>(component[t]);
    const auto row = static_cast<Eigen::Index>(t);
    for (int k = 0; k < 3; ++k) pieces.corners[c].emplace_back(shape.corner(row, k));
    pieces.areas[c] += area_vector(shape, row).stableNorm();
  }
  return pieces;
}

/// Points of a triangle, at most `spacing` apart along its edges.
void sample(const Eigen::Vector3d* corners, double spacing, std::vector<Eigen::Vector3d>& points) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, (corners[(k + 1) % 3] - corners[k]).norm());
  const int steps = static_cast<int>(std::clamp(std::ceil(longest / spacing), 1.0, 1.0 * max_steps));
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j)
      points.emplace_back(corners[0] + (corners[1] - corners[0]) * i / steps +
                          (corners[2] - corners[0]) * j / steps);
}

Cell cell_of(const Eigen::Vector3d& point, double width) {
  Cell cell;
  for (int k = 0; k < 3; ++k) cell[static_cast<std::size_t>(k)] = std::llround(point(k) / width);
  return cell;
}

/// Samples of the wires in a grid of cells of width `reach`. One sample of a wire per eighth of a cell
/// suffices.
std::vector<Sample> samples_of(const WirePieces& pieces, const std::vector<std::int32_t>& wires,
                               double reach) {
  std::vector<Sample> samples;
  for (const std::int32_t wire : wires) {
    const std::vector<Eigen::Vector3d>& corners = pieces.corners[static_cast<std::size_t>(wire)];
    std::vector<Eigen::Vector3d> points;
    for (std::size_t t = 0; t < corners.size(); t += 3) sample(&corners[t], reach / 2, points);
    std::set<Cell> taken;
    for (const Eigen::Vector3d& point : points)
      if (taken.insert(cell_of(point, reach / 2)).second)
        samples.push_back({cell_of(point, reach), wire, point});
  }
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return std::pair(a.cell, a.component) < std::pair(b.cell, b.component);
  });
  return samples;
}

/// Pairs of wires that have samples within `reach` of each other.
std::set<std::pair<std::int32_t, std::int32_t>> meetings(const std::vector<Sample>& samples, double reach) {
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  const auto before = [](const Sample& a, const Cell& cell) { return a.cell < cell; };
  for (const Sample& a : samples)
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y) {
        Cell cell = {a.cell[0] + x, a.cell[1] + y, a.cell[2] - 1};
        const Cell last = {cell[0], cell[1], cell[2] + 2};
        auto b = std::lower_bound(samples.begin(), samples.end(), cell, before);
        for (; b != samples.end() && b->cell <= last; ++b)
          if (a.component < b->component && (a.point - b->point).norm() <= reach)
            pairs.emplace(a.component, b->component);
      }
  return pairs;
}

}  // namespace

bool is_rod_lattice(const Shape& shape, const std::vector<std::int32_t>& component,
                    const RodLatticeRule& rule) {
  const WirePieces pieces = pieces_of(shape, component);
  const std::size_t count = pieces.areas.size();
  if (count < static_cast<std::size_t>(rule.min_wires)) return false;
  std::vector<std::int32_t> wires;
  std::vector<Eigen::Vector3d> all;
  for (std::size_t c = 0; c < count; ++c) {
    const double diameter = enclosing_diameter(pieces.corners[c]);
    if (pieces.areas[c] <= rule.max_surface * diameter * diameter)
      wires.push_back(static_cast<std::int32_t>(c));
    all.insert(all.end(), pieces.corners[c].begin(), pieces.corners[c].end());
  }
  if (static_cast<double>(wires.size()) < rule.min_share * static_cast<double>(count)) return false;
  const double reach = rule.reach * enclosing_diameter(all);
  if (!(reach > 0)) return false;
  const auto pairs = meetings(samples_of(pieces, wires, reach), reach);
  return 2 * static_cast<double>(pairs.size()) >= rule.min_crossings * static_cast<double>(wires.size());
}

}  // namespace stackabilization::detail
