#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// A configuration after an edit, or the reason why not.
struct EditOutcome {
  std::optional<Refusal> refusal;     ///< when set, the rest is as it was before
  std::vector<Primitive> primitives;  ///< one per part
};

/// What a ControllerModel takes on.
struct ControllerLimits {
  /// Points at which parts are joined, those that symmetries copy counted once. A solve takes a time that
  /// grows with the cube of their number, and memory with its square.
  std::size_t max_joint_points = 600;
};

/// Cuboids and generalized cylinders that move the mesh riding on them, with all relations between them kept
/// (paper, section 4.1). See docs/controllers.md.
///
/// A configuration is one primitive per part, values in and values out. An edit is made exactly or refused:
/// symmetries hold up to rounding by construction, joints to tolerance::relation of the diagonal (in practice
/// to rounding), no primitive collapses, folds or turns inside out. Symmetry planes and axes are fixed in
/// space: what one part of a pair does the other does in the mirror, and a part that is its own mirror image
/// cannot leave the plane.
class ControllerModel : public DeformationModel {
 public:
  /// Everything that depends on the rest alone is computed here. Throws InputError when `rest` is invalid or
  /// its primitives do not satisfy its symmetry relations, or it is beyond `limits`.
  explicit ControllerModel(StructuredShape rest, const ControllerLimits& limits = {});
  ControllerModel(ControllerModel&&) noexcept;
  ControllerModel& operator=(ControllerModel&&) noexcept;
  ~ControllerModel() override;

  /// The shape at rest with its structure, as given.
  const StructuredShape& rest() const;
  /// The configuration at rest.
  const std::vector<Primitive>& rest_primitives() const;

  /// The shape, parts, faces and corners of cuboids, cross-sections of generalized cylinders.
  std::vector<Handle> handles() const override;
  Eigen::Vector3d centre(const Handle& handle) const override;
  DeformationResult deformed(const std::vector<Edit>& edits,
                             const DeformationConstraints& constraints = {}) const override;

  /// One edit to a configuration that this model made. The handle goes where the edit takes it and the others
  /// follow (propagation.h, relation_solver.h); every relation is recomputed from the result before it
  /// counts. Extents and boxes of the constraints are those of the shape at rest, parts and points stay where
  /// they are in `now`. Throws UsageError as `deformed`.
  EditOutcome edited(const std::vector<Primitive>& now, const Edit& edit,
                     const DeformationConstraints& constraints = {}) const;

  /// The mesh of a configuration; at rest, the one given, to the bit.
  Shape shape_of(const std::vector<Primitive>& now) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace stackabilization
