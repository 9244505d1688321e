#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/rendering/drawing.h"
#include "stackabilization/stacking/map.h"
#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Size and heading of a picture. Text grows with the width.
struct PictureOptions {
  int width = 1600, height = 1180;  ///< pixels
  std::string title;                ///< heading, for example the file's name; may be empty
};

/// One sheet that explains a measurement: the shape with its contact regions (red), the upper (blue) and
/// lower (orange) envelope pulled apart, two copies stacked with h and f_max, the sampled gap function with
/// colour bar, and the numbers. `measured` and `contacts` must be of this shape and one direction, which
/// points up. Needs no display; throws RenderError when there is no OpenGL context.
Drawing measure_picture(const Shape& shape, const Stackability& measured,
                        const std::vector<ContactRegion>& contacts, const PictureOptions& options = {});

/// Options of `stack_picture`.
struct StackPictureOptions {
  int width = 1200, height = 900;  ///< pixels
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading, such as the numbers of the stack
  bool side_view = true;           ///< a second view along the horizontal beside the 3/4 view
};

/// A stack of copies in their places, bottom first, each in its own shade of yellow, with the total height
/// along r, which points up. Throws UsageError when there is no copy, RenderError when there is no OpenGL
/// context.
Drawing stack_picture(const std::vector<Shape>& copies, const Direction& direction,
                      const StackPictureOptions& options = {});

/// Options of `map_picture`.
struct MapPictureOptions {
  int width = 1000, height = 860;  ///< pixels
  std::string title;               ///< heading; may be empty
};

/// Map of S over all directions: the hemisphere z >= 0 as a disc in Lambert's equal-area projection, seen
/// from +z with x to the right and y up (S(r) = S(-r) gives the other half). Every point has the colour of
/// the nearest sample; the best sample, the first of equal ones, is marked. Needs no OpenGL. Throws
/// UsageError when there is no sample, a direction is zero or a value is not finite.
Drawing map_picture(const StackabilityMap& map, const MapPictureOptions& options = {});

/// Options of `structure_picture`.
struct StructurePictureOptions {
  int width = 1600, height = 1040;  ///< pixels
  std::string title;                ///< heading; may be empty
};

/// The structure of a shape, as in the paper's Fig. 7: its parts, those that are symmetric to each other in
/// one colour, with frames for the symmetries of the whole; beside them the cuboids and the circles of the
/// generalized cylinders, point joints as green balls and line joints as red bars. z points up. Throws
/// InputError when `validate(structured)` fails, RenderError when there is no OpenGL context.
Drawing structure_picture(const StructuredShape& structured, const StructurePictureOptions& options = {});

/// Options of `deformation_picture`.
struct DeformationPictureOptions {
  int width = 1200, height = 760;  ///< pixels
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading, such as the edits and what they moved
  std::vector<std::vector<std::int32_t>>
      curves;  ///< vertices of the shape along curves to be shown as edited
};

/// A shape before (yellow) and after (green) edits, side by side from one viewpoint and in one scale, with
/// the edited handles in red where they can be shown; z points up. Throws UsageError when the edits were
/// refused, RenderError when there is no OpenGL context. Precondition: `result` comes from `rest`.
Drawing deformation_picture(const StructuredShape& rest, const DeformationResult& result,
                            const std::vector<Handle>& handles,
                            const DeformationPictureOptions& options = {});

/// One of several designs of a shape.
struct DesignTile {
  Shape shape;                          ///< the design, in its own coordinates
  std::vector<Primitive> primitives;    ///< of its parts, for handles on them; may be empty
  std::vector<Handle> handles;          ///< that were edited: red
  std::vector<ContactRegion> contacts;  ///< along the direction of the sheet: red
  std::vector<std::string> captions;    ///< lines below it, the first one bold
};

/// Options of `design_sheet`.
struct DesignSheetOptions {
  int width = 1600;                ///< pixels; the height follows
  int columns = 4;                 ///< >= 1
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading
};

/// Designs in rows from one viewpoint and in one scale, `direction` up: the first one, where one stands
/// (yellow), then what it could become (green). Throws UsageError when there is no tile or no column,
/// RenderError when there is no OpenGL context.
Drawing design_sheet(const std::vector<DesignTile>& tiles, const Direction& direction,
                     const DesignSheetOptions& options = {});

/// A shape measured along a direction, and where copies of it touch.
struct MeasuredShape {
  Shape shape;            ///< in its own coordinates
  Stackability measured;  ///< `measured.f_max` is the lift from copy to copy, air between copies included
  std::vector<ContactRegion> contacts;  ///< may be empty
};

/// The same design before and after it was made stackable, measured along one direction.
struct ImprovedShape {
  MeasuredShape before, after;  ///< along one direction
};

/// Options of `improvement_picture`.
struct ImprovementPictureOptions {
  int width = 1200, height = 820;  ///< pixels
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading, such as the edits
};

/// A shape before (yellow) and after (green), side by side from one viewpoint and in one scale, with the
/// contact regions in red and S, f_max and h below each, both on the same ground wherever they are in their
/// files; the direction points up. Throws UsageError when the
/// directions differ, RenderError when there is no OpenGL context.
Drawing improvement_picture(const ImprovedShape& shapes, const ImprovementPictureOptions& options = {});

/// Options of `stacks_picture`.
struct StacksPictureOptions {
  int width = 1200, height = 900;  ///< pixels
  int copies = 5;                  ///< in each stack, in [1, 200]
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading, such as the saving
};

/// A stack of copies before (yellow) and one after (green), on the same ground and in the same scale, each
/// with its height; every copy is lifted by `measured.f_max` above the one below it. Throws UsageError when
/// the directions differ or the number of copies is out of range, RenderError when there is no OpenGL
/// context.
Drawing stacks_picture(const ImprovedShape& shapes, const StacksPictureOptions& options = {});

/// The sampled gap function f = u - l with colour bar and the place of its maximum. Needs no OpenGL.
Drawing gap_picture(const HeightField& field, const PictureOptions& options = {1000, 860, {}});

}  // namespace stackabilization
