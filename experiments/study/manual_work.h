#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/best_first.h"

namespace stackabilization::experiments {

/// How a simulated user chooses and decides. None of them plans: two edits that help only together are made
/// together by chance.
enum class Habit {
  random,   ///< tries one edit and keeps it unless S falls
  greedy,   ///< compares a few edits and keeps the one of most S, if that is more than before
  careful,  ///< takes hold only of parts that touch another copy, compares a few edits and keeps the one of
            ///< least E (Eq. 5), if that is less than before
};

/// "random", "greedy", "careful".
std::string name_of(Habit habit);

struct ManualUser {
  Habit habit = Habit::random;
  unsigned seed = 1;
  int max_edits = 200;  ///< tried before giving up, kept or not
  int compared = 8;     ///< edits tried from one design; all habits but random
};

/// The tool in the hands of a user: takes hold of what the automatic method takes hold of, makes its kinds of
/// edits under its constraints, and shows S along one direction after each. Const, safe from any number of
/// threads; the checker must outlive it.
class ManualTool {
 public:
  ManualTool(const RequirementChecker& checker, const Eigen::Vector3d& direction);

  Candidate at_rest() const;
  /// Parts, faces and corners of cuboids, cross-sections of generalized cylinders.
  const std::vector<Handle>& handles() const { return handles_; }
  /// Those of parts that touch another copy.
  std::vector<Handle> touching_handles(const Candidate& now) const;
  /// Right-handed and orthogonal, the third along the stacking direction.
  const Eigen::Matrix3d& frame() const { return frame_; }
  /// Of the shape at rest along an axis of the frame, model units.
  double extent(int axis) const { return extents_[axis]; }
  /// `now` with one more edit; nothing where the model refuses it or a part would be out of proportion.
  std::optional<Candidate> edited(const Candidate& now, const Edit& edit) const;
  /// Does it reach the target and pass every check?
  bool finished(const Candidate& candidate) const;

 private:
  Candidate measured(Design design) const;

  const RequirementChecker& checker_;
  Direction direction_;
  DeformationConstraints constraints_;
  EnergyMeter meter_;
  std::vector<Handle> handles_;
  Eigen::Matrix3d frame_;
  Eigen::Vector3d extents_;
  double before_;  ///< S at rest
};

/// What a user came to.
struct ManualWork {
  Candidate result;
  bool reached = false;
  int tried = 0;             ///< edits, kept or not
  std::vector<double> kept;  ///< S after each edit that was kept
};

/// The user at work until the target is reached or patience ends. Each edit takes hold of a random handle and
/// moves it along an axis of the frame, by up to 0.18 of the extent of the shape, or scales it, by up to 0.3
/// up or down: three times the paper's steps. A function of tool and user alone.
ManualWork worked(const ManualTool& tool, const ManualUser& user);

}  // namespace stackabilization::experiments
