#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Parts that symmetry relations tie together, with how each of them is reached from the first.
struct Orbit {
  std::vector<int> parts;                     ///< in the order they are reached, the least first
  std::vector<Eigen::Isometry3d> from_first;  ///< per entry of `parts`: takes the first part there
  std::vector<Eigen::Isometry3d>
      group;  ///< what must take the first part onto itself; the identity comes first
};

/// Relations that cannot hold together.
struct Contradiction {
  std::vector<int> relations;  ///< rows of Structure::relations
  std::string reason;          ///< one sentence
  /// The last relation of each orbit that contradicts itself, those of this one first: what to do without.
  std::vector<int> dispensable = {};
};

struct OrbitsOrContradiction {
  std::vector<Orbit> orbits;  ///< of the parts that have a symmetry relation
  std::optional<Contradiction> contradiction;
};

/// Follows the symmetry relations breadth first. What a loop of relations, or a self-symmetry, does to the
/// first part generates a group, which must be finite: two mirror planes a little apart, say, generate
/// translations, which no part allows.
OrbitsOrContradiction find_orbits(const Structure& structure);

/// "relation 3 (symmetry of 'leg_1' and 'leg_2')".
std::string describe(const Structure& structure, int relation);

}  // namespace stackabilization::detail
