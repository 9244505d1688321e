#pragma once

#include <memory>
#include <optional>

#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization {

/// How V(M) and V(M, r) are measured.
enum class BoxModel {
  oriented,  ///< V(M) minimal oriented box, V(M, r) = h times the minimal-area rectangle: independent of the
             ///< pose
  frame,     ///< V(M) the file's axis-aligned box, V(M, r) axis-aligned after the minimal rotation of z to r
};

/// V(M), model units cubed: 0 exactly when the shape is flat, straight or a point (`oriented`:
/// HullSupport::dimension() below 3; `frame`: its box is no thicker than rounding, tolerance::rounding).
double box_volume(const HullSupport& hull, BoxModel model);

/// What to do with a shape of V(M) = 0: flat, straight or a point.
enum class FlatShapes {
  refuse,
  measure,  ///< all but S, which is undefined
};

/// What a stackability means: every number depends on these.
struct StackabilityOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< of f_max
  BoxModel boxes = BoxModel::oriented;                   ///< of V(M) and V(M, r)
  FlatShapes flat_shapes = FlatShapes::refuse;           ///< what to do where V(M) = 0
};

/// Everything that Eq. 2 and 3 need, for one direction.
struct Stackability {
  Eigen::Vector3d direction;    ///< r as given
  double f_max = 0;             ///< minimal stacking translation, model units
  double extent = 0;            ///< h(M, r), model units; > 0 unless V(M) = 0
  double box_volume = 0;        ///< V(M)
  double stack_box_volume = 0;  ///< V(M, r)
  double value = 0;             ///< S(M, r) = 1 - (f_max / h) V(M, r) / V(M), Eq. 3; may be negative; NaN
                                ///< if V(M) = 0
};

/// A shape prepared for measurements in many directions: separation tree, hull and V(M), built once. Queries
/// are const, deterministic and safe to run from any number of threads.
class StackabilitySolver {
 public:
  /// Throws InputError when the shape has no volume to speak of (V(M) = 0: flat, straight or a point), since
  /// S is then undefined, unless the options ask to measure the rest, or when `validate(shape)` fails.
  explicit StackabilitySolver(const Shape& shape, const StackabilityOptions& options = {});
  StackabilitySolver(StackabilitySolver&&) noexcept;
  StackabilitySolver& operator=(StackabilitySolver&&) noexcept;
  ~StackabilitySolver();

  const Shape& shape() const;                  ///< a copy of the one given
  const SeparationTree& tree() const;          ///< of the shape
  const HullSupport& hull() const;             ///< of the shape
  const StackabilityOptions& options() const;  ///< as given
  double box_volume() const;                   ///< V(M); 0 only if the options allow it

  /// Exact f_max with witness.
  Separation separation(const Direction& direction) const;
  /// S and its terms, f_max within 1e-12 of the extent.
  Stackability measure(const Direction& direction) const;
  /// As `measure`, but gives up and returns nothing as soon as S is certainly below `threshold`.
  std::optional<Stackability> measure_if_above(const Direction& direction, double threshold) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// S(M, r) for one use: cheaper than a solver, which is prepared for many directions. Equal to what a solver
/// measures up to rounding. Throws as the constructor of StackabilitySolver.
Stackability stackability(const Shape& shape, const Direction& direction,
                          const StackabilityOptions& options = {});

/// The same unless S is certainly below `threshold`, which is often cheap to see.
std::optional<Stackability> stackability_if_above(const Shape& shape, const Direction& direction,
                                                  double threshold, const StackabilityOptions& options = {});

/// Eq. 3 with `translation` (model units) for f_max, such as one with air between the copies. Throws as the
/// constructor of StackabilitySolver.
Stackability stackability_of_translation(const Shape& shape, const Direction& direction, double translation,
                                         const StackabilityOptions& options = {});

}  // namespace stackabilization
