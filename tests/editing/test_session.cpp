#include <cmath>

#include "sessions.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/improvement/refinement.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/meshes.h"
#include "support/messages.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::editing;
using sessions::Observed;

namespace {

Edit lean_leg(const EditingSession& session, double by) {
  Edit edit{{HandleKind::part, structures::part_named(session.space().rest(), "leg_1"), 0}, Move{{by, 0, 0}}};
  return edit;
}

bool within_limits(const Assessment& assessment) {
  for (const Check& check : assessment.checks)
    if (!check.passed && check.kind != CheckKind::target) return false;
  return true;
}

}  // namespace

TEST_CASE("a suggestion that is applied gives the design and the S that it promised") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  observed.work();
  REQUIRE(session.suggestions_complete());
  REQUIRE(!session.suggestions().empty());
  const OfferedEdit offered = session.suggestions().front();
  session.execute(ApplySuggestion{0});
  const History& history = session.document().project.history;
  REQUIRE(history.nodes.size() == 2);
  CHECK(history.current == 1);
  CHECK(session.current().design->shape.vertices == offered.design->shape.vertices);
  CHECK(design_at(session.space(), history, 1).shape.vertices == offered.design->shape.vertices);
  const double value = stackability(session.current().design->shape, {0, 0, 1}).value;
  CHECK(history.nodes[1].stackability == Approx(value).margin(1e-9));
  CHECK(offered.gain == Approx(value - history.nodes[0].stackability).margin(1e-9));
}

TEST_CASE("suggestions on a plateau help: S rises, or the summed gap excess falls") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const Situation now = situation(session.checker(), *session.current().design, session.direction());
  observed.work();
  REQUIRE(!session.suggestions().empty());
  for (const OfferedEdit& one : session.suggestions()) {
    const bool rises = one.gain > 0, clears = one.suggestion.excess < now.excess;
    CHECK((rises || clears));
    CHECK(within_limits(session.checker().check(*one.design, session.direction())));
  }
}

TEST_CASE(
    "suggestions are not looked for where they are not wanted, and the design is reviewed all the same") {
  SessionOptions options;
  options.suggests = false;
  Observed observed(sessions::table_document(), options);
  observed.work();
  CHECK(observed.session.review());
  CHECK(observed.session.suggestions().empty());
  CHECK(observed.all<Progress>().empty());
  observed.session.open(sessions::table_document(), {});
  observed.work();
  CHECK(!observed.session.suggestions().empty());
}

TEST_CASE("the translation of a node is measured on its design along its direction") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  observed.work();
  session.execute(ApplySuggestion{0});
  session.execute(SetDirection{{0.4, 0, 1}});
  const History& history = session.document().project.history;
  REQUIRE(history.nodes.size() == 3);
  for (int node = 0; node < 3; ++node) {
    const Direction direction(history.nodes[static_cast<std::size_t>(node)].direction);
    const Shape& shape = session.design_of(node)->shape;
    CHECK(session.f_max_of(node) == Approx(minimal_stacking_translation(shape, direction).length));
  }
  CHECK_THROWS_AS(session.f_max_of(3), UsageError);
}

TEST_CASE("undo, redo, going back and branching") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  CHECK(!session.can_undo());
  session.execute(Undo{});
  observed.work();
  session.execute(ApplySuggestion{0});
  const Points first = session.current().design->shape.vertices;
  CHECK(session.can_undo());
  session.execute(Undo{});
  CHECK(session.current().design->shape.vertices == session.space().rest().shape.vertices);
  CHECK(session.can_redo());
  session.execute(Redo{});
  CHECK(session.current().design->shape.vertices == first);
  session.execute(RollBack{0});
  CHECK(!session.can_redo());
  observed.work();
  REQUIRE(session.suggestions().size() > 1);
  session.execute(ApplySuggestion{1});
  const History& history = session.document().project.history;
  REQUIRE(history.nodes.size() == 3);
  CHECK(history.nodes[2].parent == 0);
  session.execute(Undo{});
  session.execute(Undo{});
  CHECK(history.current == 1);
  CHECK(session.current().design->shape.vertices == first);
}

