#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Result of an edit: the configuration after it, or the reason for the refusal.
struct EditOutcome {
  /// Set when the edit was refused; `primitives` are then those before the edit.
  std::optional<Refusal> refusal;
  std::vector<Primitive> primitives;  ///< primitives of the configuration, one per part
};

/// How the parts that are not edited follow an edit.
enum class Following {
  /// Any way, cheap motions first: parts move, stretch and lean, generalized cylinders bend, single corners
  /// of
  /// cuboids move.
  free,
  /// Only by affine maps, and straight generalized cylinders also as members of a frame: they lean, stretch
  /// and
  /// change their radii linearly. Joints slide in the plane of plates and along straight members, where they
  /// do not lie at the rim or the end (Relation::carrier). Edits that need more are refused.
  smooth,
};

/// Limits on the size of a ControllerModel.
struct ControllerLimits {
  /// Largest number of points at which parts are joined. Points that symmetries map onto each other count
  /// once. The time of a solve grows with the cube of this number, and its memory with the square.
  std::size_t max_joint_points = 600;
};

/// Deformation by cuboids and generalized cylinders that carry the mesh and keep all relations between them
/// (paper, section 4.1). See docs/controllers.md.
///
/// A configuration is a list of primitives, one per part. Functions take and return configurations by value.
/// An edit is made exactly or refused. After an edit, symmetries hold up to rounding by construction, joints
/// hold within tolerance::relation of the diagonal (in practice up to rounding), and no primitive collapses,
/// folds or turns inside out. Symmetry planes and axes are fixed in space. The two parts of a mirror pair
/// therefore move as mirror images of each other, and a part that is its own mirror image cannot leave the
/// plane.
class ControllerModel : public DeformationModel {
 public:
  /// Precomputes everything that depends on the rest pose alone. Throws InputError when `rest` is invalid,
  /// when its primitives do not satisfy its symmetry relations, or when it exceeds `limits`.
  explicit ControllerModel(StructuredShape rest, const ControllerLimits& limits = {},
                           Following following = Following::free);
  ControllerModel(ControllerModel&&) noexcept;
  ControllerModel& operator=(ControllerModel&&) noexcept;
  ~ControllerModel() override;

  /// Returns the shape at rest with its structure, as given.
  const StructuredShape& rest() const;
  /// Returns the configuration at rest.
  const std::vector<Primitive>& rest_primitives() const;

  /// Returns the handles: the shape, the parts, the faces and corners of cuboids, and the cross-sections of
  /// generalized cylinders.
  std::vector<Handle> handles() const override;
  Eigen::Vector3d centre(const Handle& handle) const override;
  DeformationResult deformed(const std::vector<Edit>& edits,
                             const DeformationConstraints& constraints = {}) const override;

  /// Applies one edit to the configuration `now` of this model. The handle moves exactly as the edit
  /// prescribes, and the other parts follow (propagation.h, relation_solver.h). The function recomputes every
  /// relation from the result before it accepts the edit. Extent and box constraints refer to the shape at
  /// rest. Fixed parts and points keep their positions in `now`. Throws UsageError under the conditions of
  /// `deformed`, and when `now` does not have the kinds and sizes of primitives of this model.
  EditOutcome edited(const std::vector<Primitive>& now, const Edit& edit,
                     const DeformationConstraints& constraints = {}) const;

  /// Returns the mesh of the configuration `now`. At rest it equals the given mesh bit for bit. Throws
  /// UsageError when `now` does not have the kinds and sizes of primitives of this model.
  Shape shape_of(const std::vector<Primitive>& now) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace stackabilization
