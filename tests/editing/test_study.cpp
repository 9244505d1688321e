// Studies with people: the plan, the order of conditions, and what is written down.
#include <map>
#include <set>

#include "sessions.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/editing/study.h"
#include "support/catch.h"
#include "support/messages.h"

using namespace stackabilization;
using namespace stackabilization::editing;

namespace {

const std::string two_tasks = R"({"format": "stackabilize study", "version": 1, "tasks": [
  {"name": "table", "model": "table.obj", "target": 0.5, "without": ["middle_bar"]},
  {"name": "chair", "model": "chair.obj", "direction": [0, -0.1, 1], "target": 0.4}]})";

std::vector<std::string> fields_of(const std::string& row) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char letter : row.substr(0, row.size() - 1)) {
    if (letter == '"')
      quoted = !quoted;
    else if (letter == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += letter;
  }
  return fields;
}

}  // namespace

TEST_CASE("a plan is read, with consent and questions of its own where it has none") {
  const StudyPlan plan = study_plan_of_text(two_tasks, "plan");
  REQUIRE(plan.tasks.size() == 2);
  CHECK(plan.tasks[0].name == "table");
  CHECK(plan.tasks[0].without == std::vector<std::string>{"middle_bar"});
  CHECK(plan.tasks[0].direction == Eigen::Vector3d::UnitZ());
  CHECK(plan.tasks[1].direction == Eigen::Vector3d(0, -0.1, 1));
  CHECK(plan.tasks[1].target == 0.4);
  CHECK(!plan.consent.empty());
  for (const std::string& question : plan.questions) CHECK(!question.empty());
}

TEST_CASE("a plan that is none is refused with the place") {
  const auto refused = [](const std::string& from, const std::string& to, const std::string& place) {
    std::string text = two_tasks;
    text.replace(text.find(from), from.size(), to);
    INFO(text);
    const std::string words = message_of<InputError>([&] { study_plan_of_text(text, "plan.json"); });
    CHECK(words.find("plan.json") != std::string::npos);
    CHECK(words.find(place) != std::string::npos);
  };
  refused("stackabilize study", "stackabilize project", "/format");
  refused("\"chair\"", "\"table\"", "/tasks/1/name");
  refused("0.4", "1", "/tasks/1/target");
  refused("[0, -0.1, 1]", "[0, 0, 0]", "/tasks/1/direction");
  refused("[0, -0.1, 1]", "[0, 1]", "/tasks/1/direction");
  refused("\"table.obj\"", "7", "/tasks/0/model");
  refused("\"without\"", "\"whithout\"", "/tasks/0");
  refused("\"version\": 1,", "\"version\": 1, \"questions\": [\"Why?\"],", "/questions");
  refused("\"format\": ", "\"format\" ", "plan.json:1");
}

TEST_CASE("conditions are in balanced order") {
  for (const int tasks : {3, 6, 7}) {
    std::map<std::pair<int, StudyCondition>, int> done;
    std::map<std::pair<StudyCondition, StudyCondition>, int> follows;
    for (int participant = 13; participant < 19; ++participant) {
      const std::vector<StudyTurn> turns = study_turns(participant, tasks);
      REQUIRE(turns.size() == static_cast<std::size_t>(tasks));
      std::set<int> seen;
      for (std::size_t k = 0; k < turns.size(); ++k) {
        seen.insert(turns[k].task);
        ++done[{turns[k].task, turns[k].condition}];
        if (k % 3 > 0) ++follows[{turns[k - 1].condition, turns[k].condition}];
      }
      CHECK(seen.size() == turns.size());
    }
    CHECK(done.size() == static_cast<std::size_t>(3 * tasks));
    for (const auto& [pair, count] : done) CHECK(count == 2);
    if (tasks % 3 != 0) continue;
    CHECK(follows.size() == 6);
    for (const auto& [pair, count] : follows) CHECK(count == 2 * tasks / 3);
  }
  CHECK(study_turns(1, 3)[0].task == 0);
  CHECK(study_turns(7, 3)[0].task == 1);
}

TEST_CASE("each condition allows its own commands, and all allow to look and go back") {
  const std::vector<StudyCondition> all = {StudyCondition::manual, StudyCondition::suggestive,
                                           StudyCondition::automatic};
  const auto allowed = [&](const Command& command) {
    std::string names;
    for (const StudyCondition condition : all)
      if (allows(condition, command)) names += name_of(condition) + " ";
    return names;
  };
  CHECK(allowed(Undo{}) == "manual suggestive automatic ");
  CHECK(allowed(RollBack{}) == "manual suggestive automatic ");
  CHECK(allowed(Drag{}) == "manual suggestive ");
  CHECK(allowed(ApplySuggestion{}) == "suggestive ");
  CHECK(allowed(TakeDesign{}) == "automatic ");
  for (const Command& command :
       {Command(SetTarget{}), Command(SetLimit{}), Command(KeepParts{}), Command(SetDirection{}),
        Command(RemoveParts{}), Command(AcceptRemedy{}), Command(Segment{})})
    CHECK(allowed(command).empty());
}