TEST_CASE("a drag shows the edited design and becomes one node when it is kept") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const DeformationConstraints constraints =
      deformation_constraints(session.checker().requirements(), session.space().rest(), session.direction());
  for (const double by : {0.02, 0.05, 0.03}) {
    session.execute(Drag{lean_leg(session, by)});
    const Design wanted =
        session.space().edited(session.space().at_rest(), lean_leg(session, by), constraints).design;
    CHECK(session.shown().design->shape.vertices == wanted.shape.vertices);
    CHECK(session.document().project.history.nodes.size() == 1);
  }
  CHECK(session.dragging());
  session.execute(EndDrag{true});
  CHECK(!session.dragging());
  const History& history = session.document().project.history;
  REQUIRE(history.nodes.size() == 2);
  REQUIRE(history.nodes[1].edits.size() == 1);
  CHECK(std::get<Move>(history.nodes[1].edits[0].operation).by.x() == 0.03);
}

TEST_CASE("a drag that is not kept leaves nothing behind") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const std::string before = document_text(session.document());
  session.execute(Drag{lean_leg(session, 0.05)});
  session.execute(EndDrag{false});
  CHECK(document_text(session.document()) == before);
  CHECK(session.shown().design->shape.vertices == session.space().rest().shape.vertices);
}

TEST_CASE("a limit holds a drag, and is named") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  session.execute(Drag{lean_leg(session, 3)});
  CHECK(!observed.all<Refused>().empty());
  CHECK(within_limits(session.shown().assessment));
  const double reached = std::abs(session.shown().design->shape.vertices.maxCoeff());
  CHECK(reached < session.space().rest().shape.vertices.maxCoeff() + 3);
}

TEST_CASE("what is kept of a drag keeps the limits too that are too slow to follow it") {
  Observed observed(new_document(structures::rough_stool()));
  EditingSession& session = observed.session;
  const Edit through{{HandleKind::part, structures::part_named(session.space().rest(), "leg_1"), 0},
                     Move{{3.9, 0, 0}}};
  session.execute(Drag{through});
  REQUIRE(within_limits(session.shown().assessment));
  REQUIRE(!within_limits(session.checker().check(*session.shown().design, session.direction())));
  const double dragged = std::get<Move>(session.drag()->operation).by.x();
  session.execute(EndDrag{true});
  CHECK(within_limits(session.checker().check(*session.current().design, session.direction())));
  const History& history = session.document().project.history;
  REQUIRE(history.nodes.size() == 2);
  const double kept = std::get<Move>(history.nodes[1].edits[0].operation).by.x();
  CHECK(kept > 2);
  CHECK(kept < dragged);
  REQUIRE(observed.all<Refused>().size() == 1);
  const Obstacle obstacle = observed.all<Refused>()[0].obstacle;
  REQUIRE(std::holds_alternative<Check>(obstacle));
  CHECK(std::get<Check>(obstacle).measure == QualityMeasure::collision);
}

TEST_CASE("the range of a handle ends where limits do") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const Edit whole = lean_leg(session, 4);
  session.execute(FindRange{whole});
  observed.work();
  REQUIRE(session.range());
  const HandleRange range = *session.range();
  CHECK(range.low <= 0);
  CHECK(range.high >= 0);
  CHECK(range.high < 1);
  CHECK(range.above);
  const DeformationConstraints constraints =
      deformation_constraints(session.checker().requirements(), session.space().rest(), session.direction());
  for (const HandleRange::Sample& sample : range.samples) {
    const DeformationResult made =
        session.space().edited(session.space().at_rest(), with_magnitude(whole, sample.amount), constraints);
    REQUIRE(!made.refusal);
    CHECK(sample.stackability == Approx(stackability(made.design.shape, {0, 0, 1}).value).margin(1e-9));
    CHECK(within_limits(session.checker().check(made.design, session.direction())));
  }
  constexpr double resolution = 0.01;
  const DeformationResult beyond = session.space().edited(
      session.space().at_rest(), with_magnitude(whole, range.high + resolution), constraints);
  CHECK((beyond.refusal || !within_limits(session.checker().check(beyond.design, session.direction()))));
}

TEST_CASE("results that come too late are dropped") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  std::vector<EditingSession::Result> late;
  const auto job = session.next_job(Lane::advice);
  REQUIRE(job);
  CHECK(!session.next_job(Lane::advice));  // one at a time
  (*job)([&](EditingSession::Result result) { late.push_back(std::move(result)); });
  session.execute(SetDirection{{0, 1, 1}});
  for (const EditingSession::Result& result : late) result();
  CHECK(!session.review());
  CHECK(session.next_job(Lane::advice));
}

