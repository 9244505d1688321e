#include "apps/run_program.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/io/read.h"
#include "stackabilization/stacking/rigid_transform.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

struct CupFolder : TemporaryFolder {
  solids::FrustumShell cup;
  std::string cup_file = model("cup.obj", solids::frustum_shell(cup));
};

}  // namespace

TEST_CASE("stack puts copies f_max apart and writes them as a mesh") {
  const CupFolder folder;
  const std::string mesh = folder / "stack.3mf";
  const Outcome outcome = run_program({"stack", folder.cup_file, "-n", "5", "-o", mesh, "--json", "-"});
  REQUIRE(outcome.status == 0);
  const json result = outcome.json();
  const double f_max = solids::frustum_shell_f_max(folder.cup);
  CHECK(result["n"] == 5);
  REQUIRE(result["offsets"].size() == 5);
  for (int k = 0; k < 5; ++k) CHECK(result["offsets"][k].get<double>() == Approx(k * f_max).epsilon(1e-12));
  const json exact = result["exact_offsets"][4];
  CHECK(Rational(exact["numerator"], exact["denominator"]).to_double() == result["offsets"][4].get<double>());
  const double height = folder.cup.height + 4 * f_max;
  CHECK(result["height"].get<double>() == Approx(height).epsilon(1e-12));
  CHECK(result["nesting_increment"].get<double>() == Approx(f_max).epsilon(1e-12));
  CHECK(result["stackability"].get<double>() ==
        Approx(1 - result["stack_volume"].get<double>() / (5 * result["box_volume"].get<double>()))
            .epsilon(1e-12));
  CHECK(result["conflicts"].is_array());
  CHECK(result["within"].is_null());

  const Shape stack = read_shape(mesh);
  CHECK(stack.part_count() == 5);
  CHECK(stack.vertices.col(2).maxCoeff() - stack.vertices.col(2).minCoeff() == Approx(height).epsilon(1e-12));
}

TEST_CASE("the transforms in the JSON put the copies where the mesh has them") {
  const CupFolder folder;
  const std::string mesh = folder / "stack.obj";
  const json result = run_program({"stack", folder.cup_file, "-n", "3", "--direction", "0.3", "0", "2",
                                   "--twist-degrees", "20", "-o", mesh, "--json", "-"})
                          .json();
  const Shape model = read_shape(folder.cup_file), stack = read_shape(mesh);
  REQUIRE(stack.triangle_count() == 3 * model.triangle_count());
  REQUIRE(result["offsets"][2] > 0);
  for (int k = 0; k < 3; ++k) {
    const json& copy = result["copies"][k];
    RigidTransform place;
    for (int i = 0; i < 3; ++i) {
      place.translation[i] = copy["translation"][i];
      for (int j = 0; j < 3; ++j) place.rotation(i, j) = copy["rotation"][i][j];
    }
    const Shape placed = transformed(model, place);
    for (Eigen::Index t = 0; t < model.triangle_count(); ++t)
      CHECK((placed.corner(t, 0) - stack.corner(k * model.triangle_count() + t, 0)).norm() < 1e-12);
  }
}

TEST_CASE("a stack in 3MF and GLB is one mesh in many places, and in 3MF the same to the bit as in OBJ") {
  const CupFolder folder;
  const auto written = [&](const std::string& name, const std::string& copies) {
    const Outcome outcome = run_program({"stack", folder.cup_file, "-n", copies, "--direction", "0.3", "0",
                                         "2", "--twist-degrees", "20", "--unit", "mm", "-o", folder / name});
    REQUIRE(outcome.status == 0);
    return std::filesystem::file_size(folder / name);
  };
  for (const std::string ending : {".3mf", ".glb"})
    CHECK(written("many" + ending, "9") < 1.5 * written("two" + ending, "2"));
  CHECK(written("many.obj", "9") > 4 * written("two.obj", "2"));
  const Shape meant = read_shape(folder / "many.obj"), placed = read_shape(folder / "many.3mf"),
              single = read_shape(folder / "many.glb");
  CHECK(placed.part_names == meant.part_names);
  CHECK(single.part_names == meant.part_names);
  REQUIRE(placed.triangle_count() == meant.triangle_count());
  REQUIRE(single.triangle_count() == meant.triangle_count());
  constexpr double half_float = 6e-8;  // relative
  const double size = meant.vertices.cwiseAbs().maxCoeff(), metres = metres_per_unit(Unit::millimetre);
  // Vertices are numbered anew.
  for (Eigen::Index t = 0; t < meant.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      CHECK(placed.corner(t, corner) == meant.corner(t, corner));
      CHECK((single.corner(t, corner) - metres * meant.corner(t, corner)).norm() <
            2 * half_float * metres * size);
    }
}

