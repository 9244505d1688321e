#include "accuracy/sampling.h"

#include <algorithm>

#include "common/clock.h"
#ifdef STACKABILIZATION_WITH_RENDERING
#include "stackabilization/rendering/depth_raster.h"
#endif

namespace stackabilization::experiments {
namespace {

constexpr int coarsest = 32;

double longer_side(const Shape& shape, const Direction& direction) {
  const Frame frame = frame_of(direction);
  return std::max(range_along(shape, frame.u).length(), range_along(shape, frame.v).length());
}

Sampling sampled(const Sampler& sampler, const Direction& direction, const Window& window) {
  const Stopwatch watch;
  const HeightField field = sampler.sample(direction, window);
  Sampling result{sampler.method, std::max(window.columns, window.rows), 0, window, 0, 0};
  result.f_max = maximum_gap(field).value;
  result.processor_seconds = watch.processor_seconds();
  return result;
}

}  // namespace

std::vector<Sampler> samplers(const Shape& shape) {
  const auto caster = std::make_shared<RayCaster>(shape);
  std::vector<Sampler> list = {
      {"CPU raster",
       [&shape](const Direction& direction, const Window& window) {
         return height_field_by_scanline(shape, direction, window);
       },
       2048, 4096},
      {"rays",
       [caster](const Direction& direction, const Window& window) { return caster->cast(direction, window); },
       256, 512}};
#ifdef STACKABILIZATION_WITH_RENDERING
  const auto rasterizer = std::make_shared<DepthRasterizer>(shape);
  list.push_back({"OpenGL raster",
                  [rasterizer](const Direction& direction, const Window& window) {
                    return rasterizer->height_field(direction, window);
                  },
                  1024, 4096});
#endif
  return list;
}

std::vector<Sampling> sample_all(const Shape& shape, const std::vector<Sampler>& samplers,
                                 const Direction& direction, bool one_of_few) {
  const double side = longer_side(shape, direction);
  std::vector<Sampling> all;
  for (const Sampler& sampler : samplers)
    for (int n = coarsest; n <= (one_of_few ? sampler.largest : sampler.max_for_all); n *= 2)
      all.push_back(sampled(sampler, direction, window_around(shape, direction, n)));
#ifdef STACKABILIZATION_WITH_RENDERING
  all.push_back(sampled(samplers.back(), direction, authors_window(shape, direction)));
  all.back().method = authors_method;
#endif
  for (Sampling& one : all) one.across = side / one.window.pixel_size;
  return all;
}

}  // namespace stackabilization::experiments
