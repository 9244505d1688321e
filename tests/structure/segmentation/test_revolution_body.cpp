#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <vector>

#include "stackabilization/io/read.h"
#include "stackabilization/structure/segmentation.h"
#include "structure/segmentation/revolution_body.h"
#include "structure/segmentation/surface_graph.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"
#include "support/voxels.h"

using namespace stackabilization;

namespace {

constexpr double smallest = 0.005;

std::vector<char> body_of(const Shape& shape, double small = smallest) {
  return detail::revolution_body(shape, detail::surface_graph(shape), small);
}

/// A cup with bars of the given length that stick out at some of its rim's `places`, each connected to it at
/// one vertex.
struct CupWithBars {
  Shape shape;
  std::vector<char> body;
};

CupWithBars cup_with_bars(double length, int count, int places = 4) {
  CupWithBars result{solids::frustum_shell({}), {}};
  result.body.assign(result.shape.triangle_part.size(), 1);
  Eigen::Index rim = 0;
  (result.shape.vertices.col(0) + result.shape.vertices.col(2)).maxCoeff(&rim);
  const Eigen::Vector3d corner = result.shape.vertices.row(rim).transpose();
  for (int k = 0; k < count; ++k) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(2 * k * std::numbers::pi / places, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    Shape bar = solids::box(corner - Eigen::Vector3d(0, 0, 1), corner + Eigen::Vector3d(length, 0.8, 0));
    bar = transformed(bar, turn, {0, 0, 0});
    // The corner meets the cup in one vertex, to the bit.
    Eigen::Index on_rim = 0, of_bar = 0;
    const Eigen::Vector3d meeting = turn * corner;
    (result.shape.vertices.rowwise() - meeting.transpose()).rowwise().squaredNorm().minCoeff(&on_rim);
    (bar.vertices.rowwise() - meeting.transpose()).rowwise().squaredNorm().minCoeff(&of_bar);
    bar.vertices.row(of_bar) = result.shape.vertices.row(on_rim);
    result.body.insert(result.body.end(), bar.triangle_part.size(), 0);
    result.shape = concatenate(result.shape, bar);
  }
  result.shape.triangle_part.assign(result.shape.triangle_part.size(), 0);
  result.shape.part_names = {"cup"};
  return result;
}

}  // namespace

TEST_CASE("a cup keeps its body, whatever sticks out of it, in every pose and size") {
  for (const int bars : {1, 2, 4})
    for (const double length : {3.0, 8.0}) {
      const CupWithBars cup = cup_with_bars(length, bars);
      CAPTURE(bars, length);
      CHECK(body_of(cup.shape) == cup.body);
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        Shape posed = transformed(cup.shape, solids::random_rotation(seed), {3, -1, 7});
        posed.vertices *= 1 << (4 * seed);
        CHECK(body_of(posed) == cup.body);
      }
    }
}

TEST_CASE("what is small, or does not stick out, counts as the body of revolution") {
  const CupWithBars cup = cup_with_bars(1, 1);
  CHECK(body_of(cup.shape) == cup.body);
  CHECK(body_of(cup.shape, 0.05).empty());
  CHECK(body_of(solids::frustum_shell({})).empty());
}

TEST_CASE("a cup out of round keeps its body, a wheel with teeth has none") {
  CupWithBars cup = cup_with_bars(3, 2);
  for (Eigen::Index v = 0; v < cup.shape.vertex_count(); ++v) {
    const double turn = std::atan2(cup.shape.vertices(v, 1), cup.shape.vertices(v, 0));
    cup.shape.vertices.row(v).head<2>() *= 1 + 0.02 * std::cos(3 * turn);
  }
  CHECK(body_of(cup.shape) == cup.body);
  CHECK(body_of(cup_with_bars(0.9, 4, 32).shape).size() == 512 + 4 * 12);
  CHECK(body_of(cup_with_bars(0.9, 32, 32).shape).empty());
}

TEST_CASE("plates, boxes, beams and what is not connected have no body of revolution") {
  CHECK(body_of(solids::box({0, 0, 0}, {6, 6, 0.5})).empty());
  CHECK(body_of(solids::grid_union({{{0, 0, 0}, {16, 16, 1}}})).empty());  // around its inscribed disc
  CHECK(body_of(solids::grid_union({{{0, 0, 0}, {5, 5, 5}}})).empty());
  CHECK(body_of(solids::grid_union({{{0, 0, 0}, {2, 2, 20}}})).empty());
  CHECK(body_of(solids::l_shape(4, 1)).empty());
  Shape apart = solids::frustum_shell({});
  Shape bar = solids::box({6, 0, 0}, {9, 1, 1});
  CHECK(body_of(concatenate(apart, bar)).empty());
}

TEST_CASE("scanned cups and a vase are a body of revolution and a handle") {
  const char* folder = std::getenv("STACKABILIZATION_CORPORA");
  if (!folder) {
    std::cout << "SKIPPED: STACKABILIZATION_CORPORA is not set\n";
    return;
  }
  for (const char* name : {"23.off", "31.off", "39.off", "374.off"}) {
    const Shape parts = segment(read_shape(std::filesystem::path(folder) / "psb" / "data" / "off" / name));
    INFO(name);
    CHECK(parts.part_count() == 2);
    const auto of_body = std::count(parts.triangle_part.begin(), parts.triangle_part.end(), 0);
    CHECK(static_cast<double>(of_body) >= 0.85 * static_cast<double>(parts.triangle_count()));
  }
}

TEST_CASE("a cup and its handles are parts, the body of revolution one of them") {
  const CupWithBars cup = cup_with_bars(3, 2);
  const Shape parts = segment(cup.shape);
  CHECK(parts.part_count() == 3);
  for (std::size_t t = 0; t < cup.body.size(); ++t)
    if (cup.body[t] == 0) CHECK(parts.triangle_part[t] != 0);
}
