#include "apps/measurement.h"

#include <algorithm>

#include "apps/rendering.h"
#include "stackabilization/envelope/height_field.h"

namespace stackabilization::apps {

namespace {

/// Eq. 3 with a given f_max.
void set_f_max(Stackability& values, double f_max) {
  values.f_max = f_max;
  if (values.box_volume > 0)
    values.value = 1 - f_max / values.extent * (values.stack_box_volume / values.box_volume);
}

HeightField sampled_field(const Shape& shape, const Direction& direction, Method method,
                          const Window& window) {
  switch (method) {
    case Method::rays:
      return height_field_by_rays(shape, direction, window);
    case Method::raster:
      return height_field_by_scanline(shape, direction, window);
    default:
      return depth_buffer_field(shape, direction, window);
  }
}

}  // namespace

Measurement measure_exactly(const StackabilitySolver& solver, const Direction& direction) {
  Measurement measurement;
  measurement.options = solver.options();
  measurement.values = solver.measure(direction);
  measurement.separation = solver.separation(direction);
  if (!measurement.separation->blocked) return measurement;
  set_f_max(measurement.values, measurement.separation->length);
  ContactOptions options;
  options.semantics = solver.options().semantics;
  measurement.contacts =
      contact_regions({solver.shape(), solver.tree(), direction, *measurement.separation}, options);
  return measurement;
}

Measurement measure_by_sampling(const StackabilitySolver& solver, const Direction& direction, Method method,
                                int resolution) {
  const Shape& shape = solver.shape();
  const Window window = window_around(shape, direction, resolution);
  const double f_max = maximum_gap(sampled_field(shape, direction, method, window)).value;

  Measurement measurement;
  measurement.method = method;
  measurement.options = solver.options();
  measurement.values = solver.measure(direction);
  const Separation separation = solver.separation(direction);
  const double exact = separation.blocked ? separation.length : 0;
  Sampling sampling{resolution, window.pixel_size, window.columns, window.rows, exact, f_max - exact, {}};
  if (resolution >= 2) {
    const Window coarse = window_around(shape, direction, resolution / 2);
    sampling.half_resolution_error =
        maximum_gap(sampled_field(shape, direction, method, coarse)).value - exact;
  }
  measurement.sampling = sampling;
  set_f_max(measurement.values, f_max);
  return measurement;
}

}  // namespace stackabilization::apps
