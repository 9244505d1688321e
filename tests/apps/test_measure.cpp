#include <algorithm>
#include <cmath>
#include <sstream>

#include "apps/run_program.h"
#include "stackabilization/core/rational.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

double number(const Rational& value) {
  return value.to_double();
}

}  // namespace

TEST_CASE("measure finds f_max of a cup in closed form and says where it is attained") {
  const TemporaryFolder folder;
  const solids::FrustumShell cup;
  const Shape shape = solids::frustum_shell(cup);
  const std::string model = folder.model("cup.obj", shape);
  const Outcome outcome = run_program({"measure", model, "--direction", "0", "0", "2", "--json", "-"});
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.empty());
  const json result = outcome.json();

  const double f_max = solids::frustum_shell_f_max(cup);
  CHECK(result["f_max"].get<double>() == Approx(f_max).epsilon(1e-12));
  CHECK(result["nesting_increment"] == result["f_max"]);
  CHECK(result["height"].get<double>() == Approx(cup.height).epsilon(1e-12));
  CHECK(result["f_max_over_height"].get<double>() == Approx(f_max / cup.height).epsilon(1e-12));
  const double ratio = result["stack_box_volume"].get<double>() / result["box_volume"].get<double>();
  CHECK(result["stackability"].get<double>() == Approx(1 - f_max / cup.height * ratio).epsilon(1e-12));
  CHECK(result["direction"] == json({0, 0, 2}));
  CHECK(result["method"] == "exact");
  CHECK(result["semantics"] == "solid");
  CHECK(result["boxes"] == "oriented");
  CHECK(result["model"] == model);
  CHECK(result["unit"].is_null());
  CHECK(result["seconds"].get<double>() > 0);
  CHECK(result["findings"]["triangles"] == shape.triangle_count());

  // The exact value counts in lengths of the direction vector, which is 2 here.
  const Rational exact(result["exact"]["numerator"].get<std::string>(),
                       result["exact"]["denominator"].get<std::string>());
  CHECK(2 * number(exact) == Approx(result["f_max"].get<double>()).epsilon(1e-15));

  const json witness = result["witness"];
  CHECK(witness["triangles"].size() == 2);
  CHECK(witness["triangles"][0].get<int>() < shape.triangle_count());
  CHECK(witness["point"][2].get<double>() - witness["lower_point"][2].get<double>() ==
        Approx(f_max).epsilon(1e-12));
  REQUIRE(!result["gradient"]["touches"].empty());
  CHECK(result["gradient"]["touches"][0]["normal"][2].get<double>() == Approx(1));
  REQUIRE(result["contacts"].size() == 1);
  CHECK(result["contacts"][0]["type"] == "ring");
  CHECK(result["contacts"][0]["parts"] == json({"part", "part"}));
  CHECK(result["contacts"][0]["area"].get<double>() > 0);
  CHECK(result["contacts"][0]["centre"].size() == 3);
}

TEST_CASE("the model may follow a vector, which takes three numbers and no more") {
  const TemporaryFolder folder;
  const std::string model = folder.model("cup.obj", solids::frustum_shell({}));
  const std::vector<std::string> tail = {"--json", "-", "--no-timing"};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), tail.begin(), tail.end());
    return run_program(arguments);
  };
  const Outcome before = run({"measure", model, "--direction", "0", "-1", "2"});
  CHECK(before.status == 0);
  CHECK(run_program({"measure", "--json", "-", "--no-timing", "--direction", "0", "-1", "2", model}).out ==
        before.out);
  CHECK(run({"measure", "--direction", "0", "-1", "2", model}).out == before.out);
  CHECK(run({"validate", "--direction", "0", "0", "1", model}).status == 0);
  CHECK(run({"stack", "--direction", "0", "0", "1", model}).status == 0);
  CHECK(run({"search", "--cone-degrees", "1", "--plane", "1", "0", "0", "--direction", "0", "0", "1", model})
            .status == 0);
}

