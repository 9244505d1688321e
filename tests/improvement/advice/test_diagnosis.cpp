#include <algorithm>

#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/diagnosis.h"
#include "stackabilization/improvement/partition.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/solids.h"
#include "support/still_designs.h"
#include "support/structures.h"

namespace stackabilization {
namespace {

/// A search that made nothing better than the shape at rest.
BestFirstResult stuck_at_rest(const RequirementChecker& checker) {
  BestFirstResult result;
  Candidate candidate;
  candidate.design = checker.space().at_rest();
  candidate.measured = checker.measure(candidate.design.shape, Direction(0, 0, 1));
  result.nearest = {candidate};
  return result;
}

const Remedy* remedy_of(const Diagnosis& diagnosis, Remedy::Kind kind) {
  const auto found = std::find_if(diagnosis.remedies.begin(), diagnosis.remedies.end(),
                                  [&](const Remedy& remedy) { return remedy.kind == kind; });
  return found == diagnosis.remedies.end() ? nullptr : &*found;
}

std::vector<int> all_parts(const StructuredShape& rest) {
  std::vector<int> parts;
  for (int part = 0; part < rest.shape.part_count(); ++part) parts.push_back(part);
  return parts;
}

TEST_CASE("parts that must stay are what is in the way, and freeing the legs is offered") {
  const StructuredShape table = structures::table();
  const auto space = deformation_model(table);
  Requirements requirements = designs::frame_requirements(0.8);
  requirements.kept_parts = all_parts(table);
  const RequirementChecker checker(*space, requirements);
  BestFirstResult result = stuck_at_rest(checker);
  const int leg = structures::part_named(table, "leg_1");
  result.refusals = {{Refusal{.cause = RefusalCause::fixed_part, .part = leg}, 12},
                     {Refusal{.cause = RefusalCause::box_side, .index = 2}, 1}};
  const Diagnosis diagnosis = diagnose(checker, result);

  CHECK(diagnosis.target == 0.8);
  CHECK(diagnosis.reached == Approx(0).margin(1e-9));
  REQUIRE(diagnosis.blockers.size() == 1);  // four legs, symmetric
  const Blocker& blocker = diagnosis.blockers.front();
  CHECK(blocker.upper_part == structures::part_named(table, "top"));
  CHECK(mentions(table.shape.part_names[static_cast<std::size_t>(blocker.lower_part)], "leg_"));
  CHECK(blocker.type == ContactType::dot);
  CHECK(blocker.f == Approx(6));
  CHECK(blocker.stackability == Approx(0).margin(1e-9));
  CHECK(blocker.edits == Blocker::Edits::refused);
  CHECK(std::get<Refusal>(blocker.obstacle).cause == RefusalCause::fixed_part);
  REQUIRE(diagnosis.constraints.size() == 2);
  CHECK(describe(diagnosis.constraints[1], table.structure) ==
        "the edit would change the side of the box along z (1 edit)");

  const std::string text = stackabilization::text(diagnosis, table.structure);
  CHECK(mentions(text, "S = 0.800 was not reached; the best is S = 0.000"));
  CHECK(mentions(text, "of each copy comes down on 'top' of the copy below"));
  CHECK(mentions(text, "\n  'leg_1' is fixed, or symmetric to a part that is (12 edits)\n"));
}

TEST_CASE("where the search met nothing, what stood against the edits of the best design is told") {
  const StructuredShape table = structures::table();
  const auto space = deformation_model(table);
  Requirements requirements = designs::frame_requirements(0.8);
  requirements.kept_parts = all_parts(table);
  const RequirementChecker checker(*space, requirements);
  const Diagnosis diagnosis = diagnose(checker, stuck_at_rest(checker));
  REQUIRE_FALSE(diagnosis.constraints.empty());
  CHECK(diagnosis.constraints.front().obstacle == diagnosis.blockers.front().obstacle);
  CHECK(diagnosis.constraints.front().count > 0);
}

TEST_CASE("a check that keeps the best design from being a solution comes before what met edits") {
  const designs::Still space(designs::two_cubes(), DeformationKind::surface);
  const RequirementChecker checker(space, designs::frame_requirements(-1));
  BestFirstResult result;
  Candidate apart;
  apart.design = space.at_rest();
  apart.design.shape.vertices.bottomRows(8).col(1).array() += 0.5;
  apart.direction = Eigen::Vector3d::UnitZ();
  apart.measured = checker.measure(apart.design.shape, Direction(0, 0, 1));
  result.nearest = {apart};
  const Obstacle relations = Check{CheckKind::relations}, height = Check{CheckKind::height};
  result.refusals = {{Refusal{.cause = RefusalCause::unchanged}, 12}, {height, 3}};
  std::vector<ObstacleCount> told = diagnose(checker, result).constraints;
  REQUIRE(told.size() == 3);
  CHECK(told[0].obstacle == relations);
  CHECK(told[0].count == 1);
  CHECK(told[1].count == 12);
  // A check that the search has met as well is told once, with its count.
  result.refusals[1].obstacle = relations;
  told = diagnose(checker, result).constraints;
  REQUIRE(told.size() == 2);
  CHECK(told[0].obstacle == relations);
  CHECK(told[0].count == 3);
}

TEST_CASE("obstacles and contacts that read the same are told once") {
  StructuredShape cubes = designs::two_cubes();
  const auto symmetric_about = [](const Eigen::Vector3d& normal) {
    Relation relation;
    relation.type = RelationType::self_symmetry;
    relation.parts = {0};
    relation.symmetry.axis = normal;
    return relation;
  };
  cubes.structure.relations = {symmetric_about(Eigen::Vector3d::UnitX()),
                               symmetric_about(Eigen::Vector3d::UnitY())};
  const designs::Still space(cubes, DeformationKind::surface);
  const RequirementChecker checker(space, designs::frame_requirements(-1));
  Candidate rest;
  rest.design = space.at_rest();
  rest.direction = Eigen::Vector3d::UnitZ();
  rest.measured = checker.measure(rest.design.shape, Direction(0, 0, 1));
  rest.measured.value = -2;
  BestFirstResult result;
  result.nearest = {rest};
  Refusal about_x{.cause = RefusalCause::symmetry, .part = 0, .relation = 0}, about_y = about_x;
  about_y.relation = 1;
  result.refusals = {{Refusal{.cause = RefusalCause::unchanged}, 30}, {about_x, 24}, {about_y, 12}};
  const std::vector<ObstacleCount> told = diagnose(checker, result).constraints;
  REQUIRE(told.size() == 2);
  CHECK(told[0].obstacle == Obstacle(about_x));
  CHECK(told[0].count == 36);

  Diagnosis diagnosis;
  const Blocker blocker{.upper_part = 0, .lower_part = 0, .obstacle = {}};
  diagnosis.blockers = {blocker, blocker};
  const std::string words = text(diagnosis, cubes.structure), line = describe(blocker, cubes.structure);
  REQUIRE(mentions(words, line));
  CHECK(words.find(line) == words.rfind(line));
}

TEST_CASE("what came very near to the target is told from it") {
  Diagnosis diagnosis;
  diagnosis.target = 0.4;
  diagnosis.reached = 0.39988;
  CHECK(mentions(text(diagnosis, structures::table().structure),
                 "S = 0.400 was not reached; the best is S = 0.3999 along z."));
}

TEST_CASE("where one more edit gave a better design, that is the best") {
  Diagnosis diagnosis;
  diagnosis.target = 0.6;
  diagnosis.reached = 0.52;
  diagnosis.better.emplace();
  diagnosis.better->measured.value = 0.55;
  CHECK_FALSE(mentions(text(diagnosis, structures::table().structure), "Without its last edit"));
  Blocker blocker;
  blocker.upper_part = blocker.lower_part = 0;
  diagnosis.blockers = {blocker};
  const std::string words = text(diagnosis, structures::table().structure);
  CHECK(mentions(words,
                 "S = 0.600 was not reached; the best is S = 0.550 along z.\n"
                 "Without its last edit it has S = 0.520, and this holds it:\n"));
}

TEST_CASE("every outcome of the edits against a blocker, and every remedy, has its words") {
  const Structure table = structures::table().structure;
  const Refusal refusal{.cause = RefusalCause::fixed_part,
                        .part = structures::part_named(structures::table(), "top")};
  const std::vector<std::pair<Blocker::Edits, std::string>> reasons = {
      {Blocker::Edits::untried, ""},
      {Blocker::Edits::unfinished, "time was up before every edit that may separate it was tried"},
      {Blocker::Edits::none, "no edit would separate it: symmetries and the height that is kept leave none"},
      {Blocker::Edits::helpful, "one more edit would give S = 0.613"},
      {Blocker::Edits::unhelpful,
       "edits separate it, but other contacts ask for as much, a limit stands against it, or it takes more "
       "than one"},
      {Blocker::Edits::refused,
       "every edit that would separate it is refused, most because 'top' is fixed, or symmetric to a part "
       "that "
       "is"}};
  REQUIRE(reasons.size() == static_cast<std::size_t>(Blocker::Edits::refused) + 1);
  for (const auto& [edits, words] : reasons) {
    const Blocker blocker{
        .upper_part = 0, .lower_part = 0, .edits = edits, .best_stackability = 0.6129, .obstacle = refusal};
    CHECK(reason_of(blocker, table) == words);
    CHECK(mentions(describe(blocker, table), "leave S = 0.000" + (words.empty() ? "." : ": " + words + ".")));
  }
  const std::vector<std::pair<Remedy::Kind, std::string>> remedies = {
      {Remedy::Kind::other_direction, "stack along x, without any edit"},
      {Remedy::Kind::free_part, "let 'leg_1', 'leg_2' and 'top' change"},
      {Remedy::Kind::remove_part, "leave out 'leg_1', 'leg_2' and 'top'"},
      {Remedy::Kind::take_apart, "take off 'leg_1', 'leg_2' and 'top' and stack the pieces apart"},
      {Remedy::Kind::relax_height, "let the height change"},
      {Remedy::Kind::relax_box, "let the box change"},
      {Remedy::Kind::relax_quality, "--relax size"}};
  REQUIRE(remedies.size() == static_cast<std::size_t>(Remedy::Kind::relax_quality) + 1);
  std::vector<int> parts;
  for (const char* name : {"leg_1", "leg_2", "top"})
    parts.push_back(structures::part_named(structures::table(), name));
  for (const auto& [kind, words] : remedies)
    CHECK(describe(Remedy{kind, parts, QualityMeasure::size, Eigen::Vector3d::UnitX(), 0}, table) == words);
}

TEST_CASE("freeing the legs is what lets a table sink deeper") {
  const StructuredShape table = structures::table();
  const auto space = deformation_model(table);
  Requirements requirements = designs::frame_requirements(0.8);
  for (const char* leg : {"leg_1", "leg_2", "leg_3", "leg_4"})
    requirements.kept_parts.push_back(structures::part_named(table, leg));
  const RequirementChecker checker(*space, requirements);
  const Diagnosis diagnosis = diagnose(checker, stuck_at_rest(checker));
  const Remedy* freed = remedy_of(diagnosis, Remedy::Kind::free_part);
  REQUIRE(freed != nullptr);
  CHECK(freed->parts == requirements.kept_parts);
  CHECK(freed->stackability > 0.01);

  // The same demand, said the other way round.
  Requirements others = designs::frame_requirements(0.8);
  for (const int part : all_parts(table))
    if (std::count(requirements.kept_parts.begin(), requirements.kept_parts.end(), part) == 0)
      others.editable_parts.push_back(part);
  const RequirementChecker same(*space, others);
  const Diagnosis again = diagnose(same, stuck_at_rest(same));
  REQUIRE(remedy_of(again, Remedy::Kind::free_part) != nullptr);
  CHECK(remedy_of(again, Remedy::Kind::free_part)->stackability == freed->stackability);
}

TEST_CASE("nothing that must stay is offered to be left out or freed without need") {
  const StructuredShape table = structures::table();
  const auto space = deformation_model(table);
  const RequirementChecker checker(*space, designs::frame_requirements(0.8));
  const Diagnosis diagnosis = diagnose(checker, stuck_at_rest(checker));
  CHECK(remedy_of(diagnosis, Remedy::Kind::free_part) == nullptr);
  for (std::size_t k = 0; k < diagnosis.remedies.size(); ++k) {
    CHECK(diagnosis.remedies[k].stackability > diagnosis.reached);
    if (k > 0) CHECK(diagnosis.remedies[k].stackability <= diagnosis.remedies[k - 1].stackability);
  }
  REQUIRE(diagnosis.blockers.size() == 1);
  CHECK(diagnosis.blockers.front().edits != Blocker::Edits::untried);
  CHECK(diagnosis.blockers.front().edits != Blocker::Edits::refused);
}

TEST_CASE("an edit helps only where it keeps every requirement, also those on the whole") {
  const StructuredShape table = structures::table();
  const auto space = deformation_model(table);
  Requirements requirements = designs::frame_requirements(0.8);
  requirements.standing_copies = 2;
  for (const double degrees : {1.0, 89.0}) {
    CAPTURE(degrees);
    requirements.min_tipping_degrees = degrees;
    const RequirementChecker checker(*space, requirements);
    const Diagnosis diagnosis = diagnose(checker, stuck_at_rest(checker));
    REQUIRE(diagnosis.blockers.size() == 1);
    const Blocker& blocker = diagnosis.blockers.front();
    if (degrees > 45) {
      CHECK(blocker.edits != Blocker::Edits::helpful);
      CHECK(blocker.best_stackability == diagnosis.reached);
      CHECK_FALSE(diagnosis.better);
      continue;
    }
    CHECK(blocker.edits == Blocker::Edits::helpful);
    REQUIRE(diagnosis.better);
    CHECK(diagnosis.better->measured.value == Approx(blocker.best_stackability).epsilon(1e-12));
    for (const Check& check : checker.check(diagnosis.better->design, Direction(0, 0, 1)).checks)
      CHECK((check.passed || check.is_of_target()));
  }
}

TEST_CASE("what saves most when it is taken off is offered, with the S of its pieces") {
  const StructuredShape mug = structures::mug();
  const auto space = deformation_model(mug);
  const RequirementChecker checker(*space, designs::frame_requirements(0.99));
  const Diagnosis diagnosis = diagnose(checker, stuck_at_rest(checker));
  const Remedy* apart = remedy_of(diagnosis, Remedy::Kind::take_apart);
  PartitionOptions options;
  options.measure = checker.requirements().measure;
  const std::vector<Partition> found = suggested_partitions(mug, options);
  REQUIRE(found.size() == 1);
  REQUIRE(found.front().stackability > diagnosis.reached + 0.01);
  REQUIRE(apart != nullptr);
  CHECK(apart->parts == std::vector<int>{1});
  CHECK(apart->stackability == found.front().stackability);
  REQUIRE(apart->pieces.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(apart->pieces[k].parts == found.front().pieces[k].parts);
    CHECK(apart->pieces[k].stackability == found.front().pieces[k].stackability);
  }
}

TEST_CASE("a box that lies on its side is better stacked another way") {
  // Copies of a stretched L nest along its diagonal, not along its arms.
  StructuredShape l = structures::box_alone({4, 1, 4});
  l.shape = solids::l_shape(4, 0.5);
  l.shape.part_names = {"box"};
  const auto space = deformation_model(l);
  const RequirementChecker checker(*space, designs::frame_requirements(0.9));
  const Diagnosis diagnosis = diagnose(checker, stuck_at_rest(checker));
  const Remedy* other = remedy_of(diagnosis, Remedy::Kind::other_direction);
  REQUIRE(other != nullptr);
  CHECK(other->stackability > 0.3);
  CHECK(checker.measure(l.shape, Direction(other->direction)).value == Approx(other->stackability));
  CHECK(mentions(stackabilization::text(diagnosis, l.structure), "stack along ("));
}

}  // namespace
}  // namespace stackabilization
