#include <cmath>
#include <numbers>

#include "apps/common/edit_grammar.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"
#include "support/messages.h"

using namespace stackabilization;
using namespace stackabilization::apps;

namespace {

const std::vector<std::string> parts = {"body",     "leg_1", "left leg", "it's",    "shape", "point=3",
                                        "a/face=1", "a",     "room/leg", "a/b c'd", "move"};

Handle handle_of(const std::string& text) {
  return parse_edit(text + " scale 1", parts).handle;
}

std::string sentence_about(const std::string& text) {
  return message_of<UsageError>([&] { parse_edit(text, parts); });
}

}  // namespace

TEST_CASE("every kind of handle has its spelling") {
  CHECK(handle_of("body") == Handle{HandleKind::part, 0, 0});
  CHECK(handle_of("leg_1/face=-x") == Handle{HandleKind::face, 1, 0});
  CHECK(handle_of("leg_1/face=+x") == Handle{HandleKind::face, 1, 1});
  CHECK(handle_of("leg_1/face=-z") == Handle{HandleKind::face, 1, 4});
  CHECK(handle_of("leg_1/face=5") == Handle{HandleKind::face, 1, 5});
  CHECK(handle_of("leg_1/corner=7") == Handle{HandleKind::corner, 1, 7});
  CHECK(handle_of("body/section=12") == Handle{HandleKind::section, 0, 12});
  CHECK(handle_of("room/leg/section=0") == Handle{HandleKind::section, 8, 0});
  CHECK(handle_of("room/leg") == Handle{HandleKind::part, 8, 0});
  CHECK(handle_of("point=345") == Handle{HandleKind::point, 0, 345});
  CHECK(handle_of("wire=2") == Handle{HandleKind::wire, 0, 2});
  CHECK(handle_of("shape") == Handle{HandleKind::shape, 0, 0});
  CHECK(handle_of("move") == Handle{HandleKind::part, 10, 0});
}

TEST_CASE("quotes hold names with blanks and names that read as something else") {
  CHECK(handle_of("'left leg'") == Handle{HandleKind::part, 2, 0});
  CHECK(handle_of("'left leg'/face=+y") == Handle{HandleKind::face, 2, 3});
  CHECK(handle_of("'it''s'") == Handle{HandleKind::part, 3, 0});
  CHECK(handle_of("it's") == Handle{HandleKind::part, 3, 0});
  CHECK(handle_of("'shape'") == Handle{HandleKind::part, 4, 0});
  CHECK(handle_of("'point=3'/corner=1") == Handle{HandleKind::corner, 5, 1});
  CHECK(handle_of("'a/face=1'") == Handle{HandleKind::part, 6, 0});
  CHECK(handle_of("a/face=1") == Handle{HandleKind::face, 7, 1});
  CHECK(handle_of("'a/face=1'/face=2") == Handle{HandleKind::face, 6, 2});
}

TEST_CASE("operations carry their numbers exactly, angles in degrees") {
  const Edit move = parse_edit("  body \t move 0.1 -2 1e-3 ", parts);
  CHECK(std::get<Move>(move.operation).by == Eigen::Vector3d(0.1, -2, 1e-3));
  for (const char* text : {"shape taper 0.9 towards 0 0 -1", "shape taper 1.25 towards 0 0 1 along 1 0 0",
                           "body lean 0.1 -0.25 0 towards 0 0 -1"})
    CHECK(edit_text(parse_edit(text, parts), parts) == text);
  const Edit turn = parse_edit("leg_1 rotate 90 about 0 0 2", parts);
  CHECK(std::get<Rotate>(turn.operation).radians == Approx(std::numbers::pi / 2).epsilon(1e-15));
  CHECK(std::get<Rotate>(turn.operation).axis == Eigen::Vector3d(0, 0, 2));
  CHECK_FALSE(std::get<Scale>(parse_edit("body scale 0.95", parts).operation).along.has_value());
  const Edit stretch = parse_edit("shape scale 1.1 along 1 0 -1", parts);
  CHECK(std::get<Scale>(stretch.operation).factor == 1.1);
  CHECK(std::get<Scale>(stretch.operation).along.value() == Eigen::Vector3d(1, 0, -1));
}

TEST_CASE("a falloff is the last word of what is done to a cross-section") {
  for (const std::string text :
       {"body/section=2 move 1 0 0.5 linearly", "'left leg'/section=0 scale 0.8 linearly"}) {
    const Edit edit = parse_edit(text, parts);
    CHECK(edit.falloff == Falloff::linear);
    CHECK(edit_text(edit, parts) == text);
  }
  CHECK(parse_edit("body/section=2 move 1 0 0.5", parts).falloff == Falloff::gaussian);
  CHECK(edit_text({{HandleKind::part, 0, 0}, Scale{0.5, {}}, Falloff::linear}, parts) == "body scale 0.5");
}

