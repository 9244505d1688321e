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

/// Steps of differences that give slopes along magnitudes, as a fraction of the edits given. The shortest
/// tell kinks apart that lie close together; in the longest what a solve leaves open (up to 1e-5 of the
/// diagonal, where it stretches to keep a height) does not show.
inline constexpr double shortest_magnitude_step = 1.0 / (1 << 12), longest_magnitude_step = 1.0 / (1 << 8);

/// One magnitude per edit.
using Magnitudes = std::vector<double>;

/// A design by its magnitudes, measured.
struct MagnitudeSample {
  bool made = false;           ///< no edit was refused; otherwise the rest means nothing
  bool passes = false;         ///< every check, but perhaps for the target
  bool feasible = false;       ///< and reaches the target
  double change = 0;           ///< what is to be small
  double displacement = 0;     ///< its share that is a root mean square, 0 where that is not measured
  double stackability = 0;     ///< S, with the air asked for, less the handicap
  Eigen::VectorXd changes;     ///< whose magnitudes add up to the rest of it
  Eigen::VectorXd shortfalls;  ///< what each constraint lacks: positive where it is broken
};

/// How a sample changes with each magnitude: one column per magnitude, zero where no neighbour could be made.
struct MagnitudeSlopes {
  Eigen::MatrixXd changes, shortfalls;
  /// The square of the displacement after a step y is nearly (1 y) gram (1 y)^T; empty where that is not
  /// measured.
  Eigen::MatrixXd gram;
  std::vector<bool> made;  ///< whether there is a neighbour, per magnitude
};

/// The designs that some edits make with other magnitudes, along one direction: a function of few numbers.
/// Remembers what it measured. Deterministic for any number of threads.
class MagnitudeProblem {
 public:
  struct Limits {
    int evaluations = 0;                          ///< samples made at most, but for a few
    double reach = 0;                             ///< magnitudes lie in [-reach, max(reach, 1)]
    ChangeMeasure measure = ChangeMeasure::both;  ///< what is to be small
    std::function<bool()> cancelled;
  };

  MagnitudeProblem(const RequirementChecker& checker, std::vector<Edit> edits, const Direction& direction,
                   Limits limits);

  std::size_t size() const { return edits_.size(); }
  double lowest() const { return -limits_.reach; }
  double highest() const { return std::max(limits_.reach, 1.0); }
  /// S that is aimed at: the target, and half of the excess that is allowed.
  double aim() const;

  /// From now on shortfalls have one row for the whole shape, one for each pair of blocks that comes near its
  /// f_max at `x`, one per check and one for the proportions. That of the whole shape counts only where no
  /// such pair attains f_max, so that no pair is forgotten. Precondition: at(x).made.
  void constrain_pairs(const Magnitudes& x);

  const MagnitudeSample& at(const Magnitudes& x);
  /// By differences over a step of each magnitude, see step_by. Zero, with no neighbour made, when it is
  /// cancelled meanwhile. Precondition: what is at `x` can be made.
  MagnitudeSlopes slopes(const Magnitudes& x);
  /// Measures several at once, so that at() has them.
  void prepare(const std::vector<Magnitudes>& points);

  /// The edits with these magnitudes; those with 0 are left out.
  std::vector<Edit> edits(const Magnitudes& x) const;
  DesignOutcome design(const Magnitudes& x) const;

  /// The feasible sample of least change so far, if any, and of those that pass the one of largest S.
  const std::optional<Magnitudes>& best() const { return best_; }
  /// From now on this is the best one. Precondition: it is known and feasible.
  void prefer(const Magnitudes& x);
  const std::optional<Magnitudes>& nearest() const { return nearest_; }
  double best_change() const { return best_change_; }
  double nearest_stackability() const { return nearest_stackability_; }
  int evaluations() const { return evaluations_; }
  /// So many evaluations, in all, are the limit from now on.
  void allow(int evaluations) { limits_.evaluations = evaluations; }
  /// Slopes are taken over such steps from now on, at first over the shortest that make sense.
  void step_by(double step) { step_ = step; }
  /// The limit of evaluations is used up, or it was cancelled.
  bool stopped() const;

 private:
  struct Measured {
    MagnitudeSample sample;
    Points moved;  ///< displacements of some vertices, where they are measured
  };
  Measured measured(const Magnitudes& x) const;
  /// Those left when it is `cancelled`, which only this thread asks, are not made.
  std::vector<Measured> measured(const std::vector<Magnitudes>& points,
                                 const std::function<bool()>& cancelled) const;
  /// How much more than the target a design of such boxes needs: 0 but for a room, for which S is to grow
  /// with the boxes.
  double handicap(const Stackability& measured) const;
  void measure_blocks(const Design& design, const Stackability& whole, MagnitudeSample& sample) const;
  void remember(const Magnitudes& x, MagnitudeSample sample);
  /// Of what was measured at a point, and after one step with each magnitude.
  MagnitudeSlopes differences(const std::vector<Measured>& made, const std::vector<double>& steps) const;

  const RequirementChecker& checker_;
  std::vector<Edit> edits_;
  Direction direction_;
  Limits limits_;
  DeformationConstraints constraints_;
  EnergyMeter meter_;
  BlockSeparations blocks_;
  std::vector<BlockPair> pairs_;
  bool checks_ = false;  ///< there are more of them than S and what the deformation keeps anyway
  std::map<Magnitudes, MagnitudeSample> samples_;
  std::optional<Magnitudes> best_, nearest_;
  double best_change_ = 0, nearest_stackability_ = 0;
  int evaluations_ = 0;
  double step_ = shortest_magnitude_step;
};

}  // namespace stackabilization::detail
