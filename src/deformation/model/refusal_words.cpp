#include "deformation/model/refusal_words.h"

#include <charconv>

namespace stackabilization::detail {

std::string fraction(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 3).ptr;
  return {buffer, end};
}

std::string name_of(const Relation& relation, const Structure& structure) {
  const auto part = [&](int row) -> const Part& { return structure.parts[static_cast<std::size_t>(row)]; };
  std::string name = "the " + name_of(relation.type) + " of '" + part(relation.parts.front()).name + "'";
  if (relation.parts.size() > 1) name += " and '" + part(relation.parts.back()).name + "'";
  return name;
}

}  // namespace stackabilization::detail
