#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

bool is_png(const std::string& bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n") && bytes.size() > 2000;
}

bool is_svg(const std::string& bytes) {
  return bytes.find("<svg") != std::string::npos && bytes.find("</svg>") != std::string::npos;
}

}  // namespace

TEST_CASE("every --picture is a picture of its kind") {
  const TemporaryFolder folder;
  const std::string cup = folder.model("cup.obj", solids::frustum_shell({}));
  const std::vector<std::vector<std::string>> commands = {{"measure", cup},
                                                          {"measure", cup, "--method", "raster"},
                                                          {"search", cup, "--cone-degrees", "5"},
                                                          {"map", cup, "--step-degrees", "30"},
                                                          {"stack", cup, "-n", "3"},
                                                          {"stack", cup, "--into", cup}};
  for (const std::vector<std::string>& command : commands)
    for (const std::string name : {"picture.png", "picture.svg"}) {
      INFO(command[0] << " " << name);
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.end(), {"--picture", folder / name});
      const Outcome outcome = run_program(arguments);
      CHECK(outcome.status == 0);
      CHECK(outcome.err.empty());
      const std::string bytes = bytes_of(folder / name);
      CHECK((name == "picture.png" ? is_png(bytes) : is_svg(bytes)));
      std::filesystem::remove(folder / name);
    }
}

TEST_CASE("measure and validate use the depth buffer of OpenGL") {
  const TemporaryFolder folder;
  const std::string cup = folder.model("cup.obj", solids::frustum_shell({}));
  const json result =
      run_program({"measure", cup, "--method", "gl-raster", "--resolution", "256", "--json", "-"}).json();
  CHECK(result["method"] == "gl-raster");
  CHECK(result["sampling"]["error"].get<double>() < 1e-4);
  CHECK(result["f_max"].get<double>() > 0.9 * solids::frustum_shell_f_max({}));

  const json report = run_program({"validate", cup, "--json", "-"}).json();
  CHECK(report["passed"] == true);
  int rows = 0;
  for (const json& row : report["checks"])
    if (row["name"].get<std::string>().starts_with("OpenGL raster") && row["verdict"] != "skipped") ++rows;
  CHECK(rows >= 2);
}
