#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "stackabilization/structure/ctrl_grp_files.h"

namespace stackabilization::detail {

/// Frame of the numbers in the authors' files: p = centre + scale q.
struct CtrlGrpFrame {
  Eigen::Vector3d centre;  ///< origin of the frame, model units
  double scale;            ///< length of its unit, model units

  /// Maps a point q of the files to model units.
  Eigen::Vector3d operator()(const Eigen::Vector3d& q) const { return centre + scale * q; }
};

/// Reads the primitives of a `.ctrl` file, in the frame of the shape, by row of `part_names`. Throws
/// InputError as `read_ctrl_grp` does.
std::map<int, Primitive> parse_ctrl(const NamedText& controls, const std::vector<std::string>& part_names,
                                    const CtrlGrpFrame& frame);

/// A line of a `.grp` file.
struct CtrlGrpRelation {
  RelationType type;
  std::vector<int> parts;  ///< rows of `part_names`
  /// Points of a joint in the frame of the shape, or unit normals of a self-symmetry; may be empty.
  Points vectors;
  int count = 0;      ///< number of self-symmetries
  std::string place;  ///< "NAME:LINE", for messages
};

/// Reads the relations of a `.grp` file. Throws InputError as `read_ctrl_grp` does.
std::vector<CtrlGrpRelation> parse_grp(const NamedText& groups, const std::vector<std::string>& part_names,
                                       const CtrlGrpFrame& frame);

}  // namespace stackabilization::detail
