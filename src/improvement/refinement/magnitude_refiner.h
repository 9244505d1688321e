#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "improvement/refinement/edit_magnitudes.h"
#include "improvement/refinement/magnitude_model.h"
#include "improvement/refinement/magnitude_problem.h"
#include "stackabilization/improvement/refinement.h"

namespace stackabilization::detail {

/// Refinement of the magnitudes of one list of edits. Refers to its arguments.
class MagnitudeRefiner {
 public:
  /// `added`: edits added to those of the start, with magnitude 0.
  MagnitudeRefiner(const RequirementChecker& checker, const Candidate& start,
                   const RefinementOptions& options, const std::vector<MagnitudeEdit>& added = {});

  /// Returns the added edits of largest reduced cost at the start, at most `most`.
  std::vector<MagnitudeEdit> promising(MagnitudeGoal goal, std::size_t most);
  /// Returns the best design found, or the start.
  RefinementResult result();
  int evaluations() const { return problem_.evaluations(); }

 private:
  /// A candidate with all checks made.
  struct Verdict {
    Candidate candidate;
    bool reached = false;
    double change = 0;

    /// Of equal changes the one with fewer edits is better.
    bool is_better_than(const Verdict& other) const;
  };

  void leave_out_likes(std::vector<std::pair<double, std::size_t>>& ranked,
                       const Eigen::MatrixXd& gram) const;
  Magnitudes found() const;
  Verdict judged(const Magnitudes& x) const;
  Verdict judged(Design design, std::vector<EditReason> reasons) const;

  const RequirementChecker& checker_;
  const Candidate& start_;
  const RefinementOptions& options_;
  Direction direction_;
  std::vector<MagnitudeEdit> edits_;
  EnergyMeter meter_;
  MagnitudeProblem problem_;
};

}  // namespace stackabilization::detail
