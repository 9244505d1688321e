#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// What an edit prescribes for the controls of its part.
struct PartEdit {
  /// Control values (ControlState::values of the part itself) that it sets, and their changes. All of them
  /// for a part as a whole.
  std::vector<int> values;
  Eigen::VectorXd changes;
  Eigen::Quaterniond rotation =
      Eigen::Quaterniond::Identity();  ///< by which a whole generalized cylinder is turned
};

/// Handles of one primitive: the part, then faces and corners, or cross-sections.
std::vector<Handle> handles_of(int part, const Primitive& primitive);

/// Point about which a handle turns and scales: the mean of its control points. Throws UsageError when the
/// primitive has no such handle.
Eigen::Vector3d handle_centre(const Primitive& primitive, const Handle& handle, const std::string& part_name);

/// The freedoms of section 4.1 of the paper. A whole part moves, turns and scales, by an affine map of its
/// control points; radii follow so that the areas of the cross-sections change as under that map (a circle
/// stays one). A face moves, turns and scales within its plane; a corner moves; a cross-section moves or
/// changes its radius. Throws UsageError for other handles and operations.
PartEdit prescribed(const Primitive& now, const Edit& edit, const std::string& part_name);

}  // namespace stackabilization
