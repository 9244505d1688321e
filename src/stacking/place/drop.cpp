#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/place.h"
#include "stacking/measure/exact_span.h"
#include "stacking/place/local_frame.h"
#include "stacking/place/place_region.h"

namespace stackabilization {

namespace {

constexpr double max_map_places = 4e6;
/// Places of a map that are computed between two questions whether to go on.
constexpr std::size_t places_per_batch = 1024;

/// The line along r through the centre of the box of the shape.
Line turning_axis(const Direction& direction, const Place& given) {
  const Frame frame = frame_of(direction);
  return {given.x * frame.u + given.y * frame.v, direction};
}

/// Distances of grid points from the middle of [low, high]: multiples of the step.
std::vector<double> grid(double low, double high, double step) {
  const double middle = low / 2 + high / 2;
  const auto reach = static_cast<int>(std::floor((high - low) / 2 / step));
  std::vector<double> coordinates;
  for (int i = -reach; i <= reach; ++i) coordinates.push_back(middle + i * step);
  return coordinates;
}

}  // namespace

Place given_place(const Shape& shape, const Direction& direction) {
  validate(shape);
  const Eigen::Vector2d centre = detail::LocalShapes(shape, shape, direction).centre;
  return {centre.x(), centre.y(), 0};
}

RigidTransform transform_to(const Shape& shape, const Direction& direction, const Place& place) {
  if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.yaw_degrees))
    throw UsageError("a place needs finite coordinates and a finite turn");
  const Place given = given_place(shape, direction);
  const Frame frame = frame_of(direction);
  RigidTransform transform;
  if (place.yaw_degrees != 0) transform = rotation_about(turning_axis(direction, given), place.yaw_degrees);
  transform.translation += (place.x - given.x) * frame.u + (place.y - given.y) * frame.v;
  return transform;
}

Drop drop_at(const Shape& base, const Shape& shape, const Direction& direction, const Place& place,
             ContactSemantics semantics) {
  Drop drop;
  drop.place = place;
  drop.transform = transform_to(shape, direction, place);
  const Shape moved = transformed(shape, drop.transform);
  drop.separation =
      separation(SeparationTree(base), SeparationTree(moved), direction, {semantics, std::nullopt});
  const Span below = exact_span(base, direction), above = exact_span(moved, direction);
  drop.lift = below.bottom - above.bottom;
  drop.on_floor = !(drop.separation.blocked && drop.separation.value >= drop.lift);
  if (!drop.on_floor) drop.lift = drop.separation.value;
  const double unit = direction.length();
  drop.lift_length = drop.lift.to_double() * unit;
  drop.height = (drop.lift + above.bottom - below.bottom).to_double() * unit;
  return drop;
}

DropMap drop_map(const Shape& base, const Shape& shape, const Direction& direction, double step,
                 double yaw_degrees, const PlaceOptions& options) {
  validate(base);
  if (!(step > 0)) throw UsageError("the step of a map must be a positive length");
  Place place = given_place(shape, direction);
  const detail::PlaceRegion region(detail::LocalShapes(base, shape, direction), options.region);
  const detail::PlanarBox box = region.box(yaw_degrees * std::numbers::pi / 180, 0);
  if (!((box.width() / step + 1) * (box.height() / step + 1) <= max_map_places))
    throw UsageError("the step of the map is so small that it has more than four million places");
  DropMap map{grid(box.x_low, box.x_high, step), grid(box.y_low, box.y_high, step), {}, false};
  place.yaw_degrees = yaw_degrees;
  const Shape turned = transformed(shape, transform_to(shape, direction, place));
  const SeparationTree below(base), above(turned);
  const Span floor = exact_span(base, direction), bottom = exact_span(turned, direction);
  const Frame frame = frame_of(direction);
  std::vector<double> heights(map.x.size() * map.y.size());
  for (std::size_t begin = 0; begin < heights.size(); begin += places_per_batch) {
    if (options.progress) options.progress(static_cast<double>(begin) / static_cast<double>(heights.size()));
    if (options.cancelled && options.cancelled()) {
      map.cancelled = true;
      return map;
    }
    tbb::parallel_for(begin, std::min(begin + places_per_batch, heights.size()), [&](std::size_t k) {
      const double x = map.x[k % map.x.size()] - place.x, y = map.y[k / map.x.size()] - place.y;
      const Eigen::Vector3d shift = x * frame.u + y * frame.v;
      const Separation found =
          separation(below, above.translated(shift), direction, {options.semantics, std::nullopt});
      if (!found.blocked) return;
      const Rational level = found.value + bottom.bottom - floor.bottom;
      heights[k] = std::max(0.0, level.to_double() * direction.length() + shift.dot(direction.unit()));
    });
  }
  map.heights = std::move(heights);
  return map;
}

}  // namespace stackabilization
