#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "stackabilization/improvement/diagnosis.h"

namespace stackabilization::detail {

/// Result of trying the edits that would separate some regions.
struct EditTrial {
  double best = 0;  ///< largest S after one edit that keeps every requirement, at least the S before
  std::map<Obstacle, std::int64_t> refusals;
  std::optional<Edit> best_edit;  ///< edit that gives it, if any is better
  int made = 0;
  bool stopped = false;  ///< whether the trial ended before all edits were tried
};

/// Tries edits on one design, each by itself, with a bound of the designs made.
class EditTrials {
 public:
  /// `design`: what is edited. Model, design and options must outlive this object.
  EditTrials(const DeformationModel& space, const Candidate& design, const DiagnosisOptions& options);

  /// Tries every edit that these regions suggest to a search with the model, under the requirements of
  /// `checker`. All requirements are checked for a few edits of largest S, until one keeps them. Nothing if
  /// the edits are more designs than are left, or when stopped.
  std::optional<EditTrial> tried(const std::vector<ContactRegion>& regions,
                                 const RequirementChecker& checker);

  double designs_left() const { return options_.designs - static_cast<double>(designs_); }
  bool stopped() const { return designs_left() <= 0 || cancelled(); }

 private:
  bool cancelled() const { return options_.cancelled && options_.cancelled(); }

  const DeformationModel& space_;
  const Candidate& design_;
  const DiagnosisOptions& options_;
  std::vector<Handle> handles_;
  std::vector<Eigen::Vector3d> centres_;  ///< of the handles, at rest
  std::int64_t designs_ = 0;              ///< designs made
};

}  // namespace stackabilization::detail
