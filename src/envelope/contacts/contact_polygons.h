#pragma once

#include <cstdint>
#include <vector>

#include "envelope/separation/separation_tree.h"
#include "stackabilization/envelope/contacts.h"

namespace stackabilization::detail {

/// What counts as contact, and how much of it is listed.
struct ContactBand {
  ContactSemantics semantics = ContactSemantics::solid;
  double floor = 0;            ///< contact is where f >= floor; units of r
  std::int64_t max_pairs = 0;  ///< pairs of triangles that may be listed one by one
  double resolution = 0;       ///< depths that differ by less are equal; units of r
};

/// Polygons over which f >= floor, in the order of the pairs of triangles (upper, lower).
struct ContactPolygons {
  std::vector<ContactPolygon> polygons;
  bool complete = true;  ///< one per pair; else each triangle has its deepest partner alone, as contact_pairs
};

/// In solid semantics, pairs whose projections only touch have no polygon.
ContactPolygons contact_polygons(const SeparationTree::Data& tree, const Direction& direction,
                                 const ContactBand& band);

}  // namespace stackabilization::detail
