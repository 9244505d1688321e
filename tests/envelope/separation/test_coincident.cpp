#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "envelope/separation/separation_tree.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/io/read.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::solids;

namespace {

/// `count` copies of a shape of one part, a part each, moved by up to `shift` along each axis.
Shape instances(const Shape& one, int count, double shift) {
  Random random(5);
  const auto v = one.vertex_count(), t = one.triangle_count();
  Shape all;
  all.vertices.resize(count * v, 3);
  all.triangles.resize(count * t, 3);
  for (int k = 0; k < count; ++k) {
    all.vertices.middleRows(k * v, v) = one.vertices.rowwise() + (shift * random.in_cube()).transpose();
    all.triangles.middleRows(k * t, t) = one.triangles.array() + static_cast<std::int32_t>(k * v);
    all.triangle_part.insert(all.triangle_part.end(), static_cast<std::size_t>(t), k);
    all.part_names.push_back("part " + std::to_string(k));
  }
  return all;
}

SeparationOptions with_queue(ContactSemantics semantics, std::int64_t max_queue) {
  SeparationOptions options;
  options.semantics = semantics;
  options.max_queue = max_queue;
  return options;
}

void check_witness(const Shape& shape, const Separation& found, const Direction& direction) {
  const Eigen::Vector3d lift = found.witness.upper_point - found.witness.lower_point;
  CHECK((lift - found.value.to_double() * direction.vector()).norm() < 1e-12);
  for (const std::int32_t triangle : {found.witness.upper_triangle, found.witness.lower_triangle}) {
    CHECK(triangle >= 0);
    CHECK(triangle < shape.triangle_count());
  }
}

/// All that a query says but its counts.
void check_same_answer(const Separation& a, const Separation& b) {
  REQUIRE(a.blocked == b.blocked);
  CHECK(a.value == b.value);
  CHECK(a.length == b.length);
}

const std::vector<Direction>& few_directions() {
  static const std::vector<Direction> list = {{0, 0, 1}, {1, 0, 0}, {0.3, -0.2, 1}, {1, 2, 3}};
  return list;
}

Contacts contacts_of(const Shape& shape, const Direction& direction, const ContactOptions& options = {}) {
  const SeparationTree tree(shape);
  const Separation found = separation(tree, tree, direction, {options.semantics, {}});
  return contact_regions({shape, tree, direction, found}, options);
}

}  // namespace

TEST_CASE("triangles with the same three points are one, named by the first") {
  const Shape cube = box({1, 1, 1});
  const Shape many = instances(cube, 300, 0);
  const SeparationTree tree(many), one(cube);
  CHECK(tree.data().triangles.size() == 12);
  CHECK(tree.data().copies.size() == 299 * 12);
  for (const TreeTriangle& triangle : tree.data().triangles) CHECK(triangle.index < 12);
  for (const TriangleCopy& copy : tree.data().copies) CHECK(copy.first == copy.copy % 12);
  for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed})
    for (const Direction& r : few_directions()) {
      const Separation a = separation(tree, tree, r, {semantics, {}}),
                       b = separation(one, one, r, {semantics, {}});
      check_same_answer(a, b);
      CHECK(a.witness.upper_triangle == b.witness.upper_triangle);
      CHECK(a.witness.lower_triangle == b.witness.lower_triangle);
      CHECK(a.work.node_pairs == b.work.node_pairs);
    }
}

TEST_CASE("triangles are the same however their corners are listed, and with zeros of either sign") {
  Points points(9, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0,        //
      -0.0, 1, 0, 0, -0.0, 0, 1, -0.0, -0.0,  //
      0, 1, 0, 1, 0, 0, 0, 0, 1e-300;
  Triangles triangles(3, 3);
  triangles << 0, 1, 2, 3, 4, 5, 6, 7, 8;
  const SeparationTree tree(make_shape(points, triangles));
  CHECK(tree.data().triangles.size() == 2);
  REQUIRE(tree.data().copies.size() == 1);
  CHECK(tree.data().copies[0].first == 0);
  CHECK(tree.data().copies[0].copy == 1);
}

TEST_CASE("a shape and some of its triangles twice are measured alike") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Soup soup;
    soup.seed = seed;
    soup.count = 40;
    soup.size = 1;
    soup.grid_bits = seed % 2 == 0 ? 2 : 0;
    const Shape shape = triangle_soup(soup);
    const Shape twice = concatenate(shape, permuted(flipped(shape), seed));
    const SeparationTree a(shape), b(twice);
    for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed})
      for (const Direction& r : few_directions()) {
        const Separation once = separation(a, a, r, {semantics, {}}),
                         doubled = separation(b, b, r, {semantics, {}});
        REQUIRE(once.blocked == doubled.blocked);
        if (!once.blocked) continue;
        CHECK(once.value == doubled.value);
        CHECK(doubled.witness.upper_triangle < shape.triangle_count());
        CHECK(doubled.witness.lower_triangle < shape.triangle_count());
      }
  }
}

