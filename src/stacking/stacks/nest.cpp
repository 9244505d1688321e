#include "stackabilization/stacking/nest.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/clearance.h"
#include "stacking/measure/exact_span.h"

namespace stackabilization {

std::optional<double> NestResult::stackability() const {
  if (!(box_volume > 0)) return std::nullopt;
  return 1 - stack_box_volume / box_volume;
}

NestResult nest(const Shape& container, const Shape& content, const Direction& direction,
                const NestOptions& options) {
  if (!(options.clearance >= 0 && options.clearance <= tolerance::max_coordinate))
    throw UsageError("the clearance must be a length from 0 to 10^60");
  validate(container);
  validate(content);
  const double unit = direction.length();
  const Span below = exact_span(container, direction), above = exact_span(content, direction);

  NestResult result;
  result.separation = separation_with_play(container, content, direction,
                                           {options.play, options.play_corners, options.semantics});
  result.offset = below.bottom - above.bottom;
  result.on_floor = true;
  if (result.separation.blocked) {
    Rational lift = result.separation.value + Rational(options.clearance / unit);
    if (lift >= result.offset) {
      result.offset = std::move(lift);
      result.on_floor = false;
    }
  }
  result.offset_length = result.offset.to_double() * unit;
  result.container_height = (below.top - below.bottom).to_double() * unit;
  result.content_height = (above.top - above.bottom).to_double() * unit;
  const Rational top = std::max(below.top, above.top + result.offset);
  result.total_height = (top - below.bottom).to_double() * unit;
  result.saving = result.container_height + result.content_height - result.total_height;
  const auto volume = [&](const Shape& shape) { return box_volume(HullSupport(shape), options.boxes); };
  result.content =
      transformed(content, Eigen::Matrix3d::Identity(), result.offset.to_double() * direction.vector());
  result.box_volume = volume(container) + volume(content);
  result.stack_box_volume = volume(concatenate(container, result.content));
  return result;
}

}  // namespace stackabilization
