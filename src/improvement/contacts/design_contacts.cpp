#include "improvement/contacts/design_contacts.h"

namespace stackabilization::detail {

MeasuredContacts measured_contacts(const RequirementChecker& checker, const Shape& shape,
                                   const Direction& direction, ContactOptions options) {
  options.semantics = checker.requirements().measure.semantics;
  const SeparationTree tree(shape);
  const ExactStackability exact = measure_exact(shape, tree, direction, checker.requirements().measure);
  return {exact.stackability, contact_regions({shape, tree, direction, exact.separation}, options).regions};
}

std::vector<ContactRegion> contacts_of(const RequirementChecker& checker, const Shape& shape,
                                       const Direction& direction, ContactOptions options) {
  options.semantics = checker.requirements().measure.semantics;
  return contact_regions(shape, direction, options).regions;
}

}  // namespace stackabilization::detail
