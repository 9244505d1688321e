#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// What an edit prescribes for the controls of a part.
struct PartEdit {
  int part = 0;
  /// Control values (ControlState::values of the part itself) that it sets, and their changes. All of them
  /// for a part as a whole.
  std::vector<int> values;
  Eigen::VectorXd changes;
  Eigen::Quaterniond rotation =
      Eigen::Quaterniond::Identity();  ///< by which a whole generalized cylinder is turned
  std::optional<int> linear_from;      ///< cross-section from which the change falls off linearly (Falloff)
};

/// Handles of one primitive: the part, then faces and corners, or cross-sections.
std::vector<Handle> handles_of(int part, const Primitive& primitive);

/// Point about which a handle turns and scales: the mean of its control points. Throws UsageError when the
/// primitive has no such handle. Not for the shape.
Eigen::Vector3d handle_centre(const Primitive& primitive, const Handle& handle, const std::string& part_name);

/// Point about which the whole shape turns and scales: the mean of all control points.
Eigen::Vector3d shape_centre(const std::vector<Primitive>& primitives);

/// Factors of the radii under an affine map: square roots of those of the areas of the sections.
Eigen::VectorXd radius_factors(const GeneralizedCylinder& cylinder, const Eigen::Matrix3d& linear);

/// The freedoms of section 4.1 of the paper. A whole part moves, turns and scales, by an affine map of its
/// control points; radii follow so that the areas of the cross-sections change as under that map (a circle
/// stays one). A face moves, turns and scales within its plane; a corner moves; a cross-section moves or
/// changes its radius. Throws UsageError for other handles and operations.
PartEdit prescribed(const Primitive& now, const Edit& edit, const std::string& part_name);

/// One per part, in order: the same operation on all of them as wholes, about the centre of the shape.
std::vector<PartEdit> prescribed(const std::vector<Primitive>& now, const Operation& operation);

/// `primitive` with its control values changed, and turned where it can be.
Primitive changed(Primitive primitive, const PartEdit& edit);

}  // namespace stackabilization::detail
