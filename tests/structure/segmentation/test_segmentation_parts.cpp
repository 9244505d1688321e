#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "stackabilization/io/read.h"
#include "stackabilization/mesh/boxes.h"
#include "stackabilization/structure/segmentation.h"
#include "structure/segmentation/chords.h"
#include "structure/segmentation/surface_graph.h"
#include "structure/segmentation/volume_fit.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"
#include "support/voxels.h"

using namespace stackabilization;

namespace {

Shape cut(const Shape& shape, int parts = 0, SegmentationMethod method = SegmentationMethod::primitives) {
  SegmentationOptions options;
  options.method = method;
  options.parts = parts;
  return segment(shape, options);
}

double area_of(const Shape& shape, Eigen::Index t) {
  const Eigen::Vector3d a = shape.corner(t, 0);
  return (shape.corner(t, 1) - a).cross(shape.corner(t, 2) - a).norm() / 2;
}

/// Share of each part in the area.
std::vector<double> area_shares(const Shape& shape) {
  std::vector<double> shares(static_cast<std::size_t>(shape.part_count()), 0);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    shares[static_cast<std::size_t>(shape.triangle_part[static_cast<std::size_t>(t)])] += area_of(shape, t);
  const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= total;
  return shares;
}

/// Share of the area of which the part is the one that `found` pairs with the true part: for each found part
/// the true part it shares most with.
double agreement(const Shape& truth, const Shape& found) {
  std::map<std::int32_t, std::map<std::int32_t, double>> shared;
  double total = 0, same = 0;
  for (Eigen::Index t = 0; t < truth.triangle_count(); ++t) {
    const auto row = static_cast<std::size_t>(t);
    shared[found.triangle_part[row]][truth.triangle_part[row]] += area_of(truth, t);
    total += area_of(truth, t);
  }
  for (const auto& [part, areas] : shared)
    same += std::max_element(areas.begin(), areas.end(), [](const auto& a, const auto& b) {
              return a.second < b.second;
            })->second;
  return same / total;
}

double sum_of_box_volumes(const Shape& shape) {
  double sum = 0;
  for (Eigen::Index p = 0; p < shape.part_count(); ++p)
    sum += minimal_oriented_box(HullSupport(extract_part(shape, p))).volume();
  return sum;
}

/// Do the triangles of each part hang together through shared vertices?
bool parts_are_connected(const Shape& shape) {
  for (Eigen::Index p = 0; p < shape.part_count(); ++p) {
    Shape part = extract_part(shape, p);
    if (cut(part, 0, SegmentationMethod::components).part_count() != 1) return false;
  }
  return true;
}

/// Share of the area whose image in the plane across axis `axis` at `place` lies in another part than most of
/// the image of its part does. The image of a triangle is the one with the nearest centre.
double asymmetry(const Shape& shape, int axis, double place) {
  const auto centre = [&](Eigen::Index t) {
    return Eigen::Vector3d((shape.corner(t, 0) + shape.corner(t, 1) + shape.corner(t, 2)) / 3);
  };
  Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(shape.part_count(), shape.part_count());
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    Eigen::Vector3d image = centre(t);
    image(axis) = 2 * place - image(axis);
    Eigen::Index nearest = 0;
    for (Eigen::Index s = 1; s < shape.triangle_count(); ++s)
      if ((centre(s) - image).squaredNorm() < (centre(nearest) - image).squaredNorm()) nearest = s;
    shared(shape.triangle_part[static_cast<std::size_t>(t)],
           shape.triangle_part[static_cast<std::size_t>(nearest)]) += area_of(shape, t);
  }
  return 1 - shared.rowwise().maxCoeff().sum() / shared.sum();
}

/// Partition of the triangles as numbers in order of first appearance.
std::vector<int> partition(const std::vector<std::int32_t>& part) {
  std::map<std::int32_t, int> number;
  std::vector<int> result;
  for (const std::int32_t p : part)
    result.push_back(number.try_emplace(p, static_cast<int>(number.size())).first->second);
  return result;
}

const solids::GridBox seat{{0, 0, 12}, {16, 16, 14}};
const std::vector<solids::GridBox> stool{seat,
                                         {{1, 1, 0}, {3, 3, 12}},
                                         {{13, 1, 0}, {15, 3, 12}},
                                         {{1, 13, 0}, {3, 15, 12}},
                                         {{13, 13, 0}, {15, 15, 12}}};
