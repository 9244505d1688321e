#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "stackabilization/deformation/as_rigid_as_possible.h"
#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization {

/// What handles of a `surface_model` hold, and how far an edit reaches.
struct SurfaceModelOptions {
  /// A point handle takes the surface within this distance of its vertex with it, fraction of the
  /// bounding-box diagonal; finite, >= 0.
  double handle_radius = 0.05;
  /// What is farther than this from every handle that was edited stays, fraction of the bounding-box
  /// diagonal; >= 0, and infinity for shapes that follow as a whole.
  double influence = 0.25;
  /// Shells (connected pieces) that come nearer to each other than this hang together there, fraction of the
  /// bounding-box diagonal; finite, >= 0.
  double reach = 0.01;
  /// Slices of equal height that HandleKind::section counts along the main axis; >= 1.
  int sections = 24;
  /// Main axis, not zero. Nothing: of the minimal oriented box the axis across two sides that are equal to a
  /// twentieth, as those of a body of revolution are; else the longest.
  std::optional<Eigen::Vector3d> axis;
  RigidityOptions rigidity;  ///< of the surface between the handles
};

/// As-rigid-as-possible deformation of the surface (as_rigid_as_possible.h), for shapes without useful parts.
///
/// Handles hold vertices: HandleKind::part those of `part`; point those within the handle radius of vertex
/// `index`; section those in slice `index` of the shape (`part` is not looked at), the first at the lower end
/// of the main axis; shape all. A section is scaled across the axis, everything else in all directions or,
/// parts and the shape only, along one. Handles turn and scale about the centroid of their surface, points
/// about their vertex. handles() leaves out slices without vertices, and names one vertex of each place.
///
/// Edits of the shape transform everything, also what is the rest form of the surface. All other edited
/// handles keep the vertices they hold where the edits, one after the other, have put them; the surface
/// within their influence follows as rigidly as possible, and the rest of the vertices do not move at all.
/// Distances are straight, not along the surface, so that the two sides of a wall go together. Shells
/// that touch deform together; those of which nothing is held, nothing stays and nothing touches follow
/// rigidly the point of the others that is nearest. Vertices of equal coordinates stay equal. Vertices that
/// no triangle uses stay.
///
/// The extent along r is kept by stretching along r what lies above or below everything that stays and, where
/// this does not help, the whole (see vertex_constraints.h); fixed parts and points hold their vertices in
/// place, against any handle: edits that move them are refused. The box is checked.
///
/// Rigid motions of everything are exact up to rounding. Keeps nothing of `shape`'s storage. Throws
/// InputError when `shape` is invalid, UsageError for options outside their ranges.
std::unique_ptr<DeformationModel> surface_model(const Shape& shape, const SurfaceModelOptions& options = {});

}  // namespace stackabilization
