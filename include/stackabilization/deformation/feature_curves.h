#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// What `feature_curves` takes for a crease, an end and a crumb.
struct FeatureCurveOptions {
  /// An edge of two triangles is a crease when their planes turn by more than this, degrees.
  double crease_angle = 40;
  /// A curve ends where it turns by more than this, degrees: the square is four curves, the octagon is one.
  double corner_angle = 50;
  /// A curve is also cut where a straight run of at least `smallest_length` meets one that is shorter by this
  /// factor: the sides of a rectangle with rounded corners are curves of their own.
  double straight_run_ratio = 3;
  /// Curves that hang together are dropped when their bounding box has a smaller diagonal than this, and so
  /// is a shorter curve that ends in nothing; fraction of the diagonal of the shape's bounding box.
  double smallest_length = 0.02;
};

/// A chain of feature edges of a surface.
struct FeatureCurve {
  /// Rows of Shape::vertices in the order of the curve, neighbours at different coordinates. Of several rows
  /// with equal coordinates the one that triangles use first stands for all.
  std::vector<std::int32_t> vertices;
  bool closed = false;  ///< the last vertex is followed by the first, which is not repeated
};

/// The feature curves of a surface: creases and boundaries, chained
/// between the places where more or fewer than two of them meet, where they turn sharply and where straight
/// runs end (Gal et al. 2009, section 4). Triangles may be turned either way, vertices of equal coordinates
/// are one. Smooth closed surfaces have none.
///
/// Deterministic; the same curves in every pose, but for angles within rounding of the options. Throws
/// UsageError for options that are negative or not finite. Precondition: `validate(shape)`.
std::vector<FeatureCurve> feature_curves(const Shape& shape, const FeatureCurveOptions& options = {});

}  // namespace stackabilization