TEST_CASE("an edit that is printed is parsed as itself") {
  std::vector<Handle> handles = {
      {HandleKind::point, 0, 9}, {HandleKind::wire, 0, 0}, {HandleKind::shape, 0, 0}};
  for (int part = 0; part < static_cast<int>(parts.size()); ++part) {
    handles.push_back({HandleKind::part, part, 0});
    for (int face = 0; face < 6; ++face) handles.push_back({HandleKind::face, part, face});
    handles.push_back({HandleKind::corner, part, 6});
    handles.push_back({HandleKind::section, part, 23});
  }
  std::vector<Operation> operations = {Move{{1.0 / 3, -1e-17, 2e300}}, Scale{0.1 + 0.2, {}},
                                       Scale{7, Eigen::Vector3d(1, 1.0 / 7, 0)}};
  for (const char* degrees : {"5", "-90", "0.1", "33.3333333333", "1e-5", "720"})
    operations.push_back(
        parse_edit(std::string("body rotate ") + degrees + " about 0.3 0 1", parts).operation);
  for (const Handle& handle : handles)
    for (const Operation& operation : operations) {
      const std::string text = edit_text({handle, operation}, parts);
      INFO(text);
      const Edit again = parse_edit(text, parts);
      CHECK(again.handle == handle);
      REQUIRE(again.operation.index() == operation.index());
      if (const auto* turn = std::get_if<Rotate>(&operation))
        CHECK(std::get<Rotate>(again.operation).radians == turn->radians);
      CHECK(edit_text(again, parts) == text);
    }
  CHECK(edit_text(parse_edit("leg_1/face=4 rotate 5 about 0 0 1", parts), parts) ==
        "leg_1/face=-z rotate 5 about 0 0 1");
  CHECK(edit_text(parse_edit("body rotate 120 about 0 0 1", parts), parts) == "body rotate 120 about 0 0 1");
}

TEST_CASE("a mistake is named by its word and by what was expected") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "found nothing"},
      {"body", "expected move, rotate, scale, taper or lean, found the end"},
      {"body shove 1 0 0", "expected move, rotate, scale, taper or lean, found 'shove'"},
      {"leg_9 move 1 0 0",
       "expected a part, shape, point=N or wire=N, and there is no part 'leg_9', only 'leg_1', "},
      {"left leg move 1 0 0", "there is no part 'left'"},
      {"'left leg move 1 0 0", "expected a closing '"},
      {"'left leg'x move 1 0 0", "after the quoted part, found 'x'"},
      {"body/face=up move 1 0 0", "+z or a number from 0 to 5, found 'up'"},
      {"body/face=6 move 1 0 0", "a number from 0 to 5, found '6'"},
      {"body/corner=8 move 1 0 0", "corner= expects a whole number from 0 to 7, found '8'"},
      {"body/section=-1 move 1 0 0", "section= expects a whole number"},
      {"body/side=1 move 1 0 0", "there is no part 'body/side=1'"},
      {"point=x move 1 0 0", "point= expects a whole number"},
      {"wire=99999999999 move 1 0 0", "wire= expects a whole number"},
      {"body move 1 0", "move expects three numbers, found 2"},
      {"body move 1 0 up", "move expects a finite number, found 'up'"},
      {"body move 1 0 nan", "move expects a finite number, found 'nan'"},
      {"body move 1 0 0 0", "expected nothing after 0, found '0'"},
      {"body rotate 5", "expected about after 5, found the end"},
      {"body rotate 5 0 0 1", "expected about after 5, found '0'"},
      {"body rotate 5 about 0 0 0", "axis that is not zero"},
      {"body rotate about 0 0 1", "rotate expects a finite number, found 'about'"},
      {"body scale", "scale expects a number, found the end"},
      {"body scale 0", "positive factor"},
      {"body scale -2", "positive factor"},
      {"body scale 2 by 1 0 0", "expected along after 2, found 'by'"},
      {"body scale 2 along 0 0 0", "not zero"},
      {"body scale 2 linearly", "expected linearly after moves and scalings of cross-sections only"},
      {"body/section=1 rotate 5 about 0 0 1 linearly", "of cross-sections only"},
      {"body/section=1 move 1 0 0 slowly", "expected nothing after 0, found 'slowly'"},
      {"body/section=1 scale 2 linearly 3", "expected nothing after linearly, found '3'"},
      {"body scale 2 along 1 0", "along expects three numbers, found 2"},
  };
  for (const auto& [text, words] : cases) {
    const std::string sentence = sentence_about(text);
    INFO(sentence);
    CHECK(sentence.find(words) != std::string::npos);
    CHECK(sentence.starts_with("the edit \"" + text + "\": "));
  }
}
