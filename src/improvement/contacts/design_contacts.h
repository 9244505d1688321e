#pragma once

#include <vector>

#include "stackabilization/envelope/contacts.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// The exact measures of a shape stacked on itself, and its contact regions.
struct MeasuredContacts {
  Stackability measured;               ///< from the exact separation, with clearance and play
  std::vector<ContactRegion> regions;  ///< without clearance and play; none where the copies pass each other
};

/// Measures a shape exactly along `direction`, as the requirements measure S, and finds its contact regions.
/// Both come from one separation. Throws as measure_exact and contact_regions.
MeasuredContacts measured_contacts(const RequirementChecker& checker, const Shape& shape,
                                   const Direction& direction, ContactOptions options);

/// Returns the contact regions of a shape stacked on itself along `direction`, in the semantics in which the
/// requirements measure S. None where the copies pass each other. Throws as contact_regions.
std::vector<ContactRegion> contacts_of(const RequirementChecker& checker, const Shape& shape,
                                       const Direction& direction, ContactOptions options);

}  // namespace stackabilization::detail