TEST_CASE("meshes are written in the units of their formats, and a unit that is guessed is named") {
  const CupFolder folder;
  struct Case {
    std::vector<std::string> options;
    std::string extension;
    double factor;
    std::string named;
  };
  const std::vector<Case> cases = {{{"--unit", "mm"}, ".glb", 1e-3, ""}, {{}, ".glb", 1, " m in "},
                                   {{"--unit", "ft"}, ".3mf", 1, ""},    {{}, ".3mf", 1, " mm in "},
                                   {{"--quiet"}, ".3mf", 1, ""},         {{}, ".obj", 1, ""}};
  for (const Case& wanted : cases) {
    const std::string mesh = folder / ("stack" + wanted.extension);
    INFO(mesh << " " << wanted.named);
    std::vector<std::string> arguments = {"stack", folder.cup_file, "-n", "3", "-o", mesh};
    arguments.insert(arguments.end(), wanted.options.begin(), wanted.options.end());
    const Outcome outcome = run_program(arguments);
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty() == wanted.named.empty());
    if (!wanted.named.empty()) {
      CHECK(is_one_sentence(outcome.err));
      CHECK(outcome.err.find(wanted.named + mesh) != std::string::npos);
    }
    const Shape stack = read_shape(mesh);
    const double height = stack.vertices.col(2).maxCoeff() - stack.vertices.col(2).minCoeff();
    CHECK(height == Approx(wanted.factor * (folder.cup.height + 2 * solids::frustum_shell_f_max(folder.cup)))
                        .epsilon(1e-6));
  }
}

TEST_CASE("meshes are converted to the unit that is asked for, whatever their format") {
  const CupFolder folder;
  const auto written = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {"stack", folder.cup_file, "--unit", "in", "-o", folder / name};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_program(arguments);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.find(" in  ") != std::string::npos);  // the report stays in the unit of the model
    CHECK(outcome.err.empty());
    return read_shape(folder / name);
  };
  const Shape inches = written("inches.obj", {});
  const Shape obj = written("converted.obj", {"--to-unit", "mm"});
  CHECK(obj.vertices == Points(inches.vertices * 127 / 5));
  const Shape three_mf = written("converted.3mf", {"--to-unit", "mm"});
  CHECK(three_mf.unit == Unit::millimetre);
  CHECK(range_along(three_mf, Eigen::Vector3d::UnitZ()).length() ==
        Approx(range_along(obj, Eigen::Vector3d::UnitZ()).length()).epsilon(1e-14));
  CHECK(written("relabelled.3mf", {}).unit == Unit::inch);
}

TEST_CASE("a size that no object has is questioned in the first line") {
  const CupFolder folder;
  const auto first_line = [&](const std::string& unit) {
    const std::string out = run_program({"measure", folder.cup_file, "--unit", unit}).out;
    return out.substr(0, out.find('\n'));
  };
  CHECK(first_line("cm").ends_with("closed"));
  CHECK(first_line("um").ends_with("an unlikely size: are these numbers m?"));
}

TEST_CASE("clearances lift the copies") {
  const CupFolder folder;
  const auto increment = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"stack", folder.cup_file, "--unit", "cm", "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments).json()["nesting_increment"].get<double>();
  };
  const double f_max = solids::frustum_shell_f_max(folder.cup);
  CHECK(increment({"--clearance", "0.25"}) == Approx(f_max + 0.25).epsilon(1e-12));
  CHECK(increment({"--clearance", "2.5mm"}) == Approx(f_max + 0.25).epsilon(1e-12));
  CHECK(increment({"--lateral-clearance", "0.05"}) > f_max);
}

