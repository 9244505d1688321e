#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "stackabilization/structure/ctrl_grp_files.h"

namespace stackabilization::detail {

/// The frame of the authors' numbers: p = centre + scale q.
struct CtrlGrpFrame {
  Eigen::Vector3d centre;
  double scale;  ///< model units

  Eigen::Vector3d operator()(const Eigen::Vector3d& q) const { return centre + scale * q; }
};

/// Primitives of a `.ctrl` file in the frame of the shape, by row of `part_names`.
std::map<int, Primitive> parse_ctrl(const NamedText& controls, const std::vector<std::string>& part_names,
                                    const CtrlGrpFrame& frame);

/// A line of a `.grp` file.
struct CtrlGrpRelation {
  RelationType type;
  std::vector<int> parts;  ///< rows of `part_names`
  Points vectors;     ///< joint points, in the frame of the shape; normals of a self-symmetry, unit, or none
  int count = 0;      ///< of self-symmetries
  std::string place;  ///< "NAME:LINE"
};

std::vector<CtrlGrpRelation> parse_grp(const NamedText& groups, const std::vector<std::string>& part_names,
                                       const CtrlGrpFrame& frame);

}  // namespace stackabilization::detail
