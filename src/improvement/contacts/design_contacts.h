#pragma once

#include <vector>

#include "stackabilization/envelope/contacts.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// The contact regions of a shape stacked on itself along `direction`, in the semantics that the requirements
/// measure S in; none where copies pass each other. Throws as contact_regions does.
std::vector<ContactRegion> contacts_of(const RequirementChecker& checker, const Shape& shape,
                                       const Direction& direction, ContactOptions options);

}  // namespace stackabilization::detail
