// Parts left out and joined, edits taken from another design, maps of directions, and other documents.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "editing/structure/pair_relations.h"
#include "sessions.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/meshes.h"
#include "support/messages.h"
#include "support/symmetric_solids.h"

using namespace stackabilization;
using namespace stackabilization::editing;
using sessions::Observed;

namespace {

std::vector<int> joint_rows(const EditingSession& session, int first, int second) {
  std::vector<int> rows;
  const std::vector<Relation>& relations = session.space().rest().structure.relations;
  for (std::size_t row = 0; row < relations.size(); ++row) {
    const Relation& one = relations[row];
    if (one.is_joint() &&
        (one.parts == std::vector<int>{first, second} || one.parts == std::vector<int>{second, first}))
      rows.push_back(static_cast<int>(row));
  }
  return rows;
}

std::vector<Relation> pairs(const EditingSession& session) {
  std::vector<Relation> found;
  for (const Relation& relation : session.space().rest().structure.relations)
    if (relation.type == RelationType::symmetry) found.push_back(relation);
  return found;
}

Eigen::Vector3d skew_normal() {
  return Eigen::Vector3d(1, 1, 0).normalized();
}

/// A brick at a signed distance from the plane x + y = 12, along it.
Shape brick(double distance, double height) {
  const Eigen::Matrix3d skew = Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitZ()).matrix();
  return solids::named(
      transformed(solids::box({distance - 0.5, -1, 0}, {distance + 0.5, 1, height}), skew, {6, 6, 0}),
      distance < 0 ? "left" : "right");
}

/// A beam that is not symmetric in that plane.
Shape beam() {
  return solids::named(solids::box({20, 3, 5}, {29, 4, 7}), "beam");
}

}  // namespace

TEST_CASE("parts that are left out are gone until Undo, and S is that of the rest") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const std::vector<std::string> names = session.space().rest().shape.part_names;
  std::vector<int> legs;
  for (const char* name : {"leg_1", "leg_2", "leg_3", "leg_4"})
    legs.push_back(structures::part_named(session.space().rest(), name));
  const StructuredShape top = without_parts(session.space().rest(), legs);
  session.execute(RemoveParts{legs});
  CHECK(session.space().rest().shape.part_names == top.shape.part_names);
  CHECK(session.current().assessment.measured.value == stackability(top.shape, {0, 0, 1}).value);
  CHECK(session.document().project.history.nodes[0].stackability ==
        session.current().assessment.measured.value);
  session.execute(Undo{});
  CHECK(session.space().rest().shape.part_names == names);
  CHECK_THROWS_AS(session.execute(RemoveParts{{}}), UsageError);
  CHECK_THROWS_AS(session.execute(RemoveParts{{99}}), UsageError);
  CHECK(session.space().rest().shape.part_names == names);
}

TEST_CASE("a joint that was taken out comes back where it was when the parts are joined") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const int leg = structures::part_named(session.space().rest(), "leg_1");
  const int top = structures::part_named(session.space().rest(), "top");
  const std::vector<int> rows = joint_rows(session, leg, top);
  REQUIRE(rows.size() == 1);
  const Relation before = session.space().rest().structure.relations[static_cast<std::size_t>(rows[0])];
  CHECK(mentions(message_of<UsageError>([&] { session.execute(Join{{leg, top}}); }), "joined already"));
  session.execute(RemoveRelations{rows});
  REQUIRE(joint_rows(session, leg, top).empty());
  session.execute(Join{{top, leg}});
  const std::vector<int> again = joint_rows(session, leg, top);
  REQUIRE(again.size() == 1);
  const Relation after = session.space().rest().structure.relations[static_cast<std::size_t>(again[0])];
  CHECK((after.points.colwise().mean() - before.points.colwise().mean()).norm() <
        0.01 * session.space().rest().structure.diagonal);
  CHECK(mentions(message_of<UsageError>([&] { session.execute(Join{{leg, leg}}); }), "itself"));
  CHECK_THROWS_AS(session.execute(Join{{leg, 99}}), UsageError);
}

