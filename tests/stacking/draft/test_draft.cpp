#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stackabilization/stacking/draft.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::solids;

namespace {

DraftAnalysis draft_of(const Shape& shape, const Direction& direction = upwards) {
  return analyse_draft(shape, SeparationTree(shape), direction);
}

struct Sums {
  double area = 0, undercut = 0, inner = 0, least_draft = 90;
};

Sums sums_of(const DraftAnalysis& draft) {
  Sums sums;
  for (const TriangleDraft& triangle : draft.triangles) {
    sums.area += triangle.area;
    sums.undercut += triangle.undercut_area;
    sums.inner += triangle.inner_area;
    if (triangle.free_area() > 1e-6 * triangle.area)
      sums.least_draft = std::min(sums.least_draft, triangle.angle);
  }
  return sums;
}

/// Areas are sums over a grid of 2^30 cells.
constexpr double grid_area = 1e-6;

/// A double T, 4 wide and 4 high, with a web 1 wide and flanges 1 thick, 3 long along y.
Shape i_beam() {
  return extruded_profile({{0, 0},
                           {4, 0},
                           {4, 1},
                           {2.5, 1},
                           {2.5, 3},
                           {4, 3},
                           {4, 4},
                           {0, 4},
                           {0, 3},
                           {1.5, 3},
                           {1.5, 1},
                           {0, 1}},
                          3);
}

/// Four undersides of flanges, and both sides of the web between them.
constexpr double undercut_of_beam = 4 * 1.5 * 3 + 2 * 2 * 3;

/// Is there a triangle over, or under, the point on triangle `own`? Moeller and Trumbore along z.
bool is_covered(const Shape& shape, Eigen::Index own, const Eigen::Vector3d& p, double sign) {
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    if (t == own) continue;
    Eigen::Matrix3d corners;
    for (int c = 0; c < 3; ++c) corners.col(c) << shape.corner(t, c).head<2>(), 1;
    const Eigen::Vector3d weights = corners.inverse() * Eigen::Vector3d(p.x(), p.y(), 1);
    if (weights.minCoeff() < 0) continue;
    double height = 0;
    for (int c = 0; c < 3; ++c) height += weights[c] * shape.corner(t, c).z();
    if (sign * (height - p.z()) > 0) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a cup leaves its mould, with the draft of its outer wall") {
  FrustumShell cup;
  cup.segments = 16;
  const DraftAnalysis draft = draft_of(frustum_shell(cup));
  const Sums sums = sums_of(draft);
  CHECK(draft.complete);
  CHECK(draft.undercuts.empty());
  CHECK(sums.undercut == 0);
  CHECK(sums.inner == 0);
  CHECK(sums.area == Approx(surface_area(frustum_shell(cup))));
  // A side of the ring of circumradius rho is at rho cos(pi / n).
  const double rise = (cup.outer_top - cup.outer_bottom) * std::cos(std::numbers::pi / 16);
  CHECK(sums.least_draft == Approx(std::atan2(rise, cup.height) * 180 / std::numbers::pi));
}

TEST_CASE("the flanges and the web of a double T are undercut along the web, and not across it") {
  const Shape beam = i_beam();
  const Sums along = sums_of(draft_of(beam)), back = sums_of(draft_of(beam, Direction(0, 0, -2)));
  CHECK(along.undercut == Approx(undercut_of_beam).margin(grid_area));
  CHECK(back.undercut == Approx(along.undercut).margin(grid_area));
  CHECK(sums_of(draft_of(flipped(beam))).undercut == Approx(along.undercut).margin(grid_area));
  CHECK(along.least_draft == 0);
  CHECK(sums_of(draft_of(beam, Direction(1, 0, 0))).undercut == 0);
  CHECK(sums_of(draft_of(beam, Direction(0, 1, 0))).undercut == 0);
}

TEST_CASE("undercuts turn with the shape and grow with its size") {
  const Shape beam = i_beam();
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Eigen::Matrix3d turn = random_rotation(seed);
    const Shape turned = permuted(transformed(subdivided(beam), 5 * turn, {7, -3, 2}), seed);
    const Sums sums = sums_of(draft_of(turned, Direction(0.1 * turn.col(2))));
    CHECK(sums.undercut == Approx(25 * undercut_of_beam).epsilon(1e-7));
    CHECK(sums.inner == Approx(0).margin(1e-5));
    CHECK(sums.least_draft == Approx(0).margin(1e-5));
  }
}

TEST_CASE("an undercut is the portion that others lie above and below of") {
  // The lower bar has the seat above and nothing below, so only its top is hidden from both sides, and what
  // of the seat's underside is over it.
  const Shape seat = named(box({0, 0, 5}, {10, 10, 6}), "seat");
  const Shape bar = named(box({1, 4, 2}, {9, 5, 3}), "bar");
  const DraftAnalysis draft = draft_of(concatenate(seat, bar));
  CHECK(sums_of(draft).undercut == Approx(8 + 8).margin(grid_area));
  CHECK(sums_of(draft).inner == 0);
  for (const UndercutPiece& piece : draft.undercuts)
    for (Eigen::Index c = 0; c < piece.corners.rows(); ++c) {
      const double z = piece.corners(c, 2);
      CHECK((std::abs(z - 3) < 1e-9 || std::abs(z - 5) < 1e-9));
    }
}

