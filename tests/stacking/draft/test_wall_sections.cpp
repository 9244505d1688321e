#include <algorithm>

#include "stacking/draft/wall_sections.h"
#include "support/catch.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::detail;

namespace {

bool is_between(const std::vector<PlaneSection>& sections, double s, double height) {
  bool above = false, below = false;
  for (const PlaneSection& one : sections) {
    if (s < one.from || s > one.to) continue;
    above = above || one.at(s) > height;
    below = below || one.at(s) < height;
  }
  return above && below;
}

int count_around(const std::vector<Trapezoid>& areas, double s, double height) {
  return static_cast<int>(std::count_if(areas.begin(), areas.end(), [&](const Trapezoid& one) {
    if (s <= one.from || s >= one.to) return false;
    const double t = (s - one.from) / (one.to - one.from);
    return height > one.low_from + t * (one.low_to - one.low_from) &&
           height < one.high_from + t * (one.high_to - one.high_from);
  }));
}

double area_of(const std::vector<Trapezoid>& areas) {
  double sum = 0;
  for (const Trapezoid& one : areas)
    sum += (one.to - one.from) * (one.high_from - one.low_from + one.high_to - one.low_to) / 2;
  return sum;
}

}  // namespace

TEST_CASE("what lies between random sections has one above and one below, and is told once") {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    solids::Random random(seed);
    std::vector<PlaneSection> sections;
    for (int k = 0; k < 12; ++k) {
      const double a = random.uniform(0, 10), b = random.uniform(0, 10);
      sections.push_back({std::min(a, b), std::max(a, b), random.uniform(0, 5), random.uniform(0, 5)});
    }
    const std::vector<Trapezoid> areas = area_between(sections);
    int inside = 0;
    for (int k = 0; k < 2000; ++k) {
      const double s = random.uniform(0, 10), height = random.uniform(0, 5);
      const bool expected = is_between(sections, s, height);
      CHECK(count_around(areas, s, height) == (expected ? 1 : 0));
      inside += expected;
    }
    CHECK(inside > 200);
    std::reverse(sections.begin(), sections.end());
    CHECK(area_of(area_between(sections)) == Approx(area_of(areas)));
  }
}

TEST_CASE("the area between two crossing sections is two triangles") {
  CHECK(area_of(area_between({{0, 4, 0, 4}, {0, 4, 4, 0}})) == Approx(8));
  CHECK(area_of(area_between({{0, 4, 1, 1}, {0, 4, 3, 3}, {0, 4, 2, 2}})) == Approx(8));
  CHECK(area_of(area_between({{0, 2, 1, 1}, {3, 4, 3, 3}})) == 0);
  CHECK(area_between({{0, 4, 1, 1}, {2, 2, 0, 5}}).empty());
  CHECK(area_of(area_between({{0, 4, 1, 1}, {0, 4, 1, 1}})) == 0);
  CHECK(area_between({}).empty());
}
