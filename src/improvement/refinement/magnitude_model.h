#pragma once

#include "improvement/refinement/magnitude_problem.h"

namespace stackabilization::detail {

/// Objective of a run of the optimiser.
enum class MagnitudeGoal {
  feasible,    ///< minimise the largest constraint violation, until a sample is feasible
  min_change,  ///< minimise the change subject to all constraints
};

/// Convex model of a MagnitudeProblem around a point, the centre. Changes and displacement are modelled by
/// their slopes at the centre. Every constraint is modelled by the maximum of its cuts: linearisations at
/// several points. Cuts make kinks known to the model.
class MagnitudeModel {
 public:
  MagnitudeModel(MagnitudeGoal goal, Magnitudes centre, const MagnitudeSample& base,
                 const MagnitudeSlopes& slopes);

  /// Re-centres the model at `centre`. Keeps only cuts that are valid there: value at the centre not above
  /// the measured violation, and not far below 0. Then adds the constraints linearised at `centre`.
  void move_to(Magnitudes centre, const MagnitudeSample& base, const MagnitudeSlopes& slopes);
  /// Adds the linearised constraints at `at` as cuts. Removes all corrections.
  void add(const Magnitudes& at, const MagnitudeSample& sample, const MagnitudeSlopes& slopes);
  /// Adds corrections: cuts for the constraints violated at `at`, with the slopes of the centre. They suffice
  /// where these constraints are smooth but curved.
  void correct(const Magnitudes& at, const MagnitudeSample& sample);

  const Magnitudes& centre() const { return centre_; }
  /// Returns the objective at a sample: the largest violation, or the change.
  double merit(const MagnitudeSample& sample) const;

  /// A step of the model.
  struct Step {
    Magnitudes to;
    double predicted_decrease = 0;  ///< predicted decrease of the merit
    /// Reduced cost per magnitude: further predicted decrease per unit by which the bounds of the magnitude
    /// are relaxed.
    Eigen::VectorXd reduced_costs;
  };
  /// Returns the step to the minimum of the model within the bounds `lowest` and `highest`. A magnitude does
  /// not go where its neighbour of the centre could not be made.
  Step step(const Magnitudes& lowest, const Magnitudes& highest) const;

 private:
  using Row = Eigen::RowVectorXd;
  /// A linearised constraint: value + slope * x, for constraint `row`.
  struct Cut {
    Eigen::Index row = 0;
    double value = 0;
    Row slope;
    bool measured = true;  ///< false: a correction
  };
  class Programme;

  double level(const Cut& cut) const;  ///< value of the cut at the centre
  void add(Cut cut);
  void group_changes(const MagnitudeSample& base, const MagnitudeSlopes& slopes);

  MagnitudeGoal goal_;
  Magnitudes centre_;
  MagnitudeSample base_;
  MagnitudeSlopes slopes_;
  /// Sums of changes that are multiples of each other: value at the centre, then slope.
  std::vector<Row> changes_;
  double constant_ = 0;  ///< sum of the changes that do not depend on the magnitudes
  std::vector<Cut> cuts_;
};

}  // namespace stackabilization::detail
