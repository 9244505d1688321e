#include <algorithm>
#include <functional>

#include "apps/common/design_json.h"
#include "apps/common/edit_grammar.h"
#include "apps/common/measurement.h"
#include "apps/common/text.h"
#include "apps/suggest/suggest_run.h"
#include "stackabilization/core/direction_text.h"

namespace stackabilization::apps {

namespace {

/// How many of the suggestions are shown.
std::size_t shown(const SuggestRun& run, const SuggestCommandOptions& options) {
  return options.all ? run.suggestions.size()
                     : std::min(run.possible(), static_cast<std::size_t>(options.top));
}

/// Where a design stands.
Json standing_json(const Stackability& measured, const Json& energy) {
  return {{"direction", to_json(measured.direction)},
          {"stackability", measured.value},
          {"f_max", measured.f_max},
          {"height", measured.extent},
          {"energy", energy}};
}

Json suggestion_json(const Suggestion& suggestion, const SuggestRun& run) {
  const std::vector<std::string>& part_names = run.project.rest.shape.part_names;
  const ContactEdit& edit = suggestion.edit;
  Json json = {
      {"edit", edit_text(edit.edit, part_names)},
      {"words", describe(edit.edit, part_names)},
      {"why", describe(edit.reason, part_names)},
      {"contact",
       {{"region", edit.region},
        {"type", name_of(edit.type)},
        {"copy", edit.of_lower_copy ? "below" : "above"}}},
      {"refusal",
       suggestion.refusal ? Json(describe(*suggestion.refusal, run.project.rest.structure)) : Json(nullptr)}};
  if (suggestion.refusal) return json;
  json.update(standing_json(suggestion.measured, to_json(suggestion.energy, run.alpha)));
  return json;
}

Json history_json(const Project& project) {
  Json nodes = Json::array();
  for (const HistoryNode& node : project.history.nodes)
    nodes.push_back({{"parent", node.parent},
                     {"name", node.name},
                     {"edits", edit_texts(node.edits, project.rest.shape.part_names)},
                     {"direction", to_json(node.direction)},
                     {"stackability", node.stackability},
                     {"energy", node.energy}});
  return {{"current", project.history.current}, {"nodes", std::move(nodes)}};
}

std::string contacts_text(const std::vector<ContactRegion>& regions) {
  std::string text;
  for (const ContactType type : {ContactType::dot, ContactType::line, ContactType::ring}) {
    const auto count = std::count_if(regions.begin(), regions.end(),
                                     [&](const ContactRegion& region) { return region.type == type; });
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, name_of(type));
  }
  return text;
}

std::string suggestion_table(const SuggestRun& run, const SuggestCommandOptions& options) {
  const std::vector<std::string>& names = run.project.rest.shape.part_names;
  std::vector<std::string> headings = {"no.", "S", "E", "D", "edit", "why"};
  ColumnTable table(headings);
  for (std::size_t k = 0; k < shown(run, options); ++k) {
    const Suggestion& one = run.suggestions[k];
    const std::string edit = describe(one.edit.edit, names);
    if (one.refusal)
      table.add({"-", "-", "-", "-", edit, "refused: " + describe(*one.refusal, run.project.rest.structure)});
    else
      table.add({std::to_string(k + 1), stackability_text(one.measured.value),
                 stackability_text(one.energy.value), stackability_text(one.energy.distortion.total()), edit,
                 describe(one.edit.reason, names) +
                     (options.target && one.reaches_target ? " (reaches the target)" : "")});
  }
  return table.empty() ? "" : "\nS " + direction_text(run.direction.vector()) + ":\n" + table.text();
}

}  // namespace

void add_suggestions(Json& document, const SuggestRun& run, const SuggestCommandOptions& options) {
  const std::vector<std::string>& names = run.project.rest.shape.part_names;
  document["deformation"] = name_of(run.project.space.kind);
  document["direction"] = to_json(run.direction.vector());
  document["boxes"] = name_of(options.measure.boxes);
  document["semantics"] = name_of(options.measure.semantics);
  document["node"] = run.node;
  document["now"] = standing_json(run.now.measured, to_json(run.now.energy, run.alpha));
  document["contacts"] = to_json(run.now.contacts, names);
  Json list = Json::array();
  for (std::size_t k = 0; k < shown(run, options); ++k) {
    Json one = {{"number", run.suggestions[k].refusal ? Json(nullptr) : Json(k + 1)}};
    one.update(suggestion_json(run.suggestions[k], run));
    if (options.target) one["reaches_target"] = run.suggestions[k].reaches_target;
    list.push_back(std::move(one));
  }
  document["possible"] = run.possible();
  document["refused"] = run.suggestions.size() - run.possible();
  document["suggestions"] = std::move(list);
  document["applied"] = run.applied ? Json(*run.applied + 1) : Json(nullptr);
  document["history"] = history_json(run.project);
}

std::string suggestions_text(const SuggestRun& run, const SuggestCommandOptions& options,
                             const Model& model) {
  TextTable table;
  add_model_line(table, model);
  table.add(
      "Node", std::to_string(run.node),
      "of " + counted(static_cast<long long>(run.project.history.nodes.size()), "node") + " in the history");
  table.add("Direction", vector_text(run.direction.vector()));
  table.add("S", stackability_text(run.now.measured.value) + " " + direction_text(run.direction.vector()),
            "f_max " + quantity(run.now.measured.f_max, model.shape.unit) + ", h " +
                quantity(run.now.measured.extent, model.shape.unit));
  table.add("E", stackability_text(run.now.energy.value),
            "distortion " + stackability_text(run.now.energy.distortion.total()));
  table.add("Contacts", std::to_string(run.now.contacts.size()), contacts_text(run.now.contacts));
  const std::size_t refused = run.suggestions.size() - run.possible();
  table.add("Suggestions", std::to_string(run.possible()),
            std::to_string(refused) + (refused == 1 ? " more is refused" : " more are refused") +
                (refused > 0 && !options.all ? ": see --all" : ""));
  std::string text = table.text() + suggestion_table(run, options);
  if (run.applied)
    text += "\nApplied number " + std::to_string(*run.applied + 1) + " as node " +
            std::to_string(run.project.history.current) + ".\n";
  return text;
}

std::string history_text(const Project& project) {
  const History& history = project.history;
  ColumnTable table({"node", "S", "direction", "E", "edits"});
  const std::function<void(int, const std::string&)> add = [&](int row, const std::string& indent) {
    const HistoryNode& node = history.nodes[static_cast<std::size_t>(row)];
    std::string edits;
    for (const Edit& edit : node.edits)
      edits += (edits.empty() ? "" : "; ") + describe(edit, project.rest.shape.part_names);
    if (!node.name.empty()) edits += edits.empty() ? node.name : " (" + node.name + ")";
    table.add({std::to_string(row) + (row == history.current ? " *" : ""),
               stackability_text(node.stackability), direction_text(node.direction),
               stackability_text(node.energy), indent + edits});
    for (std::size_t child = 0; child < history.nodes.size(); ++child)
      if (history.nodes[child].parent == row) add(static_cast<int>(child), indent + "  ");
  };
  add(0, "");
  return table.text() + "\n* is the current node.\n";
}

std::string essential_suggestions(const SuggestRun& run, const SuggestCommandOptions& options) {
  std::string text;
  for (std::size_t k = 0; k < std::min(shown(run, options), run.possible()); ++k)
    text += std::to_string(k + 1) + " " + exact_digits(run.suggestions[k].measured.value) + " " +
            exact_digits(run.suggestions[k].energy.value) + "\n";
  return text;
}

}  // namespace stackabilization::apps
