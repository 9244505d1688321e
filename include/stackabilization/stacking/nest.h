#pragma once

#include <optional>

#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Options of `nest`.
struct NestOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< what counts as a collision
  double clearance = 0;                 ///< additional gap along r at contacts, model units, in [0, 1e60]
  double play = 0;                      ///< lateral play that must remain free, model units, >= 0
  int play_corners = 16;                ///< see DilationOptions
  BoxModel boxes = BoxModel::oriented;  ///< boxes whose volumes are compared
};

/// Placement of one object in or on another.
struct NestResult {
  /// sep(container, content, r), with play when requested, without clearance.
  Separation separation;
  /// Whether the content stands on the floor: nothing blocks it above the lowest point of the container.
  bool on_floor = false;
  /// Lift of the content from its position in the file, in units of r.
  Rational offset;
  double offset_length = 0;                         ///< `offset` in model units
  double container_height = 0, content_height = 0;  ///< extents along r, model units
  double total_height = 0;                          ///< extent of both together, model units
  double saving = 0;            ///< container_height + content_height - total_height, model units
  Shape content;                ///< the content, lowered; coordinates rounded to double
  double box_volume = 0;        ///< box of the container plus box of the content, model units cubed
  double stack_box_volume = 0;  ///< box of both together, nested, model units cubed

  /// Returns S of the two objects, as in Eq. 4: 1 - stack_box_volume / box_volume. Nothing
  /// for objects without volume.
  std::optional<double> stackability() const;
};

/// Lowers `content` along r, at the lateral position of its coordinates, until it rests on `container` or on
/// the floor below the container: offset = max(sep(container, content, r) + clearance, floor). Exact except
/// for the rounding of clearance / |r| and of dilated coordinates. Throws UsageError for options out of
/// range, and InputError when `validate` fails for either shape.
NestResult nest(const Shape& container, const Shape& content, const Direction& direction,
                const NestOptions& options = {});

}  // namespace stackabilization
