#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// An orbit: parts that symmetry relations map onto each other, with the maps from the first part.
struct Orbit {
  std::vector<int> parts;  ///< rows of Structure::parts in breadth-first order, the lowest row first
  /// Per entry of `parts`, the map from the first part to it.
  std::vector<Eigen::Isometry3d> from_first;
  /// Group of the isometries that must map the first part onto itself, the identity first.
  std::vector<Eigen::Isometry3d>
      group;  ///< what must take the first part onto itself; the identity comes first
};

/// Relations that cannot hold together.
struct Contradiction {
  std::vector<int> relations;  ///< rows of Structure::relations
  std::string reason;          ///< one sentence
  /// Rows of the relations to remove: the last relation of each contradictory orbit, starting with the orbit
  /// of `relations`.
  std::vector<int> dispensable = {};
};

/// Result of `find_orbits`.
struct OrbitsOrContradiction {
  std::vector<Orbit> orbits;  ///< orbits of the parts with a symmetry relation
  std::optional<Contradiction> contradiction;
};

/// Computes the orbits by a breadth-first walk along the symmetry relations. Every loop of relations and
/// every self-symmetry maps the first part to itself. These maps generate a group, which must be finite. Two
/// parallel mirror planes at a small distance, for example, generate translations, and no part is invariant
/// under a translation.
OrbitsOrContradiction find_orbits(const Structure& structure);

/// Returns a description such as "relation 3 (symmetry of 'leg_1' and 'leg_2')".
std::string describe(const Structure& structure, int relation);

}  // namespace stackabilization::detail
