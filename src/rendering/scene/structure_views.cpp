#include "stackabilization/rendering/structure_views.h"

#include <algorithm>
#include <utility>

#include "rendering/scene/structure_scene.h"

namespace stackabilization {
namespace {

constexpr std::size_t max_symmetries = 4;  ///< frames drawn: more of them would hide the shape

/// Frames of the planes and axes of the global symmetries, a little larger than the shape.
SceneLines symmetry_frames(const StructuredShape& structured) {
  OrientedBox box = axis_aligned_box(structured.shape.vertices);
  box.half_extents += Eigen::Vector3d::Constant(0.03 * structured.structure.diagonal);
  SceneLines frames{{}, structure_colour::symmetry, 2};
  const std::vector<Symmetry>& symmetries = structured.structure.symmetries;
  for (std::size_t k = 0; k < std::min(max_symmetries, symmetries.size()); ++k) {
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

/// Green balls and red bars, larger than the surface they sit on is thick.
void add_joints(Scene& scene, const Structure& structure) {
  const double size = 0.011 * structure.diagonal;
  for (const Relation& relation : structure.relations) {
    if (relation.type == RelationType::point_joint)
      scene.add({detail::ball(relation.points.row(0).transpose(), size),
                 {structure_colour::point_joint},
                 1,
                 Finish::smooth});
    if (relation.type == RelationType::line_joint)
      scene.add(
          {detail::bar(relation.points.row(0).transpose(), relation.points.row(1).transpose(), 0.6 * size),
           {structure_colour::line_joint},
           1,
           Finish::smooth});
  }
}

}  // namespace

Scene parts_scene(const StructuredShape& structured) {
  Scene scene;
  scene.add({structured.shape, detail::part_colours(structured.structure)});
  SceneLines frames = symmetry_frames(structured);
  if (!frames.polylines.empty()) scene.add(std::move(frames));
  return scene;
}

Scene primitives_scene(const StructuredShape& structured) {
  const Structure& structure = structured.structure;
  const std::vector<Colour> colours = detail::part_colours(structure);
  Scene scene;
  scene.add({structured.shape, {structure_colour::ghost}, 0.22, Finish::smooth});
  for (std::size_t part = 0; part < structure.parts.size(); ++part) {
    const Primitive& primitive = structure.parts[part].primitive;
    const Shape sides = detail::faces(primitive);
    if (sides.triangle_count() > 0) scene.add({sides, {colours[part]}, 0.14, Finish::smooth});
    scene.add({detail::outline(primitive), mix(colours[part], palette::ink, 0.25), 1.6});
  }
  add_joints(scene, structure);
  return scene;
}

}  // namespace stackabilization
