#include "stackabilization/core/errors.h"
#include "stackabilization/structure/seeds.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;

TEST_CASE("seeds are read part by part, in order of first use") {
  const Shape box = solids::box({1, 2, 3});
  const std::vector<PartSeeds> parts =
      parse_seeds("# marked by hand\nlid 11 0\n\n  base\t3\r\nlid 4\n", "marks.txt", box);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].name == "lid");
  CHECK(parts[0].triangles == std::vector<std::int32_t>{11, 0, 4});
  CHECK(parts[1].name == "base");
  CHECK(parts[1].triangles == std::vector<std::int32_t>{3});
}

TEST_CASE("a mistake among seeds is told with its line and what was expected") {
  const Shape box = solids::box({1, 2, 3});
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "expected parts with their triangles, found none"},
      {"# nothing\n", "found none"},
      {"lid\n", "marks.txt:1: expected a part and its triangles, found 'lid' alone"},
      {"lid 1\nbase 12\n", "marks.txt:2: expected a triangle between 0 and 11, found '12'"},
      {"lid -1\n", "between 0 and 11, found '-1'"},
      {"lid 1.5\n", "found '1.5'"},
      {"lid 99999999999999999999\n", "between 0 and 11"},
      {"lid 1 2\nbase 2\n", "marks.txt:2: triangle 2 is listed already"},
      {"lid 1 1\n", "listed already"},
  };
  for (const auto& [text, words] : cases) {
    std::string sentence;
    try {
      parse_seeds(text, "marks.txt", box);
    } catch (const InputError& error) {
      sentence = error.what();
    }
    INFO(sentence);
    CHECK(sentence.find(words) != std::string::npos);
  }
  CHECK_THROWS_AS(read_seeds("no_such_file.txt", box), InputError);
}
