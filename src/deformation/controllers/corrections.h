#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "deformation/controllers/part_edit.h"
#include "deformation/controllers/rig.h"
#include "deformation/controllers/straightness.h"

namespace stackabilization::detail {

/// Corrections that a solver may apply to every class of parts, and the restrictions on them.
class CorrectionSpace {
 public:
  /// `bases`: those of the rig, or its free ones.
  CorrectionSpace(const Rig& rig, const std::vector<Eigen::MatrixXd>& bases);

  /// Forbids all corrections of the class.
  void fix(int of_class);
  bool is_fixed(int of_class) const { return bases_[static_cast<std::size_t>(of_class)].cols() == 0; }
  /// Restricts corrections of the edited class to the null space of `rows`, at weight 1/0.3^2. `rows`: linear
  /// functions of the control values of the class, one per row.
  void hold(const PartEdit& edit, Eigen::MatrixXd rows);
  /// Restricts corrections of the cylinders that are straight in `states` to those that keep them straight.
  /// Call it after all other restrictions.
  void keep_straight(const std::vector<ControlState>& states);

  /// Returns, per class, columns of changes of control values. All columns have the same cost.
  const std::vector<Eigen::MatrixXd>& bases() const { return bases_; }
  /// Removes the higher-order effects of a step along the columns from `states`, and recomputes the columns
  /// for the new states.
  void retract(std::vector<ControlState>& states);

 private:
  struct Held {
    PartEdit edit;
    Eigen::MatrixXd rows;
  };

  void allow(int of_class, const Eigen::MatrixXd& columns);
  StraightHandle handle_in(int of_class) const;

  const Rig& rig_;
  std::vector<Eigen::MatrixXd> bases_;
  std::optional<Held> held_;
  std::vector<std::optional<StraightCorrections>> straight_;  ///< per class; only for straight cylinders
  std::vector<ControlState> start_;
};

}  // namespace stackabilization::detail