TEST_CASE(
    "a symmetry that was taken out comes back, in the plane of the whole, when the parts are made "
    "symmetric") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  const int one = structures::part_named(session.space().rest(), "leg_1");
  const std::vector<Relation> before = session.space().rest().structure.relations;
  const auto pair = std::find_if(before.begin(), before.end(), [&](const Relation& relation) {
    return relation.type == RelationType::symmetry && relation.parts[0] == one;
  });
  REQUIRE(pair != before.end());
  const int other = pair->parts[1];
  CHECK(mentions(message_of<UsageError>([&] {
                   session.execute(MakeSymmetric{{other, one}});
                 }),
                 "symmetric already"));
  session.execute(RemoveRelations{{static_cast<int>(pair - before.begin())}});
  REQUIRE(session.space().rest().structure.relations.size() == before.size() - 1);
  session.execute(MakeSymmetric{{other, one}});
  const std::vector<Relation>& after = session.space().rest().structure.relations;
  REQUIRE(after.size() == before.size());
  const auto again = std::find_if(after.begin(), after.end(), [&](const Relation& relation) {
    return relation.type == RelationType::symmetry && relation.parts == pair->parts;
  });
  REQUIRE(again != after.end());
  CHECK(again->symmetry.axis.cross(pair->symmetry.axis).norm() < 1e-12);
  CHECK(std::abs((again->symmetry.point - pair->symmetry.point).dot(pair->symmetry.axis)) < 1e-12);
}

TEST_CASE("mirror images without a plane of the whole are made symmetric in their own") {
  Observed observed(new_document(analyse_structure(solids::joined({brick(-2, 3), brick(2, 3), beam()}))));
  EditingSession& session = observed.session;
  REQUIRE(pairs(session).empty());
  CHECK(mentions(message_of<UsageError>([&] {
                   session.execute(MakeSymmetric{{0, 2}});
                 }),
                 "no mirror images"));
  CHECK(mentions(message_of<UsageError>([&] { session.execute(MakeSymmetric{{1, 1}}); }), "itself"));
  CHECK_THROWS_AS(session.execute(MakeSymmetric{{0, 3}}), UsageError);
  session.execute(MakeSymmetric{{1, 0}});
  REQUIRE(pairs(session).size() == 1);
  const Symmetry plane = pairs(session)[0].symmetry;
  CHECK(plane.axis.cross(skew_normal()).norm() < 1e-9);
  CHECK(plane.point.dot(skew_normal()) == Approx(12 / std::sqrt(2.0)).epsilon(1e-9));
  session.execute(Undo{});
  CHECK(pairs(session).empty());
}

TEST_CASE("the residual of a symmetry that is drawn in is a fraction of the whole") {
  // Bricks that are mirror images but for a hundredth of their heights; the whole is five times as large.
  // Planes are fitted to samples, so that residuals are alike and not the same.
  const std::vector<Shape> bricks = {brick(-2, 3), brick(2, 3.03)};
  const StructuredShape alone = analyse_structure(solids::joined(bricks));
  const StructuredShape beside = analyse_structure(solids::joined({bricks[0], bricks[1], beam()}));
  const auto found = std::find_if(
      alone.structure.relations.begin(), alone.structure.relations.end(), [](const Relation& relation) {
        return relation.type == RelationType::symmetry && relation.parts.size() == 2;
      });
  REQUIRE(found != alone.structure.relations.end());
  REQUIRE(found->residual > 1e-4);
  CHECK(symmetry_between(beside, 0, 1).residual * beside.structure.diagonal ==
        Approx(found->residual * alone.structure.diagonal).epsilon(0.25));
}

TEST_CASE("a symmetry that is drawn in takes the plane of the whole, though the two alone have one nearby") {
  // The right brick is wider by 0.02, so their own plane is off that of the slab by 0.005.
  StructuredShape structured =
      analyse_structure(solids::joined({solids::named(solids::box({-10, -3, 0}, {10, 3, 1}), "slab"),
                                        solids::named(solids::box({-3, -1, 1}, {-2, 1, 4}), "left"),
                                        solids::named(solids::box({2, -1, 1}, {3.02, 1, 4}), "right")}));
  std::erase_if(structured.structure.relations,
                [](const Relation& relation) { return relation.type == RelationType::symmetry; });
  const Relation pair = symmetry_between(structured, 1, 2);
  const auto& planes = structured.structure.symmetries;
  const auto plane = std::find_if(planes.begin(), planes.end(), [](const Symmetry& symmetry) {
    return symmetry.kind == SymmetryKind::reflection && std::abs(symmetry.axis.x()) > 0.99;
  });
  REQUIRE(plane != planes.end());
  CHECK(std::abs(pair.symmetry.axis.dot(plane->axis)) == Approx(1).epsilon(1e-12));
  CHECK(std::abs((pair.symmetry.point - plane->point).dot(plane->axis)) < 1e-9);
}

