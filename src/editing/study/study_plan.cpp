#include <algorithm>
#include <nlohmann/json.hpp>
#include <variant>

#include "io/formats/json_node.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/editing/study.h"

namespace stackabilization::editing {

namespace {

constexpr const char* default_consent =
    "You will be asked to change a few objects so that they stack better. The program writes down how long "
    "you "
    "take, each edit, how well the result stacks and your answers, and nothing that says who you are. You "
    "may "
    "stop at any time.";
const std::array<std::string, 3> default_questions = {"Are you content with the design?",
                                                      "Was it easy to get there?", "Would you build it?"};

std::string text_of(const detail::JsonNode& node, const char* what) {
  const std::string text = node.text();
  if (text.empty() || text.find_first_of("\r\n") != std::string::npos) node.fail_expected(what);
  return text;
}

StudyPlanTask task_of(const detail::JsonNode& node) {
  StudyPlanTask task;
  task.name = text_of(node["name"], "a name");
  task.model = text_of(node["model"], "the name of a file");
  task.target = node["target"].number();
  if (!(task.target < 1)) node["target"].fail_expected("a number less than 1");
  if (node.has("direction")) task.direction = node["direction"].numbers(3);
  if (!(task.direction.norm() > 0)) node["direction"].fail_expected("a direction that is not zero");
  if (node.has("without"))
    for (std::size_t k = 0; k < node["without"].list_size(); ++k)
      task.without.push_back(text_of(node["without"][k], "the name of a part"));
  return task;
}

template <class... Kinds>
bool is_any(const Command& command) {
  return (std::holds_alternative<Kinds>(command) || ...);
}

/// Orders of the conditions in which each follows each other one equally often.
constexpr std::array<std::array<int, 3>, 6> williams_rows = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}, {0, 2, 1}, {1, 0, 2}}};

}  // namespace

std::string name_of(StudyCondition condition) {
  constexpr std::array<const char*, 3> names = {"manual", "suggestive", "automatic"};
  return names[static_cast<std::size_t>(condition)];
}

bool allows(StudyCondition condition, const Command& command) {
  if (is_any<RollBack, Undo, Redo, MapDirections, SampleEnvelopes, FindRange>(command)) return true;
  switch (condition) {
    case StudyCondition::manual:
      return is_any<Drag, EndDrag, TakeEdit>(command);
    case StudyCondition::suggestive:
      return is_any<Drag, EndDrag, TakeEdit, ApplySuggestion>(command);
    case StudyCondition::automatic:
      break;
  }
  return is_any<FindDesigns, StopFinding, TakeDesign>(command);
}

StudyPlan study_plan_of_text(std::string_view text, const std::string& name) {
  const nlohmann::ordered_json json = detail::parse_json(text, name);
  const detail::JsonNode root(json, name);
  root.expect_keys({"format", "version", "tasks", "consent", "questions"}, 2);
  root["format"].one_of({"stackabilize study"});
  root["version"].integer(1, 1);
  StudyPlan plan{default_consent, default_questions, {}};
  if (root.has("consent")) plan.consent = text_of(root["consent"], "a text");
  if (root.has("questions")) {
    const detail::JsonNode questions = root["questions"];
    questions.expect_size(plan.questions.size());
    for (std::size_t k = 0; k < plan.questions.size(); ++k)
      plan.questions[k] = text_of(questions[k], "a question");
  }
  const detail::JsonNode tasks = root["tasks"];
  for (std::size_t k = 0; k < tasks.list_size(); ++k) {
    tasks[k].expect_keys({"name", "model", "target", "direction", "without"}, 2);
    plan.tasks.push_back(task_of(tasks[k]));
    const auto same = [&](const StudyPlanTask& task) { return task.name == plan.tasks.back().name; };
    if (std::count_if(plan.tasks.begin(), plan.tasks.end(), same) > 1)
      tasks[k]["name"].fail_expected("a name that no other task has");
  }
  if (plan.tasks.empty()) tasks.fail_expected("at least one task");
  return plan;
}

std::vector<StudyTurn> study_turns(int participant, int tasks) {
  const int row = (participant - 1) % 6, shift = (participant - 1) / 6;
  std::vector<StudyTurn> turns;
  for (int k = 0; k < tasks; ++k) {
    const int condition = williams_rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(k % 3)];
    turns.push_back({(k + shift) % tasks, static_cast<StudyCondition>(condition)});
  }
  return turns;
}

}  // namespace stackabilization::editing
