#pragma once

#include <cstddef>
#include <vector>

#include "stackabilization/mesh/box_pairs.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Thresholds of `find_joints`.
struct JointOptions {
  /// Largest distance between the surfaces of two parts that meet, fraction of the diameter of the smallest
  /// ball around the shape.
  double reach = 0.01;
  /// Contact regions of two parts nearer to each other than this are one joint, fraction of the diameter of
  /// the smallest ball around the smaller part.
  double separate = 0.15;
  /// Smallest ratio of length to width of a line joint. A line joint must also be longer than `min_line`.
  double line_aspect = 4;
  /// Smallest length of a line joint, fraction of the diameter of the smallest ball around the smaller part.
  double min_line = 0.25;
  /// Limit of the number of pairs of nearby parts; more pairs are refused.
  std::size_t max_pairs = 100'000;
  /// Limit of the number of triangles of nearby parts, counted once per pair; more triangles are refused.
  std::size_t max_pair_triangles = 8'000'000;
};

/// Returns the pairs of parts whose boxes come within reach of each other: the input of `find_joints`. Throws
/// UsageError for options out of range. Throws InputError when there are more than JointOptions::max_pairs
/// pairs or more than JointOptions::max_pair_triangles triangles in them.
BoxPairs near_parts(const Shape& shape, const JointOptions& options);

/// Finds the point joints and line joints of all pairs of parts.
///
/// * A contact region of two parts consists of the places where the surfaces come within reach, and of the
///   portions of one part inside the other. A compact region gives a point joint at its centroid. An
///   elongated region gives a line joint between its ends. Separate regions give separate joints.
/// * The surface of a part decides whether a point is inside, when the surface is closed. Otherwise its
///   primitive decides, provided that it fits well.
/// * The function omits a joint inside a third part that both parts meet: two bars that end in one leg are
///   joined to the leg only.
/// * Several regions in a row along a cuboid, with the other part present between them, become one line
///   joint: a rail on pegs. A handle is a cylinder and keeps its two point joints.
/// * A ring-shaped region, with neither part in its middle, gives four joints at its sides. The four sides
///   follow the axes of the shape.
///
/// The regions are computed from edges and faces, without sampling. The result is the same in every pose and
/// at every scale, up to rounding and to the order of the joints of one pair: they are ordered by
/// coordinates. Relation::residual is the remaining gap between the surfaces, as a fraction of the diameter
/// of the smallest ball around the shape.
///
/// Precondition: `parts` are the parts of `shape`, in its order. Throws UsageError for options out of range.
/// Throws InputError when a part has no triangle of positive area, and under the conditions of `near_parts`
/// before any pair is examined.
std::vector<Relation> find_joints(const Shape& shape, const std::vector<Part>& parts,
                                  const JointOptions& options = {});

}  // namespace stackabilization
