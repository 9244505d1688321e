#include "rendering/drawing/plot_parts.h"
#include "rendering/pictures/map_panel.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/rendering/pictures.h"

namespace stackabilization {

Drawing map_picture(const StackabilityMap& map, const MapPictureOptions& options) {
  const MapSample& best = detail::best_sample(map.samples);
  Drawing drawing{options.width, options.height, {}};
  const double size = options.width / 48.0, margin = 1.5 * size;
  const detail::Heading heading =
      detail::heading(options.title.empty() ? "Stackability S over all directions" : options.title,
                      {"best S = " + fixed_text(best.stackability, 4) + " " + direction_text(best.direction) +
                       " (red ring), of " + std::to_string(map.samples.size()) + " directions"},
                      options.width, size);
  drawing.add(heading.elements);
  drawing.add(
      detail::map_panel({margin, heading.bottom, options.width - 2 * margin, options.height - heading.bottom},
                        map.samples, size));
  return drawing;
}

}  // namespace stackabilization
