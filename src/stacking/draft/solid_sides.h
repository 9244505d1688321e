#pragma once

#include <Eigen/Core>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <memory>

#include "stackabilization/core/shape.h"
#include "stacking/draft/pieces.h"
#include "stacking/validation/solid_location.h"

namespace stackabilization::detail {

/// Tells surfaces of a shape from those inside of it, where its parts touch or overlap. Only parts with
/// closed surfaces have an inside. Safe to share between threads.
class SolidSides {
 public:
  /// `reach`: distance beside a surface at which one looks for solid, model units.
  SolidSides(const Shape& shape, double reach);

  /// Returns whether solid lies on both sides of a piece: at its centre and halfway to its corners. `normal`
  /// is a unit vector. Exact for these points.
  bool both(const Piece& piece, const Eigen::Vector3d& normal) const;
  /// Returns whether a point lies in the solid or on its surface. Exact.
  bool contains(const Eigen::Vector3d& point) const;

 private:
  using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Corner>;

  bool both(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  double reach_;
  /// Boxes of the connected components of the closed parts.
  boost::geometry::index::rtree<Box, boost::geometry::index::rstar<16>> boxes_;
  Shape solid_;                                  ///< the closed parts
  std::unique_ptr<const SolidLocator> locator_;  ///< null where there is none
};

}  // namespace stackabilization::detail
