#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Directions at which S often has peaks that even samples miss. Unit vectors, one for r and -r, no two
/// closer than tolerance::relative, most probable first.
struct CandidateDirections {
  /// The axes of the file, the axes of the minimal box and the principal axes of the surface: probable
  /// normals of symmetry planes.
  std::vector<Eigen::Vector3d> main;
  /// Normals of the largest hull faces, the dominant normals of the surface, and the directions along pairs
  /// of the most important of these faces.
  std::vector<Eigen::Vector3d> others;
};

/// Computes the candidates for the shape of `solver`. The same shape gives the same bits.
CandidateDirections candidate_directions(const StackabilitySolver& solver);

}  // namespace stackabilization
