#include "apps/common/measurement.h"

#include <algorithm>
#include <cmath>

#include "apps/common/rendering.h"
#include "stackabilization/envelope/height_field.h"

namespace stackabilization::apps {

namespace {

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
  const ExactStackability exact = solver.measure_exact(direction);
  measurement.values = exact.stackability;
  measurement.separation = exact.separation;
  if (!exact.separation.blocked) return measurement;
  measurement.gradients = separation_gradients({solver.tree(), solver.tree(), direction, exact.separation},
                                               {.semantics = solver.options().semantics});
  ContactOptions options;
  options.semantics = solver.options().semantics;
  measurement.contacts =
      contact_regions({solver.shape(), solver.tree(), direction, exact.separation}, options);
  return measurement;
}

LayerFit measure_layer(const StackabilitySolver& solver, const Measurement& measured, double layer,
                       int resolution) {
  const Shape& shape = solver.shape();
  const Direction direction(measured.values.direction);
  const double height = measured.values.extent;
  ContactOptions options;
  options.semantics = measured.options.semantics;
  options.band = height > 0 ? std::min(1.0, layer / height) : 1;
  LayerFit result;
  result.layer = layer;
  result.resolution = resolution;
  result.contacts = contact_regions({shape, solver.tree(), direction, *measured.separation}, options);
  result.fit = close_fit(shape, direction, result.contacts);
  const Eigen::MatrixXd samples =
      gap(height_field_by_scanline(shape, direction, window_around(shape, direction, resolution)));
  for (const double sample : samples.reshaped())
    if (!std::isnan(sample))
      result.largest_gap = std::max(result.largest_gap, measured.values.f_max - sample);
  return result;
}

Measurement measure_by_sampling(const StackabilitySolver& solver, const Direction& direction, Method method,
                                int resolution) {
  const Shape& shape = solver.shape();
  const Window window = window_around(shape, direction, resolution);
  const double f_max = maximum_gap(sampled_field(shape, direction, method, window)).value;

  Measurement measurement;
  measurement.method = method;
  measurement.options = solver.options();
  const Stackability measured = solver.measure_exact(direction).stackability;
  const double exact = measured.f_max;
  Sampling sampling{resolution, window.pixel_size, window.columns, window.rows, exact, f_max - exact, {}};
  if (resolution >= 2) {
    const Window coarse = window_around(shape, direction, resolution / 2);
    sampling.half_resolution_error =
        maximum_gap(sampled_field(shape, direction, method, coarse)).value - exact;
  }
  measurement.sampling = sampling;
  measurement.values = measured.with_f_max(f_max);
  return measurement;
}

}  // namespace stackabilization::apps
