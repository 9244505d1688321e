#pragma once

#include <cstdint>
#include <vector>

#include "envelope/separation/separation_tree.h"
#include "stackabilization/envelope/contacts.h"

namespace stackabilization::detail {

/// Definition of contact and limits of its output.
struct ContactBand {
  ContactSemantics semantics = ContactSemantics::solid;
  double floor = 0;  ///< contact is where f >= floor; units of r
  /// Limit of the number of pairs of triangles that are listed one by one.
  std::int64_t max_pairs = 0;
  double resolution = 0;  ///< depths that differ by less are equal; units of r
};

/// Polygons with f >= floor, in the order of the pairs of triangles (upper, lower).
struct ContactPolygons {
  std::vector<ContactPolygon> polygons;
  /// Whether there is one polygon per pair. Otherwise each triangle has its deepest partner only, see
  /// contact_pairs.
  bool complete = true;
};

/// Computes the contact polygons. In solid semantics, pairs whose projections only touch have no polygon.
ContactPolygons contact_polygons(const SeparationTree::Data& tree, const Direction& direction,
                                 const ContactBand& band);

}  // namespace stackabilization::detail
