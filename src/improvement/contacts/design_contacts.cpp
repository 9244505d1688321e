#include "improvement/contacts/design_contacts.h"

namespace stackabilization::detail {

namespace {

std::vector<ContactRegion> regions_at(const Separation& separation, const SeparationTree& tree,
                                      const Shape& shape, const Direction& direction,
                                      const ContactOptions& options) {
  if (!separation.blocked) return {};
  return contact_regions({shape, tree, direction, separation}, options).regions;
}

}  // namespace

MeasuredContacts measured_contacts(const RequirementChecker& checker, const Shape& shape,
                                   const Direction& direction, ContactOptions options) {
  options.semantics = checker.requirements().measure.semantics;
  const SeparationTree tree(shape);
  const ExactStackability exact = measure_exact(shape, tree, direction, checker.requirements().measure);
  return {exact.stackability, regions_at(exact.separation, tree, shape, direction, options)};
}

std::vector<ContactRegion> contacts_of(const RequirementChecker& checker, const Shape& shape,
                                       const Direction& direction, ContactOptions options) {
  options.semantics = checker.requirements().measure.semantics;
  const SeparationTree tree(shape);
  return regions_at(separation(tree, tree, direction, {options.semantics, std::nullopt}), tree, shape,
                    direction, options);
}

}  // namespace stackabilization::detail
