#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/deformation/deformation_model.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// A deformed object: how it came about, and what it is. A value; candidates of a search own theirs.
struct Design {
  std::vector<Edit> edits;            ///< from rest, in this order
  std::vector<Primitive> primitives;  ///< one per part of the structure
  Shape shape;                        ///< triangles and parts as at rest
};

/// A design after one more edit, or the reason why not.
struct DesignOutcome {
  std::optional<Refusal> refusal;  ///< when set, `design` is what it was before
  Design design;                   ///< with the edit, if there is no refusal
};

/// What moves the mesh.
enum class DeformationKind { controllers, surface, iwires, gap_scaling };

/// "controllers", "surface", "iwires", "gap-scaling".
std::string name_of(DeformationKind kind);

/// All designs that one deformation model makes of one structured shape. Queries are const, deterministic and
/// safe from any number of threads.
///
/// Models without primitives (all but controllers) carry those of the structure along: each by the affine map
/// that fits the displacements of its part best in the least-squares sense (the translation alone where the
/// vertices of the part do not determine one), so that energies are defined for every model.
class DesignSpace {
 public:
  virtual ~DesignSpace() = default;

  /// The shape without edits, with its structure.
  virtual const StructuredShape& rest() const = 0;
  /// Which model moves the mesh.
  virtual DeformationKind kind() const = 0;
  /// Everything that can be edited.
  virtual std::vector<Handle> handles() const = 0;
  /// Where `handles` are at rest, in their order, model units; empty for controllers, whose primitives say
  /// so.
  virtual std::vector<Eigen::Vector3d> centres() const { return {}; }
  /// The design without edits: vertices and primitives at rest to the bit.
  virtual Design at_rest() const = 0;
  /// `now` with one more edit. Extents and boxes of the constraints are those of the shape at rest. Throws
  /// UsageError for a handle that the model does not have, or an operation it cannot take.
  virtual DesignOutcome edited(const Design& now, const Edit& edit,
                               const DeformationConstraints& constraints) const = 0;
  /// All edits from rest: the same, to the bit, as one after the other. When one is refused, `design` is what
  /// the edits before it made.
  virtual DesignOutcome replayed(const std::vector<Edit>& edits,
                                 const DeformationConstraints& constraints) const;
};

/// Which deformation model `design_space` prepares.
struct DesignSpaceOptions {
  DeformationKind kind = DeformationKind::controllers;  ///< the model
  /// Along which gap scaling squashes, and the main axis of the surface model's slices.
  Direction direction{0, 0, 1};
};

/// Most parts of a shape that is searched for designs: a search makes hundreds of edits, and every energy
/// compares all pairs of parts.
inline constexpr std::size_t max_design_parts = 500;
/// Most points of all joints of such a shape.
inline constexpr std::size_t max_design_joint_points = 200;

/// Throws as the constructor of the model does, and InputError for a shape of more than `max_design_parts`
/// parts, or with controllers more than `max_design_joint_points` (ControllerLimits).
std::unique_ptr<DesignSpace> design_space(StructuredShape rest, const DesignSpaceOptions& options = {});

}  // namespace stackabilization
