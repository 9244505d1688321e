#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/deformation/edit.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// Control values that an edit prescribes for a part.
struct PartEdit {
  int part = 0;
  /// Prescribed control values (entries of ControlState::values of the part itself), and their changes. An
  /// edit of the part as a whole prescribes all of them.
  std::vector<int> values;
  Eigen::VectorXd changes;
  Eigen::Quaterniond rotation =
      Eigen::Quaterniond::Identity();  ///< rotation of a whole generalized cylinder by the edit
  /// Cross-section from which the change decreases linearly (Falloff::linear).
  std::optional<int> linear_from;
  bool leans = false;  ///< whether it is a leaning, which leaves heights free where an extent is kept
};

/// Returns the handles of one primitive: the part, then faces and corners, or cross-sections.
std::vector<Handle> handles_of(int part, const Primitive& primitive);

/// Returns the point about which a handle rotates and scales: the mean of its control points. Throws
/// UsageError when the primitive has no such handle, and for HandleKind::shape.
Eigen::Vector3d handle_centre(const Primitive& primitive, const Handle& handle, const std::string& part_name);

/// Returns the point about which the whole shape rotates and scales: the mean of all control points.
Eigen::Vector3d shape_centre(const std::vector<Primitive>& primitives);

/// Returns the n factors of the radii under an affine map with the given linear part: the square roots of the
/// factors of the areas of the sections.
Eigen::VectorXd radius_factors(const GeneralizedCylinder& cylinder, const Eigen::Matrix3d& linear);

/// Computes the control values that an edit prescribes for a part, with the degrees of freedom of section 4.1
/// of the paper. A whole part moves, rotates, scales and leans, by an affine map of its control points. Its
/// radii change such that the areas of the cross-sections change as under that map (circles stay circles).
/// With Following::smooth, a bent bar that is scaled along an axis keeps its radii. A face moves, rotates,
/// and scales within its plane. A corner moves. A cross-section moves or changes its radius. Throws
/// UsageError for other handles and operations.
PartEdit edit_handle(const Primitive& now, const Edit& edit, const std::string& part_name,
                     Following following);

/// Computes the prescriptions of one operation on all parts as wholes about the centre of the shape, one per
/// part in order.
std::vector<PartEdit> edit_handle(const std::vector<Primitive>& now, const Operation& operation,
                                  Following following);

/// Returns `primitive` with the changes of control values and, for a generalized cylinder, the rotation of
/// `edit`.
Primitive changed(Primitive primitive, const PartEdit& edit);

}  // namespace stackabilization::detail
