#include <string>
#include <vector>

#include "improvement/explanation/part_phrases.h"
#include "support/catch.h"

using namespace stackabilization::detail;

namespace {

std::string phrase(const std::vector<std::string>& names, const std::vector<int>& parts) {
  return PartPhrases(names, std::vector<std::string>(names.size(), "bar")).phrase(parts).words;
}

}  // namespace

TEST_CASE("Parts are called by the words that they share", "[explanation]") {
  const std::vector<std::string> chair = {
      "leg_back_left", "leg_back_right", "leg_front_left", "leg_front_right", "seat",  "rail_left",
      "rail_right",    "rail_back",      "slat_1",         "slat_2",          "slat_3"};
  CHECK(phrase(chair, {0, 1, 2, 3}) == "4 legs");
  CHECK(phrase(chair, {0, 1}) == "2 back legs");
  CHECK(phrase(chair, {0, 3}) == "back left and front right legs");
  CHECK(phrase(chair, {0}) == "back left leg");
  CHECK(phrase(chair, {4}) == "seat");
  CHECK(phrase(chair, {5, 6}) == "left and right rails");
  CHECK(phrase(chair, {7}) == "back rail");
  CHECK(phrase(chair, {8, 10}) == "slats 1 and 3");
  CHECK(phrase(chair, {9}) == "slat 2");
  CHECK(phrase(chair, {4, 7}) == "seat and back rail");
}

TEST_CASE("Words of one or two letters tell parts apart as numbers do", "[explanation]") {
  const std::vector<std::string> bench = {"leg_lf", "leg_lb", "leg_rf",  "leg_rb",  "mid_l",
                                          "mid_r",  "top",    "front_l", "front_r", "post00"};
  CHECK(phrase(bench, {0, 1, 2, 3}) == "4 legs");
  CHECK(phrase(bench, {0, 1}) == "legs lf and lb");
  CHECK(phrase(bench, {2}) == "leg rf");
  CHECK(phrase(bench, {4, 5}) == "2 mids");
  CHECK(phrase(bench, {5, 8}) == "mid r and front r");
  CHECK(phrase(bench, {9}) == "post");
}

TEST_CASE("Parts without a word are called by their form", "[explanation]") {
  const std::vector<std::string> parts = {"0_part0", "1_part1", "2_part2"};
  CHECK(phrase(parts, {0, 1, 2}) == "3 bars");
  CHECK(phrase(parts, {1}) == "bar (1_part1)");
  CHECK(phrase({"part"}, {0}) == "bar");
}

TEST_CASE("A name for a side alone is a noun, and plurals keep their form", "[explanation]") {
  CHECK(phrase({"back", "back_bar"}, {1}) == "back bar");
  CHECK(phrase({"Back", "seat"}, {0}) == "back");
  CHECK(phrase({"Back", "back_bar"}, {0}) == "back");
  CHECK(phrase({"legs", "top"}, {0}) == "legs");
  CHECK(PartPhrases({"legs", "top"}, {"part", "part"}).phrase({0}).plural);
  CHECK(phrase({"box1", "box2"}, {0, 1}) == "2 boxes");
  CHECK(phrase({"body_1", "body_2"}, {0, 1}) == "2 bodies");
}
