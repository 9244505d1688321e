#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "improvement/contacts/block_separations.h"
#include "stackabilization/improvement/change_measure.h"
#include "stackabilization/improvement/energy.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// Steps of the finite differences for slopes, as fractions of the given edits. The shortest step tells apart
/// kinks that lie close together. The longest step hides the residuals of the deformation solves (up to 1e-5
/// of the diagonal, where the shape is stretched to keep a height).
inline constexpr double min_magnitude_step = 1.0 / (1 << 12), max_magnitude_step = 1.0 / (1 << 8);

/// Magnitudes of the edits, one per edit; 1: as given, 0: none.
using Magnitudes = std::vector<double>;

/// Measures of the design for some magnitudes.
struct MagnitudeSample {
  bool made = false;        ///< whether no edit was refused; if false, the other fields are meaningless
  bool passes = false;      ///< whether every check passes, the target excepted
  bool feasible = false;    ///< whether `passes`, and S reaches the target
  double change = 0;        ///< objective: size of the change
  double displacement = 0;  ///< share of `change` that is a root mean square displacement; 0 if not measured
  double stackability = 0;  ///< S with clearance and play, minus the handicap
  Eigen::VectorXd changes;  ///< signed changes whose absolute values add up to the rest of `change`
  Eigen::VectorXd violations;  ///< constraint violations, > 0 where a constraint is violated
};

/// Slopes of a sample: one column per magnitude, 0 where no neighbour could be made.
struct MagnitudeSlopes {
  Eigen::MatrixXd changes, violations;
  /// Model of the displacement: its square after a step y is about (1 y) gram (1 y)^T. Empty if not measured.
  Eigen::MatrixXd gram;
  std::vector<bool> made;  ///< per magnitude, whether a neighbour could be made
  /// Per magnitude, whether the neighbour above, or below, could not be made. Empty: none is known.
  std::vector<bool> refused_above, refused_below;
};

/// Optimisation problem over the magnitudes of given edits, along one direction. Remembers its measurements.
/// Deterministic for any number of threads.
class MagnitudeProblem {
 public:
  /// Limits and objective.
  struct Limits {
    int evaluations = 0;                          ///< `stopped` is true from this number of samples on
    double magnitude_bound = 0;                   ///< magnitudes lie in [-reach, max(reach, 1)]
    ChangeMeasure measure = ChangeMeasure::both;  ///< objective
    std::function<bool()> cancelled;
  };

  MagnitudeProblem(const RequirementChecker& checker, std::vector<Edit> edits, const Direction& direction,
                   Limits limits);

  std::size_t size() const { return edits_.size(); }
  double lowest() const { return -limits_.magnitude_bound; }
  double highest() const { return std::max(limits_.magnitude_bound, 1.0); }
  /// Returns the S to aim at: the target plus half of the allowed excess, tolerance::target.
  double target() const;

  /// Defines the constraints, that is the rows of MagnitudeSample::shortfalls: the whole shape, every pair of
  /// blocks whose separation comes near f_max (or what the target allows) at `x`, every check, and the
  /// proportions. The row of the whole shape is active only if no such pair attains f_max, so that no pair is
  /// missed. Forgets all samples. Precondition: at(x).made.
  void constrain_pairs(const Magnitudes& x);

  /// Returns the measures at `x`; measures only new points.
  const MagnitudeSample& at(const Magnitudes& x);
  /// Computes slopes at `x` by finite differences with the step of `step_by`. All zero, without neighbours,
  /// when cancelled meanwhile. Precondition: at(x).made.
  MagnitudeSlopes slopes(const Magnitudes& x);
  /// Measures several points in parallel, for later calls of `at`.
  void prepare(const std::vector<Magnitudes>& points);

  /// Returns the edits with magnitudes `x`, without those of magnitude 0.
  std::vector<Edit> edits(const Magnitudes& x) const;
  /// Makes the design with magnitudes `x`.
  DeformationResult design(const Magnitudes& x) const;

  /// best(): the feasible sample of least change so far, if any. nearest(): of the samples that pass all
  /// checks but the target, the one of largest S.
  const std::optional<Magnitudes>& best() const { return best_; }
  /// Makes `x` the best sample. Precondition: it was measured and is feasible.
  void prefer(const Magnitudes& x);
  const std::optional<Magnitudes>& nearest() const { return nearest_; }
  double best_change() const { return best_change_; }
  double nearest_stackability() const { return nearest_stackability_; }
  int evaluations() const { return evaluations_; }
  /// Sets the total number of evaluations allowed.
  void allow(int evaluations) { limits_.evaluations = evaluations; }
  /// Sets the step of finite differences; initially min_magnitude_step.
  void step_by(double step) { step_ = step; }
  /// Returns whether the evaluations are used up or the caller cancelled.
  bool stopped() const;

 private:
  struct Measured {
    MagnitudeSample sample;
    Points moved;  ///< displacements of some vertices, n x 3; empty if not measured
  };
  Measured measured(const Magnitudes& x) const;
  /// Measures `points` in parallel. Only the calling thread asks `cancelled`; once it is true, the remaining
  /// points are not made.
  std::vector<Measured> measured(const std::vector<Magnitudes>& points,
                                 const std::function<bool()>& cancelled) const;
  /// Returns the S needed for these boxes minus the target: 0 unless a room is required, for which the S
  /// needed depends on the boxes.
  double target_offset(const Stackability& measured) const;
  void measure_blocks(const Design& design, const Stackability& whole, MagnitudeSample& sample) const;
  void remember(const Magnitudes& x, MagnitudeSample sample);
  /// Returns the slopes from measurements at a point and at one neighbour per magnitude.
  MagnitudeSlopes differences(const std::vector<Measured>& made, const std::vector<double>& steps) const;

  const RequirementChecker& checker_;
  std::vector<Edit> edits_;
  Direction direction_;
  Limits limits_;
  DeformationConstraints constraints_;
  EnergyMeter meter_;
  BlockSeparations blocks_;
  std::vector<BlockPair> pairs_;
  bool checks_ = false;  ///< whether there are checks beyond S and what the deformation model guarantees
  std::map<Magnitudes, MagnitudeSample> samples_;
  std::optional<Magnitudes> best_, nearest_;
  double best_change_ = 0, nearest_stackability_ = 0;
  int evaluations_ = 0;
  double step_ = min_magnitude_step;
};

}  // namespace stackabilization::detail
