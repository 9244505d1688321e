#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/deformation/design.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/rendering/drawing.h"
#include "stackabilization/stacking/draft.h"
#include "stackabilization/stacking/map.h"
#include "stackabilization/stacking/place.h"
#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Size and heading of a picture. The size of text grows with the width.
struct PictureOptions {
  int width = 1600, height = 1180;  ///< pixels
  std::string title;                ///< heading, for example the file's name; may be empty
};

/// Draws a sheet that explains a measurement: the shape with its contact regions (red), the upper (blue) and
/// lower (orange) envelope pulled apart, two stacked copies with h and f_max, the sampled gap function with
/// its colour bar, and the numbers. The direction points up. Needs no display. Throws RenderError when there
/// is no OpenGL context. Precondition: `measured` and `contacts` belong to this shape and one direction.
Drawing measure_picture(const Shape& shape, const Stackability& measured,
                        const std::vector<ContactRegion>& contacts, const PictureOptions& options = {});

/// Options of `stack_picture`.
struct StackPictureOptions {
  int width = 1200, height = 900;  ///< pixels
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading, such as the numbers of the stack
  std::vector<Shape> separators;   ///< bodies between the copies, drawn orange
  bool side_view = true;           ///< whether to draw a horizontal view beside the 3/4 view
};

/// Draws a stack of placed copies, lowest copy first, each in its own shade of yellow, with the total height
/// along r. r points up. Throws UsageError when there is no copy, and RenderError when there is no OpenGL
/// context.
Drawing stack_picture(const std::vector<Shape>& copies, const Direction& direction,
                      const StackPictureOptions& options = {});

/// Options of `map_picture`.
struct MapPictureOptions {
  int width = 1000, height = 860;  ///< pixels
  std::string title;               ///< heading; may be empty
};

/// Draws a map of S over all directions: the hemisphere z >= 0 as a disc in Lambert's equal-area projection,
/// seen from +z with x to the right and y up (S(r) = S(-r) determines the other hemisphere). Every point has
/// the colour of the nearest sample. A mark shows the best sample, the first of equal ones. Needs no OpenGL.
/// Throws UsageError when there is no sample, a direction is zero or a value is not finite.
Drawing map_picture(const StackabilityMap& map, const MapPictureOptions& options = {});

/// Options of `structure_picture`.
struct StructurePictureOptions {
  int width = 1600, height = 1040;  ///< pixels
  std::string title;                ///< heading; may be empty
};

/// Draws the structure of a shape, as in Fig. 7 of the paper. One view shows the parts, with symmetric parts
/// in one colour and frames for the symmetries of the whole shape. The other view shows the cuboids, the
/// circles of the generalized cylinders, point joints as green balls and line joints as red bars. z points
/// up. Throws InputError when `validate(structured)` fails, and RenderError when there is no OpenGL context.
Drawing structure_picture(const StructuredShape& structured, const StructurePictureOptions& options = {});

/// Options of `deformation_picture`.
struct DeformationPictureOptions {
  int width = 1200, height = 760;  ///< pixels
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading, such as the edits and what they moved
  /// Vertices of the shape along edited curves.
  std::vector<std::vector<std::int32_t>> curves;
};

/// Draws a shape before (yellow) and after (green) edits, side by side from one viewpoint and in one scale.
/// Edited handles are red where they can be shown. z points up. Throws RenderError when there is
/// no OpenGL context. Precondition: `design` was made of `rest`; without primitives, handles of primitives
/// are not shown.
Drawing deformation_picture(const StructuredShape& rest, const Design& design,
                            const std::vector<Handle>& handles,
                            const DeformationPictureOptions& options = {});

/// A design of a shape in a sheet of designs.
struct DesignTile {
  Shape shape;                          ///< the design, in its own coordinates
  std::vector<Primitive> primitives;    ///< primitives of its parts, to show handles; may be empty
  std::vector<Handle> handles;          ///< edited handles, drawn red
  std::vector<ContactRegion> contacts;  ///< contact regions along the direction of the sheet, drawn red
  std::vector<std::string> captions;    ///< lines below the design, the first one bold
  bool at_rest = false;                 ///< whether those that follow come from this design
};

