#pragma once

#include "improvement/refinement/magnitude_problem.h"

namespace stackabilization::detail {

enum class MagnitudeGoal {
  feasible,   ///< the largest shortfall is made as small as can be, until a sample is feasible
  unchanged,  ///< the change is made as small as can be while no constraint falls short
};

/// A convex model of a MagnitudeProblem around a point: the changes and the displacement as their slopes at
/// that point say, every constraint as the maximum of what was seen of it from several points (cuts), which
/// is how kinks become known.
class MagnitudeModel {
 public:
  MagnitudeModel(MagnitudeGoal goal, Magnitudes centre, const MagnitudeSample& base,
                 const MagnitudeSlopes& slopes);

  /// The model around another point. Of what is known of the constraints that stays which agrees with it.
  void move_to(Magnitudes centre, const MagnitudeSample& base, const MagnitudeSlopes& slopes);
  /// Adds how the constraints look from a point, in place of all corrections.
  void add(const Magnitudes& at, const MagnitudeSample& sample, const MagnitudeSlopes& slopes);
  /// The same with the slopes that the centre has, for those that fall short: enough where they are curved
  /// only.
  void correct(const Magnitudes& at, const MagnitudeSample& sample);

  const Magnitudes& centre() const { return centre_; }
  /// What the goal makes small, of a sample.
  double merit(const MagnitudeSample& sample) const;

  struct Step {
    Magnitudes to;
    double promised = 0;  ///< by which the merit falls, according to the model
    /// Per magnitude: how much more it would promise, per unit, if its limits left it room.
    Eigen::VectorXd pull;
  };
  /// To the minimum of the model within these limits.
  Step step(const Magnitudes& lowest, const Magnitudes& highest) const;

 private:
  using Row = Eigen::RowVectorXd;
  /// value + slope * x, of constraint `row`.
  struct Cut {
    Eigen::Index row = 0;
    double value = 0;
    Row slope;
    bool measured = true;  ///< false: a correction
  };
  class Programme;

  double level(const Cut& cut) const;  ///< at the centre
  void add(Cut cut);
  void group_changes(const MagnitudeSample& base, const MagnitudeSlopes& slopes);

  MagnitudeGoal goal_;
  Magnitudes centre_;
  MagnitudeSample base_;
  MagnitudeSlopes slopes_;
  std::vector<Row> changes_;  ///< value at the centre and slope, of sums of changes that grow together
  double constant_ = 0;       ///< what the others add to the change
  std::vector<Cut> cuts_;
};

}  // namespace stackabilization::detail
