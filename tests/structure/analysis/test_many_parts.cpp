#include <algorithm>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/extract_parts.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/mesh/box_pairs.h"
#include "stackabilization/structure/analysis.h"
#include "structure/model/part_surface.h"
#include "structure/symmetry/part_match.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using solids::Random;

namespace {

/// `count` shapes as one, each a part.
Shape joined(const std::vector<Shape>& shapes) {
  Shape all;
  Eigen::Index vertices = 0, triangles = 0;
  for (const Shape& shape : shapes) {
    vertices += shape.vertex_count();
    triangles += shape.triangle_count();
  }
  all.vertices.resize(vertices, 3);
  all.triangles.resize(triangles, 3);
  vertices = triangles = 0;
  for (const Shape& shape : shapes) {
    all.vertices.middleRows(vertices, shape.vertex_count()) = shape.vertices;
    all.triangles.middleRows(triangles, shape.triangle_count()) =
        shape.triangles.array() + static_cast<std::int32_t>(vertices);
    all.triangle_part.insert(all.triangle_part.end(), static_cast<std::size_t>(shape.triangle_count()),
                             static_cast<std::int32_t>(all.part_names.size()));
    all.part_names.push_back("part" + std::to_string(all.part_names.size()));
    vertices += shape.vertex_count();
    triangles += shape.triangle_count();
  }
  return all;
}

/// Unit cubes `step` apart.
Shape grid(int nx, int ny, int nz, double step) {
  std::vector<Shape> cubes;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) {
        const Eigen::Vector3d low = step * Eigen::Vector3d(i, j, k);
        cubes.push_back(solids::box(low, low + Eigen::Vector3d::Ones()));
      }
  return joined(cubes);
}

/// Boxes of all poses, many of them across each other.
Shape random_boxes(std::uint64_t seed, int count, double side) {
  Random random(seed);
  std::vector<Shape> boxes;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d size = 0.6 * (random.in_cube() + Eigen::Vector3d::Constant(1.1));
    boxes.push_back(
        transformed(solids::box(size), solids::random_rotation(random.next()), side * random.in_cube()));
  }
  return joined(boxes);
}

BoxPairs all_pairs(const std::vector<Eigen::AlignedBox3d>& boxes, double reach) {
  BoxPairs pairs;
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      if (boxes[a].isEmpty() || boxes[b].isEmpty()) continue;
      if ((boxes[a].min().array() - reach <= boxes[b].max().array()).all() &&
          (boxes[b].min().array() - reach <= boxes[a].max().array()).all())
        pairs.emplace_back(static_cast<int>(a), static_cast<int>(b));
    }
  return pairs;
}

/// Diameter of the smallest ball around the shape, which the reach of joints is a fraction of.
double size_of(const Shape& shape) {
  std::vector<Eigen::Vector3d> corners;
  for (const auto& v : shape.vertices.rowwise()) corners.emplace_back(v.transpose());
  return detail::enclosing_diameter(corners);
}

bool same(const Shape& a, const Shape& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles && a.part_names == b.part_names &&
         a.triangle_part == b.triangle_part && a.unit == b.unit;
}

std::vector<Part> cuboids(const Shape& shape) {
  std::vector<Part> parts;
  for (const Shape& part : extract_parts(shape)) {
    const FittedPrimitive fitted = fit_primitive(part);
    parts.push_back({part.part_names[0], fitted.primitive, fitted.fit});
  }
  return parts;
}

}  // namespace

TEST_CASE("near boxes are those that a look at every pair finds", "[parts]") {
  Random random(11);
  for (const double reach : {0.0, 0.25, 1.0})
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<Eigen::AlignedBox3d> boxes(1);  // an empty one
      for (int k = 0; k < 60; ++k) {
        // Multiples of 1/4: many touch, and many coincide.
        const auto whole = [&] { return Eigen::Vector3d((8 * random.in_cube()).array().floor() / 4); };
        const Eigen::Vector3d low = whole();
        boxes.emplace_back(low, low + whole().cwiseAbs() / 4);
      }
      const BoxPairs expected = all_pairs(boxes, reach);
      REQUIRE_FALSE(expected.empty());
      const auto found = near_boxes(boxes, reach, expected.size());
      REQUIRE(found);
      CHECK(*found == expected);
      CHECK_FALSE(near_boxes(boxes, reach, expected.size() - 1));
    }
  CHECK(near_boxes({}, 1, 0)->empty());
}

TEST_CASE("no more pairs of boxes are gone through than are allowed", "[parts]") {
  // 20,000 boxes in one place have 200 million pairs: a search through them would not end here.
  const std::vector<Eigen::AlignedBox3d> boxes(
      20000, Eigen::AlignedBox3d(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()));
  CHECK_FALSE(near_boxes(boxes, 0, 1000));
}

TEST_CASE("parts taken out all at once are those taken out one by one", "[parts]") {
  for (const Shape& shape : {solids::table({}), solids::permuted(solids::table({}), 5), grid(2, 2, 1, 1),
                             solids::triangle_soup({.seed = 3, .count = 50, .parts = 7})}) {
    const std::vector<Shape> parts = extract_parts(shape);
    REQUIRE(parts.size() == shape.part_names.size());
    for (std::size_t k = 0; k < parts.size(); ++k)
      CHECK(same(parts[k], extract_part(shape, static_cast<Eigen::Index>(k))));
  }
}

