#include <string>
#include <vector>

#include "stackabilization/improvement/checks.h"
#include "support/catch.h"

namespace stackabilization {
namespace {

Structure two_parts() {
  Structure structure;
  structure.parts = {{"leg", {}, {}}, {"seat", {}, {}}};
  structure.relations = {{.type = RelationType::line_joint, .parts = {0, 1}, .symmetry = {}, .points = {}},
                         {.type = RelationType::self_symmetry, .parts = {1}, .symmetry = {}, .points = {}}};
  structure.diagonal = 10;
  return structure;
}

std::string note(CheckKind kind, int where, bool passed = false) {
  return note_of({kind, 1, 2, passed, where, 5}, two_parts());
}

TEST_CASE("violations are positive where a check fails, whichever side its limit is on") {
  using enum CheckKind;
  for (const CheckKind kind : {target, proportions, thickness, draft, standing, resting}) {
    INFO(name_of(Check{kind}));
    CHECK(violation({kind, 1, 2, false}) == Approx(0.5));
    CHECK(violation({kind, 3, 2, true}) == Approx(-0.5));
  }
  for (const CheckKind kind : {room, height, relations, box, parts, jam}) {
    INFO(name_of(Check{kind}));
    CHECK(violation({kind, 3, 2, false}) == Approx(0.5));
    CHECK(violation({kind, 1, 2, true}) == Approx(-0.5));
  }
  CHECK(violation({jam, 0.25, 0, false}) == Approx(0.25));
  CHECK(violation({jam, 0, 0, true}) == 0);
}

TEST_CASE("every requirement has its name, its unit and a note") {
  struct Words {
    CheckKind kind;
    std::string name, unit, note;
  };
  using enum CheckKind;
  const std::vector<Words> all = {{target, "target", "", ""},
                                  {room, "room", "model units", ""},
                                  {height, "height", "of the height", ""},
                                  {relations, "relations", "of the diagonal", "self-symmetry of 'seat'"},
                                  {proportions, "proportions", "of the size at rest", "'seat'"},
                                  {box, "box", "of a side", "along y"},
                                  {parts, "parts", "of the diagonal", "'seat'"},
                                  {thickness, "thickness", "model units", "'seat'"},
                                  {draft, "draft", "degrees", ""},
                                  {standing, "standing", "degrees", "copy 2 of 5 goes first"},
                                  {jam, "jam", "of the force", "'seat'"},
                                  {resting, "resting", "of the height", "'seat'"},
                                  {quality, "quality: self-intersection", "pairs of triangles", "'seat'"}};
  REQUIRE(all.size() == static_cast<std::size_t>(quality) + 1);
  for (std::size_t k = 0; k < all.size(); ++k) {
    INFO(all[k].name);
    CHECK(all[k].kind == static_cast<CheckKind>(k));
    CHECK(name_of(Check{all[k].kind}) == all[k].name);
    CHECK(unit_of(Check{all[k].kind}) == all[k].unit);
    CHECK(note(all[k].kind, all[k].note.empty() ? -1 : 1) == all[k].note);
  }
  CHECK(note(relations, 0) == "line joint of 'leg' and 'seat'");
  for (const CheckKind kind : {relations, proportions, box, parts}) CHECK(note(kind, -1).empty());
  CHECK(note(thickness, -1, true) == "nothing has a thickness");
  CHECK(note(thickness, 1, true) == "nowhere thinner than at rest");
  CHECK(note_of({thickness, 2, 2, true, 1}, two_parts()).empty());
  CHECK(note_of({thickness, 2 - 0.9e-8, 2, true, 1}, two_parts()).empty());
  CHECK(note(standing, -1) == "copies pass each other along the direction");
}

TEST_CASE("obstacles are told one by one, and counted") {
  const Structure rest = two_parts();
  const Refusal fixed{.cause = RefusalCause::fixed_part, .part = 0};
  CHECK(describe(Obstacle(fixed), rest) == "'leg' is fixed, or symmetric to a part that is");
  CHECK(describe(Obstacle(Check{CheckKind::box, 1, 0, false, 2}), rest) ==
        "the requirement 'box' would not hold: along z");
  CHECK(describe(Obstacle(Check{CheckKind::draft}), rest) == "the requirement 'draft' would not hold");
  CHECK(describe(ObstacleCount{fixed, 1}, rest) == "'leg' is fixed, or symmetric to a part that is (1 edit)");
  CHECK(describe(ObstacleCount{Check{CheckKind::draft}, 2}, rest) ==
        "a design that reaches the target fails its check of: draft (2 edits)");

  const Refusal other{.cause = RefusalCause::fixed_part, .part = 1};
  std::vector<ObstacleCount> counts = {
      {Check{CheckKind::draft}, 2}, {other, 2}, {fixed, 2}, {Refusal{RefusalCause::unchanged}, 3}};
  sort_by_count(counts, rest);
  CHECK(counts[0].obstacle == Obstacle(Refusal{RefusalCause::unchanged}));
  CHECK(counts[1].obstacle == Obstacle(fixed));
  CHECK(counts[2].obstacle == Obstacle(other));
  CHECK(counts[3].obstacle == Obstacle(Check{CheckKind::draft}));
}

}  // namespace
}  // namespace stackabilization