TEST_CASE("where parts touch or overlap there is no surface") {
  const Sums touching = sums_of(draft_of(table({})));
  CHECK(touching.undercut == 0);
  CHECK(touching.inner == Approx(8).margin(grid_area));  // four tops of legs, and the underside over them

  const Shape top = named(box({0, 0, 5}, {8, 8, 6}), "top");
  const Shape leg = named(box({3, 3, 0}, {5, 5, 5.5}), "leg");
  const Sums overlapping = sums_of(draft_of(concatenate(top, leg)));
  CHECK(overlapping.undercut == 0);
  CHECK(overlapping.inner == Approx(8 + 4 * 2 * 0.5).margin(grid_area));  // with the walls inside
  // An open leg has no inside: half of its top is a sheet below another one.
  const Sums open = sums_of(draft_of(concatenate(top, named(open_box({3, 3, 0}, {5, 5, 5}), "leg"))));
  CHECK(open.undercut > 1);
  CHECK(open.inner == 0);
}

TEST_CASE("what is inside is told apart below a surface that hides all") {
  // A table on a board: legs stand inwards, so that the board lies below the whole underside of the top.
  Shape all = concatenate(named(box({0, 0, 0}, {8, 8, 1}), "board"), named(box({0, 0, 5}, {8, 8, 6}), "top"));
  for (const double x : {1.0, 6.0})
    for (const double y : {1.0, 6.0}) all = concatenate(all, named(box({x, y, 1}, {x + 1, y + 1, 5}), "leg"));
  const Sums sums = sums_of(draft_of(all));
  CHECK(sums.inner == Approx(4 * 4).margin(grid_area));  // both ends of legs, and what they touch
  CHECK(sums.undercut == Approx(2 * (64 - 4) + 4 * 4 * 4).margin(grid_area));  // with the sides of legs
}

TEST_CASE("a sheet without extent along the direction has no undercut") {
  Shape sheet = transformed(subdivided(box({2, 3, 1})), Eigen::Vector3d(1, 1, 0).asDiagonal(), {0, 0, 5});
  const Sums sums = sums_of(draft_of(sheet));
  CHECK(sums.area == Approx(2 * 6));
  CHECK(sums.undercut == 0);
  CHECK(sums.inner == 0);
  CHECK(sums.least_draft == 90);
}

TEST_CASE("a sheet over the plane has no undercut, whichever side its triangles face") {
  for (const Shape& sheet : {bumpy_bowl(12), flipped(bumpy_bowl(12))}) {
    const DraftAnalysis draft = draft_of(sheet);
    CHECK(draft.undercuts.empty());
    CHECK(draft.complete);
  }
}

TEST_CASE("undercuts of triangles in any position agree with rays") {
  Soup options;
  options.count = 40;
  options.size = 0.8;
  for (const std::uint64_t seed : {1, 2}) {
    options.seed = seed;
    const Shape soup = triangle_soup(options);
    const DraftAnalysis draft = draft_of(soup);
    Random random(seed);
    double expected = 0, area = 0;
    constexpr int samples = 400;
    for (Eigen::Index t = 0; t < soup.triangle_count(); ++t) {
      const double own = draft.triangles[static_cast<std::size_t>(t)].area;
      int hidden = 0;
      for (int s = 0; s < samples; ++s) {
        double u = random.uniform(), v = random.uniform();
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Eigen::Vector3d p = soup.corner(t, 0) + u * (soup.corner(t, 1) - soup.corner(t, 0)) +
                                  v * (soup.corner(t, 2) - soup.corner(t, 0));
        hidden += is_covered(soup, t, p, 1) && is_covered(soup, t, p, -1);
      }
      expected += own * hidden / samples;
      area += own;
    }
    const double found = sums_of(draft).undercut;
    CHECK(found > 0.1 * area);
    CHECK(found == Approx(expected).margin(0.02 * area));  // over four standard deviations
  }
}

TEST_CASE("a wall has enough triangles above and below it when many coincide") {
  Shape all = named(box({1, 1, 1}, {2, 2, 2}), "core");
  for (int k = 0; k < 400; ++k) {
    all = concatenate(all, named(box({0, 0, -1}, {3, 3, 0}), "below_" + std::to_string(k)));
    all = concatenate(all, named(box({0, 0, 3}, {3, 3, 4}), "above_" + std::to_string(k)));
  }
  const DraftAnalysis draft = draft_of(all);
  CHECK_FALSE(draft.complete);  // the slabs themselves make too many pairs
  double walls = 0;
  for (std::size_t t = 0; t < 12; ++t)
    if (draft.triangles[t].angle == 0) walls += draft.triangles[t].undercut_area;
  CHECK(walls == Approx(4));
}

TEST_CASE("a wall with more triangles above it than are examined is not called undercut") {
  // Walls across x and y: the box around one of them, a quarter of the sheet, has 1,800 triangles, or 9,800.
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Shape core = named(transformed(box({-0.7, -0.7, 1}, {0.7, 0.7, 2}), turn, {0, 0, 0}), "core");
  const Shape base = named(box({-2, -2, -1}, {2, 2, 0}), "base");
  for (const int cells : {60, 140}) {
    const Shape sheet = named(moved(bumpy_bowl(cells), {0, 0, 9}), "sheet");
    const DraftAnalysis draft = draft_of(concatenate(concatenate(core, base), sheet));
    CHECK(draft.complete == (cells == 60));
    double walls = 0;
    for (std::size_t t = 0; t < 12; ++t)
      if (draft.triangles[t].angle == 0) walls += draft.triangles[t].undercut_area;
    CHECK(walls == Approx(cells == 60 ? 4 * 1.4 : 0));
  }
}
