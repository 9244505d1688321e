#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/measurement.h"
#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/envelope/contacts.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/stacking/draft.h"
#include "stackabilization/stacking/map.h"
#include "stackabilization/stacking/place.h"
#include "stackabilization/stacking/validation.h"

/// What needs the rendering room. In a program built without it every function throws UsageError unless it
/// says otherwise.
namespace stackabilization::apps {

/// Call it before a long computation whose result is to be drawn.
void require_rendering();

/// Height field of the OpenGL depth buffer.
HeightField depth_buffer_field(const Shape& shape, const Direction& direction, const Window& window);

inline constexpr const char* depth_buffer_name = "OpenGL raster";
/// Of its heights, as a fraction of the extent: 24 bits of depth in single precision.
inline constexpr double depth_buffer_precision = 1e-5;
/// Why its values may lie further above the exact one.
inline constexpr const char* depth_buffer_excess =
    "OpenGL moves corners by up to 1/256 of a pixel, which tilts steep triangles";

/// The depth buffer as one of the checks of `validate`; without an OpenGL context, or without rendering, the
/// reason.
struct DepthBufferMaker {
  std::optional<HeightFieldMaker> maker;
  std::string reason;
};
DepthBufferMaker depth_buffer_maker(const Shape& shape);

/// A picture file and its heading.
struct PictureFile {
  std::string path;  ///< .png or .svg
  std::string title;
};

void write_measurement_picture(const PictureFile& file, const Shape& shape, const Measurement& measurement);
void write_map_picture(const PictureFile& file, const StackabilityMap& map);
/// Copies in their places, bottom first; `notes` are lines below the heading.
struct PlacedCopies {
  std::vector<Shape> copies;
  Direction direction{0, 0, 1};
  std::vector<std::string> notes;
  std::vector<Shape> separators = {};  ///< bodies between them
};
void write_stack_picture(const PictureFile& file, const PlacedCopies& stack);
/// A shape that came down on another one; `notes` are lines below the heading.
struct DropView {
  Shape base, shape;  ///< where they are at the end
  Place place;
  DropMap map;
  Direction direction{0, 0, 1};
  std::vector<std::string> notes;
};
void write_drop_picture(const PictureFile& file, DropView view);
/// Undercuts and draft of a shape; `notes` are lines below the heading.
struct DraftView {
  const Shape& shape;
  const DraftAnalysis& draft;
  Direction direction{0, 0, 1};
  double min_draft = 0;  ///< degrees
  std::vector<std::string> notes;
};
void write_draft_picture(const PictureFile& file, const DraftView& view);
void write_structure_picture(const PictureFile& file, const StructuredShape& structured);
/// A shape before and after edits; `notes` are lines below the heading.
struct EditedShape {
  const StructuredShape& rest;
  const Design& design;
  const std::vector<Edit>& edits;
  const std::vector<std::vector<std::int32_t>>& curves;  ///< vertices along edited feature curves
  std::vector<std::string> notes;
};
void write_deformation_picture(const PictureFile& file, const EditedShape& edited);
/// Designs of one shape, the first one where it stands.
struct DesignSheet {
  struct Tile {
    Design design;
    std::optional<Handle> edited;
    std::vector<ContactRegion> contacts;
    std::vector<std::string> captions;
  };
  std::vector<Tile> tiles;
  Direction direction{0, 0, 1};
  std::vector<std::string> notes;
};
void write_design_sheet(const PictureFile& file, const DesignSheet& sheet);

/// Why this program draws nothing at all; empty when it does. Throws nothing.
std::string rendering_missing();
/// A design before and after it was made stackable, measured along one direction.
struct DesignView {
  const Shape& shape;
  const Stackability& measured;
  const std::vector<ContactRegion>& contacts;
};
struct ComparedDesigns {
  DesignView before, after;
  std::vector<std::string> notes;  ///< lines below the heading
};
void write_improvement_picture(const PictureFile& file, const ComparedDesigns& designs);
void write_stacks_picture(const PictureFile& file, const ComparedDesigns& designs, int copies);

/// Change over S, with the number of each design; the first one, at rest, is 0.
void write_front_picture(const PictureFile& file, const std::vector<Eigen::Vector2d>& points);

}  // namespace stackabilization::apps
