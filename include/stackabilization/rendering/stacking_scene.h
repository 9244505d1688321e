#pragma once

#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/rendering/colour.h"
#include "stackabilization/rendering/scene.h"

// Scenes that show how a shape stacks: what pictures of measurements are put together from.
namespace stackabilization {

/// A shape with the contact regions along `direction` as red marks on both envelopes.
Scene touching_scene(const SceneMesh& mesh, const std::vector<ContactRegion>& contacts,
                     const Direction& direction);

/// Equal copies, the first one where the shape is, each further one moved by `step` (model units).
/// Precondition: copies >= 0.
std::vector<Shape> copies_of(const Shape& shape, const Eigen::Vector3d& step, int copies);

/// Copies in their places. Neighbours differ in shade so that each copy can be told from the next.
Scene stack_scene(const std::vector<Shape>& copies, const Colour& colour);

/// The envelopes of a shape, pulled apart: the upper one (blue) of the copy below and over it the lower one
/// (orange) of the copy above; red marks where they touch, thin lines from one to the other. `field` is of
/// `shape`. Empty when there is no envelope to see.
Scene envelope_scene(const Shape& shape, const std::vector<ContactRegion>& contacts,
                     const HeightField& field);

}  // namespace stackabilization
