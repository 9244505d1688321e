#pragma once

#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/rendering/colour.h"
#include "stackabilization/rendering/scene.h"

// Scenes that show how a shape stacks: the components of pictures of measurements.
namespace stackabilization {

/// Returns a shape with the contact regions along `direction` as red marks on both envelopes.
Scene touching_scene(const SceneMesh& mesh, const std::vector<ContactRegion>& contacts,
                     const Direction& direction);

/// Returns equal copies. The first copy has the position of the shape; each further copy is moved by `step`
/// (model units). Precondition: copies >= 0.
std::vector<Shape> copies_of(const Shape& shape, const Eigen::Vector3d& step, int copies);

/// Returns placed copies. Neighbours differ in shade, so that copies are distinguishable.
Scene stack_scene(const std::vector<Shape>& copies, const Colour& colour);

/// Returns the envelopes of a shape, pulled apart: the upper one (blue) of the copy below, and over it the
/// lower one (orange) of the copy above. Red marks show where they touch, and thin lines connect the marks.
/// Empty when there is no surface at any sample. Precondition: `field` is a height field of `shape`.
Scene envelope_scene(const Shape& shape, const std::vector<ContactRegion>& contacts,
                     const HeightField& field);

}  // namespace stackabilization
