#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization {

/// Definition of the boxes of V(M) and V(M, r).
enum class BoxModel {
  /// V(M): minimal oriented box. V(M, r): h times the minimal-area rectangle. Independent of the pose.
  oriented,
  /// V(M): axis-aligned box of the file. V(M, r): axis-aligned box after the minimal rotation from z to r.
  frame,
};

/// Computes V(M), model units cubed. It is 0 exactly when the shape is flat, straight or a point (`oriented`:
/// HullSupport::dimension() below 3; `frame`: the thickness of the box is within tolerance::rounding).
double box_volume(const HullSupport& hull, BoxModel model);

/// Treatment of a shape with V(M) = 0: flat, straight or a point.
enum class FlatShapes {
  /// The solver throws InputError.
  refuse,
  /// The solver measures everything except S, which is undefined.
  measure,
};

/// Meaning of a stackability: every number depends on these options.
struct StackabilityOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< meaning of f_max
  BoxModel boxes = BoxModel::oriented;                   ///< meaning of V(M) and V(M, r)
  FlatShapes flat_shapes = FlatShapes::refuse;           ///< what to do where V(M) = 0
  double clearance = 0;  ///< air along r that counts as part of f_max, model units, finite, >= 0
  /// Lateral play that counts as part of f_max (see separation_with_play), model units, finite, >= 0.
  double play = 0;
};

/// Stackability along one direction, with the terms of Eq. 2 and 3.
struct Stackability {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< r as given
  double f_max = 0;       ///< minimal stacking translation, with clearance and play, model units
  double extent = 0;      ///< h(M, r), model units; > 0 unless V(M) = 0
  double box_volume = 0;  ///< V(M)
  double base = 0;        ///< V(M, r) / h(M, r): area of the box across r, model units squared
  double value = 0;       ///< S(M, r), see `value_at`; may be negative; NaN if V(M) = 0

  /// Returns the height along r of a stack of `copies` copies, h + (copies - 1) f_max, model units.
  /// Precondition: copies >= 1.
  double stack_height(int copies) const { return extent + (copies - 1) * f_max; }
  /// Returns by how far the last of `copies` copies stands beside the first, with z upwards, model units: 0
  /// along the z axis. Precondition: copies >= 1.
  double stack_drift(int copies) const {
    return (copies - 1) * f_max * direction.head<2>().norm() / direction.norm();
  }
  /// Returns the angle between the direction and the z axis, degrees, in [0, 180].
  double lean_degrees() const;
  double stack_box_volume() const { return extent * base; }  ///< V(M, r)
  /// Returns S for the translation f, model units: 1 - (f / h) V(M, r) / V(M), Eq. 3; NaN if V(M) = 0.
  double value_at(double f) const;
  /// Returns the decrease of S per unit of f; the derivative of `value_at` without its sign.
  double loss_per_length() const { return stack_box_volume() / (extent * box_volume); }
  /// Returns the translation f for which S is `stackability`: the inverse of `value_at`.
  double translation_for(double stackability) const { return (1 - stackability) * box_volume / base; }
  /// Returns the same terms with the translation f and its S.
  Stackability with_f_max(double f) const;
};

/// Stackability and the exact separation that it follows from.
struct ExactStackability {
  Stackability stackability;  ///< with clearance and play
  Separation separation;      ///< exact, with witness, without clearance and play
};

/// A shape prepared for measurements in many directions. The separation tree, the hull and V(M) are computed
/// once. Queries are const, deterministic and safe from any number of threads.
class StackabilitySolver {
 public:
  /// Throws InputError when `validate(shape)` fails. Throws InputError when V(M) = 0 (flat, straight or a
  /// point), since S is then undefined, unless the options allow it. Throws UsageError for a clearance or
  /// play out of range.
  explicit StackabilitySolver(const Shape& shape, const StackabilityOptions& options = {});

  const Shape& shape() const;                  ///< copy of the given shape
  const SeparationTree& tree() const;          ///< separation tree of the shape
  const HullSupport& hull() const;             ///< convex hull of the shape
  const StackabilityOptions& options() const;  ///< options of the solver
  const OrientedBox& box() const;              ///< the box of V(M)
  double box_volume() const;                   ///< V(M), model units cubed; 0 only when the options allow it

  /// Returns a solver that differs in play only. It shares the tree, the hull and the box with this one.
  /// Throws UsageError for a play out of range.
  StackabilitySolver with_play(double play) const;

  /// Returns the exact f_max with its witness, without clearance and play.
  Separation separation(const Direction& direction) const;
  /// Returns S and its terms; f_max within 1e-12 of the extent.
  Stackability measure(const Direction& direction) const;
  /// Returns S and its terms from the exact separation, with that separation.
  ExactStackability measure_exact(const Direction& direction) const;
  /// Computes the same as `measure`, but returns nothing as soon as S is certainly below `threshold`.
  std::optional<Stackability> measure_if_above(const Direction& direction, double threshold) const;
  /// Computes the same, and how many pairs of nodes of the separation tree that took.
  std::optional<Stackability> measure_if_above(const Direction& direction, double threshold,
                                               std::int64_t& node_pairs) const;

 private:
  struct Data;
  explicit StackabilitySolver(std::shared_ptr<const Data> data, const StackabilityOptions& options);

  std::shared_ptr<const Data> data_;
  StackabilityOptions options_;
};

/// Computes S(M, r) for one direction, cheaper than a solver, which is prepared for many directions. The
/// result equals that of a solver up to rounding. Throws as the constructor of StackabilitySolver does.
Stackability stackability(const Shape& shape, const Direction& direction,
                          const StackabilityOptions& options = {});

/// Computes the same, but returns nothing when S is certainly below `threshold`, which is often cheap to
/// decide.
std::optional<Stackability> stackability_if_above(const Shape& shape, const Direction& direction,
                                                  double threshold, const StackabilityOptions& options = {});

/// Returns what StackabilitySolver::measure_exact does, for one use. `tree`: the separation tree of `shape`.
ExactStackability measure_exact(const Shape& shape, const SeparationTree& tree, const Direction& direction,
                                const StackabilityOptions& options = {});

}  // namespace stackabilization
