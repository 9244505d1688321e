#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Callbacks of `measure_many`.
struct MeasureManyOptions {
  /// Called from the calling thread with the completed fraction in [0, 1].
  std::function<void(double)> progress = {};
  /// Asked from the calling thread, about once per 512 directions; true ends the measurement early.
  std::function<bool()> cancelled = {};
};

/// Measures S along every row of `directions` (k x 3, any length but zero), in parallel. Returns k
/// measurements in the order of the rows, each equal to that of `solver.measure`; fewer, the first ones, when
/// `cancelled` ended it. Deterministic for any number of threads. Throws UsageError naming the first row that
/// is no direction, before anything is measured.
std::vector<Stackability> measure_many(const StackabilitySolver& solver,
                                       const Eigen::Ref<const Points>& directions,
                                       const MeasureManyOptions& options = {});

}  // namespace stackabilization