const std::vector<solids::GridBox> dumbbell{
    {{0, 0, 0}, {6, 6, 6}}, {{16, 0, 0}, {22, 6, 6}}, {{6, 2, 2}, {16, 4, 4}}};

}  // namespace

TEST_CASE("a table made as one surface falls into its top and its legs") {
  const Shape truth = solids::grid_union(stool);
  for (const int parts : {0, 5}) {
    const Shape found = cut(truth, parts);
    CHECK(found.part_count() == 5);
    CHECK(agreement(truth, found) > 0.99);
    CHECK(parts_are_connected(found));
  }
}

TEST_CASE("a symmetric shape is cut alike on both sides, however rough its surface is") {
  for (const std::uint64_t seed : {2, 4}) {
    INFO("seed " << seed);
    Shape rough = solids::grid_union(stool);
    solids::Random random(seed);
    for (Eigen::Index v = 0; v < rough.vertex_count(); ++v)
      rough.vertices.row(v) += 0.45 * random.in_cube().transpose();  // up to 3 % of the diagonal
    const Shape found = cut(rough);
    // A number of parts that is asked for is kept, with whatever cut the roughness suggests.
    const Shape as_asked = cut(rough, 5);
    CHECK(as_asked.part_count() == 5);
    for (const int axis : {0, 1}) {
      CHECK(asymmetry(as_asked, axis, 8) > 0.08);
      CHECK(asymmetry(found, axis, 8) < 0.03);
    }
  }
}

TEST_CASE("two boxes joined by a thin bar are three parts, cut along the concave edges") {
  const Shape truth = solids::grid_union(dumbbell);
  const Shape found = cut(truth);
  CHECK(found.part_count() == 3);
  CHECK(partition(found.triangle_part) == partition(truth.triangle_part));
  CHECK(found.part_names == std::vector<std::string>{"part_1", "part_2", "part_3"});
}

TEST_CASE("an L falls into two boxes that fill it") {
  const Shape l = solids::grid_union({{{0, 0, 0}, {16, 6, 4}}, {{0, 0, 4}, {4, 6, 14}}});
  const double volume = solids::signed_volume(l);
  const Shape found = cut(l, 2);
  REQUIRE(found.part_count() == 2);
  CHECK(sum_of_box_volumes(make_shape(l.vertices, l.triangles)) > 1.9 * volume);
  CHECK(sum_of_box_volumes(found) == Approx(volume).epsilon(0.05));
  CHECK(cut(l).part_count() == 2);
}

TEST_CASE("with one part asked for there is one") {
  CHECK(cut(solids::grid_union(dumbbell), 1).part_count() == 1);
}

TEST_CASE("parts do not depend on pose, scale, or the order of the triangles") {
  const Shape truth = solids::grid_union(stool);
  const Eigen::Matrix3d turn = solids::random_rotation(7);
  for (const double scale : {1.0, 1e-3, 1e4}) {
    const Shape found = cut(transformed(truth, scale * turn, Eigen::Vector3d(3, -2, 5) * scale));
    CHECK(partition(found.triangle_part) == partition(cut(truth).triangle_part));
  }
  for (const std::uint64_t seed : {1, 2, 3}) {
    Shape mixed = solids::permuted(truth, seed);
    const Shape found = cut(mixed);
    CHECK(found.part_count() == 5);
    CHECK(partition(found.triangle_part) == partition(mixed.triangle_part));
  }
  const Shape inside_out = cut(solids::flipped(truth));
  CHECK(partition(inside_out.triangle_part) == partition(truth.triangle_part));
}

TEST_CASE("the error of a volume scales with the shape, to the bit") {
  solids::Polygon profile;  // a paraboloid that stands off the origin
  for (int k = 0; k <= 12; ++k) profile.push_back({std::sqrt(k / 3.0), 5 + 0.5 * k});
  profile.push_back({0, 11});
  const auto error = [](const Shape& shape) {
    const detail::SurfaceGraph graph = detail::surface_graph(shape);
    const std::vector<std::int32_t> patch(static_cast<std::size_t>(graph.size()), 0);
    const std::vector<detail::Chord> found = detail::chords(shape, graph, patch, 400);
    std::vector<std::int32_t> all(found.size());
    std::iota(all.begin(), all.end(), 0);
    return detail::volume_error(found, all);
  };
  const Shape solid = solids::surface_of_revolution(profile, 24);
  const double expected = error(solid);
  CHECK(expected > 0);
  for (const int exponent : {-40, -10, 10, 40}) {
    Shape scaled = solid;
    scaled.vertices *= std::exp2(exponent);
    CHECK(error(scaled) == std::exp2(4 * exponent) * expected);  // area times squared length
  }
}