TEST_CASE("a report says in which unit it took the lengths that were typed without one") {
  const CupFolder folder;
  const std::string sentence = "Lengths without a unit are in ";
  const auto report = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"stack", folder.cup_file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string out = run_program(arguments).out;
    const std::size_t at = out.find(sentence);
    return at == std::string::npos ? "" : out.substr(at + sentence.size());
  };
  CHECK(report({"--unit", "cm", "--clearance", "0.25", "--within", "9m"}) ==
        "cm, the unit of the model: --clearance 0.25\n");
  CHECK(report({"--clearance", "0.25", "--within", "900"}) ==
        "that of the model, which is unknown: --clearance 0.25, --within 900\n");
  // Nothing to say of nought, of numbers that are no lengths, and where only numbers are asked for.
  CHECK(report({"--unit", "cm", "--clearance", "0", "--lateral-clearance", "1mm", "-n", "3"}).empty());
  CHECK(report({"--unit", "cm", "--clearance", "0.25", "--quiet"}).empty());
  CHECK(report({"--unit", "cm", "--clearance", "0.25", "--json", "-"}).empty());
  const std::string items =
      run_program({"items", folder.cup_file, "--unit", "cm", "--clearance", "0.25"}).out;
  CHECK(items.ends_with(sentence + "that of each model: --clearance 0.25\n"));
}

TEST_CASE("a wish that is met ends with 0, one that is not with 1, and both say what it takes") {
  const CupFolder folder;
  const double f_max = solids::frustum_shell_f_max(folder.cup);
  const double height = folder.cup.height + 9 * f_max;
  const auto wished = [&](double length) {
    return run_program(
        {"stack", folder.cup_file, "-n", "10", "--within", std::to_string(length), "--json", "-"});
  };
  const Outcome met = wished(height + 0.5), unmet = wished(height - 0.5);
  CHECK(met.status == 0);
  CHECK(met.json()["within"]["met"] == true);
  CHECK(met.json()["within"]["straight"]["copies_now"].get<int>() >= 10);
  CHECK(unmet.status == 1);
  CHECK(unmet.json()["within"]["met"] == false);
  CHECK(unmet.json()["within"]["straight"]["f_max"].get<double>() == Approx(f_max - 0.5 / 9).epsilon(1e-6));
  const Outcome text = run_program({"stack", folder.cup_file, "-n", "10", "--within", "1"});
  CHECK(text.status == 1);
  CHECK(text.out.find("not met") != std::string::npos);
}

TEST_CASE("stack turns and flips copies when asked") {
  const TemporaryFolder folder;
  const std::string model = folder.model("l.obj", solids::l_shape(3, 1));
  const json twisted =
      run_program({"stack", model, "-n", "3", "--twist-degrees", "180", "--json", "-"}).json();
  CHECK(twisted["twist_degrees"] == 180);
  CHECK(twisted["copies"][1]["rotation"][0][0] == -1);
  const json best = run_program({"stack", model, "-n", "2", "--twist-degrees", "auto", "--json", "-"}).json();
  CHECK(best["stackability"].get<double>() >= best["untwisted_stackability"].get<double>());
  const json period = run_program({"stack", model, "-n", "4", "--period", "2", "--json", "-"}).json();
  CHECK(period["period"] == 2);
  CHECK(period["poses"].size() == 2);
  // An L upside down fits onto an upright one: together they are 4 high, not 6.
  const json straight = run_program({"stack", model, "-n", "4", "--json", "-"}).json();
  CHECK(straight["height"] == 12);
  CHECK(period["height"] == 8);
}

TEST_CASE("stack --into lowers one object into another") {
  const TemporaryFolder folder;
  const std::string container = folder.model("u.obj", solids::u_shape(4, 1));
  const std::string content = folder.model("cube.obj", solids::box({1.25, 0.25, 7}, {2.75, 0.75, 8}));
  const Outcome outcome = run_program({"stack", content, "--into", container, "--json", "-"});
  REQUIRE(outcome.status == 0);
  const json result = outcome.json();
  CHECK(result["offset"].get<double>() == Approx(1 - 7).epsilon(1e-15));
  CHECK(result["exact_offset"]["numerator"] == "-6");
  CHECK(result["exact_offset"]["denominator"] == "1");
  CHECK(result["height"] == 4);
  CHECK(result["saving"] == 1);
  CHECK(run_program({"stack", content, "--into", container, "--quiet"}).out == "-6\n");
}

