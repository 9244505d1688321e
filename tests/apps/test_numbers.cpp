// Numbers on the command line: every option that takes one, as the help lists them, with hostile values.
#include <CLI/Error.hpp>
#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include "apps/common/program.h"
#include "apps/run_program.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;

namespace {

struct NumericOption {
  std::string command, name, kind;
};

/// Options of all commands with a value that is a number, or several.
std::vector<NumericOption> numeric_options() {
  std::vector<NumericOption> options;
  const std::regex line(
      "\n +(?:-[a-zA-Z],)?(--?[a-z][a-z-]*) (NUMBER|FRACTION|LENGTH|N|A\\|auto|X Y Z)[ \n]");
  for (const std::string& command : command_names()) {
    const std::string help = run_program({command, "--help"}).out;
    for (std::sregex_iterator match(help.begin(), help.end(), line), end; match != end; ++match)
      options.push_back({command, (*match)[1], (*match)[2]});
  }
  return options;
}

/// What a number of that kind never is. Each is a list of what stands after the name.
std::vector<Arguments> hostile_values(const NumericOption& option) {
  const Arguments words = {"nan",    "inf", "-inf",  "infinity", "1e400", "-1e400", "1e-400", "0x1p3", "0x10",
                           "\u0661", "1,5", "1.5.2", "1e",       "+-1",   "++1",    "1/2",    "one",   " 1",
                           "1 ",     "",    "1\n",   "\xff",     "--",    "1 2",    "1;2",    "1f"};
  std::vector<Arguments> values;
  if (option.kind == "X Y Z") {
    for (const std::string& word : words) values.push_back({"0", word, "1"});
    if (option.name == "--fix-point") return values;
    for (const std::string size : {"0", "1e300", "-1e300", "1e-300", "5e-324", "1e-170"})
      values.push_back({size, "0", "0"});
    return values;
  }
  Arguments more = {"-1e300", "-1e-3"};
  if (option.kind == "N") {
    more.insert(more.end(), {"-1", "1.5", "1e3", "18446744073709551616", "99999999999999999999999", "+1"});
    if (option.name != "--seed") more.push_back("18446744073709551615");
    if (option.name != "--seed" && option.name != "--expansions") more.push_back("1000000000");
  } else {
    more.push_back("1e300");
  }
  if (option.kind == "FRACTION") more.insert(more.end(), {"1.01", "101%", "-1%", "5%%", "%", "nan%"});
  if (option.kind == "LENGTH")
    more.insert(more.end(), {"1e61", "1e300m", "infm", "-1mm", "5 mm", "5league", "mm", "5mm5"});
  if (option.kind == "A|auto") more.insert(more.end(), {"AUTO", "auto ", "3601"});
  // Signed by nature.
  if (option.name == "--target" || option.kind == "A|auto") std::erase(more, "-1e-3");
  more.insert(more.end(), words.begin(), words.end());
  for (const std::string& word : more) values.push_back({word});
  return values;
}

/// "accepted", or what the program says.
std::string words_about(const Arguments& arguments) {
  try {
    Program().parse(arguments);
  } catch (const UsageError& error) {
    return error.what();
  } catch (const CLI::Error& error) {
    return error.what();
  }
  return "accepted";
}

Arguments with(const NumericOption& option, const Arguments& values) {
  Arguments arguments = {option.command, "model.obj"};
  if (option.command == "improve") arguments.insert(arguments.end(), {"-o", "folder"});
  if (option.command == "drop") arguments.insert(arguments.end(), {"--onto", "other.obj"});
  if (values.size() == 1 && option.name.starts_with("--")) {
    arguments.push_back(option.name + "=" + values.front());
  } else {
    arguments.push_back(option.name);
    arguments.insert(arguments.end(), values.begin(), values.end());
  }
  return arguments;
}

void check_finite(const nlohmann::json& json) {
  CHECK_FALSE((json.is_number_float() && !std::isfinite(json.get<double>())));
  if (json.is_structured())
    for (const auto& value : json) check_finite(value);
}

/// Runs to the end, with a sentence or with finite numbers.
void check_sane(const TemporaryFolder& folder, Arguments arguments) {
  const std::string path = folder / "result.json";
  std::filesystem::remove(path);
  arguments.insert(arguments.end(), {"--json", path});
  std::string line;
  for (const std::string& argument : arguments) line += argument + " ";
  INFO(line);
  // No run may take a gigabyte more than the program itself, or half a minute of computing.
  const Outcome outcome = run_program(arguments, "", "ulimit -t 30;");
  INFO(outcome.err << outcome.out);
  CHECK(outcome.status >= 0);
  CHECK(outcome.status <= 3);
  CHECK_FALSE(std::regex_search(outcome.out, std::regex("\\b(nan|inf)\\b")));
  CHECK(outcome.err.find("unexpected failure") == std::string::npos);
  if (outcome.status >= 2) {
    CHECK(is_one_sentence(outcome.err));
    CHECK_FALSE(std::filesystem::exists(path));
  } else {
    check_finite(nlohmann::json::parse(bytes_of(path)));
  }
}

}  // namespace

