#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Conventional suffix of project files.
inline constexpr std::string_view project_suffix = ".stackabilize.json";

/// Writes a structured shape as one JSON text for people to read and correct. It holds the parts with their
/// primitives, the symmetries, the relations by part names, and last the mesh, with one vertex or triangle
/// per line.
///
///     {"format": "stackabilize project", "version": 1, "unit": "mm",
///      "parts": [{"name": "leg", "primitive": {"kind": "cuboid", "centre": [0, 0, 0],
///                 "half_axes": [[1, 0, 0], [0, 2, 0], [0, 0, 3]]},
///                 "fit": {"cuboid_error": 0.01, "cylinder_error": 0.2, "note": ""}}, ...],
///      "symmetries": [{"kind": "reflection", "point": [0, 0, 0], "axis": [1, 0, 0]}],
///      "relations": [{"type": "symmetry", "parts": ["leg", "leg_2"], "symmetry": {...}, "residual": 0},
///                    {"type": "point_joint", "parts": ["leg", "top"], "points": [[0, 0, 3]],
///                     "residual": 0}],
///      "mesh": {"vertices": [[x, y, z], ...], "triangles": [[a, b, c, part], ...]}}
///
/// A cuboid that is a box has `centre` and `half_axes`, the vectors from the centre to three faces. Any other
/// cuboid has its eight `corners`. A generalized cylinder is {"kind": "cylinder", "closed": false,
/// "sections": [[x, y, z, radius], ...]}, with an entry "rotation": [w, x, y, z] when it was rotated. `unit`
/// is um, mm, cm, m, in, ft or unknown. Reading the numbers gives the same doubles. Before writing, `centre`
/// and `half_axes` are rounded once to 2^-48 of the largest coordinate of the cuboid.
///
/// An optional last entry, "history", belongs to other modules (`ProjectSections`).
///
/// Throws InputError when `structured` is invalid or a part name is not UTF-8.
std::string project_text(const StructuredShape& structured);

/// Entries of a project file that other modules write and read, each as the JSON text of its value. A missing
/// entry is empty.
struct ProjectSections {
  std::optional<std::string> history;  ///< designs that were tried, see improvement/history.h
};

/// Writes the same text with further entries. Precondition: each section is one JSON value; it is copied
/// verbatim.
std::string project_text(const StructuredShape& structured, const ProjectSections& sections);

/// Writes the project text to a file with `write_file_atomically`. Also throws OutputError.
void write_project(const StructuredShape& structured, const std::filesystem::path& path);

/// Reads a project. Primitives that violate a symmetry relation, for instance after editing by hand, are
/// symmetrized (`symmetrize`). Sections are ignored.
///
/// Throws InputError for any text that differs from the description above: unknown and repeated keys, missing
/// entries, wrong types and sizes, names of parts that do not exist, numbers that are not finite, and
/// relations that contradict each other. The message is one sentence with `name`, the place and the expected
/// content. The place is a JSON pointer ("/parts/2/primitive/half_axes"), or the line when the text is not
/// JSON.
StructuredShape project_of_text(std::string_view text, const std::string& name);

/// Reads a project from a file; "-" is standard input.
StructuredShape read_project(const std::filesystem::path& path);

/// A project together with the entries of other modules.
struct ProjectContents {
  StructuredShape structured;  ///< result of `project_of_text`
  ProjectSections sections;    ///< JSON texts of the entries of other modules
};

/// Reads a project with its sections. The function checks only that sections are JSON. Throws as
/// `project_of_text` does.
ProjectContents project_contents(std::string_view text, const std::string& name);

}  // namespace stackabilization
