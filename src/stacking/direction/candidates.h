#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Directions at which S often peaks although samples miss them; unit vectors, one for r and -r, no two
/// closer than tolerance::relative, the most natural first.
struct CandidateDirections {
  /// The file's axes, the axes of the minimal box, the principal axes of the surface: normals of likely
  /// symmetry planes.
  std::vector<Eigen::Vector3d> main;
  /// Normals of the largest hull faces and of the directions most of the surface faces, and the directions
  /// along pairs of the most important of these.
  std::vector<Eigen::Vector3d> others;
};

/// Candidates for the shape of `solver`; the same bits for the same shape.
CandidateDirections candidate_directions(const StackabilitySolver& solver);

}  // namespace stackabilization
