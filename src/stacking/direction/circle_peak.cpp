#include "stacking/direction/circle_peak.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace stackabilization::detail {

namespace {

constexpr int circle_samples = 24;
constexpr int circle_halvings = 10;
static_assert(circle_samples + 4 * circle_halvings == max_circle_directions);  // two peaks, two sides

/// Returns the two largest local maxima of the values on a circle.
std::vector<int> circle_peaks(const std::vector<double>& values) {
  const auto count = static_cast<int>(values.size());
  const auto at = [&](int i) { return values[static_cast<std::size_t>((i + count) % count)]; };
  std::vector<int> peaks;
  for (int i = 0; i < count; ++i)
    if (at(i) > at(i - 1) && at(i) >= at(i + 1)) peaks.push_back(i);
  std::stable_sort(peaks.begin(), peaks.end(), [&](int a, int b) { return at(a) > at(b); });
  if (peaks.size() > 2) peaks.erase(peaks.begin() + 2, peaks.end());
  return peaks;
}

}  // namespace

CirclePeak circle_peak(const StackabilitySolver& solver, const DirectionRegion& region,
                       const Eigen::Vector3d& centre, double radius) {
  const Frame frame = frame_of(Direction(centre));
  CirclePeak result;
  result.best.value = -std::numeric_limits<double>::infinity();
  // Values below `least` stay -infinity.
  const auto measure_at = [&](const std::vector<double>& angles, double least) {
    std::vector<double> values(angles.size(), -std::numeric_limits<double>::infinity());
    std::vector<std::optional<Stackability>> measured(angles.size());
    tbb::parallel_for(std::size_t{0}, angles.size(), [&](std::size_t i) {
      const Eigen::Vector3d local(radius * std::cos(angles[i]), radius * std::sin(angles[i]), 1);
      const auto direction = region.nearest(frame.to_world(local));
      if (!direction) return;
      measured[i] = solver.measure_if_above(Direction(*direction), least);
      if (measured[i]) values[i] = measured[i]->value;
    });
    result.evaluated += static_cast<std::int64_t>(angles.size());
    for (std::size_t i = 0; i < angles.size(); ++i)
      if (values[i] > result.best.value) result.best = *measured[i];
    return values;
  };
  const double even_step = 2 * std::numbers::pi / circle_samples;
  std::vector<double> angles;
  for (int i = 0; i < circle_samples; ++i) angles.push_back(i * even_step);
  const std::vector<double> values = measure_at(angles, result.best.value);
  for (const int peak : circle_peaks(values)) {
    double middle = angles[static_cast<std::size_t>(peak)], value = values[static_cast<std::size_t>(peak)],
           step = even_step;
    for (int halving = 0; halving < circle_halvings; ++halving) {
      step /= 2;
      const std::vector<double> sides = measure_at({middle - step, middle + step}, value);
      const int better = sides[0] >= sides[1] ? 0 : 1;
      if (sides[static_cast<std::size_t>(better)] <= value) continue;
      value = sides[static_cast<std::size_t>(better)];
      middle += better == 0 ? -step : step;
    }
  }
  return result;
}

}  // namespace stackabilization::detail
