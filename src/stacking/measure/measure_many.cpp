#include "stackabilization/stacking/measure_many.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

constexpr std::size_t directions_per_report = 512;  ///< directions between two reports of progress

std::vector<Direction> checked(const Eigen::Ref<const Points>& rows) {
  std::vector<Direction> directions;
  directions.reserve(static_cast<std::size_t>(rows.rows()));
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    try {
      directions.emplace_back(Eigen::Vector3d(rows.row(row).transpose()));
    } catch (const UsageError& error) {
      throw UsageError("row " + std::to_string(row) + " of the directions: " + error.what());
    }
  }
  return directions;
}

}  // namespace

std::vector<Stackability> measure_many(const StackabilitySolver& solver,
                                       const Eigen::Ref<const Points>& directions,
                                       const MeasureManyOptions& options) {
  const std::vector<Direction> asked = checked(directions);
  std::vector<Stackability> measured(asked.size());
  for (std::size_t begin = 0; begin < asked.size(); begin += directions_per_report) {
    if (options.cancelled && options.cancelled()) {
      measured.resize(begin);
      return measured;
    }
    if (options.progress) options.progress(static_cast<double>(begin) / static_cast<double>(asked.size()));
    tbb::parallel_for(begin, std::min(begin + directions_per_report, asked.size()),
                      [&](std::size_t i) { measured[i] = solver.measure(asked[i]); });
  }
  if (options.progress) options.progress(1);
  return measured;
}

}  // namespace stackabilization
