#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "deformation/controllers/part_edit.h"
#include "deformation/controllers/rig.h"
#include "deformation/controllers/straightness.h"

namespace stackabilization::detail {

/// What a solver may change of every class of parts, and what it leaves alone.
class Corrections {
 public:
  explicit Corrections(const Rig& rig);

  /// Nothing may be changed of the class.
  void fix(int of_class);
  bool is_fixed(int of_class) const { return bases_[static_cast<std::size_t>(of_class)].cols() == 0; }
  /// Of the class that `edit` is made on, what changes none of these linear functions of its control values,
  /// and dearly.
  void hold(const PartEdit& edit, Eigen::MatrixXd rows);
  /// What is straight in these states may be corrected only so that it stays so. Call last.
  void keep_straight(const std::vector<ControlState>& states);

  /// Per class: columns of changes of control values, all of the same price.
  const std::vector<Eigen::MatrixXd>& bases() const { return bases_; }
  /// Takes back what a step along the columns did to higher order, and gives the columns that belong to the
  /// new states.
  void settle(std::vector<ControlState>& states);

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
  std::vector<std::optional<StraightCorrections>> straight_;  ///< per class
  std::vector<ControlState> start_;
};

}  // namespace stackabilization::detail
