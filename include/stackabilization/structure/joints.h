#pragma once

#include <cstddef>
#include <vector>

#include "stackabilization/mesh/box_pairs.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// What `find_joints` takes for contact of two parts, and for a line.
struct JointOptions {
  /// Parts whose surfaces come nearer than this meet, fraction of the diameter of the smallest ball around
  /// the shape.
  double reach = 0.01;
  /// Regions of contact nearer than this are one joint, fraction of the diameter of the ball around the
  /// smaller part.
  double separate = 0.15;
  /// A contact this many times longer than wide, and longer than `min_line`, is a line joint.
  double line_aspect = 4;
  /// Shortest line joint, fraction of the diameter of the smallest ball around the smaller part.
  double min_line = 0.25;
  /// Pairs of parts that are looked at; more are refused.
  std::size_t max_pairs = 100'000;
  /// Triangles of the parts of these pairs, each pair counting those of both its parts; more are refused.
  std::size_t max_pair_triangles = 8'000'000;
};

/// The pairs of parts that `find_joints` looks at: their boxes come within reach of each other. Throws
/// UsageError for options out of range, InputError when there are more than JointOptions::max_pairs, or they
/// have more than JointOptions::max_pair_triangles.
BoxPairs near_parts(const Shape& shape, const JointOptions& options);

/// Point and line joints of every pair of parts. Regions of contact are where the surfaces come within reach
/// and what one part has inside the other: compact regions give a point joint at their centroid, elongated
/// ones a line joint between their ends, separate ones a joint each. Whether a point is inside is decided by
/// the part's surface where that is closed, else by its primitive, where that fits well. A joint inside a
/// third part that both parts meet is left out: two bars that end in one leg are held by the leg. Several
/// regions in a row along a cuboid, with the other part there between them, are one line joint, as the
/// primitives would have it (a rail hung on pegs); a handle, which is a cylinder, keeps its two points. A
/// ring, in whose middle neither part is, is joined at four sides, which follow the axes of the shape.
///
/// The regions are found from edges and faces, without sampling; they are the same in every pose and at every
/// scale, up to rounding and to the order of the joints of one pair, which is by their coordinates.
/// Relation::residual is the gap left between the surfaces, fraction of the diameter of the ball around the
/// shape.
///
/// `parts` are those of `shape`, in its order. Throws UsageError for options out of range, InputError when a
/// part has no triangle of positive area.
///
/// Throws InputError as well when more than JointOptions::max_pairs pairs of parts come near each other,
/// before it looks at any of them.
std::vector<Relation> find_joints(const Shape& shape, const std::vector<Part>& parts,
                                  const JointOptions& options = {});

}  // namespace stackabilization
