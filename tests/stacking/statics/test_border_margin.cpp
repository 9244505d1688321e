#include "stacking/statics/border_margin.h"
#include "support/catch.h"

namespace stackabilization::detail {
namespace {

constexpr double resolution = 1e-9;

TEST_CASE("the margin of a polygon is the distance of its nearest side, outside that of its nearest point") {
  const auto square_at = [](double x, double y) {
    return border_margin({{x - 1, y - 1}, {x + 1, y - 1}, {x + 1, y + 1}, {x - 1, y + 1}, {x, y}},
                         resolution);
  };
  CHECK(square_at(0.25, 0).distance == Approx(0.75));
  CHECK(square_at(0.25, 0).outwards.isApprox(Eigen::Vector2d(-1, 0)));
  CHECK(square_at(0, -0.5).outwards.isApprox(Eigen::Vector2d(0, 1)));
  CHECK(square_at(3, 0).distance == Approx(-2));
  CHECK(square_at(3, 0).outwards.isApprox(Eigen::Vector2d(-1, 0)));
  CHECK(square_at(4, 5).distance == Approx(-5));  // a corner
  CHECK(square_at(4, 5).outwards.isApprox(Eigen::Vector2d(-0.6, -0.8)));
  CHECK(square_at(1, 0).distance == 0);
  CHECK(square_at(1, 0).outwards.isApprox(Eigen::Vector2d(-1, 0)));
  CHECK_FALSE(square_at(1, 0).flat);
}

TEST_CASE("segments and points have no inside") {
  const BorderMargin through = border_margin({{-1, 0}, {0.5, 0}, {2, 0}}, resolution);
  CHECK(through.flat);
  CHECK(through.distance == 0);
  CHECK(std::abs(through.outwards.y()) == Approx(1));
  const BorderMargin beside = border_margin({{-1, 2}, {2, 2}}, resolution);
  CHECK(beside.flat);
  CHECK(beside.distance == Approx(-2));
  CHECK(beside.outwards.isApprox(Eigen::Vector2d(0, -1)));
  CHECK(border_margin({{3, 4}, {3, 4}}, resolution).distance == Approx(-5));
  const BorderMargin nothing = border_margin({{0, 0}}, resolution);
  CHECK(nothing.distance == 0);
  CHECK(nothing.outwards == Eigen::Vector2d::Zero());
}

}  // namespace
}  // namespace stackabilization::detail
