#include <sstream>

#include "apps/run_program.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::apps;

namespace {

/// An OBJ file of cubes, each a group; cube k stands at k * step.
std::string cubes(std::size_t count, const Eigen::Vector3d& step) {
  const Shape cube = solids::box({1, 1, 1});
  std::ostringstream text;
  for (std::size_t k = 0; k < count; ++k) {
    text << "g cube_" << k << '\n';
    for (const auto& v : cube.vertices.rowwise())
      text << "v " << v(0) + static_cast<double>(k) * step.x() << ' '
           << v(1) + static_cast<double>(k) * step.y() << ' ' << v(2) + static_cast<double>(k) * step.z()
           << '\n';
    for (const auto& t : cube.triangles.rowwise())
      text << "f " << t(0) + 8 * static_cast<int>(k) + 1 << ' ' << t(1) + 8 * static_cast<int>(k) + 1 << ' '
           << t(2) + 8 * static_cast<int>(k) + 1 << '\n';
  }
  return text.str();
}

}  // namespace

TEST_CASE("more parts than a command takes are refused before the work, with the bound") {
  const TemporaryFolder folder;
  const AnalysisOptions limits;
  const std::string apart_20001 = folder.file("apart_20001.obj", cubes(limits.max_parts + 1, {2, 0, 0})),
                    apart_2001 = folder.file("apart_2001.obj", cubes(2001, {2, 0, 0})),
                    apart_501 =
                        folder.file("apart_501.obj", cubes(DeformationLimits().max_parts + 1, {2, 0, 0})),
                    together = folder.file("together.obj", cubes(700, {0, 0, 0}));
  check_refused(folder, {"structure", apart_20001}, 3,
                "apart_20001.obj: it has 20001 parts, and the structure of at most 20000 is analysed");
  check_refused(folder, {"deform", apart_2001, "--edit", "cube_0 scale 1.1"}, 3,
                "apart_2001.obj: it has 2001 parts, and the structure of at most 2000 is analysed");
  check_refused(folder, {"suggest", apart_501}, 3,
                "apart_501.obj: it has 501 parts, and the structure of at most 500 is analysed");
  check_refused(folder, {"improve", apart_501, "--target", "0.5", "-o", folder / "better"}, 3,
                "apart_501.obj: it has 501 parts, and the structure of at most 500 is analysed");
  check_refused(folder, {"structure", together}, 3,
                "together.obj: more than 100000 pairs of its parts come near each other");
  check_refused(folder, {"deform", together, "--edit", "cube_0 scale 1.1"}, 3,
                "together.obj: more than 20000 pairs of its parts come near each other");
}

TEST_CASE("a project file of more parts than designs are made of is refused") {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("apart.obj", cubes(DeformationLimits().max_parts + 1, {2, 0, 0}));
  const std::string project = folder / "apart.json";
  REQUIRE(run_program({"structure", mesh, "--save", project, "--quiet"}).status == 0);
  check_refused(folder, {"suggest", project}, 3,
                "apart.json: it has 501 parts, and designs are made of at most 500");
}

TEST_CASE("validate passes a shape with a part inside out and says what it did not check") {
  const TemporaryFolder folder;
  const Shape shape = concatenate(solids::box({1, 1, 1}), solids::flipped(solids::box({3, 0, 0}, {4, 1, 2})));
  const Outcome outcome = run_program({"validate", folder.model("mixed.obj", shape), "--json", "-"});
  CHECK(outcome.status == 0);
  bool skipped = false;
  const nlohmann::json document = outcome.json();
  for (const nlohmann::json& check : document["checks"])
    if (check["name"] == "overlap of interiors")
      skipped = check["verdict"] == "skipped" &&
                check["note"].get<std::string>().find("inside out") != std::string::npos;
  CHECK(skipped);
}