TEST_CASE("a row has a field per column, numbers to the last digit, and no more of a person than a number") {
  StudyEntry entry;
  entry.participant = 4;
  entry.turn = 2;
  entry.task = "table, \"old\"";
  entry.condition = StudyCondition::suggestive;
  entry.seconds = 12.3456;
  entry.event = "edit";
  entry.edit = "leg move 0 0 1";
  entry.target = 0.1;
  entry.assessment.measured.value = 1.0 / 3;
  entry.answers = {1, 0, 5};
  Check size;
  size.kind = CheckKind::quality;
  size.measure = QualityMeasure::size;
  size.value = 0.9;
  size.passed = true;
  entry.assessment.checks = {size};
  const QualityLimits limits;
  std::string row = study_row(entry, limits);
  CHECK(row.find("\"table, \"\"old\"\"\"") != std::string::npos);
  const std::vector<std::string> heading = fields_of(study_heading()), fields = fields_of(row);
  REQUIRE(fields.size() == heading.size());
  std::map<std::string, std::string> named;
  for (std::size_t k = 0; k < fields.size(); ++k) named[heading[k]] = fields[k];
  CHECK(named["participant"] == "4");
  CHECK(named["condition"] == "suggestive");
  CHECK(named["seconds"] == "12.3");
  CHECK(std::stod(named["stackability"]) == 1.0 / 3);
  CHECK(named["reached"] == "true");
  CHECK(named["nearest_limit"] == "size");
  CHECK(std::stod(named["share_of_limit"]) ==
        share_of_limit({QualityMeasure::size, 0.9, size.where, size.other}, limits));
  CHECK(named["answer_1"] == "1");
  CHECK(named["answer_2"] == "");
  CHECK(named["answer_3"] == "5");
}

TEST_CASE("results come back from what was written down") {
  StudyEntry entry;
  entry.task = "a, \"b\"";
  entry.condition = StudyCondition::automatic;
  entry.target = 0.6;
  entry.energy.distortion = {0.1, 0.2, 1.0 / 3, 0};
  entry.change = 0.03;
  std::string csv = study_heading();
  const auto add = [&](const std::string& event, double seconds) {
    entry.event = event;
    entry.seconds = seconds;
    csv += study_row(entry, {});
  };
  add("begin", 0);
  add("edit", 1);
  add("go", 2);
  add("edit", 3);
  entry.participant = 2;
  add("begin", 0);
  add("edit", 5);
  entry.participant = 1;
  entry.assessment.measured.value = 0.61;
  entry.edits = 1;
  entry.answers = {2, 3, 4};
  add("done", 61.5);
  const std::vector<StudyResult> results = study_results(csv, "r.csv");
  REQUIRE(results.size() == 1);
  CHECK(results[0].participant == 1);
  CHECK(results[0].task == entry.task);
  CHECK(results[0].condition == StudyCondition::automatic);
  CHECK(results[0].seconds == 61.5);
  CHECK(results[0].target == 0.6);
  CHECK(results[0].stackability == 0.61);
  CHECK(results[0].reached);
  CHECK(results[0].distortion.total() == entry.energy.distortion.total());
  CHECK(results[0].change == 0.03);
  CHECK(results[0].edits == 1);
  CHECK(results[0].made == 2);
  CHECK(results[0].answers == entry.answers);
  csv.replace(csv.rfind("automatic"), 9, "by magic!");
  CHECK(mentions(message_of<InputError>([&] { study_results(csv, "r.csv"); }), "r.csv, line 8"));
}

TEST_CASE("the next participant has the number after the last one") {
  CHECK(last_participant(study_heading(), "r.csv") == 0);
  StudyEntry entry;
  std::string csv = study_heading();
  for (const int participant : {1, 1, 12, 3}) {
    entry.participant = participant;
    csv += study_row(entry, {});
  }
  CHECK(last_participant(csv, "r.csv") == 12);
  CHECK(message_of<InputError>([&] { last_participant("a,b\n1,2\n", "r.csv"); }).find("line 1") !=
        std::string::npos);
  CHECK(message_of<InputError>([&] { last_participant(csv + "x,2\n", "r.csv"); }).find("line 6") !=
        std::string::npos);
}
