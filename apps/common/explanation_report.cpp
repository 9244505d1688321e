#include "apps/common/explanation_report.h"

namespace stackabilization::apps {

namespace {

Json names_json(const std::vector<int>& parts, const std::vector<std::string>& part_names) {
  Json list = Json::array();
  for (const int part : parts) list.push_back(part_names.at(static_cast<std::size_t>(part)));
  return list;
}

Json group_json(const GroupChange& group, const Explanation& explanation,
                const std::vector<std::string>& part_names) {
  Json changes = Json::array();
  for (const FormChange& change : group.changes)
    changes.push_back(
        {{"kind", name_of(change.kind)},
         {"amount", change.amount},
         {"unit", unit_of(change.kind)},
         {"heading", change.heading == Heading::none ? Json(nullptr) : Json(name_of(change.heading))}});
  return {{"words", describe(group, explanation)},
          {"parts", names_json(group.parts, part_names)},
          {"changes", changes},
          {"displacement", group.displacement},
          {"edited", group.edited},
          {"clears", group.cleared},
          {"followers", names_json(group.followers, part_names)}};
}

}  // namespace

Json explanation_json(const Explanation& explanation, const std::vector<std::string>& part_names) {
  Json groups = Json::array();
  for (const GroupChange& group : explanation.groups)
    groups.push_back(group_json(group, explanation, part_names));
  return {{"lines", lines(explanation)}, {"groups", groups}};
}

std::vector<std::string> explanation_lines(const Explanation& explanation, std::size_t max_lines) {
  std::vector<std::string> result = lines(explanation, max_lines);
  if (result.empty()) result.emplace_back("nothing that is seen");
  return result;
}

}  // namespace stackabilization::apps