TEST_CASE("the shape diameter tells thick from thin") {
  // Two balls of radius 2 on a bar of radius 0.4.
  solids::Polygon profile;
  for (int k = 0; k <= 14; ++k) {
    const Eigen::Vector2d p = 2 * solids::circle_point(k - 8, 32);
    profile.push_back({std::max(0.0, p.x()), p.y() + 2});
  }
  for (int k = 1; k < 12; ++k) profile.push_back({0.4, 3.9 + 0.25 * k});
  for (int k = 0; k <= 14; ++k) {
    const Eigen::Vector2d p = 2 * solids::circle_point(k - 6, 32);
    profile.push_back({std::max(0.0, p.x()), p.y() + 8.7});
  }
  const Shape barbell = solids::surface_of_revolution(profile, 24);
  const Shape found = cut(barbell, 3, SegmentationMethod::shape_diameter);
  REQUIRE(found.part_count() == 3);
  const Shape bar = extract_part(found, 2);
  const Range z = range_along(bar, Eigen::Vector3d::UnitZ());
  CHECK(z.low == Approx(3.9).margin(0.4));
  CHECK(z.high == Approx(6.8).margin(0.4));
}

TEST_CASE("a shell hangs on the larger shell that is nearest, not on the largest of all") {
  // A patch on the side of a leg, under a top that is larger and farther away.
  const Shape top = solids::box({0, 0, 10}, {9, 9, 11}), leg = solids::box({1, 1, 0}, {2, 2, 9});
  Points corners(3, 3);
  corners << 1, 1.2, 1, 1, 1.8, 1, 1, 1.5, 1.5;
  const Shape patch = make_shape(corners, Triangles(Eigen::RowVector3i(0, 1, 2)));
  const Shape shape = concatenate(concatenate(top, leg), patch);
  detail::SurfaceGraph graph = detail::surface_graph(shape);
  const std::size_t within = graph.links.size();
  detail::link_shells(graph, shape, 0.01);
  REQUIRE(graph.links.size() == within + 2);
  const auto between = [](const detail::SurfaceLink& link) {
    const auto shell = [](std::int32_t triangle) { return triangle / 12; };  // 0 top, 1 leg, 2 patch
    return std::minmax({shell(link.a), shell(link.b)});
  };
  CHECK(between(graph.links[within]) == std::minmax({0, 1}));
  CHECK(between(graph.links[within + 1]) == std::minmax({1, 2}));
}

TEST_CASE("a sheet, a soup and sheets on one edge end with every triangle in a part") {
  Points points(5, 3);
  points << 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, -1, 0;
  Triangles triangles(6, 3);
  triangles << 0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 0, 1, 2, 2, 2, 0, 1,
      2;  // three fins, two degenerate, one double
  const Shape fins = make_shape(points, triangles);
  solids::Soup soup;
  soup.count = 300;
  soup.grid_bits = 2;
  Points flat(4, 3);
  flat << 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0;
  Triangles collapsed(2, 3);
  collapsed << 0, 1, 2, 1, 2, 3;
  for (const Shape& shape : {fins, solids::triangle_soup(soup), make_shape(flat, collapsed)})
    for (const auto method : {SegmentationMethod::components, SegmentationMethod::primitives,
                              SegmentationMethod::shape_diameter, SegmentationMethod::automatic}) {
      const Shape found = cut(shape, 0, method);
      CHECK_NOTHROW(validate(found));
      CHECK(found.triangle_part.size() == shape.triangle_part.size());
      CHECK(std::set<std::int32_t>(found.triangle_part.begin(), found.triangle_part.end()).size() ==
            found.part_names.size());
    }
}

