#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/plot_parts.h"

namespace stackabilization {

Drawing gap_picture(const HeightField& field, const PictureOptions& options) {
  Drawing drawing{options.width, options.height, {}};
  const double size = options.width / 50.0, margin = 1.2 * size;
  const std::string title = options.title.empty() ? "Gap function f = u - l" : options.title;
  drawing.add(Text{{margin, 2.2 * size}, title, 1.3 * size, palette::ink, Anchor::left, true});
  const GapMaximum peak = maximum_gap(field);
  drawing.add(Text{{margin, 3.8 * size},
                   peak.column < 0 ? "nothing is covered"
                                   : "largest sampled value " + detail::length_text(peak.value, field.unit) +
                                         " (red ring)",
                   size,
                   palette::faint});
  const double top = 4.5 * size;
  drawing.add(detail::gap_panel({margin, top, options.width - 2 * margin, options.height - top - margin}, field, size));
  return drawing;
}

}  // namespace stackabilization
