#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/deformation/feature_curves.h"
#include "stackabilization/structure/symmetry.h"

namespace stackabilization {

/// Individual form of a wire, which every edit keeps.
enum class WireForm {
  straight,  ///< a line segment
  circular,  ///< a circle or an arc of one
  planar,    ///< any other curve in a plane
  spatial,   ///< anything else
};

/// A feature curve with its individual properties (Gal et al. 2009, section 5).
struct Wire {
  FeatureCurve curve;                 ///< vertices of the wire
  WireForm form = WireForm::spatial;  ///< form that edits keep
  double length = 0;                  ///< length of the polygon, model units
  Eigen::Vector3d centre =
      Eigen::Vector3d::Zero();  ///< midpoint of a segment, centre of a circle, else centroid of the polygon
  /// Unit direction of a segment, unit normal of the plane of a circular or planar wire, zero for a spatial
  /// wire.
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  double radius = 0;  ///< radius of a circular wire, model units
};

/// A plane and the wires that lie in it.
struct WirePlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit normal
  double offset = 0;       ///< normal . p of the points p of the plane, model units
  std::vector<int> wires;  ///< rows of WireStructure::wires, ascending
};

/// A symmetry that maps wire `wire` onto wire `image`; both may be the same wire.
struct WireSymmetry {
  int symmetry = 0;         ///< row of WireStructure::symmetries
  int wire = 0, image = 0;  ///< rows of WireStructure::wires
};

/// A vertex at which wires end or cross.
struct WireJunction {
  std::int32_t vertex = 0;  ///< row of Shape::vertices, as in FeatureCurve
  std::vector<int> wires;   ///< two or more rows of WireStructure::wires, ascending
};

/// Wires and the relations between them. Relations identify wires by their rows in `wires`. Every list is in
/// ascending order.
struct WireStructure {
  std::vector<Wire> wires;                 ///< wires in the order of the curves
  std::vector<std::vector<int>> parallel;  ///< classes of parallel wires; every straight wire is in one class
  std::vector<std::pair<int, int>> orthogonal;  ///< pairs of orthogonal classes, rows of `parallel`
  /// Groups of two or more wires: parallel segments of equal length, or circular wires of equal radius and
  /// length.
  std::vector<std::vector<int>> congruent;
  /// Planes with three or more wires, or with two of which at least one is circular or planar.
  std::vector<WirePlane> planes;
  std::vector<Symmetry> symmetries;     ///< symmetries, as given
  std::vector<WireSymmetry> symmetric;  ///< pairs of wires that the symmetries map onto each other
  std::vector<WireJunction> junctions;  ///< vertices where wires meet
};

/// Tolerances within which `analysed_wires` accepts a property or a relation.
struct WireAnalysisOptions {
  /// Largest distance of a curve's vertices from its segment, circle or plane, fraction of the curve's
  /// length.
  double form_tolerance = 0.002;
  /// Largest deviation from parallel and from orthogonal directions, degrees. It is wide enough for the edges
  /// of a tapered leg, which an edit should treat as parallel.
  double angle_tolerance = 3;
  double size_tolerance = 0.002;  ///< largest relative difference of equal lengths and radii
  /// Largest distance of vertices from a common plane and from mirror images, fraction of the diagonal of the
  /// shape's bounding box.
  double distance_tolerance = 0.001;
  /// Symmetries of the shape, to be found among the wires; none by default.
  std::vector<Symmetry> symmetries;
};

/// Computes the individual properties and the mutual relations of curves on a shape. Deterministic. Throws
/// UsageError for tolerances that are negative or not finite, and for symmetries that are not finite or of an
/// order below 2. Preconditions: `validate(shape)` passes, and feature_curves computed `curves`.
WireStructure analysed_wires(const Shape& shape, const std::vector<FeatureCurve>& curves,
                             const WireAnalysisOptions& options = {});

}  // namespace stackabilization
