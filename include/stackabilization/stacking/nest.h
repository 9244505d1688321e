#pragma once

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// Air that `nest` leaves between content and container.
struct NestOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< what counts as a collision
  double clearance = 0;   ///< air added along r where they touch, model units, in [0, 1e60]
  double play = 0;        ///< lateral play that must remain possible, model units, >= 0
  int play_corners = 16;  ///< see DilationOptions
};

/// One object set down into or onto another.
struct NestResult {
  Separation separation;     ///< sep(container, content, r), with play if asked for, without clearance
  bool on_floor = false;     ///< nothing stops the content above the level of the container's lowest point
  Rational offset;           ///< lift of the content from where its file puts it, in units of r
  double offset_length = 0;  ///< the same, model units
  double container_height = 0, content_height = 0;  ///< extents along r, model units
  double total_height = 0;                          ///< extent of both together, model units
  double saving = 0;  ///< container_height + content_height - total_height, model units
};

/// Lowers `content` along r, at the lateral place that its coordinates say, until it rests on `container` or
/// on the floor that the container stands on: offset = max(sep(container, content, r) + clearance, floor).
/// Exact but for the rounding of clearance / |r| and of dilated coordinates. Throws UsageError on options
/// outside their ranges, InputError when `validate` fails for either shape.
NestResult nest(const Shape& container, const Shape& content, const Direction& direction,
                const NestOptions& options = {});

}  // namespace stackabilization