TEST_CASE("seeds on the boxes of a table give back its parts") {
  const Shape truth = solids::grid_union(stool);
  std::vector<PartSeeds> seeds;
  for (std::int32_t p = 0; p < 5; ++p) {
    // The triangles in the middle of the part's list.
    std::vector<std::int32_t> members;
    for (std::int32_t t = 0; t < truth.triangle_count(); ++t)
      if (truth.triangle_part[static_cast<std::size_t>(t)] == p) members.push_back(t);
    seeds.push_back({"mine_" + std::to_string(p), {members[members.size() / 2]}});
  }
  const Shape found = segment(truth, seeds);
  CHECK(agreement(truth, found) > 0.98);
  CHECK(found.part_names.front() == "mine_0");
  for (std::size_t p = 0; p < seeds.size(); ++p)
    CHECK(found.triangle_part[static_cast<std::size_t>(seeds[p].triangles[0])] ==
          static_cast<std::int32_t>(p));
}

TEST_CASE("a component without a seed goes to the part nearest in space") {
  const Shape near = solids::box({0, 0, 0}, {1, 1, 1}), far = solids::box({9, 0, 0}, {10, 1, 1});
  const Shape lone = solids::box({2, 0, 0}, {3, 1, 1});
  const Shape found = segment(concatenate(concatenate(near, far), lone), {{"far", {12}}, {"near", {0}}});
  for (std::size_t t = 0; t < 36; ++t) CHECK(found.triangle_part[t] == (t >= 12 && t < 24 ? 0 : 1));
}

TEST_CASE("the authors' connected models are cut") {
  const char* folder = std::getenv("STACKABILIZATION_PAPER_DATA");
  if (!folder) {
    std::cout << "SKIPPED: STACKABILIZATION_PAPER_DATA is not set\n";
    return;
  }
  const std::filesystem::path data = std::filesystem::path(folder) / "stacker" / "data";
  for (const char* name : {"selected/68.obj", "stackablechair_chocolate.obj"}) {
    const Shape shape = read_shape(data / name);
    CHECK(cut(shape, 0, SegmentationMethod::components).part_count() == 1);
    for (const auto method : {SegmentationMethod::primitives, SegmentationMethod::shape_diameter}) {
      const Shape found = cut(shape, 0, method);
      INFO(name << (method == SegmentationMethod::primitives ? ", primitives" : ", shape diameter"));
      CHECK_NOTHROW(validate(found));
      CHECK(found.triangles == shape.triangles);
      // Nothing that comes off is a splinter, and what is left is not nearly everything.
      const std::vector<double> shares = area_shares(found);
      CHECK(shares.size() >= 2);
      CHECK(*std::min_element(shares.begin(), shares.end()) >= 0.02);
      CHECK(*std::max_element(shares.begin(), shares.end()) <= 0.86);
    }
  }
}

TEST_CASE("a body of revolution stays whole, cut only when asked to") {
  // A hat: brim, crown and flat top in one surface.
  const int sides = 48;
  const std::vector<Eigen::Vector2d> profile = {{0, 0},       {1, 0},     {1, 0.05},
                                                {0.55, 0.05}, {0.5, 0.8}, {0, 0.8}};
  Points points(static_cast<Eigen::Index>(sides * profile.size()), 3);
  for (int k = 0; k < sides; ++k)
    for (std::size_t i = 0; i < profile.size(); ++i) {
      const double turn = 2 * std::acos(-1.0) * k / sides;
      points.row(static_cast<Eigen::Index>(i) * sides + k) << profile[i].x() * std::cos(turn),
          profile[i].x() * std::sin(turn), profile[i].y();
    }
  Triangles triangles(static_cast<Eigen::Index>(2 * sides * (profile.size() - 1)), 3);
  for (Eigen::Index i = 0, t = 0; i + 1 < static_cast<Eigen::Index>(profile.size()); ++i)
    for (int k = 0; k < sides; ++k) {
      const auto a = static_cast<int>(i) * sides, b = a + sides, next = (k + 1) % sides;
      triangles.row(t++) << a + k, a + next, b + next;
      triangles.row(t++) << a + k, b + next, b + k;
    }
  const Shape hat = make_shape(points, triangles);
  CHECK(cut(hat, 0, SegmentationMethod::automatic).part_count() == 1);
  CHECK(cut(hat, 2, SegmentationMethod::automatic).part_count() == 2);
}