TEST_CASE("far from the file's origin coincident triangles are one as well") {
  const Shape many = instances(box({1, 1, 1}), 20, 0), there = moved(many, {1000, 0, 0});
  const SeparationTree near(many), far(there);
  CHECK(far.data().triangles.size() == 12);
  const Separation found = separation(near, far, Direction(1, 0, 0));
  CHECK(found.value == Rational(-999.0));
  CHECK(found.witness.upper_triangle < 12);
  CHECK(found.witness.lower_triangle < 12);
}

TEST_CASE("a bounded queue finds the same value, and keeps to its bound") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Soup soup;
    soup.seed = seed;
    soup.count = 150;
    soup.size = seed % 3 == 0 ? 1 : 0.3;
    soup.grid_bits = seed % 2 == 0 ? 3 : 0;
    const Shape shape = triangle_soup(soup);
    const SeparationTree tree(shape);
    for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed})
      for (const Direction& r : few_directions()) {
        const Separation free = separation(tree, tree, r, with_queue(semantics, std::int64_t{1} << 40));
        const Enclosure wide = separation_enclosure(tree, tree, r, with_queue(semantics, 2));
        for (const std::int64_t bound : {0, 1, 2, 7, 64}) {
          const Separation bounded = separation(tree, tree, r, with_queue(semantics, bound));
          check_same_answer(free, bounded);
          if (bounded.blocked) check_witness(shape, bounded, r);
          CHECK(bounded.work.longest_queue <= bound + 64);
        }
        if (!free.blocked) continue;
        CHECK(Rational(wide.lower) <= free.value);
        CHECK(Rational(wide.upper) >= free.value);
        CHECK((wide.upper - wide.lower) * r.length() < 1e-10);
      }
  }
}

TEST_CASE("a bounded queue finds the same value on the shipped models") {
  const std::filesystem::path folder = std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "data/models";
  for (const char* const name : {"chair.obj", "basket.obj", "mug_with_handle.obj"}) {
    INFO(name);
    const SeparationTree tree(read_shape(folder / name));
    for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed})
      for (const Direction& r : few_directions()) {
        const Separation free = separation(tree, tree, r, {semantics, {}});
        for (const std::int64_t bound : {0, 5}) {
          const Separation bounded = separation(tree, tree, r, with_queue(semantics, bound));
          check_same_answer(free, bounded);
          CHECK(bounded.work.longest_queue <= bound + 100);
        }
      }
  }
}

TEST_CASE("abandoning works with a full queue") {
  const SeparationTree tree(box({1, 2, 3}));
  SeparationOptions options = with_queue(ContactSemantics::solid, 0);
  options.abandon_above = 2.0;
  CHECK(separation_enclosure(tree, tree, upwards, options).abandoned);
}

TEST_CASE("the work for parts in nearly the same place grows with their number, not its square") {
  for (const double shift : {1e-3, 1e-12})
    for (const ContactSemantics semantics : {ContactSemantics::solid, ContactSemantics::closed})
      for (const Direction& r : {Direction(0, 0, 1), Direction(0.3, 0.2, 1)}) {
        const Shape many = instances(box({1, 1, 1}), 500, shift);
        const SeparationTree tree(many);
        const SeparationWork work = separation(tree, tree, r, {semantics, {}}).work;
        INFO(shift);
        CHECK(work.node_pairs < 20 * many.triangle_count());
        CHECK(work.triangle_pairs < 20 * many.triangle_count());
        CHECK(work.exact_pairs < 1000);
        CHECK(work.longest_queue < 20 * many.triangle_count());
      }
}