TEST_CASE("every option with a number refuses what is none, and names itself") {
  const std::vector<NumericOption> options = numeric_options();
  CHECK(options.size() > 80);
  std::set<std::string> kinds;
  for (const NumericOption& option : options) {
    kinds.insert(option.kind);
    for (const Arguments& values : hostile_values(option)) {
      const std::string words = words_about(with(option, values));
      INFO(option.command << " " << option.name << " '" << values.front() << "': " << words);
      CHECK(words != "accepted");
      // Text that is not UTF-8 may be refused before it is known whose value it is.
      CHECK((words.find(option.name) != std::string::npos || words.find("UTF-8") != std::string::npos));
      CHECK(words.find("exception") == std::string::npos);
    }
  }
  CHECK(kinds.size() == 6);
}

TEST_CASE("what is no number ends with 2 before anything is read or written") {
  const TemporaryFolder folder;
  const std::string box = folder.model("box.obj", solids::box({1, 2, 3})), missing = folder / "missing.obj";
  check_refused(folder, {"stack", missing, "-n", "1000000000"}, 2,
                "-n expects a whole number from 1 to 10000");
  check_refused(folder, {"map", missing, "--step-degrees", "1e-9", "-o", folder / "map.csv"}, 2,
                "--step-degrees expects a number from 0.1 to 90, found 1e-9");
  check_refused(folder, {"improve", missing, "--time", "1e300", "-o", folder / "out"}, 2,
                "--time expects a number above 0 and up to 1e+09, found 1e300");
  check_refused(folder, {"suggest", missing, "--target", "2"}, 2,
                "--target expects a number from -1000 and below 1, found 2");
  check_refused(folder, {"stack", missing, "--within", "1e300m"}, 2,
                "--within expects a length of at most 1e60");
  check_refused(folder, {"stack", box, "--within", "1e60m", "--unit", "um"}, 2,
                "the length 1e60m is more than 1e60 in the unit of the model");
  check_refused(folder, {"validate", missing, "--direction", "1e300", "0", "0"}, 2,
                "--direction: a direction needs numbers whose squares neither overflow nor underflow");
}