TEST_CASE("joints are those that a look at every pair of parts finds, but for hidden ones",
          "[parts][joints]") {
  for (const Shape& shape :
       {random_boxes(1, 20, 1.5), random_boxes(2, 30, 4), grid(3, 2, 2, 1), grid(2, 2, 2, 1.5)}) {
    const std::vector<Part> parts = cuboids(shape);
    const std::vector<Shape> pieces = extract_parts(shape);
    const auto count = static_cast<int>(parts.size());
    std::set<std::vector<int>> found, alone;
    for (const Relation& joint : find_joints(shape, parts)) found.insert(joint.parts);
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b) {
        const Shape two = joined({pieces[static_cast<std::size_t>(a)], pieces[static_cast<std::size_t>(b)]});
        JointOptions options;
        options.reach *= size_of(shape) / size_of(two);  // the same length
        if (!find_joints(two, {parts[static_cast<std::size_t>(a)], parts[static_cast<std::size_t>(b)]},
                         options)
                 .empty())
          alone.insert({a, b});
      }
    CHECK(std::includes(alone.begin(), alone.end(), found.begin(), found.end()));
    const auto meet = [&](int a, int b) { return alone.contains({std::min(a, b), std::max(a, b)}); };
    for (const std::vector<int>& pair : alone) {
      if (found.contains(pair)) continue;
      bool may_hide = false;
      for (int third = 0; third < count; ++third)
        may_hide |= third != pair[0] && third != pair[1] && meet(pair[0], third) && meet(pair[1], third);
      CAPTURE(pair[0], pair[1]);
      CHECK(may_hide);
    }
  }
}

TEST_CASE("a grid of touching cubes has as many near pairs as it has neighbours", "[parts][joints]") {
  for (const int n : {2, 3, 5}) {
    const Shape shape = grid(n, n, n, 1);
    // Cubes meet the up to 26 around them, at faces, edges and corners.
    const int directed = (3 * n - 2) * (3 * n - 2) * (3 * n - 2) - n * n * n;
    CHECK(near_parts(shape, {}).size() == static_cast<std::size_t>(directed / 2));
  }
}

TEST_CASE("the counterparts of a part are among those near its image", "[parts][symmetry]") {
  Random random(4);
  for (const Shape& shape : {grid(4, 3, 2, 1.5), random_boxes(8, 20, 3), solids::table({})}) {
    const detail::PartSurfaces parts(shape, {});
    for (int axis = 0; axis < 3; ++axis) {
      const Symmetry plane{SymmetryKind::reflection, parts.whole().centroid, Eigen::Vector3d::Unit(axis), 2};
      for (int a = 0; a < parts.count(); ++a) {
        const std::vector<int> near = parts.near_image(a, plane);
        CHECK(std::is_sorted(near.begin(), near.end()));
        CHECK(near.size() <= 2);  // not the square of the parts
        for (int b = 0; b < parts.count(); ++b)
          if (parts.match(a, b, plane)) CHECK(std::count(near.begin(), near.end(), b) == 1);
      }
    }
  }
}

TEST_CASE("of copies of one part in one place a bounded number is compared", "[parts][symmetry]") {
  const Shape shape = joined(std::vector<Shape>(100, solids::box({1, 2, 3})));
  const detail::PartSurfaces parts(shape, {});
  const Symmetry plane{SymmetryKind::reflection, parts.whole().centroid, Eigen::Vector3d::UnitX(), 2};
  const std::vector<int> near = parts.near_image(50, plane);
  REQUIRE(near.size() == detail::PartSurfaces::max_matches);
  CHECK(near.front() == 0);
  CHECK(near.back() == static_cast<int>(near.size()) - 1);
}

TEST_CASE("more parts or pairs of parts than are analysed are refused before the work", "[parts][analysis]") {
  const Shape shape = grid(3, 3, 1, 1);
  AnalysisOptions parts, pairs, triangles, enough;
  std::vector<AnalysisStep> steps;
  const auto listen = [&](AnalysisStep step, double) { steps.push_back(step); };
  parts.progress = pairs.progress = listen;
  parts.max_parts = 8;
  pairs.joints.max_pairs = 19;
  triangles.joints.max_pair_triangles = 479;
  enough.max_parts = 9;
  enough.joints.max_pairs = 20;
  enough.joints.max_pair_triangles = 480;
  CHECK_THROWS_AS(analyse_structure(shape, parts), InputError);
  CHECK_THROWS_WITH(analyse_structure(shape, parts),
                    "it has 9 parts, and the structure of at most 8 is analysed");
  CHECK_THROWS_AS(analyse_structure(shape, pairs), InputError);
  CHECK_THROWS_WITH(
      analyse_structure(shape, pairs),
      "more than 19 pairs of its parts come near each other, by their boxes: joints are looked for "
      "between at most so many");
  CHECK_THROWS_AS(analyse_structure(shape, triangles), InputError);
  CHECK_THROWS_WITH(
      analyse_structure(shape, triangles),
      "the 20 pairs of its parts that come near each other have 480 triangles, counted pair by pair: "
      "joints are looked for between at most 479");
  CHECK(steps == std::vector<AnalysisStep>(4, AnalysisStep::parts));
  CHECK(analyse_structure(shape, enough).structure.parts.size() == 9);
}

TEST_CASE("the analysis tells each of its steps, in order, from the calling thread", "[parts][analysis]") {
  std::vector<AnalysisStep> steps;
  double before = 0;
  AnalysisOptions options;
  options.progress = [&, caller = std::this_thread::get_id()](AnalysisStep step, double fraction) {
    CHECK(std::this_thread::get_id() == caller);
    CHECK((fraction >= 0 && fraction <= 1));
    if (steps.empty() || steps.back() != step) {
      steps.push_back(step);
      before = 0;
    }
    CHECK(fraction >= before);
    before = fraction;
  };
  analyse_structure(grid(3, 2, 1, 1.5), options);
  CHECK(steps == std::vector<AnalysisStep>{AnalysisStep::parts, AnalysisStep::primitives,
                                           AnalysisStep::symmetries, AnalysisStep::joints});
}
