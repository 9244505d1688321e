#include "apps/editor/page_command.h"

#include <array>
#include <functional>
#include <limits>
#include <map>

#include "apps/common/edit_grammar.h"
#include "stackabilization/core/errors.h"

namespace stackabilization::apps {

namespace {

using editing::AcceptRemedy, editing::ApplySuggestion, editing::Drag, editing::EndDrag, editing::FindDesigns,
    editing::FindRange, editing::KeepParts, editing::Redo, editing::RollBack, editing::SetDirection,
    editing::SetLimit, editing::SetTarget, editing::StopFinding, editing::TakeDesign, editing::Undo;

[[noreturn]] void refuse_entry(const std::string& key, const std::string& what) {
  throw UsageError("'" + key + "' of the command expects " + what);
}

const Json& entry_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end()) throw UsageError(std::string("the command expects '") + key + "'");
  return *found;
}

/// Is it a number counted from 0 that an int holds?
bool is_row(const Json& value) {
  return value.is_number_integer() && value.get<std::int64_t>() >= 0 &&
         value.get<std::int64_t>() <= std::numeric_limits<int>::max();
}

/// A JSON object of a page, with the shape that its commands are about.
class PageCommand {
 public:
  PageCommand(const Json& json, const StructuredShape& rest) : json_(json), rest_(rest) {}

  editing::Command command() const {
    const std::map<std::string, std::function<editing::Command()>> commands = {
        {"apply", [&] { return ApplySuggestion{whole("number")}; }},
        {"drag", [&] { return Drag{edit()}; }},
        {"end-drag", [&] { return EndDrag{truth("keep")}; }},
        {"range", [&] { return FindRange{edit()}; }},
        {"roll-back", [&] { return RollBack{whole("node")}; }},
        {"undo", [] { return Undo{}; }},
        {"redo", [] { return Redo{}; }},
        {"target", [&] { return SetTarget{number(entry("value"))}; }},
        {"within",
         [&] {
           return editing::SetLengthLimit{{whole("copies"), number(entry("length"))}};
         }},
        {"direction", [&] { return SetDirection{direction()}; }},
        {"limit", [&] { return limit(); }},
        {"keep", [&] { return KeepParts{rows("parts")}; }},
        {"find", [&] { return FindDesigns{json_.contains("front") && truth("front")}; }},
        {"stop", [] { return StopFinding{}; }},
        {"take", [&] { return TakeDesign{whole("number")}; }},
        {"segment", [&] { return segment(); }},
        {"kind", [&] { return kind(); }},
        {"remove-relations", [&] { return editing::RemoveRelations{rows("relations")}; }},
        {"remove-parts", [&] { return editing::RemoveParts{rows("parts")}; }},
        {"join", [&] { return editing::Join{two_parts()}; }},
        {"make-symmetric", [&] { return editing::MakeSymmetric{two_parts()}; }},
        {"take-edit",
         [&] {
           return editing::TakeEdit{whole("node"), whole("edit")};
         }},
        {"map", [] { return editing::MapDirections{}; }},
        {"envelopes", [] { return editing::SampleEnvelopes{}; }},
        {"accept-advice",
         [&] {
           return AcceptRemedy{whole("number"), AcceptRemedy::Source::advice};
         }},
        {"accept", [&] {
           return AcceptRemedy{whole("number"), AcceptRemedy::Source::search};
         }}};
    const std::string word = text("do");
    const auto found = commands.find(word);
    if (found == commands.end()) throw UsageError("there is no command '" + word + "'");
    return found->second();
  }

 private:
  const Json& entry(const char* key) const { return entry_of(json_, key); }
  static double number(const Json& value) {
    if (!value.is_number()) throw UsageError("the command expects a number, found " + value.dump());
    return value.get<double>();
  }
  int whole(const char* key) const { return command_number(json_, key); }
  bool truth(const char* key) const {
    if (!entry(key).is_boolean()) refuse_entry(key, "true or false");
    return entry(key).get<bool>();
  }
  std::string text(const char* key) const {
    if (!entry(key).is_string()) refuse_entry(key, "a text");
    return entry(key).get<std::string>();
  }
  Edit edit() const { return parse_edit(text("edit"), rest_.shape.part_names, rest_.structure.diagonal); }
  Eigen::Vector3d direction() const {
    const Json& value = entry("direction");
    if (!value.is_array() || value.size() != 3) refuse_entry("direction", "three numbers");
    return {number(value[0]), number(value[1]), number(value[2])};
  }
  editing::Command limit() const {
    const std::string name = text("measure");
    const auto measure = quality_measure_of(name);
    if (!measure) throw UsageError("there is no measure of quality '" + name + "'");
    const Json& value = entry("value");
    return SetLimit{*measure, value.is_null() ? std::nullopt : std::optional(number(value))};
  }
  static std::vector<std::int32_t> numbers(const Json& value) {
    if (!value.is_array()) throw UsageError("the command expects a list of numbers counted from 0");
    std::vector<std::int32_t> result;
    for (const Json& one : value) {
      if (!is_row(one)) throw UsageError("the command expects numbers counted from 0, found " + one.dump());
      result.push_back(one.get<std::int32_t>());
    }
    return result;
  }
  std::vector<int> rows(const char* key) const { return numbers(entry(key)); }
  std::array<int, 2> two_parts() const {
    const std::vector<int> parts = rows("parts");
    if (parts.size() != 2) refuse_entry("parts", "two parts");
    return {parts[0], parts[1]};
  }
  editing::Command kind() const {
    const std::string name = text("kind");
    if (name != "cuboid" && name != "cylinder") refuse_entry("kind", "cuboid or cylinder");
    return editing::SetKind{whole("part"),
                            name == "cuboid" ? PrimitiveKind::cuboid : PrimitiveKind::cylinder};
  }
  editing::Command segment() const {
    editing::Segment command;
    const Json& strokes = entry("strokes");
    if (!strokes.is_array()) refuse_entry("strokes", "a list");
    for (const Json& stroke : strokes) {
      if (!stroke.is_object() || !stroke.contains("part") || !stroke["part"].is_string() ||
          !stroke.contains("triangles"))
        refuse_entry("strokes", "parts and triangles");
      command.strokes.push_back({stroke["part"].get<std::string>(), numbers(stroke["triangles"])});
    }
    return command;
  }

  const Json& json_;
  const StructuredShape& rest_;
};

}  // namespace

std::string command_word(const Json& json) {
  const auto found = json.is_object() ? json.find("do") : json.end();
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

int command_number(const Json& json, const char* key) {
  const Json& value = entry_of(json, key);
  if (!is_row(value)) refuse_entry(key, "a number counted from 0");
  return value.get<int>();
}

editing::Command page_command(const Json& json, const StructuredShape& rest) {
  if (!json.is_object()) throw UsageError("a command is a JSON object");
  return PageCommand(json, rest).command();
}

}  // namespace stackabilization::apps
