#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Density and callbacks of `stackability_map`.
struct MapOptions {
  /// Angle between rings of latitude and between samples of a ring, degrees, in [0.1, 90].
  double step_degrees = 1;
  /// Called from the calling thread with the completed fraction in [0, 1].
  std::function<void(double)> progress = {};
  /// Asked from the calling thread; true ends the map early.
  std::function<bool()> cancelled = {};
};

/// S in the direction (sin theta cos phi, sin theta sin phi, cos theta).
struct MapSample {
  Eigen::Vector3d direction;     ///< unit
  double theta = 0;              ///< angle from the file's +z, degrees, in [0, 90]
  double phi = 0;                ///< angle from +x towards +y, degrees, in [0, 360)
  double f_max_over_height = 0;  ///< f_max / h(M, r), in [0, 1]
  double stackability = 0;       ///< S(M, r), Eq. 3
};

/// S over the hemisphere z >= 0 of the file's frame. S(-r) = S(r) determines the other hemisphere.
struct StackabilityMap {
  double step_degrees = 0;         ///< step of the options
  std::vector<MapSample> samples;  ///< rings from +z downwards, each ring by increasing phi
  bool cancelled = false;          ///< whether the map ended early with its first samples only
};

/// Measures S on rings of latitude, `step_degrees` apart from the pole to the equator. Samples along a ring
/// are about as far apart; their number is a multiple of four. 1 degree gives 20,969 directions. Directions
/// along the axes are exact. Deterministic for any number of threads. Throws UsageError when the step is out
/// of range or S is undefined.
StackabilityMap stackability_map(const StackabilitySolver& solver, const MapOptions& options = {});

}  // namespace stackabilization
