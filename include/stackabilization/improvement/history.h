#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/improvement/design.h"

namespace stackabilization {

/// One step of an editing session.
struct HistoryNode {
  int parent = -1;          ///< row of History::nodes, above this one; -1 for the root, the shape at rest
  std::vector<Edit> edits;  ///< made on top of the parent's design; none for the root
  DeformationConstraints constraints;                    ///< under which they were made
  std::string name;                                      ///< for people, UTF-8; may be empty
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< r along which it was measured
  double stackability = 0;                               ///< S(M, r)
  double energy = 0;                                     ///< E(M)
};

/// The tree of all designs that were tried; the first node is the shape at rest. Nodes are never changed or
/// removed: rolling back makes another one current.
struct History {
  std::vector<HistoryNode> nodes;  ///< parents before children
  int current = 0;                 ///< row of `nodes`
};

/// All edits from rest to a node. Throws UsageError when there is none, or a parent is not above its child.
std::vector<Edit> edits_to(const History& history, int node);

/// The history with a further node, a child of the current one, which becomes current. Throws UsageError when
/// there is no current node.
History apply(History history, HistoryNode child);

/// The history with another node current. Throws UsageError when there is no such node.
History roll_back(History history, int node);

/// The design of a node: its edits made again, each under the constraints of its node. The same, to the bit,
/// every time. Throws UsageError when there is no such node, InputError naming the node when an edit is
/// refused or is none of this space.
Design design_at(const DesignSpace& space, const History& history, int node);

/// A structured shape with the history of its designs: what `suggest` and an interactive editor work on.
struct Project {
  StructuredShape rest;      ///< without edits
  History history;           ///< no nodes: nothing was tried yet
  DesignSpaceOptions space;  ///< what makes its designs
};

/// The project file of the shape at rest (structure/project_file.h) with the history as its last entry, left
/// out when it has no nodes:
///
///     "history": {"model": "controllers", "model_direction": [0, 0, 1], "current": 1, "nodes": [
///       {"parent": -1, "name": "", "direction": [0, 0, 1], "stackability": 0.41, "energy": 0},
///       {"parent": 0, "name": "", "direction": [0, 0, 1], "stackability": 0.52, "energy": -0.08,
///        "edits": [{"handle": {"kind": "section", "part": "leg", "index": 3}, "move": [0.1, 0, 0],
///                   "falloff": "linear"}],
///        "constraints": {"keep_extent": [0, 0, 1], "extent_ends": "fixed", "box_tolerance": 0.1,
///                        "fixed_parts": ["top"], "fixed_points": [[0, 0, 1]]}}]}
///
/// A handle of kind "part" has a part, "face", "corner" and "section" have part and index, "point" and "wire"
/// an index, "shape" nothing. An operation is "move": [x, y, z], "rotate": {"axis": [x, y, z], "radians": a}
/// or "scale": {"factor": f, "along": [x, y, z]}; `along`, `falloff` ("gaussian"), `extent_ends` ("free") and
/// every constraint may be left out. Numbers read back as the same doubles.
///
/// Throws InputError when the shape is invalid, or the history is none that could be read again.
std::string project_text(const Project& project);

/// Reads a project file with its history, if it has one. Throws InputError as `project_of_text`, with places
/// such as "/history/nodes/2/parent": unknown keys, parents that are not above their children, parts and
/// handles that the shape does not have, numbers that are not finite, factors that are not positive.
Project project_with_history(std::string_view text, const std::string& name);

/// The same with the text of a file; "-" is standard input.
Project read_project_with_history(const std::filesystem::path& path);

}  // namespace stackabilization
