#include "stackabilization/core/errors.h"
#include "stackabilization/core/part_names.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace stackabilization;

TEST_CASE("parts are found by their names, in order and each once", "[part_names]") {
  Shape shape = test::two_tetrahedra();
  shape.part_names = {"leg", "seat", "back"};
  CHECK(parts_named(shape, {"back", "leg", "back"}) == std::vector{0, 2});
  CHECK(parts_named(shape, {}).empty());
}

TEST_CASE("the name of a part that was cut stands for its members", "[part_names]") {
  Shape shape = test::two_tetrahedra();
  shape.part_names = {"leg", "frame.1", "frame.x", "frame.12", "frames.1"};
  CHECK(member_name("frame", 12) == "frame.12");
  CHECK(parts_named(shape, {"frame"}) == std::vector{1, 3});
  CHECK(parts_named(shape, {"frame.12", "leg"}) == std::vector{0, 3});
  CHECK_THROWS_AS(parts_named(shape, {"frame."}), InputError);
}

TEST_CASE("a name that no part has is answered with the parts that there are, the nearest first",
          "[part_names]") {
  Shape shape = test::two_tetrahedra();
  shape.part_names = {"back", "seat", "leg"};
  std::string refusal;
  try {
    parts_named(shape, {"seat", "Leg_"});
  } catch (const InputError& error) {
    refusal = error.what();
  }
  CHECK(refusal == "there is no part 'Leg_', only 'leg', 'seat', 'back'");
  CHECK(unknown_part({"back", "seat"}, "SEAT") == "there is no part 'SEAT', only 'seat', 'back'");
  CHECK(unknown_part({"a\nb", "\xc3\xa4"}, "c") == "there is no part 'c', only '\xc3\xa4', 'a?b'");
}

TEST_CASE("of many parts some are listed, of parts without names it is said how to see them",
          "[part_names]") {
  std::vector<std::string> names;
  for (int k = 0; k < 5000; ++k) names.push_back("board " + std::to_string(k));
  const std::string many = unknown_part(names, "board 1234x");
  CHECK(many.starts_with("there is no part 'board 1234x', only 'board 1234', "));
  CHECK(many.ends_with(" and 4988 more"));
  CHECK(many.size() < 400);
  CHECK(unknown_part({"part_1", "part_2"}, "seat").find("stackabilize structure --picture") !=
        std::string::npos);
  CHECK(unknown_part({"part_1", "part_"}, "seat").find("structure") == std::string::npos);
}
