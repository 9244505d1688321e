// Which primitives hold the parts of real models: those of this project, and those the authors fitted by
// hand.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>
#include <variant>

#include "stackabilization/io/read.h"
#include "stackabilization/structure/fitting.h"
#include "structure/fitting/part_box.h"
#include "structure/model/fit_error.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

Shape part_named(const Shape& shape, const std::string& name) {
  const auto found = std::find(shape.part_names.begin(), shape.part_names.end(), name);
  REQUIRE(found != shape.part_names.end());
  return extract_part(shape, found - shape.part_names.begin());
}

/// "cuboid", "open" or "closed" cylinder.
std::string kind_of(const std::string& model, const std::string& part) {
  const Shape shape =
      read_shape(std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "data/models" / (model + ".obj"));
  const FittedPrimitive fitted = fit_primitive(part_named(shape, part));
  validate(fitted.primitive, part);
  const auto* cylinder = std::get_if<GeneralizedCylinder>(&fitted.primitive);
  return cylinder == nullptr ? "cuboid" : cylinder->closed ? "closed" : "open";
}

double distance_to_curve(const GeneralizedCylinder& cylinder, const Eigen::RowVector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i + 1 < cylinder.centres.rows(); ++i) {
    const Eigen::RowVector3d start = cylinder.centres.row(i), step = cylinder.centres.row(i + 1) - start;
    const double t = std::clamp((point - start).dot(step) / step.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (point - start - t * step).norm());
  }
  return least;
}

/// The authors' primitives are in the frame where the box of the shape is centred and half its diagonal is 1.
Shape normalised(Shape shape) {
  const Eigen::RowVector3d low = shape.vertices.colwise().minCoeff(),
                           high = shape.vertices.colwise().maxCoeff();
  shape.vertices = (shape.vertices.rowwise() - (low + high) / 2) / ((high - low).norm() / 2);
  return shape;
}

GeneralizedCylinder read_cylinder(std::istream& fields) {
  double cage_scale = 0, cage_sides = 0, delta_scale = 0;
  int n = 0;
  REQUIRE(fields >> cage_scale >> cage_sides >> delta_scale >> n);
  GeneralizedCylinder cylinder{.centres = Points(n, 3), .radii = Eigen::VectorXd(n)};
  for (double& value : cylinder.centres.reshaped<Eigen::RowMajor>()) fields >> value;
  for (double& value : cylinder.radii) fields >> value;
  REQUIRE(fields);
  return cylinder;
}

OrientedBox read_box(std::istream& fields) {
  OrientedBox box;
  for (double& value : box.centre) fields >> value;
  for (double& value : box.axes.reshaped()) fields >> value;
  for (double& value : box.half_extents) fields >> value;
  REQUIRE(fields);
  return box;
}

/// Every primitive of a .ctrl file against the one fitted here.
void compare_with_authors(const std::filesystem::path& controls) {
  const Shape shape = normalised(read_shape(std::filesystem::path(controls).replace_extension(".obj")));
  std::ifstream file(controls);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string kind, name;
    if (!(fields >> kind >> name)) continue;
    INFO(controls << ": " << name);
    const Shape part = part_named(shape, name);
    const detail::FitSurface surface(part);
    const FittedPrimitive fitted = fit_primitive(part);
    const double diagonal = 2 * detail::part_box(surface).box.half_extents.norm();
    const auto* cylinder = std::get_if<GeneralizedCylinder>(&fitted.primitive);
    const double error = cylinder != nullptr ? *fitted.fit.cylinder_error : fitted.fit.cuboid_error;
    double theirs = 0;
    if (kind == "GC") {
      const GeneralizedCylinder authors = read_cylinder(fields);
      theirs = detail::fit_error(authors, surface);
      REQUIRE(cylinder != nullptr);
      for (const auto& centre : authors.centres.rowwise())
        CHECK(distance_to_curve(*cylinder, centre) < 0.03 * diagonal);
    } else {
      REQUIRE(kind == "CUBOID");
      theirs = detail::fit_error(read_box(fields), surface);
    }
    CHECK(error <= 1.02 * theirs / diagonal);
  }
}

}  // namespace

TEST_CASE("the parts of this project's models are held by what they look like") {
  CHECK(kind_of("cup", "body") == "open");
  CHECK(kind_of("mug_with_handle", "handle") == "open");
  CHECK(kind_of("bucket_with_handles", "rim") == "closed");
  CHECK(kind_of("bucket_with_handles", "handle_left") == "open");
  CHECK(kind_of("crate", "body") == "cuboid");
  CHECK(kind_of("crate", "rim") == "closed");
  CHECK(kind_of("table", "top") == "cuboid");
  CHECK(kind_of("table", "apron_left") == "cuboid");
  CHECK(kind_of("stool", "seat") == "open");
  CHECK(kind_of("stool", "leg_front_left") == "open");
  CHECK(kind_of("zigzag_chair", "diagonal") == "cuboid");
}

TEST_CASE("the authors' cylinders are found, and no primitive of theirs holds its part better") {
  const char* folder = std::getenv("STACKABILIZATION_PAPER_DATA");
  if (folder == nullptr || *folder == '\0') {
    std::cout << "SKIPPED: STACKABILIZATION_PAPER_DATA is not set\n";
    return;
  }
  const std::filesystem::path data = std::filesystem::path(folder) / "user-study-graphics/UserStudyApp/data";
  for (const char* model : {"Tasks/IKEA-cup", "Tasks/cup-handle-01", "Tasks/cup", "Tasks/stool-01",
                            "Tasks/table-midbar", "table", "tableGC"})
    compare_with_authors(data / (std::string(model) + ".ctrl"));
}
