#include "common/statistics.h"

#include <algorithm>
#include <cmath>

namespace stackabilization::experiments {

double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

double quantile(std::vector<double> values, double fraction) {
  const auto count = static_cast<double>(values.size());
  const double rank = std::clamp(std::ceil(fraction * count), 1.0, count);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::optional<PowerLaw> power_law(const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector2d> logarithms;
  for (const Eigen::Vector2d& point : points)
    if (point.minCoeff() > 0 && point.allFinite()) logarithms.emplace_back(point.array().log());
  const auto by_x = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() < b.x(); };
  const auto [least, most] = std::minmax_element(logarithms.begin(), logarithms.end(), by_x);
  if (logarithms.empty() || least->x() == most->x()) return std::nullopt;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : logarithms) mean += p / static_cast<double>(logarithms.size());
  double xy = 0, xx = 0;
  for (const Eigen::Vector2d& p : logarithms) {
    xy += (p.x() - mean.x()) * (p.y() - mean.y());
    xx += (p.x() - mean.x()) * (p.x() - mean.x());
  }
  return PowerLaw{xy / xx, std::exp(mean.y() - xy / xx * mean.x())};
}

std::optional<double> order_of_convergence(const std::vector<Eigen::Vector2d>& points, double floor) {
  std::vector<Eigen::Vector2d> counted;
  for (const Eigen::Vector2d& point : points)
    if (point.y() > floor) counted.push_back(point);
  const auto law = power_law(counted);
  return law ? std::optional<double>(-law->exponent) : std::nullopt;
}

}  // namespace stackabilization::experiments
