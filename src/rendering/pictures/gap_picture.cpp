#include "rendering/drawing/plot_parts.h"
#include "stackabilization/rendering/pictures.h"

namespace stackabilization {

Drawing gap_picture(const HeightField& field, const PictureOptions& options) {
  Drawing drawing{options.width, options.height, {}};
  const double size = options.width / 50.0, margin = 1.5 * size;
  const GapMaximum peak = maximum_gap(field);
  const std::string note = peak.column < 0 ? "nothing is covered"
                                           : "largest sampled value " +
                                                 detail::length_text(peak.value, field.unit) + " (red ring)";
  const detail::Heading heading = detail::heading(
      options.title.empty() ? "Gap function f = u - l" : options.title, {note}, options.width, size);
  drawing.add(heading.elements);
  const double top = heading.bottom + 0.7 * size;
  drawing.add(detail::gap_panel({margin, top, options.width - 2 * margin, options.height - top - margin},
                                field, size));
  return drawing;
}

}  // namespace stackabilization
