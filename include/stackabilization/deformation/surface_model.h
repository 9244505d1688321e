#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "stackabilization/deformation/as_rigid_as_possible.h"
#include "stackabilization/deformation/carried_model.h"

namespace stackabilization {

/// Options of `surface_model`: the extent of its handles and the reach of its edits.
struct SurfaceModelOptions {
  /// Radius of a point handle, fraction of the bounding-box diagonal; finite, >= 0. The handle holds the
  /// vertices within this distance of its vertex.
  double handle_radius = 0.05;
  /// Distance from the nearest edited handle beyond which vertices do not move, fraction of the bounding-box
  /// diagonal; >= 0. With infinity the whole shape follows the handles.
  double influence = 0.25;
  /// Distance up to which shells (connected components) are tied together, fraction of the bounding-box
  /// diagonal; finite, >= 0.
  double reach = 0.01;
  /// Number of slices of equal height along the main axis, the sections of HandleKind::section; >= 1.
  int sections = 24;
  /// Main axis, not zero. By default an axis of the minimal oriented box: the axis across two sides that are
  /// equal to a twentieth, as for a body of revolution, else the longest axis.
  std::optional<Eigen::Vector3d> axis;
  RigidityOptions rigidity;  ///< rigidity of the surface between the handles
};

/// Creates the as-rigid-as-possible deformation model of a surface (as_rigid_as_possible.h), for shapes
/// without useful parts.
///
/// Handles hold vertices. HandleKind::part holds those of `part`. HandleKind::point holds those within the
/// handle radius of vertex `index`. HandleKind::section holds those in slice `index` of the shape, counted
/// from the lower end of the main axis, and ignores `part`. HandleKind::shape holds all. A section scales
/// across the axis. The other handles scale in all directions; parts and the shape also scale along one
/// direction. Handles rotate and scale about the centroid of their surface, points about their vertex.
/// handles() omits slices without vertices, and lists one vertex for each position.
///
/// Edits of the shape transform everything, including the rest pose of the surface. Every other edited handle
/// keeps its vertices where the sequence of edits has put them. The surface within the influence of these
/// handles follows as rigidly as possible, and the remaining vertices do not move at all. Distances are
/// Euclidean, not geodesic, so the two sides of a wall move together. Shells within `reach` of each other
/// deform together. A shell follows the nearest point of the other shells rigidly when none of its vertices
/// is held or stays and no other shell is within `reach`. Vertices of equal coordinates stay equal. Vertices
/// that no triangle uses do not move.
///
/// To keep the extent along r, the model stretches along r the surface above and below all vertices that
/// stay. When this does not suffice, the model stretches the whole shape (vertex_constraints.h). Fixed parts
/// and points hold their vertices against any handle: the model refuses edits that move them. The model
/// checks the box.
///
/// Rigid motions of the whole shape are exact up to rounding. The structure of `rest` is carried along
/// (carried_model.h); it may be that of `unstructured`. Throws InputError when the shape is invalid, and
/// UsageError for options out of range.
std::unique_ptr<DeformationModel> surface_model(StructuredShape rest,
                                                const SurfaceModelOptions& options = {});

}  // namespace stackabilization
