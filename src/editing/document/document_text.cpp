#include <limits>
#include <nlohmann/json.hpp>

#include "io/formats/json_node.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/part_names.h"
#include "stackabilization/editing/document.h"

namespace stackabilization::editing {

namespace {

using Json = nlohmann::ordered_json;
using detail::JsonNode;

constexpr const char* document_format = "stackabilize session";

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < quality_measure_count; ++k)
    names.push_back(name_of(static_cast<QualityMeasure>(k)));
  return names;
}

Json changed_limits(const QualityLimits& limits) {
  const QualityLimits defaults;
  Json json = Json::object();
  for (std::size_t k = 0; k < quality_measure_count; ++k) {
    const auto measure = static_cast<QualityMeasure>(k);
    if (!limits.is_limited(measure))
      json[name_of(measure)] = nullptr;
    else if (limits[measure] != defaults[measure])
      json[name_of(measure)] = limits[measure];
  }
  return json;
}

QualityLimits limits_of(const Json& value, const JsonNode& node) {
  QualityLimits limits;
  for (const auto& [name, limit] : value.items()) {
    const auto measure = quality_measure_of(name);
    if (!measure)
      node.fail("there is no measure '" + name + "'" + detail::nearest_hint(name, measure_names()));
    if (limit.is_null())
      limits.relax(*measure);
    else
      limits[*measure] = node[name].number();
  }
  try {
    validate(limits);
  } catch (const UsageError& error) {
    node.fail(error.what());
  }
  return limits;
}

}  // namespace

std::string document_text(const Document& document) {
  const Requirements& wishes = document.requirements;
  Json kept = Json::array();
  for (const int part : wishes.kept_parts)
    kept.push_back(document.project.rest.shape.part_names.at(static_cast<std::size_t>(part)));
  Json within;
  if (wishes.length_limit)
    within = {{"copies", wishes.length_limit->copies}, {"length", wishes.length_limit->length}};
  const Json head = {
      {"format", document_format},   {"version", 1},
      {"target", wishes.target},     {"keep_height", wishes.keep_height},
      {"kept_parts", kept},          {"limits", changed_limits(wishes.quality.value_or(QualityLimits()))},
      {"visited", document.visited}, {"place", document.place},
      {"source", document.source},   {"within", within}};
  std::string text = head.dump();
  text.pop_back();
  return text + ",\n \"project\": " + project_text(document.project) + "}\n";
}

Document document_of_text(std::string_view text, const std::string& name,
                          const StackabilityOptions& measure) {
  const Json json = detail::parse_json(text, name);
  const JsonNode root(json, name);
  root.expect_keys({"format", "version", "target", "keep_height", "kept_parts", "limits", "visited", "place",
                    "source", "project", "within"},
                   1);
  root["format"].one_of({document_format});
  root["version"].integer(1, 1);
  Document document = document_of(project_with_history(json["project"].dump(), name), measure);
  const auto last_node = static_cast<std::int64_t>(document.project.history.nodes.size()) - 1;
  Requirements& wishes = document.requirements;
  wishes.target = root["target"].number();
  if (root.has("within") && !json["within"].is_null()) {
    const JsonNode within = root["within"];
    within.expect_keys({"copies", "length"});
    wishes.length_limit = {static_cast<int>(within["copies"].integer(2, std::numeric_limits<int>::max())),
                           within["length"].number()};
    if (!(wishes.length_limit->length > 0)) within["length"].fail_expected("a number above 0");
  }
  wishes.keep_height = root["keep_height"].boolean();
  std::vector<std::string> kept;
  for (std::size_t k = 0; k < root["kept_parts"].list_size(); ++k)
    kept.push_back(root["kept_parts"][k].text());
  try {
    wishes.kept_parts = parts_named(document.project.rest.shape, kept);
  } catch (const InputError& error) {
    root["kept_parts"].fail(error.what());
  }
  wishes.quality = limits_of(json["limits"], root["limits"]);
  document.source = root["source"].text();
  document.visited.clear();
  const JsonNode visited = root["visited"];
  for (std::size_t k = 0; k < visited.list_size(); ++k)
    document.visited.push_back(static_cast<int>(visited[k].integer(0, last_node)));
  if (document.visited.empty()) visited.fail_expected("at least one node");
  document.place = static_cast<std::size_t>(
      root["place"].integer(0, static_cast<std::int64_t>(document.visited.size()) - 1));
  if (document.visited[document.place] != document.project.history.current)
    root["place"].fail_expected("the current node of the history");
  try {
    validate(wishes, document.project.rest);
  } catch (const UsageError& error) {
    root["target"].fail(error.what());
  }
  return document;
}

}  // namespace stackabilization::editing