TEST_CASE("measure gives all of a flat shape but its stackability") {
  const TemporaryFolder folder;
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  const std::string wall = "v 0 0 0\nv 1 0 0\nv 1 0 2\nv 0 0 2\nf 1 2 3 4\n";
  struct Case {
    std::string name, obj, semantics;
    double f_max, height;
    std::size_t contacts;
  };
  const std::vector<Case> cases = {{"square.obj", square, "solid", 0, 0, 1},
                                   {"square.obj", square, "closed", 0, 0, 1},
                                   {"wall.obj", wall, "solid", 0, 2, 0},
                                   {"wall.obj", wall, "closed", 2, 2, 1},
                                   {"point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n", "solid", 0, 0, 0},
                                   {"line.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", "solid", 0, 2, 0}};
  for (const Case& flat : cases) {
    INFO(flat.name << " " << flat.semantics);
    const std::vector<std::string> measure = {"measure", folder.file(flat.name, flat.obj), "--semantics",
                                              flat.semantics};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), measure.begin(), measure.end());
      return run_program(more);
    };
    const Outcome outcome = with({"--json", "-"});
    REQUIRE(outcome.status == 0);
    const json result = outcome.json();
    CHECK(result["f_max"] == flat.f_max);
    CHECK(result["height"] == flat.height);
    CHECK(result["f_max_over_height"].is_null() == (flat.height == 0));
    CHECK(result["stackability"].is_null());
    CHECK(result["box_volume"] == 0);
    CHECK(result["contacts"].size() == flat.contacts);
    const Outcome text = with({});
    CHECK(text.out.find("not defined") != std::string::npos);
    CHECK(text.out.find("nan") == std::string::npos);
    CHECK(with({"--quiet"}).out == "undefined\n");
    CHECK(with({"--method", "rays", "--resolution", "16"}).status == 0);
  }
}

TEST_CASE("a stackability of rounding size reads 0 and keeps its digits in the JSON") {
  const TemporaryFolder folder;
  int with_digits = 0;
  for (int seed = 0; seed < 8; ++seed) {
    const Eigen::Matrix3d rotation = solids::random_rotation(seed);
    const std::string model =
        folder.model("box.obj", transformed(solids::box({1, 2, 3}), rotation, {1, 2, 3}));
    std::vector<std::string> measure = {"measure", model, "--direction"};
    for (int i = 0; i < 3; ++i) {
      std::ostringstream digits;
      digits.precision(17);
      digits << rotation(i, 2);
      measure.push_back(digits.str());
    }
    const std::string text = run_program(measure).out;
    CHECK(text.find("\nStackability  0 ") != std::string::npos);
    measure.insert(measure.end(), {"--json", "-"});
    const double value = run_program(measure).json()["stackability"];
    CHECK(std::abs(value) < 1e-11);
    if (value != 0) ++with_digits;
  }
  CHECK(with_digits > 0);
}

TEST_CASE("measure takes +z when no direction is given, and frame boxes when asked") {
  const TemporaryFolder folder;
  const std::string model = folder.model("box.off", solids::box({1, 2, 3}));
  const json result = run_program({"measure", model, "--boxes", "frame", "--json", "-"}).json();
  CHECK(result["direction"] == json({0, 0, 1}));
  CHECK(result["boxes"] == "frame");
  CHECK(result["stackability"] == 0);
  CHECK(result["box_volume"] == 6);
}

TEST_CASE("measure tells sliding walls from touching ones") {
  const TemporaryFolder folder;
  const std::string model = folder.model("wall.obj", solids::boxes_sharing_wall());
  CHECK(run_program({"measure", model, "--json", "-"}).json()["f_max"] == 1);
  CHECK(run_program({"measure", model, "--semantics", "closed", "--json", "-"}).json()["f_max"] == 3);
}

TEST_CASE("measure says how much of a copy lies within a layer of the one below") {
  // Over the treads of these stairs f is 0.75, 1.5, 2.25 and 3: copies are 2.25, 1.5, 0.75 and 0 apart.
  const TemporaryFolder folder;
  Shape stairs = solids::stairs({});
  stairs.unit = Unit::centimetre;
  const std::string model = folder.model("stairs.3mf", stairs);
  const json layer = run_program({"measure", model, "--layer", "8mm", "--json", "-"}).json()["layer"];
  CHECK(layer["distance"].get<double>() == Approx(0.8));
  CHECK(layer["close_share"].get<double>() == Approx(0.5).epsilon(1e-7));
  CHECK(layer["close_area"].get<double>() == Approx(4).epsilon(1e-7));
  CHECK(layer["projected_area"].get<double>() == Approx(8).epsilon(1e-7));
  CHECK(layer["complete"] == true);
  CHECK(layer["largest_sampled_gap"].get<double>() == Approx(2.25));
  const json all = run_program({"measure", model, "--layer", "100", "--json", "-"}).json()["layer"];
  CHECK(all["close_share"] == 1);
  CHECK(run_program({"measure", model, "--layer", "8mm"}).out.find("50.0 %") != std::string::npos);
  CHECK_FALSE(run_program({"measure", model, "--json", "-"}).json().contains("layer"));
  check_refused(folder, {"measure", model, "--layer", "0"}, 2, "--layer");
  check_refused(folder, {"measure", model, "--layer", "1", "--method", "rays"}, 2, "needs --method exact");
}

