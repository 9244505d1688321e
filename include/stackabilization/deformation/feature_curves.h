#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Thresholds of `feature_curves` for creases, ends of curves and negligible curves.
struct FeatureCurveOptions {
  /// An edge of two triangles is a crease when the angle between their planes exceeds this value, degrees.
  double crease_angle = 40;
  /// A curve ends where it turns by more than this angle, degrees: a square has four curves, an octagon one.
  double corner_angle = 50;
  /// A curve is also cut between two straight runs when the longer one has at least the length
  /// `smallest_length` and exceeds the shorter one by more than this factor: the sides of a rectangle with
  /// rounded corners become separate curves.
  double straight_run_ratio = 3;
  /// A connected set of curves is dropped when the diagonal of its bounding box is smaller than this length.
  /// A curve with a free end is dropped when it is shorter than this length. Fraction of the diagonal of the
  /// shape's bounding box.
  double smallest_length = 0.02;
};

/// A chain of feature edges of a surface.
struct FeatureCurve {
  /// Rows of Shape::vertices in the order of the curve. Consecutive vertices have different coordinates. The
  /// row that the triangles use first represents all rows with equal coordinates.
  std::vector<std::int32_t> vertices;
  bool closed = false;  ///< whether the first vertex, which is not repeated, follows the last one
};

/// Computes the feature curves of a surface: chains of creases and boundary edges (Gal et al. 2009, section
/// 4). Chains end at vertices with more or fewer than two feature edges, at sharp turns, and at the ends of
/// straight runs. Triangles may have either orientation. Vertices of equal coordinates count as one. Smooth
/// closed surfaces have no feature curves.
///
/// Deterministic. The curves do not depend on the pose of the shape, except for angles within rounding of the
/// options. Throws UsageError for options that are negative or not finite. Precondition: `validate(shape)`
/// passes.
std::vector<FeatureCurve> feature_curves(const Shape& shape, const FeatureCurveOptions& options = {});

}  // namespace stackabilization
