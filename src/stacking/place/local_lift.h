#pragma once

#include <Eigen/Core>
#include <map>

#include "stackabilization/envelope/separation.h"
#include "stacking/place/local_frame.h"
#include "stacking/place/place_region.h"

namespace stackabilization::detail {

/// A lift, and the points across r that touch; those of the shape before it is turned and moved.
struct Touch {
  double lift = 0;
  bool on_floor = true;
  Eigen::Vector2d of_shape = Eigen::Vector2d::Zero(), of_base = Eigen::Vector2d::Zero();
};

/// Lifts of the local coordinates along the third axis, exact for these, rounded. Keeps a reference to the
/// shapes; not for several threads at a time.
class LocalLift {
 public:
  LocalLift(const LocalShapes& shapes, ContactSemantics semantics);

  /// Returns the lift at which the shape stands on the floor.
  double floor() const { return floor_; }
  /// Returns the lift at which the shape comes to rest at a place.
  Touch operator()(const LocalPlace& place);

 private:
  const SeparationTree& turned(double yaw);

  const LocalShapes& shapes_;
  ContactSemantics semantics_;
  SeparationTree base_;
  double floor_ = 0;
  std::map<double, SeparationTree> trees_;  ///< of the turned shape, by its yaw
};

}  // namespace stackabilization::detail
