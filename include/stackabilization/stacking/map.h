#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Density of `stackability_map`, and what watches it.
struct MapOptions {
  double step_degrees = 1;  ///< between rings of latitude and along each ring, in [0.1, 90]
  /// Called with the fraction done, in [0, 1], from the calling thread.
  std::function<void(double)> progress = {};
  std::function<bool()> cancelled = {};  ///< asked from the calling thread; true ends the map early
};

/// S in one direction: (sin theta cos phi, sin theta sin phi, cos theta).
struct MapSample {
  Eigen::Vector3d direction;     ///< unit
  double theta = 0;              ///< angle from the file's +z, degrees, in [0, 90]
  double phi = 0;                ///< angle from +x towards +y, degrees, in [0, 360)
  double f_max_over_height = 0;  ///< f_max / h(M, r), in [0, 1]
  double stackability = 0;       ///< S(M, r), Eq. 3
};

/// S over the hemisphere z >= 0 of the file's frame; S(-r) = S(r) gives the rest.
struct StackabilityMap {
  double step_degrees = 0;         ///< as asked for
  std::vector<MapSample> samples;  ///< ring by ring from +z down, each ring by phi
  bool cancelled = false;          ///< ended early: the first samples only
};

/// S on rings of latitude `step_degrees` apart, from the pole to the equator, with samples about as far apart
/// along each ring, a multiple of four per ring; 1 degree gives 20,969 directions. Directions on the axes are
/// exact. Deterministic for any number of threads. Throws UsageError when the step is out of range
/// or S is undefined.
StackabilityMap stackability_map(const StackabilitySolver& solver, const MapOptions& options = {});

}  // namespace stackabilization
