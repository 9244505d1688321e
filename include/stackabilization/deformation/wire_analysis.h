#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/deformation/feature_curves.h"
#include "stackabilization/structure/symmetry.h"

namespace stackabilization {

/// What a wire is by itself, and stays in every edit.
enum class WireForm {
  straight,  ///< a segment
  circular,  ///< a circle or an arc of one
  planar,    ///< any other curve in a plane
  spatial,   ///< anything else
};

/// A feature curve and its individual properties (Gal et al. 2009, section 5).
struct Wire {
  FeatureCurve curve;                 ///< its vertices
  WireForm form = WireForm::spatial;  ///< what it stays
  double length = 0;                  ///< of the polygon, model units
  Eigen::Vector3d centre =
      Eigen::Vector3d::Zero();  ///< middle of a segment, centre of a circle, else of the length
  /// Unit direction of a segment, unit normal of the plane of circular and planar ones; of spatial ones zero.
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  double radius = 0;  ///< of circular ones, model units
};

/// A plane and the wires in it.
struct WirePlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit
  double offset = 0;                                  ///< normal . p, model units
  std::vector<int> wires;                             ///< ascending
};

/// A symmetry takes wire `wire` onto wire `image`, which may be the same.
struct WireSymmetry {
  int symmetry = 0;         ///< row of WireStructure::symmetries
  int wire = 0, image = 0;  ///< rows of WireStructure::wires
};

/// A place where wires end or cross.
struct WireJunction {
  std::int32_t vertex = 0;  ///< row of Shape::vertices, as in FeatureCurve
  std::vector<int> wires;   ///< ascending, two or more
};

/// Wires and what holds between them. Wires are given by their rows in `wires`; every list is in ascending
/// order.
struct WireStructure {
  std::vector<Wire> wires;                 ///< in the order of the curves
  std::vector<std::vector<int>> parallel;  ///< classes of straight wires, every straight one in one class
  std::vector<std::pair<int, int>> orthogonal;  ///< pairs of rows of `parallel`
  /// Groups of two and more: straight and parallel of equal length, or circular of equal radius and length.
  std::vector<std::vector<int>> congruent;
  /// Planes with three or more wires, or with one that is circular or planar and one more.
  std::vector<WirePlane> planes;
  std::vector<Symmetry> symmetries;     ///< as given
  std::vector<WireSymmetry> symmetric;  ///< which wires the symmetries take onto which
  std::vector<WireJunction> junctions;  ///< where wires meet
};

/// How nearly something must hold for `analysed_wires` to have it kept.
struct WireAnalysisOptions {
  /// Largest distance of a curve's vertices from the segment, circle or plane that it is taken for, fraction
  /// of its length.
  double form_tolerance = 0.002;
  /// Between parallel, from orthogonal directions, degrees; wide enough for the edges of a tapered leg, which
  /// an edit should treat as one.
  double angle_tolerance = 3;
  double size_tolerance = 0.002;  ///< of equal lengths and radii, fraction of them
  /// Of vertices from a common plane, from mirror images; fraction of the diagonal of the shape's bounding
  /// box.
  double distance_tolerance = 0.001;
  std::vector<Symmetry> symmetries;  ///< of the shape, to be looked for among the wires; none by default
};

/// Individual properties and mutual relations of curves on a shape. Deterministic. Throws UsageError for
/// options that are negative or not finite. Precondition: `validate(shape)`, curves as feature_curves gives
/// them.
WireStructure analysed_wires(const Shape& shape, const std::vector<FeatureCurve>& curves,
                             const WireAnalysisOptions& options = {});

}  // namespace stackabilization
