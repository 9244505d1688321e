#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Suffix of project files by convention.
inline constexpr std::string_view project_suffix = ".stackabilize.json";

/// A structured shape as one JSON text for people to read and correct: parts with their primitives,
/// symmetries, relations by part names, and last the mesh, a vertex or triangle per line.
///
///     {"format": "stackabilize project", "version": 1, "unit": "mm",
///      "parts": [{"name": "leg", "primitive": {"kind": "cuboid", "centre": [0, 0, 0],
///                 "half_axes": [[1, 0, 0], [0, 2, 0], [0, 0, 3]]},
///                 "fit": {"cuboid_error": 0.01, "cylinder_error": 0.2, "note": ""}}, ...],
///      "symmetries": [{"kind": "reflection", "point": [0, 0, 0], "axis": [1, 0, 0]}],
///      "relations": [{"type": "symmetry", "parts": ["leg", "leg_2"], "symmetry": {...}, "residual": 0},
///                    {"type": "point_joint", "parts": ["leg", "top"], "points": [[0, 0, 3]], "residual":
///                    0}],
///      "mesh": {"vertices": [[x, y, z], ...], "triangles": [[a, b, c, part], ...]}}
///
/// A primitive is a cuboid by `centre` and `half_axes` (vectors from the centre to three faces), once it is
/// no such box by its eight `corners`, or {"kind": "cylinder", "closed": false, "sections": [[x, y, z,
/// radius], ...]}, with "rotation": [w, x, y, z] where it was turned. `unit` is um, mm, cm, m, in, ft or
/// unknown. Numbers are written so that they read back as the same doubles; `centre` and `half_axes` are
/// rounded to 2^-48 of the cuboid's largest coordinate first, once.
///
/// A last entry, "history", is for modules built on this one (`ProjectSections`).
///
/// Throws InputError when `structured` is invalid or a part name is not UTF-8.
std::string project_text(const StructuredShape& structured);

/// Entries of a project file that are written and understood elsewhere: the JSON text of each value; nothing
/// where the file has no such entry.
struct ProjectSections {
  std::optional<std::string> history;  ///< the designs that were tried: see improvement/history.h
};

/// The same with further entries, their texts as they are. Precondition: each is one JSON value.
std::string project_text(const StructuredShape& structured, const ProjectSections& sections);

/// Writes that text (`write_file_atomically`). Throws OutputError as well.
void write_project(const StructuredShape& structured, const std::filesystem::path& path);

/// Reads a project. Primitives that miss a symmetry, after editing by hand, are made symmetric
/// (`symmetrize`).
///
/// Throws InputError, one sentence with `name`, the place as a JSON pointer ("/parts/2/primitive/half_axes";
/// the line for text that is no JSON) and what was expected there, for anything that is not as described
/// above: unknown and repeated keys, missing entries, wrong types and sizes, names of parts that do not
/// exist, numbers that are not finite, relations that contradict each other. Sections are passed over.
StructuredShape project_of_text(std::string_view text, const std::string& name);

/// The same with the text of a file; "-" is standard input.
StructuredShape read_project(const std::filesystem::path& path);

/// A project with the entries that this module does not look into.
struct ProjectContents {
  StructuredShape structured;  ///< what `project_of_text` gives
  ProjectSections sections;    ///< as texts
};

/// As `project_of_text`; the sections are JSON, and whoever knows them checks the rest.
ProjectContents project_contents(std::string_view text, const std::string& name);

}  // namespace stackabilization
