#include <algorithm>
#include <array>
#include <utility>

#include "rendering/drawing/legend.h"
#include "rendering/drawing/plot_parts.h"
#include "rendering/scene/structure_scene.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/structure_views.h"

namespace stackabilization {
namespace {

using detail::Elements;

struct Tally {
  int cuboids = 0, cylinders = 0, pairs = 0, self_symmetries = 0, points = 0, lines = 0;
};

Tally tally(const Structure& structure) {
  Tally count;
  for (const Part& part : structure.parts)
    ++(std::holds_alternative<Cuboid>(part.primitive) ? count.cuboids : count.cylinders);
  for (const Relation& relation : structure.relations) switch (relation.type) {
      case RelationType::symmetry:
        ++count.pairs;
        break;
      case RelationType::self_symmetry:
        ++count.self_symmetries;
        break;
      case RelationType::point_joint:
        ++count.points;
        break;
      case RelationType::line_joint:
        ++count.lines;
        break;
    }
  return count;
}

std::string counted(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string summary(const Structure& structure) {
  const Tally count = tally(structure);
  return counted(static_cast<int>(structure.parts.size()), "part") + ": " + counted(count.cuboids, "cuboid") +
         ", " + counted(count.cylinders, "generalized cylinder") +
         ".  Relations: " + counted(count.pairs, "symmetric pair") + ", " +
         std::to_string(count.self_symmetries) + " self-symmetric, " + counted(count.points, "point joint") +
         ", " + counted(count.lines, "line joint") + ".";
}

std::vector<LegendEntry> part_entries(const StructuredShape& structured) {
  const std::vector<Part>& parts = structured.structure.parts;
  const std::vector<Colour> colours = detail::part_colours(structured.structure);
  std::vector<LegendEntry> entries;
  for (const std::vector<int>& orbit : detail::symmetry_orbits(structured.structure)) {
    std::string text = parts[static_cast<std::size_t>(orbit[0])].name;
    if (orbit.size() == 2) text += ", " + parts[static_cast<std::size_t>(orbit[1])].name;
    if (orbit.size() > 2) text += " and " + std::to_string(orbit.size() - 1) + " like it";
    entries.push_back({LegendMark::swatch, colours[static_cast<std::size_t>(orbit[0])], text});
  }
  if (!structured.structure.symmetries.empty())
    entries.push_back({LegendMark::line, structure_colour::symmetry, "symmetry of the whole"});
  return entries;
}

std::vector<LegendEntry> relation_entries(const Structure& structure) {
  const Tally count = tally(structure);
  std::vector<LegendEntry> entries;
  if (count.cuboids > 0)
    entries.push_back({LegendMark::swatch, mix(structure_colour::ghost, palette::upper, 0.4), "cuboid"});
  if (count.cylinders > 0)
    entries.push_back({LegendMark::ring, palette::faint, "cross-section of a generalized cylinder"});
  if (count.points > 0) entries.push_back({LegendMark::dot, structure_colour::point_joint, "point joint"});
  if (count.lines > 0) entries.push_back({LegendMark::bar, structure_colour::line_joint, "line joint"});
  return entries;
}

struct StructurePanel {
  Scene scene;
  std::string heading;
  std::vector<LegendEntry> entries;
};

}  // namespace

Drawing structure_picture(const StructuredShape& structured, const StructurePictureOptions& options) {
  validate(structured);
  const double size = options.width / 76.0, margin = 1.5 * size, captions = 9.5 * size;
  Drawing drawing{options.width, options.height, {}};
  const detail::Heading heading =
      detail::heading(options.title.empty() ? "Structure of a shape" : options.title,
                      {summary(structured.structure)}, options.width, size);
  drawing.add(heading.elements);
  const double top = heading.bottom + size, column = (options.width - 3 * margin) / 2;
  const double height = options.height - top - captions;
  const std::array<StructurePanel, 2> panels{
      {{parts_scene(structured), "Parts: one colour for parts that are symmetric to each other",
        part_entries(structured)},
       {primitives_scene(structured), "What stands for them, and where they are joined",
        relation_entries(structured.structure)}}};
  ViewOptions view_options;
  view_options.width = static_cast<int>(column);
  view_options.height = static_cast<int>(height);
  Scene both = panels[0].scene;
  both.add(panels[1].scene);
  const View view = fit_view(both, Direction(0, 0, 1), view_options);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Rectangle place{margin + static_cast<double>(k) * (column + margin), top, column, height};
    drawing.add(PlacedImage{place, render(panels[k].scene, view)});
    const double base = place.bottom() + 1.2 * size;
    drawing.add(detail::fitted(
        {{place.x, base}, panels[k].heading, 1.05 * size, palette::ink, Anchor::left, true}, place.width));
    drawing.add(detail::legend(panels[k].entries,
                               {place.x, base + 0.4 * size, place.width, options.height - base - 0.8 * size},
                               0.9 * size));
  }
  return drawing;
}

}  // namespace stackabilization
