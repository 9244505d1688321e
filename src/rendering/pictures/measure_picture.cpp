#include <algorithm>
#include <array>

#include "rendering/drawing/plot_parts.h"
#include "rendering/pictures/scene_overlay.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/rendering/foot.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/scene.h"
#include "stackabilization/rendering/stacking_scene.h"

namespace stackabilization {
namespace {

using detail::Elements;
using detail::length_text;
using detail::number_text;

constexpr int gap_samples = 400;

/// Data of all panels of the sheet.
struct Subject {
  const Shape& shape;
  const Stackability& measured;
  const std::vector<ContactRegion>& contacts;
  Direction direction;
  HeightField field;
  double text_size;
};

Elements picture_of(const Scene& scene, const View& view, const Rectangle& place) {
  return {PlacedImage{place, render(scene, view), Sampling::smooth}};
}

ViewOptions view_of(const Rectangle& place) {
  ViewOptions options;
  options.width = static_cast<int>(place.width);
  options.height = static_cast<int>(place.height);
  return options;
}

/// Writes into the middle of a panel why it is empty.
Elements no_envelope(const Rectangle& place, double text_size) {
  return detail::paragraph(
      {{place.x, place.y + place.height / 2},
       "No envelope to show: every face is parallel to r, or nearly so, or slips between the samples.",
       text_size,
       palette::faint},
      place.width);
}

/// Two copies from the side, with h at the left of the lower one and f_max at the right, from rim to rim.
Elements stacked_panel(const Subject& s, const Rectangle& place) {
  const Frame& frame = s.field.frame;
  const Range along = range_along(s.shape, frame.w);
  ScenePanel panel;
  panel.up = s.direction;
  panel.elevation_degrees = 8;
  panel.scene = stack_scene(copies_of(s.shape, s.measured.f_max * frame.w, 2), palette::input);
  const Eigen::Vector3d foot = foot_of(s.shape, s.direction), rim = foot + along.length() * frame.w;
  const Unit unit = s.shape.unit;
  panel.over.dimensions = {{foot, rim, "h = " + length_text(s.measured.extent, unit), Anchor::left},
                           {rim, rim + s.measured.f_max * frame.w,
                            "f_max = " + length_text(s.measured.f_max, unit), Anchor::right}};
  return detail::scene_elements(panel, place, {s.text_size, {}});
}

struct Caption {
  std::string heading, words;
};

Elements caption(const Caption& text, const Rectangle& place, double text_size) {
  Elements elements{
      Text{{place.x, place.y + text_size}, text.heading, 1.05 * text_size, palette::ink, Anchor::left, true}};
  const Elements words = detail::paragraph(
      {{place.x, place.y + 2.4 * text_size}, text.words, 0.85 * text_size, palette::faint}, place.width);
  elements.insert(elements.end(), words.begin(), words.end());
  return elements;
}

std::string contact_summary(const std::vector<ContactRegion>& contacts) {
  std::array<int, 3> count{};
  for (const ContactRegion& region : contacts) ++count[static_cast<std::size_t>(region.type)];
  std::string text;
  constexpr std::array<const char*, 3> names{"dot", "line", "ring"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (count[k] == 0) continue;
    if (!text.empty()) text += ", ";
    text += std::to_string(count[k]) + " " + names[k] + (count[k] > 1 ? "s" : "");
  }
  return text.empty() ? "none" : text;
}

std::string volume_text(double value, Unit unit) {
  return unit == Unit::unknown ? number_text(value) : length_text(value, unit) + "³";
}

/// The numbers, one row each: name and value.
Elements number_table(const Subject& s, const Rectangle& place) {
  const Stackability& m = s.measured;
  const Unit unit = s.shape.unit;
  const std::vector<std::array<std::string, 2>> rows{
      {"stacking direction r", detail::vector_text(m.direction)},
      {"height h along r", length_text(m.extent, unit)},
      {"minimal lift f_max between two copies",
       length_text(m.f_max, unit) + "  =  " + number_text(100 * m.f_max / m.extent, 3) + " % of h"},
      {"box volume V(M)", volume_text(m.box_volume, unit)},
      {"box volume along r, V(M,r)", volume_text(m.stack_box_volume(), unit)},
      {"contact regions", contact_summary(s.contacts)}};
  const double line = 1.75 * s.text_size;
  double y = place.y + 1.5 * s.text_size;
  Elements elements{Text{{place.x, y},
                         "Stackability  S = " + fixed_text(m.value, 4) + " " + direction_text(m.direction),
                         1.6 * s.text_size,
                         palette::ink,
                         Anchor::left,
                         true}};
  y += 1.5 * s.text_size;
  elements.emplace_back(
      Text{{place.x, y},
           "S = 1 - (f_max / h) V(M,r) / V(M): the part of its box that each further copy saves",
           0.85 * s.text_size,
           palette::faint});
  y += 0.7 * s.text_size;
  for (const auto& [name, value] : rows) {
    y += line;
    elements.emplace_back(Text{{place.x, y}, name, s.text_size});
    elements.emplace_back(
        Text{{place.x + 0.52 * place.width, y}, value, s.text_size, palette::ink, Anchor::left, true});
    elements.emplace_back(
        Polyline{detail::segment(place.x, y + 0.45 * s.text_size, place.right(), y + 0.45 * s.text_size),
                 mix(palette::faint, palette::white, 0.7), 1});
  }
  return elements;
}

}  // namespace

Drawing measure_picture(const Shape& shape, const Stackability& measured,
                        const std::vector<ContactRegion>& contacts, const PictureOptions& options) {
  const Direction direction(measured.direction);
  const double size = options.width / 68.0, margin = 1.5 * size;
  const Subject subject{
      shape,
      measured,
      contacts,
      direction,
      height_field_by_scanline(shape, direction, window_around(shape, direction, gap_samples)),
      size};
  Drawing drawing{options.width, options.height, {}};
  const detail::Heading heading = detail::heading(
      options.title.empty() ? "How one shape stacks" : options.title, {}, options.width, size);
  drawing.add(heading.elements);

  const double top = heading.bottom + 1.2 * size;
  const double column = (options.width - 4 * margin) / 3, words = 5.2 * size;
  const double upper_height = 0.6 * (options.height - top - 2 * words - margin);
  const auto panel = [&](int k) {
    return Rectangle{margin + k * (column + margin), top, column, upper_height};
  };
  const auto below = [&](const Rectangle& place) {
    return Rectangle{place.x, place.bottom() + 0.4 * size, place.width, words};
  };
  const Scene touching = touching_scene({shape, {palette::input}}, contacts, direction);
  const Scene apart = envelope_scene(shape, contacts, subject.field);
  drawing.add(picture_of(touching, fit_view(touching, direction, view_of(panel(0))), panel(0)));
  drawing.add(caption({"1  The shape", "Red: where two stacked copies touch or nearly touch."},
                      below(panel(0)), size));
  drawing.add(apart.meshes.empty()
                  ? no_envelope(panel(1), size)
                  : picture_of(apart, fit_view(apart, direction, view_of(panel(1))), panel(1)));
  drawing.add(caption(
      {"2  Its envelopes, pulled apart",
       "Blue: all that is seen from above, u. Orange: all that is seen from below, l, of the next copy."},
      below(panel(1)), size));
  drawing.add(stacked_panel(subject, panel(2)));
  drawing.add(caption({"3  Two copies stacked", "The second copy comes to rest f_max higher than the first."},
                      below(panel(2)), size));

  const double row = top + upper_height + words + 0.5 * margin;
  const Rectangle gap{margin, row, column, options.height - row - words};
  drawing.add(detail::gap_panel(gap, subject.field, 0.85 * size));
  drawing.add(caption(
      {"4  The gap f = u - l, seen along r", "Its largest value (ring) is what keeps the copies apart."},
      below(gap), size));
  drawing.add(
      number_table(subject, {2 * margin + column, row, 2 * column + margin, options.height - row - margin}));
  return drawing;
}

}  // namespace stackabilization