/// Options of `design_sheet`.
struct DesignSheetOptions {
  int width = 1600;                ///< pixels; the height results from the tiles
  int columns = 4;                 ///< >= 1
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading
};

/// Draws designs in rows, with `direction` up. The first design, and every other one at rest, is yellow;
/// those up to the next one at rest come from it (green), and are drawn from one viewpoint and in one scale
/// with it. Throws UsageError when there is no tile or no column, and RenderError when there is no OpenGL
/// context.
Drawing design_sheet(const std::vector<DesignTile>& tiles, const Direction& direction,
                     const DesignSheetOptions& options = {});

/// A shape with its stackability along a direction and its contact regions.
struct MeasuredShape {
  Shape shape;  ///< in its own coordinates
  /// `measured.f_max` is the lift between consecutive copies, including any clearance.
  Stackability measured;
  std::vector<ContactRegion> contacts;  ///< may be empty
};

/// A design before and after improvement.
struct ImprovedShape {
  MeasuredShape before, after;  ///< measured along one direction
};

/// Options of `improvement_picture`.
struct ImprovementPictureOptions {
  int width = 1200, height = 820;  ///< pixels
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading, such as the edits
};

/// Draws a shape before (yellow) and after (green), side by side from one viewpoint and in one scale. Contact
/// regions are red. S, f_max and h are written below each shape. Both stand on the same ground, whatever
/// their coordinates; the direction points up. Throws UsageError when the directions differ, and RenderError
/// when there is no OpenGL context.
Drawing improvement_picture(const ImprovedShape& shapes, const ImprovementPictureOptions& options = {});

/// Options of `stacks_picture`.
struct StacksPictureOptions {
  int width = 1200, height = 900;  ///< pixels
  int copies = 5;                  ///< copies in each stack, in [1, 200]
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading, such as the saving
};

/// Draws a stack of copies before (yellow) and one after (green), on the same ground and in the same scale,
/// each with its height. Every copy is lifted by `measured.f_max` above the one below it. Throws UsageError
/// when the directions differ or the number of copies is out of range, and RenderError when there is no
/// OpenGL context.
Drawing stacks_picture(const ImprovedShape& shapes, const StacksPictureOptions& options = {});

/// A shape that came down along a direction, what it rests on, and the heights at places around.
struct DroppedShape {
  Shape base, shape;             ///< both where they are at the end
  Place place;                   ///< of `shape`
  DropMap map;                   ///< with the turn of `place`
  Direction direction{0, 0, 1};  ///< against which it came down
};

/// Options of `drop_picture`.
struct DropPictureOptions {
  int width = 1400, height = 760;  ///< pixels
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading, such as the height
};

/// Draws what is below (yellow) and what came down on it (orange), and beside them the map: one cell of
/// colour per place, u to the right and v up, with a ring around the place taken. The direction points up.
/// Throws UsageError when the map has no place or a height that is not finite, and RenderError when there is
/// no OpenGL context.
Drawing drop_picture(const DroppedShape& dropped, const DropPictureOptions& options = {});

/// Options of `draft_picture`.
struct DraftPictureOptions {
  int width = 1400, height = 760;  ///< pixels
  double min_draft = 1;            ///< smallest draft that counts as enough, degrees in [0, 90]
  std::string title;               ///< heading; may be empty
  std::vector<std::string> notes;  ///< lines under the heading, such as the areas
};

/// Draws a shape from above and from below, with the direction up: surfaces with enough draft green, those
/// with less yellow, undercuts red. Throws RenderError when there is no OpenGL context. Precondition: `draft`
/// belongs to this shape and direction.
Drawing draft_picture(const Shape& shape, const DraftAnalysis& draft, const Direction& direction,
                      const DraftPictureOptions& options = {});

/// Draws the sampled gap function f = u - l with its colour bar and the position of its maximum. Needs no
/// OpenGL.
Drawing gap_picture(const HeightField& field, const PictureOptions& options = {1000, 860, {}});

}  // namespace stackabilization
