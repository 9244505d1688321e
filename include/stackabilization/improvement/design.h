#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// A deformed object with the edits that made it. A value type: every candidate of a search owns its design.
struct Design {
  std::vector<Edit> edits;            ///< edits from rest, in order
  std::vector<Primitive> primitives;  ///< one primitive per part of the structure, deformed
  Shape shape;                        ///< deformed mesh; triangles and parts as at rest
};

/// A design after one more edit, or the reason why the edit was refused.
struct DesignOutcome {
  std::optional<Refusal> refusal;  ///< reason; when set, `design` is the design before the edit
  Design design;                   ///< the design with the edit, unless it was refused
};

/// Deformation models.
enum class DeformationKind { controllers, surface, iwires, gap_scaling };

/// Returns "controllers", "surface", "iwires" or "gap-scaling".
std::string name_of(DeformationKind kind);

/// The designs that one deformation model can make of one structured shape. Queries are const, deterministic
/// and safe from any number of threads.
///
/// Models without primitives (all except controllers) carry the primitives of the structure along, so that
/// energies are defined for every model. Each primitive follows the affine map that fits the displacements of
/// its part best in the least-squares sense, or only the mean translation where the vertices of the part do
/// not determine an affine map.
class DesignSpace {
 public:
  virtual ~DesignSpace() = default;

  /// Returns the shape without edits, with its structure.
  virtual const StructuredShape& rest() const = 0;
  /// Returns which deformation model this is.
  virtual DeformationKind kind() const = 0;
  /// Returns how parts follow an edit; free for models other than controllers.
  virtual Following following() const { return Following::free; }
  /// Returns everything that can be edited.
  virtual std::vector<Handle> handles() const = 0;
  /// Returns the centres of `handles` at rest, in the same order, model units. Empty for controllers: their
  /// primitives determine the centres.
  virtual std::vector<Eigen::Vector3d> centres() const { return {}; }
  /// Returns the design without edits: vertices and primitives are those at rest, to the bit.
  virtual Design at_rest() const = 0;
  /// Makes one more edit to `now`. The extent and the box that the constraints keep are those of the shape at
  /// rest. Throws UsageError for a handle that the model does not have and for an operation that it does not
  /// support.
  virtual DesignOutcome edited(const Design& now, const Edit& edit,
                               const DeformationConstraints& constraints) const = 0;
  /// Makes all edits from rest. The result equals that of one call of `edited` per edit, to the bit. When an
  /// edit is refused, `design` has the edits before it.
  virtual DesignOutcome replayed(const std::vector<Edit>& edits,
                                 const DeformationConstraints& constraints) const;
};

/// Which deformation model `design_space` prepares.
struct DesignSpaceOptions {
  DeformationKind kind = DeformationKind::controllers;  ///< the model
  /// Direction along which gap scaling compresses, and main axis of the slices of the surface model.
  Direction direction{0, 0, 1};
  Following following = Following::free;  ///< controllers: how parts follow an edit
};

/// Largest number of parts of a shape that can be edited. A search makes hundreds of edits, and every energy
/// compares all pairs of parts.
inline constexpr std::size_t max_design_parts = 500;
/// Largest number of points in all joints of such a shape, with controllers.
inline constexpr std::size_t max_design_joint_points = 200;

/// Prepares a deformation model for `rest`. Throws as the constructor of the model. Throws InputError for a
/// shape of more than `max_design_parts` parts, and with controllers for one of more than
/// `max_design_joint_points` (ControllerLimits).
std::unique_ptr<DesignSpace> design_space(StructuredShape rest, const DesignSpaceOptions& options = {});

}  // namespace stackabilization