TEST_CASE("numbers that do not exist are refused and change nothing") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const std::string before = document_text(session.document());
  CHECK_THROWS_AS(session.execute(ApplySuggestion{0}), UsageError);
  CHECK_THROWS_AS(session.execute(RollBack{1}), UsageError);
  CHECK_THROWS_AS(session.execute(TakeDesign{0}), UsageError);
  CHECK_THROWS_AS(session.execute(AcceptRemedy{0}), UsageError);
  CHECK_THROWS_AS(session.execute(SetTarget{1.5}), UsageError);
  CHECK_THROWS_AS(session.execute(SetTarget{std::nan("")}), UsageError);
  CHECK_THROWS_AS(session.execute(SetLimit{QualityMeasure::size, -1.0}), UsageError);
  CHECK_THROWS_AS(session.execute(KeepParts{{99}}), UsageError);
  CHECK_THROWS_AS(session.execute(SetDirection{{0, 0, 0}}), UsageError);
  CHECK_THROWS_AS(session.execute(Drag{{{HandleKind::section, 0, 3}, Move{{1, 0, 0}}}}), UsageError);
  CHECK(!session.dragging());
  CHECK(document_text(session.document()) == before);
}

TEST_CASE("a part that is kept does not move in any suggestion") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const int leg = structures::part_named(session.space().rest(), "leg_1");
  session.execute(KeepParts{{leg}});
  observed.work();
  const Shape& rest = session.space().rest().shape;
  const Shape before = extract_part(rest, leg);
  for (const OfferedEdit& one : session.suggestions())
    CHECK((extract_part(one.design->shape, leg).vertices - before.vertices).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("a session that was killed goes on as it was") {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / "stackabilize_session_test.json";
  std::filesystem::remove(file);
  SessionOptions options;
  options.autosave = file;
  Points shown;
  std::string saved;
  {
    Observed observed(sessions::table_document(), options);
    observed.work();
    observed.session.execute(ApplySuggestion{0});
    observed.session.execute(SetTarget{0.5});
    observed.session.execute(Drag{lean_leg(observed.session, 0.05)});  // was never ended
    shown = observed.session.current().design->shape.vertices;
    saved = document_text(observed.session.document());
  }
  CHECK(read_file(file) == saved);
  Observed again(document_of_text(read_file(file), file.string()));
  CHECK(again.session.current().design->shape.vertices == shown);
  CHECK(again.session.document().requirements.target == 0.5);
  CHECK(again.session.can_undo());
  std::filesystem::remove(file);
}

TEST_CASE("a file that cannot be written is said, and nothing else is lost") {
  SessionOptions options;
  options.autosave = "/nowhere/at/all/session.json";
  Observed observed(sessions::table_document(), options);
  observed.session.execute(SetDirection{{0, 0.1, 1}});
  REQUIRE(!observed.all<Failed>().empty());
  CHECK(observed.session.document().project.history.nodes.size() == 2);
  CHECK(!observed.session.saved());
}

TEST_CASE("changes are saved where there is a file for them, and it can be written") {
  CHECK(!Observed(sessions::table_document()).session.saved());
  const test::ScratchFolder scratch("editing_saved");
  const std::filesystem::path folder = scratch.path() / "session";
  SessionOptions options;
  options.autosave = folder / "session.json";
  Observed observed(sessions::table_document(), options);
  EditingSession& session = observed.session;
  CHECK(session.saved());  // there is no change yet
  session.execute(SetTarget{0.5});
  CHECK(!session.saved());
  std::filesystem::create_directory(folder);
  session.execute(SetTarget{0.6});
  CHECK(session.saved());
}

TEST_CASE("strokes cut a part in two, and Undo joins it again") {
  const Shape tower =
      concatenate(solids::box({0, 0, 0}, {2, 2, 1}), solids::box({0.5, 0.5, 1}, {1.5, 1.5, 4}));
  AnalysisOptions whole;
  whole.segmentation.method = SegmentationMethod::whole;
  Observed observed(new_document(analyse_structure(make_shape(tower.vertices, tower.triangles), whole)));
  EditingSession& session = observed.session;
  const Shape before = session.space().rest().shape;
  REQUIRE(before.part_count() == 1);
  const std::string own = before.part_names[0];
  session.execute(Segment{{{"tower", {12}}, {own, {0}}}});
  const Shape& cut = session.space().rest().shape;
  REQUIRE(cut.part_count() == 2);
  CHECK(cut.vertices == before.vertices);
  CHECK(cut.triangles == before.triangles);
  for (std::size_t t = 0; t < cut.triangle_part.size(); ++t)
    CHECK((cut.part_names[static_cast<std::size_t>(cut.triangle_part[t])] == "tower") == (t >= 12));
  CHECK(session.can_undo());
  session.execute(Undo{});
  CHECK(session.space().rest().shape.part_count() == 1);
  CHECK(!session.can_undo());
}

TEST_CASE("strokes that contradict each other or leave nothing are refused") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const std::string before = document_text(session.document());
  CHECK_THROWS_AS(session.execute(Segment{}), UsageError);
  CHECK_THROWS_AS(session.execute(Segment{{{"new", {0}}}}), UsageError);            // what would stay?
  CHECK_THROWS_AS(session.execute(Segment{{{"a", {0}}, {"b", {0}}}}), UsageError);  // they cross
  CHECK_THROWS_AS(session.execute(Segment{{{"a", {1'000'000}}}}), UsageError);
  CHECK_THROWS_AS(session.execute(Segment{{{"", {0}}}}), UsageError);
  CHECK_THROWS_AS(session.execute(SetKind{99, PrimitiveKind::cuboid}), UsageError);
  CHECK_THROWS_AS(session.execute(RemoveRelations{{}}), UsageError);
  CHECK_THROWS_AS(session.execute(RemoveRelations{{100'000}}), UsageError);
  CHECK(document_text(session.document()) == before);
}

TEST_CASE("a part and those symmetric to it change their kind") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const int leg = structures::part_named(session.space().rest(), "leg_1");
  session.execute(SetKind{leg, PrimitiveKind::cylinder});
  for (const char* name : {"leg_1", "leg_2", "leg_3", "leg_4"}) {
    const StructuredShape& rest = session.space().rest();
    const auto row = static_cast<std::size_t>(structures::part_named(rest, name));
    CHECK(std::holds_alternative<GeneralizedCylinder>(rest.structure.parts[row].primitive));
  }
  session.execute(Undo{});
  const StructuredShape& rest = session.space().rest();
  CHECK(std::holds_alternative<Cuboid>(rest.structure.parts[static_cast<std::size_t>(leg)].primitive));
}

TEST_CASE("a joint that is taken out is gone until Undo") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const std::size_t before = session.space().rest().structure.relations.size();
  std::vector<int> joints;
  for (std::size_t row = 0; row < before; ++row)
    if (session.space().rest().structure.relations[row].type == RelationType::point_joint)
      joints.push_back(static_cast<int>(row));
  REQUIRE(!joints.empty());
  session.execute(RemoveRelations{joints});
  CHECK(session.space().rest().structure.relations.size() == before - joints.size());
  CHECK(session.document().project.history.nodes.size() == 1);
  session.execute(Undo{});
  CHECK(session.space().rest().structure.relations.size() == before);
}

TEST_CASE("so many copies within a length are wanted in place of a stackability, until one is again") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const double target = session.checker().requirements().target;
  // The table is 6 high, and stands on the one below: 5 copies are 30 high.
  session.execute(SetLengthLimit{{5, 30}});
  CHECK(session.checker().meets_target(session.current().assessment.measured));
  CHECK(session.checker().requirements().target == Approx(0).margin(1e-12));
  session.execute(SetLengthLimit{{5, 26}});
  CHECK(!session.checker().meets_target(session.current().assessment.measured));
  CHECK(!observed.all<Changed>().empty());
  observed.work();
  REQUIRE(!session.suggestions().empty());
  for (const OfferedEdit& one : session.suggestions()) {
    const Stackability measured = session.checker().measure(one.design->shape, session.direction());
    CHECK(one.suggestion.reaches_target == (measured.stack_height(5) <= 26));
  }
  CHECK(mentions(message_of<UsageError>([&] {
                   session.execute(SetLengthLimit{{5, 6}});
                 }),
                 "no room for 5 copies"));
  CHECK_THROWS_AS(session.execute(SetLengthLimit{{1, 60}}), UsageError);
  CHECK(session.checker().requirements().length_limit->length == 26);
  Observed again(document_of_text(document_text(session.document()), "saved"));
  CHECK(again.session.checker().requirements().length_limit->copies == 5);
  session.execute(RemoveParts{{structures::part_named(session.space().rest(), "bar_1")}});
  CHECK(session.checker().requirements().length_limit->length == 26);
  session.execute(SetTarget{target});
  CHECK(!session.checker().requirements().length_limit);
  CHECK(session.checker().requirements().target == target);
}
