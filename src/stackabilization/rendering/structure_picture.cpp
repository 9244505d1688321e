#include <algorithm>
#include <array>
#include <utility>

#include "stackabilization/rendering/legend.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/plot_parts.h"
#include "stackabilization/rendering/structure_scene.h"

namespace stackabilization {
namespace {

using detail::Elements;
using detail::LegendEntry;
using detail::LegendMark;

const Colour point_colour{0.10, 0.66, 0.22};
const Colour line_colour = palette::contact;
const Colour plane_colour{0.45, 0.62, 0.88};
const Colour ghost{0.90, 0.90, 0.88};
constexpr std::size_t most_symmetries = 4;  ///< frames drawn: more of them would hide the shape

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

/// Frames of the planes and axes of the global symmetries, a little larger than the shape.
SceneLines symmetry_frames(const StructuredShape& structured) {
  OrientedBox box = axis_aligned_box(structured.shape.vertices);
  box.half_extents += Eigen::Vector3d::Constant(0.03 * structured.structure.diagonal);
  SceneLines frames{{}, plane_colour, 2};
  const std::vector<Symmetry>& symmetries = structured.structure.symmetries;
  for (std::size_t k = 0; k < std::min(most_symmetries, symmetries.size()); ++k) {
    const Symmetry& symmetry = symmetries[k];
    if (symmetry.kind == SymmetryKind::reflection) {
      Points border = detail::plane_in_box(symmetry.point, symmetry.axis, box);
      if (border.rows() > 0) frames.polylines.push_back(std::move(border));
      continue;
    }
    const Eigen::Vector3d axis = symmetry.axis.normalized();
    const double middle = axis.dot(box.centre - symmetry.point);
    const double reach = axis.cwiseAbs().dot(box.half_extents);
    Points line(2, 3);
    line.row(0) = (symmetry.point + (middle - reach) * axis).transpose();
    line.row(1) = (symmetry.point + (middle + reach) * axis).transpose();
    frames.polylines.push_back(std::move(line));
  }
  return frames;
}

Scene parts_scene(const StructuredShape& structured) {
  Scene scene;
  scene.add({structured.shape, detail::part_colours(structured.structure)});
  SceneLines frames = symmetry_frames(structured);
  if (!frames.polylines.empty()) scene.add(std::move(frames));
  return scene;
}

/// Green balls and red bars, larger than the surface they sit on is thick.
void add_joints(Scene& scene, const Structure& structure) {
  const double size = 0.011 * structure.diagonal;
  for (const Relation& relation : structure.relations) {
    if (relation.type == RelationType::point_joint)
      scene.add({detail::ball(relation.points.row(0).transpose(), size), {point_colour}, 1, Finish::smooth});
    if (relation.type == RelationType::line_joint)
      scene.add(
          {detail::bar(relation.points.row(0).transpose(), relation.points.row(1).transpose(), 0.6 * size),
           {line_colour},
           1,
           Finish::smooth});
  }
}

Scene primitives_scene(const StructuredShape& structured) {
  const Structure& structure = structured.structure;
  const std::vector<Colour> colours = detail::part_colours(structure);
  Scene scene;
  scene.add({structured.shape, {ghost}, 0.22, Finish::smooth});
  for (std::size_t part = 0; part < structure.parts.size(); ++part) {
    const Primitive& primitive = structure.parts[part].primitive;
    const Shape sides = detail::faces(primitive);
    if (sides.triangle_count() > 0) scene.add({sides, {colours[part]}, 0.14, Finish::smooth});
    scene.add({detail::outline(primitive), mix(colours[part], palette::ink, 0.25), 1.6});
  }
  add_joints(scene, structure);
  return scene;
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
    entries.push_back({LegendMark::line, plane_colour, "symmetry of the whole"});
  return entries;
}

std::vector<LegendEntry> relation_entries(const Structure& structure) {
  const Tally count = tally(structure);
  std::vector<LegendEntry> entries;
  if (count.cuboids > 0) entries.push_back({LegendMark::swatch, mix(ghost, palette::upper, 0.4), "cuboid"});
  if (count.cylinders > 0)
    entries.push_back({LegendMark::ring, palette::faint, "cross-section of a generalized cylinder"});
  if (count.points > 0) entries.push_back({LegendMark::dot, point_colour, "point joint"});
  if (count.lines > 0) entries.push_back({LegendMark::bar, line_colour, "line joint"});
  return entries;
}

struct Panel {
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
  const std::array<Panel, 2> panels{
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
