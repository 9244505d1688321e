#include <algorithm>
#include <cmath>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/separators.h"
#include "stackabilization/stacking/stack.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::solids;

namespace {

SeparatorOptions gap_of(double lift, double layer) {
  SeparatorOptions options;
  options.lift = lift;
  options.layer = layer;
  return options;
}

}  // namespace

TEST_CASE("the separator of a box is the slab between it and the next one") {
  const Eigen::Matrix3d turn = random_rotation(5);
  const Shape turned = transformed(box({4, 3, 2}), turn, {1, -2, 3});
  for (const bool straight : {true, false}) {
    const Shape shape = straight ? box({4, 3, 2}) : turned;
    const Direction direction = straight ? upwards : Direction(0.5 * turn.col(2));
    const Shape slab = separators(shape, direction, gap_of(2.3, 0.1));
    CHECK(slab.part_count() == 1);
    CHECK(is_closed(slab));
    CHECK(signed_volume(slab) == Approx(12 * 0.3));
    const Range along = range_along(slab, direction.unit()), box_along = range_along(shape, direction.unit());
    CHECK(along.low == Approx(box_along.high));
    CHECK(along.length() == Approx(0.3));
  }
}

TEST_CASE("the separator of a cup is a ring where the gap is narrow") {
  // f falls by 7.5 per unit of radius inwards of the foot's edge at 3, and by 0.5 outwards.
  FrustumShell cup;
  cup.segments = 16;
  const Shape shape = frustum_shell(cup);
  const double gap = 0.2, layer = 0.15, lift = frustum_shell_f_max(cup) + gap;
  const Shape ring = separators(shape, upwards, gap_of(lift, layer));
  CHECK(ring.part_count() == 1);
  const double inner = 3 - layer / 7.5, outer = 3 + 2 * layer;
  // The integral of (gap + slope (rho - 3)) 2 rho from a to b.
  const auto swept = [gap](double slope, double a, double b) {
    const auto antiderivative = [&](double rho) {
      return (gap - 3 * slope) * rho * rho + slope * 2 / 3 * rho * rho * rho;
    };
    return antiderivative(b) - antiderivative(a);
  };
  const double polygon = 16 / 2.0 * std::sin(2 * std::numbers::pi / 16);
  CHECK(signed_volume(ring) ==
        Approx(polygon * (swept(-7.5, inner, 3) + swept(0.5, 3, outer))).epsilon(1e-6));
}

TEST_CASE("each place where copies are close has a separator of its own") {
  const Table legs;
  const Shape bodies = separators(table(legs), upwards, gap_of(legs.height + 0.25, 0.25));
  CHECK(bodies.part_names == std::vector<std::string>{"region_1", "region_2", "region_3", "region_4"});
  CHECK(signed_volume(bodies) == Approx(4 * legs.leg * legs.leg * 0.25));
  for (Eigen::Index part = 0; part < 4; ++part)
    CHECK(signed_volume(extract_part(bodies, part)) == Approx(legs.leg * legs.leg * 0.25));
}

TEST_CASE("separators need a gap, and a layer") {
  const Shape shape = box({4, 3, 2});
  CHECK_THROWS_AS(separators(shape, upwards, gap_of(2, 0.1)), UsageError);
  CHECK_THROWS_AS(separators(shape, upwards, gap_of(1, 0.1)), UsageError);
  CHECK_THROWS_AS(separators(shape, upwards, gap_of(2.1, 0)), UsageError);
  CHECK_THROWS_AS(separators(shape, upwards, gap_of(2.1, std::nan(""))), UsageError);
  const Shape wall = transformed(box({1, 1, 1}), Eigen::Vector3d(1, 0, 1).asDiagonal(), {0, 0, 0});
  CHECK(separators(wall, upwards, gap_of(1, 0.1)).triangle_count() == 0);
}

TEST_CASE("copies in whole layers keep their clearance, and less than a layer more") {
  const auto lift_of = [](const Shape& shape, const Direction& direction, double clearance, double layer) {
    StackOptions options;
    options.copies = 4;
    options.clearance = clearance;
    options.layer = layer;
    const StackResult stack = stack_copies(shape, direction, options);
    for (std::size_t k = 0; k < stack.copies.size(); ++k)
      CHECK(stack.copies[k].offset == Rational(static_cast<double>(k)) * stack.copies[1].offset);
    CHECK(stack.increment == Approx(stack.copies[1].offset_length));
    return stack.copies[1].offset;
  };
  CHECK(lift_of(box({1, 1, 1}), upwards, 0, 0.25) == Rational(1.0));
  CHECK(lift_of(box({1, 1, 1}), upwards, 0.01, 0.25) == Rational(1.25));
  CHECK(lift_of(box({1, 1, 1}), upwards, 0.25, 0.25) == Rational(1.25));
  CHECK(lift_of(box({1, 1, 1}), upwards, 0, 3) == Rational(3.0));
  // 0.7 is above 7 times 0.1 in doubles by less than rounding: no layer more where there is clearance.
  CHECK(lift_of(box({1, 1, 0.6}), upwards, 0.1, 0.1) == Rational(7.0) * Rational(0.1));
  // Copies never overlap: 3 times 0.1 is above 0.3, 6 times 0.05 + 2^-60 below it counts as one layer more.
  const double above = std::nextafter(3 * 0.25, 1);
  CHECK(lift_of(box({1, 1, above}), upwards, 0, 0.25) == Rational(1.0));
  const Rational slanted = lift_of(l_shape(2, 1), Direction(1, 0, 1), 0.3, 0.2);
  const double layer = 0.2 / Direction(1, 0, 1).length();
  CHECK((slanted / Rational(layer)).denominator() == "1");
  const double least = l_shape_f_max(2, 1, Direction(1, 0, 1)) + 0.3 / Direction(1, 0, 1).length();
  CHECK(slanted.to_double() >= least);
  CHECK(slanted.to_double() < least + layer);
}

TEST_CASE("copies that are turned have no whole layers") {
  StackOptions options;
  options.layer = 0.1;
  options.twist_degrees = 10;
  CHECK_THROWS_AS(stack_copies(box({1, 1, 1}), upwards, options), UsageError);
  options.twist_degrees = 360;
  CHECK_NOTHROW(stack_copies(box({1, 1, 1}), upwards, options));
  options.poses = {{}, {random_rotation(1), {0, 0, 0}}};
  CHECK_THROWS_AS(stack_copies(box({1, 1, 1}), upwards, options), UsageError);
  options.poses = {};
  for (const double layer : {-1.0, 1e61, std::nan("")}) {
    options.layer = layer;
    CHECK_THROWS_AS(stack_copies(box({1, 1, 1}), upwards, options), UsageError);
  }
  options.layer = 1e-30;
  CHECK_THROWS_AS(stack_copies(box({1, 1, 1}), upwards, options), UsageError);
}