TEST_CASE("measure by samples stays below the exact value and says how far") {
  const TemporaryFolder folder;
  const std::string model = folder.model("cup.obj", solids::frustum_shell({}));
  for (const std::string method : {"rays", "raster"}) {
    const json result =
        run_program({"measure", model, "--method", method, "--resolution", "128", "--json", "-"}).json();
    CHECK(result["method"] == method);
    CHECK(result["exact"].is_null());
    CHECK(result["witness"].is_null());
    CHECK(result["gradient"].is_null());
    CHECK(result["contacts"].is_null());
    const json sampling = result["sampling"];
    CHECK(sampling["resolution"] == 128);
    CHECK(sampling["exact_f_max"].get<double>() == Approx(solids::frustum_shell_f_max({})).epsilon(1e-10));
    CHECK(sampling["error"].get<double>() < 1e-9);
    CHECK(sampling["error"].get<double>() >= sampling["half_resolution_error"].get<double>() - 1e-9);
    CHECK(result["f_max"].get<double>() - sampling["exact_f_max"].get<double>() ==
          Approx(sampling["error"].get<double>()).margin(1e-12));
    const double ratio = result["stack_box_volume"].get<double>() / result["box_volume"].get<double>();
    CHECK(result["stackability"].get<double>() ==
          Approx(1 - result["f_max_over_height"].get<double>() * ratio).epsilon(1e-12));
  }
}

TEST_CASE("samples are set beside the same f_max, to the last bit, as the exact method gives") {
  const TemporaryFolder folder;
  const std::string model = folder.model("soup.obj", solids::triangle_soup({.seed = 4, .count = 40}));
  for (const std::string x : {"0.1", "0.2", "0.3", "0.4", "0.5"}) {
    std::vector<std::string> measure = {"measure", model, "--direction", x, "-0.2", "1", "--json", "-"};
    const json exact = run_program(measure).json();
    measure.insert(measure.end(), {"--method", "raster", "--resolution", "16"});
    CHECK(run_program(measure).json()["sampling"]["exact_f_max"] == exact["f_max"]);
  }
}

TEST_CASE("measure warns where more samples do not help") {
  // A fin far thinner than a pixel, standing high over one side of a plate that fills the picture.
  const TemporaryFolder folder;
  const Shape plate = solids::box({0, 0, 0}, {1, 1, 0.1});
  const Shape fin = solids::box({0.3, 0.2, 0.1}, {0.3000001, 0.8, 1});
  const std::string model = folder.model("fin.obj", concatenate(plate, fin));
  const Outcome outcome = run_program({"measure", model, "--method", "raster", "--resolution", "64"});
  CHECK(outcome.out.find("does NOT shrink") != std::string::npos);
}

TEST_CASE("measure explains its numbers to a reader, with units") {
  const TemporaryFolder folder;
  const std::string model = folder.model("cup.obj", solids::frustum_shell({}));
  const Outcome outcome = run_program({"measure", model, "--unit", "cm"});
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  for (const std::string text : {"cup.obj: ", "closed", "8 cm", "cm^3", "ring", "Each further copy adds "})
    CHECK(outcome.out.find(text) != std::string::npos);
}

TEST_CASE("up axis, unit, format and labels change how a file is read") {
  const TemporaryFolder folder;
  const std::string model = folder.model("box.obj", solids::box({1, 2, 3}));
  const auto measured = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"measure", model, "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments).json();
  };
  CHECK(measured({"--up", "x"})["height"] == 1);
  CHECK(measured({"--up", "y"})["height"] == 2);
  CHECK(measured({"--unit", "in"})["unit"] == "in");
  const std::string other = folder.file("box.data", bytes_of(model));
  CHECK(run_program({"measure", other, "--format", "obj", "--quiet"}).out == "0\n");

  std::string labels;
  for (int i = 0; i < 12; ++i) labels += i < 6 ? "low\n" : "high\n";
  const std::string path = folder.file("labels.txt", labels);
  CHECK(run_program({"inspect", model, "--labels", path, "--json", "-"}).json()["part_names"] ==
        json({"low", "high"}));
}

TEST_CASE("inspect counts, and names what is wrong") {
  const TemporaryFolder folder;
  const std::string open = folder.file("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n");
  const Outcome text = run_program({"inspect", open});
  CHECK(text.status == 0);
  CHECK(text.out.find("boundary edges") != std::string::npos);
  const json result = run_program({"inspect", open, "--self-intersections", "--json", "-"}).json();
  CHECK(result["findings"]["boundary_edges"] == 4);
  CHECK(result["findings"]["closed"] == false);
  CHECK(result["findings"]["volume"].is_null());
  CHECK(result["findings"]["self_intersections"] == 0);
  CHECK(run_program({"inspect", open, "--json", "-"}).json()["findings"]["self_intersections"].is_null());
}

