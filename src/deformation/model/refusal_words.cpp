#include "deformation/model/refusal_words.h"

#include "stackabilization/core/number_text.h"

namespace stackabilization::detail {

std::string fraction(double value) {
  return significant_text(value, 3);
}

std::string name_of(const Relation& relation, const Structure& structure) {
  const auto part = [&](int row) -> const Part& { return structure.parts[static_cast<std::size_t>(row)]; };
  std::string name = "the " + name_of(relation.type) + " of '" + part(relation.parts.front()).name + "'";
  if (relation.parts.size() > 1) name += " and '" + part(relation.parts.back()).name + "'";
  return name;
}

}  // namespace stackabilization::detail
