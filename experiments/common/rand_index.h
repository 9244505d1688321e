#pragma once

#include <cstdint>
#include <vector>

namespace stackabilization::experiments {

/// Share of the pairs of faces on which two segmentations disagree, together in one and apart in the other,
/// in [0, 1]: one minus the index of Rand (1971), which is what Chen, Golovinskiy and Funkhouser (2009) plot
/// as their "Rand Index". 0 means equal up to names. Precondition: one label per face in both, two faces at
/// least.
double rand_error(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b);

}  // namespace stackabilization::experiments
