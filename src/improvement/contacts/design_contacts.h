#pragma once

#include <vector>

#include "stackabilization/envelope/contacts.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// Returns the contact regions of a shape stacked on itself along `direction`, in the semantics in which the
/// requirements measure S. None where the copies pass each other. Throws as contact_regions.
std::vector<ContactRegion> contacts_of(const RequirementChecker& checker, const Shape& shape,
                                       const Direction& direction, ContactOptions options);

}  // namespace stackabilization::detail
