#include <sstream>
#include <utility>

#include "paper_figures/folder.h"
#include "paper_figures/page.h"
#include "paper_figures/run.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::figures;

namespace {

RunOptions options_for(const Folder& output, std::vector<int> figures) {
  RunOptions options;
  options.figures = std::move(figures);
  options.inputs = std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "paper_figures";
  options.models = std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "data/models";
  options.output = output.path();
  return options;
}

RunReport report_of(const RunOptions& options) {
  std::ostringstream log;
  return make_figures(options, log);
}

}  // namespace

TEST_CASE("two runs of a figure write the same bytes, and its page says the numbers of the run") {
  const Folder first, second;
  CHECK(report_of(options_for(first, {2})).figures == 1);
  CHECK(report_of(options_for(second, {2})).figures == 1);
  for (const std::string name : {"figure_02.png", "figure_02.numbers.json"}) {
    CHECK(bytes_of(first.path() / name).size() > 100);
    CHECK(bytes_of(first.path() / name) == bytes_of(second.path() / name));
  }
  const Json json = Json::parse(bytes_of(first.path() / "figure_02.numbers.json"));
  CHECK(json["figure"] == 2);
  CHECK(json["models"] == "own");
  CHECK(json.dump().find("second") == std::string::npos);  // no clock

  const std::filesystem::path inputs = options_for(first, {}).inputs;
  const std::string page = figures_page({inputs, first.path(), first.path() / "sub" / "figures.md"});
  CHECK(page.find("](../figure_02.png)") != std::string::npos);
  CHECK(page.find("| h | 0.4595 m |") != std::string::npos);
  CHECK(page.find("## Figure 7") == std::string::npos);

  // Numbers are read, not made up: other numbers give another page.
  for (const auto& [number, says] :
       {std::pair{"0.7777", "| h | 0.7777 m |"}, std::pair{"-3.4e-15", "| h | 0 m |"}}) {
    std::string numbers = bytes_of(second.path() / "figure_02.numbers.json");
    numbers.replace(numbers.find("0.4595"), 6, number);
    first.file("figure_02.numbers.json", numbers);
    CHECK(figures_page({inputs, first.path(), first.path() / "figures.md"}).find(says) != std::string::npos);
  }
  first.file("figure_02.numbers.json", "{\"figure\": 2}");
  CHECK_THROWS_AS(figures_page({inputs, first.path(), first.path() / "figures.md"}), InputError);
}

TEST_CASE("the page says what differs on the models that a figure was made from") {
  const Folder folder;
  const auto page_of = [&](const std::string& models) {
    const Json numbers = {
        {"figure", 11}, {"models", models}, {"numbers", Json::array()}, {"claims", Json::array()}};
    folder.file("figure_11.numbers.json", numbers.dump());
    return figures_page({options_for(folder, {}).inputs, folder.path(), folder.path() / "figures.md"});
  };
  CHECK(page_of("own").find("*Known difference:* The table is this project's model") != std::string::npos);
  CHECK(page_of("authors").find("*Known difference:* The table is the authors'") != std::string::npos);
  CHECK(page_of("authors").find("this project's model without") == std::string::npos);
}

TEST_CASE("a model that is damaged is one sentence, and the other figures are made") {
  const Folder output, models;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "data/models"))
    std::filesystem::copy(entry.path(), models.path() / entry.path().filename());
  models.file("stool.obj", "v 0 0 0\nf 1 2 3\n");
  RunOptions options = options_for(output, {2, 7});
  options.models = models.path();
  const RunReport report = report_of(options);
  CHECK(report.figures == 1);
  REQUIRE(report.failures.size() == 1);
  CHECK(report.failures[0].starts_with("figure 2: "));
  CHECK(report.failures[0].find("stool.obj") != std::string::npos);
  CHECK(!std::filesystem::exists(output.path() / "figure_02.png"));
  CHECK(std::filesystem::exists(output.path() / "figure_07.png"));
}

TEST_CASE("folders and figures that do not exist are refused before anything is made") {
  const Folder output;
  CHECK_THROWS_AS(report_of(options_for(output, {99})), UsageError);
  RunOptions missing = options_for(output, {2});
  missing.models = output.path() / "nowhere";
  CHECK_THROWS_AS(report_of(missing), InputError);
  missing = options_for(output, {2});
  missing.paper_data = output.path() / "nowhere";
  CHECK_THROWS_AS(report_of(missing), InputError);
  missing = options_for(output, {2});
  missing.inputs = output.path() / "nowhere";
  CHECK_THROWS_AS(report_of(missing), InputError);
  RunOptions blocked = options_for(output, {2});
  blocked.output = output.file("file", "") / "folder";
  CHECK_THROWS_AS(report_of(blocked), OutputError);
  CHECK_THROWS_AS(figures_page({options_for(output, {}).inputs, output.path(), output.path() / "figures.md"}),
                  InputError);
  CHECK(std::distance(std::filesystem::directory_iterator(output.path()), {}) == 1);
}