TEST_CASE("a stack of prints is as high as the room allows, in whole layers, with separators of its own") {
  const TemporaryFolder folder;
  Shape box = solids::box({40, 30, 2});
  box.unit = Unit::millimetre;
  const std::string model = folder.model("tile.3mf", box), mesh = folder / "stack.3mf";
  // 2.25 mm per further copy, nine layers of 0.25: 2 + 9 x 2.25 = 22.25 of 24 mm.
  const std::vector<std::string> print = {"stack",       model,   "-n",           "max",
                                          "--within",    "24",    "--layer",      "0.25",
                                          "--clearance", "0.2mm", "--separators", "--json"};
  const json stack = run_program(joined(print, {"-", "-o", mesh})).json();
  CHECK(stack["n"] == 10);
  CHECK(stack["within"]["met"] == true);
  CHECK(stack["within"]["straight"]["copies_now"] == 10);
  CHECK(stack["nesting_increment"] == 2.25);
  CHECK(stack["layer"] == 0.25);
  CHECK(stack["separators"]["gaps"] == 9);
  CHECK(stack["separators"]["regions"] == 1);
  const Shape written = read_shape(mesh);
  REQUIRE(written.part_count() == 19);
  CHECK(written.part_names[1] == "separator1/region_1");
  for (Eigen::Index part = 0; part < 19; ++part) {
    const Range along = range_along(extract_part(written, part), Eigen::Vector3d::UnitZ());
    CHECK(along.low == Approx(part / 2 * 2.25 + part % 2 * 2));
    CHECK(along.length() == Approx(part % 2 == 0 ? 2 : 0.25));
  }
  const std::string text =
      run_program({"stack", model, "-n", "max", "--within", "2.3cm", "--layer", "0.25"}).out;
  CHECK(text.find("Layers") != std::string::npos);
  CHECK(text.find("Copies        11 ") != std::string::npos);
  CHECK(run_program({"stack", model, "-n", "max", "--within", "1"}).status == 1);

  check_refused(folder, {"stack", model, "-n", "max"}, 2, "--within");
  check_refused(folder, {"stack", model, "-n", "most"}, 2, "-n");
  check_refused(folder, {"stack", model, "-n", "max", "--within", "9", "--period", "2"}, 2, "-n max");
  check_refused(folder, {"stack", model, "--layer", "1", "--twist-degrees", "5"}, 2, "--layer");
  check_refused(folder, {"stack", model, "--layer", "0"}, 2, "--layer");
  check_refused(folder, {"stack", model, "--layer", "1", "--separators"}, 2, "--clearance");
  check_refused(folder, {"stack", model, "--clearance", "1", "--separators"}, 2, "--layer");
  check_refused(folder, {"stack", model, "--layer", "1", "--into", model}, 2, "--layer");
}

TEST_CASE("copies step aside where they come lower, with a proof") {
  // A peg beside the groove below the plate: straight the feet stand on pegs.
  const TemporaryFolder folder;
  Shape shape = solids::named(solids::box({0, 0, 0}, {1, 4, 2}), "foot_1");
  shape = concatenate(shape, solids::named(solids::box({2, 0, 0}, {4, 4, 2}), "foot_2"));
  shape = concatenate(shape, solids::named(solids::box({0, 0, 2}, {4, 4, 3}), "plate"));
  shape = concatenate(shape, solids::named(solids::box({0.1, 1, 3}, {0.9, 3, 4}), "peg"));
  const std::string model = folder.model("peg.obj", shape);
  const json stack =
      run_program({"stack", model, "-n", "4", "--place", "best", "--max-shift", "1.2", "--json", "-"}).json();
  CHECK(stack["height"] == 13);
  CHECK(stack["step"]["straight_height"] == 16);
  CHECK(stack["step"]["proven"] == true);
  CHECK(stack["step"]["bound"].get<double>() > 2.99);
  CHECK(stack["copies"][1]["translation"][0] == stack["step"]["x"]);
  CHECK(stack["copies"][1]["translation"][2] == 3);
  const std::string text = run_program({"stack", model, "--place", "best", "--max-shift", "0.2"}).out;
  CHECK(text.find("no shift makes the stack lower") != std::string::npos);
  CHECK(run_program({"stack", model, "--json", "-"}).json()["step"].is_null());
  check_refused(folder, {"stack", model, "--turn"}, 2, "--turn needs --place best");
  check_refused(folder, {"stack", model, "--max-shift", "1"}, 2, "--max-shift needs --place best");
  check_refused(folder, {"stack", model, "--place", "best", "--period", "2"}, 2, "--place best");
  check_refused(folder, {"stack", model, "--place", "best", "--layer", "1"}, 2, "--layer");
  check_refused(folder, {"stack", model, "--place", "best", "--into", model}, 2, "--place best");
  check_refused(folder, {"stack", model, "--place", "best", "-n", "101"}, 2, "100 copies");
}