TEST_CASE("contacts of few coincident parts are those of all pairs of them") {
  const Contacts contacts = contacts_of(instances(box({1, 1, 1}), 5, 0), upwards);
  CHECK(contacts.complete);
  CHECK(contacts.coincident_parts.empty());
  REQUIRE(contacts.regions.size() == 25);
  std::set<std::pair<int, int>> pairs;
  for (const ContactRegion& region : contacts.regions) {
    CHECK(region.area == Approx(1));
    pairs.insert({region.upper_part, region.lower_part});
  }
  CHECK(pairs.size() == 25);
}

TEST_CASE("contacts of many coincident parts name the first, and say which others touch") {
  const int count = 3000;
  const Contacts contacts = contacts_of(instances(box({1, 1, 1}), count, 0), upwards);
  CHECK_FALSE(contacts.complete);
  REQUIRE(contacts.regions.size() == 1);
  CHECK(contacts.regions[0].upper_part == 0);
  CHECK(contacts.regions[0].lower_part == 0);
  CHECK(contacts.regions[0].area == Approx(1));
  REQUIRE(contacts.coincident_parts.size() == count - 1);
  CHECK(contacts.coincident_parts.front() == 1);
  CHECK(contacts.coincident_parts.back() == count - 1);
}

TEST_CASE("contacts of many nearly coincident parts name every part that touches, and are bounded") {
  const int count = 300;
  for (const double shift : {1e-3, 1e-12}) {
    const Shape shape = instances(box({1, 1, 1}), count, shift);
    ContactOptions options;
    options.max_pairs = 1000;
    const Contacts contacts = contacts_of(shape, upwards, options);
    CHECK_FALSE(contacts.complete);
    std::set<int> upper, lower;
    std::size_t polygons = 0;
    for (const ContactRegion& region : contacts.regions) {
      upper.insert(region.upper_part);
      lower.insert(region.lower_part);
      polygons += region.polygons.size();
    }
    CHECK(upper.size() == count);
    CHECK(lower.size() == count);
    CHECK(polygons <= 2 * static_cast<std::size_t>(shape.triangle_count()));
    CHECK(contacts.coincident_parts.empty());
  }
}

TEST_CASE("where too many pairs touch, each triangle keeps its deepest partner") {
  Soup soup;
  soup.count = 60;
  soup.size = 1;
  const Shape shape = triangle_soup(soup);
  const Direction r(0.3, -0.2, 1);
  ContactOptions all, few;
  all.band = few.band = 0.3;
  few.max_pairs = -8 * shape.triangle_count();
  const auto depth_of = [&](const ContactPolygon& polygon) {
    return ((polygon.upper_points - polygon.lower_points) * r.unit()).maxCoeff();
  };
  using Depths = std::map<std::pair<int, std::int32_t>, double>;
  const auto depths = [&](const Contacts& contacts) {
    Depths result;
    for (const ContactRegion& region : contacts.regions)
      for (const ContactPolygon& polygon : region.polygons)
        for (const auto& key : {std::pair(0, polygon.upper_triangle), std::pair(1, polygon.lower_triangle)}) {
          double& depth = result.try_emplace(key, 0.0).first->second;
          depth = std::max(depth, depth_of(polygon));
        }
    return result;
  };
  const Contacts complete = contacts_of(shape, r, all), bounded = contacts_of(shape, r, few);
  CHECK(complete.complete);
  CHECK_FALSE(bounded.complete);
  const Depths expected = depths(complete), found = depths(bounded);
  REQUIRE(found.size() == expected.size());
  for (const auto& [key, depth] : expected) CHECK(found.at(key) == Approx(depth).margin(1e-8));
}

TEST_CASE("a part of many nearly coincident pieces has one region with the area of their union") {
  Shape pieces = instances(box({1, 1, 1}), 60, 1e-3);
  pieces.triangle_part.assign(pieces.triangle_part.size(), 0);
  pieces.part_names = {"all"};
  const Contacts contacts = contacts_of(pieces, upwards);
  REQUIRE(contacts.regions.size() == 1);
  CHECK(contacts.complete);
  CHECK(contacts.regions[0].area == Approx(1).margin(0.01));
  CHECK(contacts.regions[0].area > 1);
}