TEST_CASE("numbers at the ends of their ranges give finite results, or are refused in words") {
  const TemporaryFolder folder;
  const std::string box = folder.model("box.obj", solids::box({1, 2, 3}));
  const std::string cup = folder.model("cup.obj", solids::frustum_shell({}));
  const std::string table = folder.model("table.obj", solids::table({}));
  const auto direction = [](std::string size) { return Arguments{"--direction", size, "0", size}; };
  std::vector<Arguments> runs;
  for (const std::string size : {"1e153", "1e-153", "-1e153", "1e-10"})
    for (const std::string command : {"measure", "validate", "stack", "suggest"}) {
      runs.push_back({command, command == "suggest" ? table : cup});
      const Arguments more = direction(size);
      runs.back().insert(runs.back().end(), more.begin(), more.end());
    }
  for (const std::string option : {"--clearance", "--lateral-clearance", "--within"})
    for (const std::string length : {"1e60", "1e-60", "1e-300", "5e-324", "1e30"})
      runs.push_back({"stack", cup, option, length});
  for (const std::string option : {"--clearance", "--lateral-clearance", "--thickness"})
    for (const std::string length : {"1e60", "1e-300"}) runs.push_back({"suggest", table, option, length});
  runs.insert(runs.end(), {{"stack", cup, "-n", "10000"},
                           {"stack", cup, "--twist-degrees", "3600"},
                           {"stack", cup, "--twist-degrees", "1e-300"},
                           {"stack", cup, "--into", box, "--clearance", "1e60"},
                           {"search", box, "--cone-degrees", "1e-300"},
                           {"search", box, "--cone-degrees", "90", "--plane", "1e153", "0", "0"},
                           {"map", box, "--step-degrees", "90"},
                           {"measure", cup, "--method", "rays", "--resolution", "1"},
                           {"measure", cup, "--threads", "1024", "--seed", "18446744073709551615"},
                           {"structure", table, "--symmetry-tolerance", "1e-300"},
                           {"structure", table, "--symmetry-tolerance", "1"},
                           {"structure", table, "--joint-reach", "1e-300"},
                           {"structure", table, "--joint-reach", "1"},
                           {"structure", table, "--segments", "1000"},
                           {"structure", cup, "--sections", "1000", "--primitive", "all=cylinder"},
                           {"suggest", table, "--alpha", "1", "--target", "-1000"},
                           {"suggest", table, "--draft-degrees", "90"},
                           {"suggest", table, "--standing", "10000", "--tilt-degrees", "90"},
                           {"suggest", table, "--box-tolerance", "0"}});
  for (const Arguments& arguments : runs) check_sane(folder, arguments);
}

TEST_CASE("edits with hostile numbers are refused by every model, with the edit, and write nothing") {
  const TemporaryFolder folder;
  const std::string table = folder.model("table.obj", solids::table({}));
  const std::vector<std::pair<std::string, std::string>> edits = {
      {"shape rotate 30 about 1e300 1e300 0", "a rotation needs an axis of another size"},
      {"shape rotate 30 about 1e-300 0 0", "a rotation needs an axis of another size"},
      {"shape rotate 30 about 5e-324 0 0", "a rotation needs an axis of another size"},
      {"shape rotate 1e300 about 0 0 1", "an angle from -3600 to 3600 degrees"},
      {"shape scale 2 along 1e300 0 0", "a scaling along an axis needs an axis of another size"},
      {"shape scale 2 along 0 1e-300 0", "a scaling along an axis needs an axis of another size"},
      {"shape scale 1e300", "a factor from 1e-06 to 1000000, found 1e+300"},
      {"shape scale 1e-300", "a factor from 1e-06 to 1000000"},
      {"shape move 1e300 0 0", "a move goes at most 1000 times the diagonal of the shape"},
      {"shape move nan 0 0", "move expects a finite number, found 'nan'"},
      {"shape move 0x1p3 0 0", "move expects a finite number, found '0x1p3'"},
      {"point=18446744073709551616 move 1 0 0", "whole number from 0 to 2147483647"}};
  for (const std::string model : {"controllers", "surface", "iwires"})
    for (const auto& [edit, words] : edits) {
      check_refused(folder, {"deform", table, "--model", model, "--edit", edit, "-o", folder / "out.obj"}, 2,
                    words);
      check_refused(folder, {"deform", table, "--model", model, "--edit", edit}, 2, "the edit \"" + edit);
    }
  for (const std::string far : {"1e300", "1e9", "-1e9"})
    check_refused(folder,
                  {"deform", table, "--edit", "shape move 1 0 0", "--fix-point", far, "0", "0", "-o",
                   folder / "out.obj"},
                  2, "--fix-point: a fixed point lies on the surface, or at most");
}