TEST_CASE("measure takes thousands of parts in one place, and says what it does not list") {
  const TemporaryFolder folder;
  const int count = 2000;
  std::ostringstream file;
  for (int k = 0; k < count; ++k) {
    file << "g cube_" << k << "\n";
    for (int corner = 0; corner < 8; ++corner)
      file << "v " << (corner & 1) << ' ' << (corner >> 1 & 1) << ' ' << (corner >> 2) << "\n";
    const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : faces) {
      file << "f";
      for (const int corner : face) file << ' ' << 8 * k + corner + 1;
      file << "\n";
    }
  }
  const std::string model = folder.file("cubes.obj", file.str());
  for (const char* const semantics : {"solid", "closed"}) {
    const Outcome text =
        run_program({"measure", model, "--direction", "0", "0", "1", "--semantics", semantics});
    CHECK(text.status == 0);
    CHECK(std::count(text.out.begin(), text.out.end(), '\n') < 20);
    CHECK(text.out.find("too many pairs of triangles touch") != std::string::npos);
    CHECK(text.out.find("1999 parts") != std::string::npos);
    const Outcome outcome = run_program(
        {"measure", model, "--direction", "0", "0", "1", "--semantics", semantics, "--json", "-"});
    const json result = outcome.json();
    CHECK(result["f_max"] == 1);
    CHECK(result["contacts"].size() < 20);
    REQUIRE(result["contacts_omitted"]["coincident_parts"].size() == count - 1);
    CHECK(result["contacts_omitted"]["coincident_parts"][0] == "cube_1");
  }
  const Outcome search = run_program({"search", model, "--semantics", "closed", "--json", "-"});
  CHECK(search.status == 0);
  CHECK(search.json()["contacts_omitted"]["coincident_parts"].size() == count - 1);
}

TEST_CASE("search proves that no direction is better, or says how far it came") {
  const TemporaryFolder folder;
  const std::string box = folder.model("box.off", solids::box({1, 2, 3}));
  const Outcome proven = run_program({"search", box, "--certify", "0.05", "--json", "-"});
  CHECK(proven.status == 0);
  const json result = proven.json();
  CHECK(result["stackability"].get<double>() == Approx(0).margin(1e-9));
  CHECK(result["proven"] == true);
  CHECK(result["accuracy"] == 0.05);
  CHECK(result["bound"].get<double>() >= 0);
  CHECK(result["bound"].get<double>() <= 0.05 + 1e-12);
  CHECK(result["open_cells"] == 0);
  const Outcome early = run_program({"search", box, "--certify", "0.05", "--max-cells", "1", "--json", "-"});
  CHECK(early.status == 1);
  CHECK(early.json()["proven"] == false);
  CHECK(early.json()["bound"].get<double>() >= result["bound"].get<double>());
  CHECK(early.json()["open_cells"].get<int>() > 0);
  const Outcome text = run_program({"search", box, "--certify", "0.05"});
  CHECK(text.out.find("nowhere above this") != std::string::npos);
}

TEST_CASE("search says how high S may be elsewhere without being asked, and fails for no proof then") {
  const TemporaryFolder folder;
  const std::string box = folder.model("box.off", solids::box({1, 2, 3}));
  const json result = run_program({"search", box, "--json", "-"}).json();
  CHECK(result["proven"] == true);
  CHECK(result["accuracy"] == 1e-3);
  CHECK(result["bound"].get<double>() <= result["stackability"].get<double>() + 1e-3);
  CHECK(result["cells"].get<int>() <= 10000);

  const Outcome early = run_program({"search", box, "--max-cells", "1"});
  CHECK(early.status == 0);
  CHECK(early.out.find("more than 0.001 above S") != std::string::npos);
  CHECK(early.out.find("nowhere above this") == std::string::npos);
  const Outcome counted = run_program({"search", box, "--max-cells", "1", "--json", "-"});
  CHECK(counted.json()["proven"] == false);
  CHECK(counted.json()["bound"].get<double>() > result["bound"].get<double>());

  CHECK(!run_program({"search", box, "--max-cells", "0", "--json", "-"}).json().contains("bound"));
  CHECK(!run_program({"search", box, "--boxes", "frame", "--json", "-"}).json().contains("bound"));
}
