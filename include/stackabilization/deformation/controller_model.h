#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Limits on the size of a ControllerModel.
struct ControllerLimits {
  /// Largest number of points at which parts are joined; images under symmetries count once. Rows of parts
  /// stay even only while joints and their points are no more. Time grows with the cube, memory with the
  /// square.
  std::size_t max_joint_points = 600;
};

/// Deformation by cuboids and generalized cylinders that carry the mesh and keep all relations between them
/// (paper, section 4.1). See docs/controllers.md.
///
/// The primitives of a design determine its mesh. An edit is made exactly or refused. After an edit,
/// symmetries hold up to rounding by construction, joints hold within tolerance::relation of the diagonal (in
/// practice up to rounding), and no primitive collapses, folds or turns inside out. Symmetry planes and axes
/// are fixed in space. The two parts of a mirror pair therefore move as mirror images of each other, and a
/// part that is its own mirror image cannot leave the plane.
class ControllerModel final : public DeformationModel {
 public:
  /// Precomputes everything that depends on the rest pose alone. Throws InputError when `rest` is invalid,
  /// when its primitives do not satisfy its symmetry relations, or when it exceeds `limits`.
  explicit ControllerModel(StructuredShape rest, const ControllerLimits& limits = {},
                           Following following = Following::free);
  ControllerModel(ControllerModel&&) noexcept;
  ControllerModel& operator=(ControllerModel&&) noexcept;
  ~ControllerModel() override;

  DeformationKind kind() const override { return DeformationKind::controllers; }
  Following following() const override;
  const StructuredShape& rest() const override;
  /// Returns the handles: the shape, the parts, the faces and corners of cuboids, and the cross-sections of
  /// generalized cylinders.
  std::vector<Handle> handles() const override;
  Eigen::Vector3d centre(const Handle& handle) const override;

  /// Applies one edit to the primitives of `now`, whatever its mesh. The handle moves exactly as the edit
  /// prescribes, and the other parts follow (propagation.h, relation_solver.h). The function recomputes every
  /// relation from the result before it accepts the edit. Extent and box constraints refer to the shape at
  /// rest. Fixed parts and points keep their positions in `now`. Throws UsageError also when `now` does not
  /// have the kinds and sizes of primitives of this model.
  DeformationResult edited(const Design& now, const Edit& edit,
                           const DeformationConstraints& constraints = {}) const override;
  /// Makes the mesh once, at the end.
  DeformationResult deformed(const std::vector<Edit>& edits,
                             const DeformationConstraints& constraints = {}) const override;

  /// Returns the mesh that primitives of this model carry. At rest it equals the given mesh bit for bit.
  /// Throws UsageError when they do not have the kinds and sizes of primitives of this model.
  Shape shape_of(const std::vector<Primitive>& primitives) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace stackabilization
