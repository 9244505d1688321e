#include "improvement/contacts/design_contacts.h"

namespace stackabilization::detail {

std::vector<ContactRegion> contacts_of(const RequirementChecker& checker, const Shape& shape,
                                       const Direction& direction, ContactOptions options) {
  options.semantics = checker.requirements().measure.semantics;
  const SeparationTree tree(shape);
  const Separation apart = separation(tree, tree, direction, {options.semantics, std::nullopt});
  if (!apart.blocked) return {};
  return contact_regions({shape, tree, direction, apart}, options).regions;
}

}  // namespace stackabilization::detail