TEST_CASE("an edit is taken from another design, and one that a limit does not allow is refused") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  observed.work();
  session.execute(ApplySuggestion{0});
  const Points wanted = session.current().design->shape.vertices;
  session.execute(RollBack{0});
  session.execute(TakeEdit{1, 0});
  CHECK(session.document().project.history.current == 2);
  CHECK(session.document().project.history.nodes[2].parent == 0);
  CHECK(session.current().design->shape.vertices == wanted);
  // The same edit once more, until a limit stands against it.
  std::string refusal = "accepted";
  for (int k = 0; k < 20 && refusal == "accepted"; ++k)
    refusal = message_of<UsageError>([&] { session.execute(TakeEdit{1, 0}); });
  CHECK(mentions(refusal, "cannot be made here"));
  CHECK_THROWS_AS(session.execute(TakeEdit{99, 0}), UsageError);
  CHECK_THROWS_AS(session.execute(TakeEdit{1, 1}), UsageError);
  CHECK_THROWS_AS(session.execute(TakeEdit{0, 0}), UsageError);
}

TEST_CASE("envelopes are sampled along the direction of the design, and go with it") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  observed.work();
  CHECK(!session.envelopes());
  session.execute(SampleEnvelopes{});
  observed.work();
  REQUIRE(session.envelopes());
  const HeightField field = *session.envelopes();
  CHECK(field.frame.w == session.direction().unit());
  // Legs on the top: the samples on them have the largest gap, the height.
  CHECK(maximum_gap(field).value == Approx(6).epsilon(1e-12));
  CHECK(session.current().assessment.measured.f_max == Approx(6).epsilon(1e-12));
  session.execute(SetDirection{{1, 0, 2}});
  CHECK(!session.envelopes());
  session.execute(SampleEnvelopes{});
  observed.work();
  REQUIRE(session.envelopes());
  CHECK(session.envelopes()->frame.w == session.direction().unit());
  CHECK(maximum_gap(*session.envelopes()).value <= session.current().assessment.measured.f_max * (1 + 1e-9));
}

TEST_CASE("a map of directions has S of the design, and goes with it") {
  Observed observed(sessions::table_document());
  EditingSession& session = observed.session;
  observed.work(Lane::automatic);
  CHECK(!session.map());
  session.execute(MapDirections{});
  observed.work(Lane::automatic);
  REQUIRE(session.map());
  const DirectionMap map = *session.map();
  CHECK(map.map.samples.size() > 500);
  double best_sample = -1;
  for (std::size_t k = 0; k < map.map.samples.size(); k += 97) {
    const MapSample& sample = map.map.samples[k];
    CHECK(sample.stackability ==
          Approx(stackability(session.current().design->shape, Direction(sample.direction)).value)
              .margin(1e-9));
  }
  for (const MapSample& sample : map.map.samples) best_sample = std::max(best_sample, sample.stackability);
  CHECK(map.best >= best_sample - 1e-9);
  session.execute(SetDirection{map.best_direction});
  CHECK(session.current().assessment.measured.value == Approx(map.best).margin(1e-9));
  CHECK(!session.map());
}

TEST_CASE("where no suggestion raises S it is said what blocks and what would help") {
  // A box: its copies lie on it whatever is done to it.
  Observed observed(new_document(structures::box_alone({1, 1, 1})));
  EditingSession& session = observed.session;
  observed.work();
  REQUIRE(session.suggestions_complete());
  for (const OfferedEdit& one : session.suggestions()) CHECK(one.gain < 0.005);
  REQUIRE(session.diagnosis());
  CHECK(!session.diagnosis()->blockers.empty());
  CHECK_THROWS_AS(session.execute(AcceptRemedy{99, AcceptRemedy::Source::advice}), UsageError);
  Observed table(sessions::table_document());
  table.work();
  REQUIRE(table.session.suggestions().front().gain > 0.005);
  CHECK(!table.session.diagnosis());
}

TEST_CASE("another document takes the place of the first one, with a file of its own") {
  const test::ScratchFolder scratch("editing_other_document");
  const std::filesystem::path folder = scratch.path();
  SessionOptions options;
  options.autosave = folder / "first.json";
  Observed observed(sessions::table_document(), options);
  EditingSession& session = observed.session;
  observed.work();
  session.execute(ApplySuggestion{0});
  const std::string first = read_file(folder / "first.json");
  Document other = new_document(structures::box_alone({1, 1, 1}));
  other.requirements.target = 0.3;
  options.autosave = folder / "second.json";
  session.open(other, options);
  CHECK(session.space().rest().shape.part_names == other.project.rest.shape.part_names);
  CHECK(session.document().requirements.target == 0.3);
  CHECK(!session.can_undo());
  CHECK(session.suggestions().empty());
  CHECK(read_file(folder / "first.json") == first);
  CHECK(read_file(folder / "second.json") == document_text(session.document()));
  other.visited.clear();
  options.autosave = folder / "third.json";
  CHECK_THROWS_AS(session.open(other, options), UsageError);
  CHECK(read_file(folder / "second.json") == document_text(session.document()));
}
