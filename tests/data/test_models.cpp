#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "generator/models.h"
#include "stackabilization/io/format.h"
#include "stackabilization/io/write.h"
#include "support/catch.h"
#include "support/variants.h"

namespace stackabilization::models {
namespace {

std::filesystem::path folder() {
  return std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "data" / "models";
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST_CASE("the generator reproduces every shipped model byte for byte") {
  std::set<std::string> expected, shipped;
  for (const auto& [name, shape] : all_models()) {
    INFO(name);
    expected.insert(name + ".obj");
    CHECK(bytes_of(folder() / (name + ".obj")) == shape_bytes(shape, Format::obj));
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder()))
    shipped.insert(entry.path().filename().string());
  CHECK(shipped == expected);
}

TEST_CASE("every part of every model is closed, outward oriented and named") {
  for (const auto& [name, shape] : all_models()) {
    REQUIRE_NOTHROW(validate(shape));
    CHECK(solids::is_closed(shape));
    for (Eigen::Index part = 0; part < shape.part_count(); ++part) {
      const std::string& part_name = shape.part_names[static_cast<std::size_t>(part)];
      INFO(name << " " << part_name);
      CHECK(part_name != "part");
      CHECK(part_name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_12345") == std::string::npos);
      CHECK(solids::signed_volume(extract_part(shape, part)) > 0);
    }
  }
}

/// Smallest angle of a triangle, radians; 0 for one without area.
double smallest_angle(const Shape& shape, Eigen::Index t) {
  double smallest = 4;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d a = shape.corner(t, (k + 1) % 3) - shape.corner(t, k);
    const Eigen::Vector3d b = shape.corner(t, (k + 2) % 3) - shape.corner(t, k);
    smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return smallest;
}

TEST_CASE("models have 500 to 5000 faces of fair shape and no point twice in a part") {
  for (const auto& [name, shape] : all_models()) {
    INFO(name);
    CHECK(shape.triangle_count() >= 500);
    CHECK(shape.triangle_count() <= 5000);
    Eigen::Index slivers = 0;
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
      const double angle = smallest_angle(shape, t);
      CHECK(angle > 0.005);
      if (angle < 0.035) ++slivers;
    }
    CHECK(slivers <= shape.triangle_count() / 8);
    for (Eigen::Index part = 0; part < shape.part_count(); ++part) {
      const Shape piece = extract_part(shape, part);
      std::set<std::array<double, 3>> points;
      for (Eigen::Index v = 0; v < piece.vertex_count(); ++v)
        points.insert({piece.vertices(v, 0), piece.vertices(v, 1), piece.vertices(v, 2)});
      CHECK(static_cast<Eigen::Index>(points.size()) == piece.vertex_count());
    }
  }
}

TEST_CASE("models stand on the floor around the origin and have the size of real objects, in metres") {
  for (const auto& [name, shape] : all_models()) {
    INFO(name);
    const Eigen::RowVector3d low = shape.vertices.colwise().minCoeff(),
                             high = shape.vertices.colwise().maxCoeff();
    CHECK(shape.unit == Unit::metre);
    CHECK(low.z() == 0);
    CHECK((low.x() < 0 && low.y() < 0 && high.x() > 0 && high.y() > 0));
    CHECK((high - low).maxCoeff() < 1.5);
    CHECK((high - low).minCoeff() > 0.06);
    const Eigen::MatrixXd micrometres = shape.vertices * 1e6;
    CHECK((micrometres - micrometres.array().round().matrix()).cwiseAbs().maxCoeff() < 1e-6);
  }
}

/// How often a horizontal ray away from the axis crosses the shape.
int crossings_outwards(const Shape& shape, const Eigen::Vector3d& from) {
  const Eigen::Vector3d out = Eigen::Vector3d(from.x() + 1e-5, from.y() + 2e-5, 0).normalized();
  int count = 0;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    const Eigen::Vector3d a = shape.corner(t, 0);
    Eigen::Matrix3d system;
    system << shape.corner(t, 1) - a, shape.corner(t, 2) - a, -out;
    const Eigen::Vector3d solution = system.fullPivLu().solve(from - a);
    if (system.determinant() != 0 && solution.minCoeff() > 0 && solution.x() + solution.y() < 1) ++count;
  }
  return count;
}

TEST_CASE("handles begin inside the wall and leave the inside of their vessel free") {
  for (const Shape& vessel :
       {mug_with_handle(), pot_with_handle(), bucket_with_handles(), basket(), crate()}) {
    const Shape body = extract_part(vessel, 0);
    for (Eigen::Index part = 1; part < vessel.part_count(); ++part) {
      const std::string& name = vessel.part_names[static_cast<std::size_t>(part)];
      if (name.find("handle") == std::string::npos && name.find("grip") == std::string::npos) continue;
      const Shape handle = extract_part(vessel, part);
      int in_wall = 0, in_cavity = 0;
      for (Eigen::Index v = 0; v < handle.vertex_count(); ++v) {
        const int crossings = crossings_outwards(body, handle.vertices.row(v));
        if (crossings == 2) ++in_cavity;
        if (crossings == 1) ++in_wall;
      }
      INFO(name << " of a vessel " << vessel.vertices.col(2).maxCoeff() << " m high");
      CHECK(in_cavity == 0);
      CHECK(in_wall > 0);
    }
  }
}

TEST_CASE("the furniture is symmetric between left and right") {
  for (const Shape& shape : {table(), stool(), chair(), armchair()}) {
    std::set<std::array<double, 3>> points;
    for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
      points.insert({shape.vertices(v, 0), shape.vertices(v, 1), shape.vertices(v, 2)});
    for (const auto& [x, y, z] : points) {
      INFO("point " << x << ' ' << y << ' ' << z);
      REQUIRE(points.count({-x, y, z}) == 1);
    }
  }
}

}  // namespace
}  // namespace stackabilization::models
