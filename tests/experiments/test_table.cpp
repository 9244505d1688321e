#include <charconv>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/table.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

const Provenance source{"program", "directions = 3", 2};

/// The lines of a CSV text after its comments.
std::vector<std::string> lines_of(const std::string& csv) {
  std::vector<std::string> lines;
  std::istringstream stream(csv);
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with("#")) lines.push_back(line);
  return lines;
}

Table timed_table(double milliseconds) {
  Table table({{"model", ColumnKind::key}, {"S"}, {"cpu_ms", ColumnKind::clock}});
  table.add({"cup", 0.5, milliseconds});
  return table;
}

}  // namespace

TEST_CASE("cells are written by their kind") {
  Table table(columns({"text", "real", "whole", "truth", "nothing"}));
  table.add({"cup", 0.25, std::int64_t{3}, true, {}});
  CHECK(lines_of(csv_text(table, source)) ==
        std::vector<std::string>{"text,real,whole,truth,nothing", "cup,0.25,3,1,"});
  const auto row = nlohmann::json::parse(json_text(table, source))["rows"][0];
  CHECK(row["text"] == "cup");
  CHECK(row["real"] == 0.25);
  CHECK(row["whole"].is_number_integer());
  CHECK(row["truth"] == true);
  CHECK(row["nothing"].is_null());
}

TEST_CASE("reals read back to the same bits") {
  for (const double value : {1.0 / 3, 0.1, -2.5e-300, 5e-324, 1.7976931348623157e308, -0.0}) {
    Table table(columns({"value"}));
    table.add({value});
    const std::string text = lines_of(csv_text(table, source)).at(1);
    double read = 0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    CHECK(std::memcmp(&read, &value, sizeof value) == 0);
    CHECK(nlohmann::json::parse(json_text(table, source))["rows"][0]["value"].get<double>() == value);
  }
}

TEST_CASE("what is no number is an empty place") {
  Table table(columns({"a", "b", "c"}));
  table.add({std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1.0});
  CHECK(lines_of(csv_text(table, source)).at(1) == ",,1");
  CHECK(nlohmann::json::parse(json_text(table, source))["rows"][0]["a"].is_null());
}

TEST_CASE("texts with commas, quotes and line ends stay in their place") {
  Table table(columns({"a", "b"}));
  table.add({"one, two", "he said \"no\""});
  CHECK(lines_of(csv_text(table, source)).at(1) == "\"one, two\",\"he said \"\"no\"\"\"");
  Table lines(columns({"a"}));
  lines.add({"x\ny"});
  CHECK(csv_text(lines, source).ends_with("a\n\"x\ny\"\n"));
}

TEST_CASE("a row of another width is refused") {
  Table table(columns({"a", "b"}));
  CHECK_THROWS_AS(table.add({1.0}), UsageError);
  CHECK(table.rows().empty());
}

TEST_CASE("two runs differ in their clocks only") {
  const Table quick = timed_table(1), slow = timed_table(7);
  CHECK(quick.has_clocks());
  CHECK(csv_text(quick.without_clocks(), source) == csv_text(slow.without_clocks(), source));
  CHECK(json_text(quick.without_clocks(), source) == json_text(slow.without_clocks(), source));
  CHECK_FALSE(quick.without_clocks().has_clocks());
  CHECK(lines_of(csv_text(slow.clocks(), source)) == std::vector<std::string>{"model,cpu_ms", "cup,7"});
}

TEST_CASE("every table says where it comes from") {
  const std::string csv = csv_text(timed_table(1), source);
  const auto document = nlohmann::json::parse(json_text(timed_table(1), source));
  for (const std::string key :
       {"program", "options", "threads", "processor", "compiler", "version", "revision"}) {
    CHECK(csv.find("# " + key + ": ") != std::string::npos);
    CHECK_FALSE(document["provenance"][key].get<std::string>().empty());
  }
  CHECK(document["provenance"]["options"] == "directions = 3");
  CHECK(document["columns"] == nlohmann::json({"model", "S", "cpu_ms"}));
}
