#include "accuracy/shortfall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace stackabilization::experiments {
namespace {

constexpr int around = 4;       ///< pixels a side that are looked at again
constexpr int refinement = 32;  ///< samples per pixel there
constexpr int samples_a_side = around * refinement;
constexpr double steep = 4;  ///< rise over run from which on a side is a wall and no slope
constexpr std::array<std::array<int, 2>, 4> neighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

bool inside(int i, int j) {
  return i >= 0 && j >= 0 && i < samples_a_side && j < samples_a_side;
}

/// Part of the plane about the witness in which the gap exceeds what the sampling saw.
struct Missed {
  int cells = 0;
  int columns = 0, rows = 0;  ///< extent
  int border = 0, steps = 0;  ///< sides of cells on its border, and those at which the gap falls by a step
};

/// The connected set of cells above `seen` that holds `start`; a step is a fall by more than `rise` below it.
Missed missed_part(const Eigen::MatrixXd& gaps, std::array<int, 2> start, double seen, double rise) {
  const auto above = [&](int i, int j) { return inside(i, j) && gaps(i, j) > seen; };
  Eigen::ArrayXXi reached = Eigen::ArrayXXi::Zero(samples_a_side, samples_a_side);
  std::vector<std::array<int, 2>> open{start};
  reached(start[0], start[1]) = 1;
  std::array<int, 2> low = start, high = start;
  Missed part;
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    ++part.cells;
    low = {std::min(low[0], i), std::min(low[1], j)};
    high = {std::max(high[0], i), std::max(high[1], j)};
    for (const auto& [di, dj] : neighbours) {
      const int a = i + di, b = j + dj;
      if (above(a, b)) {
        if (reached(a, b) == 0) open.push_back({a, b});
        reached(a, b) = 1;
      } else if (inside(a, b)) {
        ++part.border;
        part.steps += !(gaps(a, b) > seen - rise);  // not covered counts too
      }
    }
  }
  part.columns = high[0] - low[0] + 1;
  part.rows = high[1] - low[1] + 1;
  return part;
}

/// What lies about the witness and exceeds `seen`; nothing when it is narrower than the fine samples.
std::optional<Missed> look_again(const Shape& shape, const Direction& direction, const Sampling& sampling,
                                 const Separation& solid) {
  const Eigen::Vector3d at = frame_of(direction).to_local(solid.witness.upper_point);
  Window window;
  window.pixel_size = sampling.window.pixel_size / refinement;
  window.columns = window.rows = samples_a_side;
  window.x = at.x() - window.pixel_size * samples_a_side / 2;
  window.y = at.y() - window.pixel_size * samples_a_side / 2;
  const Eigen::MatrixXd gaps = gap(height_field_by_scanline(shape, direction, window));
  std::array<int, 2> nearest{-1, -1};
  double least = samples_a_side;
  for (int j = 0; j < samples_a_side; ++j)
    for (int i = 0; i < samples_a_side; ++i) {
      const double distance = std::hypot(i + 0.5 - samples_a_side / 2.0, j + 0.5 - samples_a_side / 2.0);
      if (gaps(i, j) > sampling.f_max && distance < least) {
        least = distance;
        nearest = {i, j};
      }
    }
  if (nearest[0] < 0) return std::nullopt;
  return missed_part(gaps, nearest, sampling.f_max, solid.length - sampling.f_max);
}

}  // namespace

Shortfall shortfall(const Shape& shape, const Direction& direction, const Sampling& sampling,
                    const Separation& solid, const Separation& closed) {
  constexpr double depth_step = 0x1p-22;  // two steps of a 24-bit depth buffer, both ways
  const double allowed = depth_step * range_along(shape, direction.unit()).length();
  const double error = sampling.f_max - solid.length;
  if (std::abs(error) <= allowed) return {"none", {}};
  if (error > 0) return {sampling.f_max <= closed.length + allowed ? "wall" : "card", {}};
  if (sampling.method == authors_method) {
    const GapMaximum framed = maximum_gap(
        height_field_by_scanline(shape, direction, window_around(shape, direction, sampling.samples)));
    if (solid.length - framed.value < -error / 2) return {"framing", {}};
  }
  const auto missed = look_again(shape, direction, sampling, solid);
  if (!missed) return {"sliver", 0.0};
  const double width =
      static_cast<double>(missed->cells) / std::max(missed->columns, missed->rows) / refinement;
  const double rise = -2 * error / (width * sampling.window.pixel_size);
  const bool thin = 2 * missed->steps > missed->border || rise > steep;
  return {thin ? "thin part" : "slope", width};
}

}  // namespace stackabilization::experiments
