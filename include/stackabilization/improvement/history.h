#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/deformation/factory.h"

namespace stackabilization {

/// A step of an editing session.
struct HistoryNode {
  int parent = -1;          ///< row of the parent in History::nodes, less than its own; -1 for the root
  std::vector<Edit> edits;  ///< edits made to the parent's design; none for the root
  DeformationConstraints constraints;                    ///< constraints under which the edits were made
  std::string name;                                      ///< name for people, UTF-8; may be empty
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< r, direction of the measures
  double stackability = 0;                               ///< S(M, r)
  double energy = 0;                                     ///< E(M), Eq. 5
};

/// Tree of all designs of an editing session. The first node, the root, is the shape at rest. Nodes are never
/// changed or removed: rolling back makes another node current.
struct History {
  std::vector<HistoryNode> nodes;  ///< parents before children
  int current = 0;                 ///< row of the current node
};

/// Returns all edits from rest to a node, in order. Throws UsageError when there is no such node, or when a
/// parent does not come before its child.
std::vector<Edit> edits_to(const History& history, int node);

/// Returns the history with `child` added as a child of the current node; the new node is current. Throws
/// UsageError when there is no current node.
History apply(History history, HistoryNode child);

/// Returns the history with `node` current. Throws UsageError when there is no such node.
History roll_back(History history, int node);

/// Makes the design of a node again: each step's edits under that step's constraints. Equal calls give equal
/// designs, to the bit. Throws UsageError when there is no such node. Throws InputError naming the node when
/// an edit is refused or does not belong to this space.
Design design_at(const DeformationModel& space, const History& history, int node);

/// A structured shape with the history of its designs: the document of `suggest` and of an interactive
/// editor.
struct Project {
  StructuredShape rest;           ///< the shape without edits
  History history;                ///< its designs; no nodes before the first step
  DeformationModelOptions space;  ///< deformation model that makes the designs
};

/// Returns the project file of the shape at rest (structure/project_file.h). The history is its last entry,
/// left out when it has no nodes:
///
///     "history": {"model": "controllers", "model_direction": [0, 0, 1], "current": 1, "nodes": [
///       {"parent": -1, "name": "", "direction": [0, 0, 1], "stackability": 0.41, "energy": 0},
///       {"parent": 0, "name": "", "direction": [0, 0, 1], "stackability": 0.52, "energy": -0.08,
///        "edits": [{"handle": {"kind": "section", "part": "leg", "index": 3}, "move": [0.1, 0, 0],
///                   "falloff": "linear"}],
///        "constraints": {"keep_extent": [0, 0, 1], "extent_ends": "fixed", "box_tolerance": 0.1,
///                        "fixed_parts": ["top"], "fixed_points": [[0, 0, 1]]}}]}
///
/// Handles: kind "part" has a part; "face", "corner" and "section" have part and index; "point" and "wire"
/// have an index; "shape" has neither. An operation is "move": [x, y, z], "rotate": {"axis": [x, y, z],
/// "radians": a} or "scale": {"factor": f, "along": [x, y, z]}. Optional: `model_direction`, `along`,
/// `falloff` (default "gaussian"), `extent_ends` (default "free") and every constraint. Numbers read back as
/// the same doubles.
///
/// Throws InputError when the shape is invalid, or when the history could not be read back.
std::string project_text(const Project& project);

/// Returns an edit as JSON, in the form that is shown above. Throws InputError when it is an edit of a part
/// that is no row of `part_names`.
std::string edit_json(const Edit& edit, const std::vector<std::string>& part_names);

/// Reads a project file with its history, if it has one. Throws InputError as `project_of_text`, with places
/// such as "/history/nodes/2/parent", for unknown keys, parents that do not come before their children, parts
/// and handles that the shape does not have, numbers that are not finite, and factors that are not positive.
Project project_with_history(std::string_view text, const std::string& name);

/// Reads the project file at `path` in the same way; "-" is standard input.
Project read_project_with_history(const std::filesystem::path& path);

}  // namespace stackabilization
